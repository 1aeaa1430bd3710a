//! The lattice around the domain in the files.

use crate::{CYLINDER, Desk};

/// The rows of a CSV file: x, y, kind.
fn rows(desk: &Desk, name: &str) -> Vec<([f64; 2], String)> {
    let text = String::from_utf8(desk.read(name)).expect("text");
    let number = |field: &str| field.parse::<f64>().expect("a number");
    text.lines()
        .skip(1)
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            ([number(fields[1]), number(fields[2])], fields[3].to_owned())
        })
        .collect()
}

fn scene(around: &str) -> String {
    format!("{CYLINDER}[output]\nsurroundings = {around}\n")
}

#[test]
fn the_lattice_goes_on() {
    let desk = Desk::new().with("alone.toml", CYLINDER).with(
        "around.toml",
        scene("{ min = [-3.0, -2.0], max = [5.0, 4.0] }"),
    );
    desk.succeed(&["pack", "alone.toml", "-o", "alone.csv"]);
    desk.succeed(&["pack", "around.toml", "-o", "around.csv"]);
    let (alone, around) = (rows(&desk, "alone.csv"), rows(&desk, "around.csv"));
    let in_domain = |rows: &[([f64; 2], String)]| -> Vec<([f64; 2], String)> {
        (rows.iter().filter(|row| row.1 != "frozen").cloned()).collect()
    };
    assert_eq!(in_domain(&alone), in_domain(&around));
    // As many as the boxes' areas ask for, none of them within the domain.
    let more: Vec<[f64; 2]> = (around.iter().filter(|row| row.1 == "frozen"))
        .map(|row| row.0)
        .collect();
    let due = (8.0 * 6.0 - 16.0) / 16.0 * in_domain(&alone).len() as f64;
    assert!(
        (more.len() as f64 / due - 1.0).abs() < 0.05,
        "{} {due}",
        more.len()
    );
    for p in &more {
        let within =
            |low: [f64; 2], high: [f64; 2]| (0..2).all(|k| low[k] <= p[k] && p[k] <= high[k]);
        assert!(
            within([-3.0, -2.0], [5.0, 4.0]) && !within([-2.0; 2], [2.0; 2]),
            "{p:?}"
        );
    }
    // Where the frozen layer was they are the same.
    for (p, kind) in &alone {
        let is_around = (-2.0..=4.0).contains(&p[1]) && (-3.0..=5.0).contains(&p[0]);
        if kind == "frozen" && is_around {
            let same = |q: &[f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]) < 1e-9;
            assert!(more.iter().any(same), "{p:?}");
        }
    }
}

#[test]
fn what_is_not_around_is_refused() {
    let desk = Desk::new()
        .with(
            "small.toml",
            scene("{ min = [-1.0, -2.0], max = [5.0, 4.0] }"),
        )
        .with("flat.toml", scene("{ min = [-3.0], max = [5.0] }"))
        .with(
            "huge.toml",
            scene("{ min = [-1e9, -1e9], max = [1e9, 1e9] }"),
        )
        .with(
            "none.toml",
            format!(
                "{}[fluid]\nfill = false\n",
                scene("{ min = [-3.0, -3.0], max = [3.0, 3.0] }")
            ),
        );
    for (name, parts) in [
        ("small.toml", ["output.surroundings", "axis 0"]),
        ("flat.toml", ["output.surroundings.min", "2"]),
        ("huge.toml", ["particles", "GiB"]),
        ("none.toml", ["output.surroundings", "leave it out"]),
    ] {
        desk.refuse(&["pack", name, "-o", "out.csv"], &parts);
    }
}
