//! Particles in every format.

use serde_json::Value;
use sphpack::files::{Columns, PARTICLE_FORMATS};

use crate::{CYLINDER, Desk};

/// Two bodies of different densities, one with an awkward name.
const TWO: &str = "\
spacing = 0.2
[domain]
min = [-2.0, -1.0]
max = [2.0, 1.0]
[[body]]
name = \"left; 'wing', \\\"öl\\\"\"
density = 2.5
shape = { circle = { center = [-1.0, 0.0], radius = 0.6 } }
[[body]]
name = \"right\"
density = 0.125
shape = { circle = { center = [1.0, 0.0], radius = 0.6 } }
[fluid]
density = 0.5
[output]
include = [\"free\", \"boundary\"]
";

/// `-o` for every format.
fn all_outputs() -> Vec<String> {
    PARTICLE_FORMATS
        .iter()
        .flat_map(|(_, ending)| ["-o".to_owned(), format!("o.{ending}")])
        .collect()
}

#[test]
fn all_formats_say_the_same() {
    let desk = Desk::new().with("two.toml", TWO);
    let outputs = all_outputs();
    let mut arguments = vec!["pack", "two.toml", "--report", "o.json"];
    arguments.extend(outputs.iter().map(String::as_str));
    desk.succeed(&arguments);
    let report: Value = serde_json::from_slice(&desk.read("o.json")).expect("JSON");
    let asked_for = ["free", "boundary"].map(|kind| report["particles"][kind].as_u64());
    let asked_for: u64 = asked_for.iter().flatten().sum();
    assert!(report["particles"]["total"].as_u64() > Some(asked_for));

    let csv = Columns::read(&desk.path().join("o.csv")).expect("columns");
    assert_eq!(csv.numbers["x"].len() as u64, asked_for);
    for ending in ["npz", "vtu", "vtp", "vtk", "ply"] {
        let name = format!("o.{ending}");
        let columns = Columns::read(&desk.path().join(&name)).expect("columns");
        for (column, numbers) in &csv.numbers {
            assert_eq!(columns.numbers[column], *numbers, "{name} {column}");
        }
        assert_eq!(columns.words, csv.words, "{name}");
        let ending = desk.succeed(&["quality", &name, "--spacing", "0.2", "--json"]);
        let found: Value = serde_json::from_str(&ending.stdout).expect("JSON");
        assert_eq!(found["particles"]["total"], asked_for);
        assert_eq!(found["dimension"], 2);
    }

    // A body's mass is its density times its volume.
    let words = &csv.words["body"];
    for (body, density) in [("left; 'wing', \"öl\"", 2.5), ("right", 0.125), ("", 0.5)] {
        let rows: Vec<usize> = (0..words.len()).filter(|&i| words[i] == body).collect();
        assert!(rows.len() > 10, "{body}");
        for i in rows {
            let is = csv.numbers["mass"][i] / csv.numbers["volume"][i];
            assert!((is / density - 1.0).abs() < 1e-12, "{body}");
            let is_solid = csv.words["side"][i] == "solid";
            assert_eq!(is_solid, !body.is_empty());
        }
    }
}

/// With all that a file may hold: frozen particles, pressure and density.
#[test]
fn whatever_is_written_is_measured() {
    let more = "\
[fluid]
hydrostatic = { gravity = [0.0, -9.81], level = 4.0, sound_speed = 90.0 }
[output]
include = [\"free\", \"boundary\", \"fixed\", \"frozen\"]
";
    let scene = CYLINDER.to_owned() + more;
    let desk = Desk::new().with("box.toml", scene);
    let outputs = all_outputs();
    let mut arguments = vec!["pack", "box.toml"];
    arguments.extend(outputs.iter().map(String::as_str));
    desk.succeed(&arguments);
    let answers: Vec<Value> = PARTICLE_FORMATS
        .iter()
        .map(|(_, ending)| {
            let name = format!("o.{ending}");
            let said = desk.succeed(&["quality", &name, "--spacing", "0.2", "--json"]);
            serde_json::from_str(&said.stdout).expect("JSON")
        })
        .collect();
    assert!(answers[0]["particles"]["frozen"].as_u64() > Some(100));
    for answer in &answers {
        assert_eq!(answer, &answers[0]);
    }
}

#[test]
fn no_format_is_replaced_without_force() {
    for (_, ending) in PARTICLE_FORMATS {
        let name = format!("o.{ending}");
        let desk = Desk::new().with("two.toml", TWO).with(&name, "precious");
        desk.refuse(&["pack", "two.toml", "-o", &name], &[&name, "--force"]);
        assert_eq!(desk.read(&name), b"precious");
    }
}
