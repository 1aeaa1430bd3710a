//! Anybody's particles.

use serde_json::Value;

use crate::Desk;

/// A square lattice with spacing 0.1.
fn lattice(header: &str, row: impl Fn(f64, f64) -> String) -> String {
    let mut text = header.to_owned() + "\n";
    for i in 0..24 {
        for j in 0..24 {
            text += &(row(0.1 * f64::from(i), 0.1 * f64::from(j)) + "\n");
        }
    }
    text
}

fn answer(desk: &Desk, arguments: &[&str]) -> Value {
    let mut all = vec!["quality", "p.csv", "--spacing", "0.1", "--json"];
    all.extend(arguments);
    serde_json::from_str(&desk.succeed(&all).stdout).expect("JSON")
}

#[test]
fn a_perfect_lattice() {
    let desk = Desk::new().with("p.csv", lattice("x,y", |x, y| format!("{x},{y}")));
    let found = answer(&desk, &[]);
    assert_eq!(found["dimension"], 2);
    assert_eq!(found["particles"]["total"], 576);
    assert!(found["particles"]["left_out_near_edge"].as_u64() > Some(200));
    assert!(
        found["density"]["linf"].as_f64().expect("a number") < 1e-4,
        "{found}"
    );
    assert!(
        found["residual"]["max"].as_f64().expect("a number") < 1e-9,
        "{found}"
    );
    // Short kernels are biased on a lattice.
    let biased = answer(
        &desk,
        &["--kernel", "wendland-c2", "--h-over-spacing", "1.3"],
    );
    assert!(
        (biased["density"]["max"].as_f64().expect("a number") - 1.0105).abs() < 1e-4,
        "{biased}"
    );
    let words = desk
        .succeed(&["quality", "p.csv", "--spacing", "0.1"])
        .stdout;
    assert!(
        words.contains("left out") && words.contains("measured"),
        "{words}"
    );
}

#[test]
fn volumes_and_frozen_rows_count() {
    let half = lattice("y,x,volume", |x, y| format!("{y},{x},0.005"));
    let ending =
        Desk::new()
            .with("p.csv", half)
            .run(&["quality", "p.csv", "--spacing", "0.1", "--json"]);
    // Half of what should be there is not sound.
    assert_eq!(ending.status, Some(3), "{ending:?}");
    let found: Value = serde_json::from_str(&ending.stdout).expect("JSON");
    assert_eq!(found["audit"]["passed"], false);
    assert!(
        (found["density"]["max"].as_f64().expect("a number") - 0.5).abs() < 1e-4,
        "{found}"
    );
    let ringed = lattice("x,y,kind", |x, y| {
        let is_inner = [x, y].iter().all(|v| (0.45..1.85).contains(v));
        format!("{x},{y},{}", if is_inner { "free" } else { "frozen" })
    });
    let found = answer(&Desk::new().with("p.csv", ringed), &[]);
    assert_eq!(found["particles"]["measured"], 14 * 14);
    assert_eq!(found["particles"]["left_out_near_edge"], 0);
}

#[test]
fn files_of_numpy_and_pysph() {
    let plain = lattice("x,y", |x, y| format!("{x},{y}"));
    let figures = answer(&Desk::new().with("p.csv", &plain), &[]);
    let same = |name: &str, content: Vec<u8>, more: &[&str]| {
        let desk = Desk::new().with(name, content);
        let all = [&["quality", name, "--spacing", "0.1", "--json"], more].concat();
        let found: Value = serde_json::from_str(&desk.succeed(&all).stdout).expect("JSON");
        assert_eq!(found["particles"], figures["particles"], "{name}");
        found
    };
    // numpy.savetxt as it is by default, with and without a header.
    for header in ["# x y", "# made by hand"] {
        let text = lattice(header, |x, y| format!("{x:.18e} {y:.18e}"));
        for name in ["p.csv", "p.txt", "p.dat"] {
            let found = same(name, text.clone().into_bytes(), &[]);
            assert_eq!(found["density"], figures["density"]);
        }
    }
    // numpy.save of an array of two columns.
    let mut array =
        b"\x93NUMPY\x01\x00\x76\x00{'descr': '<f8', 'fortran_order': False, 'shape': (576, 2), }"
            .to_vec();
    array.resize(127, b' ');
    array.push(b'\n');
    for i in 0..24 {
        for j in 0..24 {
            array.extend((0.1 * f64::from(i)).to_le_bytes());
            array.extend((0.1 * f64::from(j)).to_le_bytes());
        }
    }
    assert_eq!(same("p.npy", array, &[])["density"], figures["density"]);
    // PySPH's names: volumes are m / rho, and its h measures unless another is asked for.
    let table = lattice("X,Y,m,rho,h", |x, y| format!("{x},{y},20,2000,0.13"));
    let found = same(
        "p.csv",
        table.clone().into_bytes(),
        &["--h-over-spacing", "1.2"],
    );
    assert_eq!(found["h_over_spacing"], 1.2);
    let gamma = |of: &Value| of["density"]["max"].as_f64().expect("a number");
    assert!((gamma(&found) - gamma(&figures)).abs() < 1e-9, "{found}");
    let desk = Desk::new().with("p.csv", &table);
    let ratio = answer(&desk, &[])["h_over_spacing"]
        .as_f64()
        .expect("a number");
    assert!((ratio - 1.3).abs() < 1e-12, "{ratio}");
    // Lengths of no sense, or several, are passed over, and so are densities that were never set.
    for (row, max) in [("20,0,0", 1.0), ("20,2000,99", 1.0), ("10,2000,-1", 0.5)] {
        let text = lattice("x,y,m,rho,h", |x, y| format!("{x},{y},{row}"));
        let ending = Desk::new().with("p.csv", text).run(&[
            "quality",
            "p.csv",
            "--spacing",
            "0.1",
            "--json",
        ]);
        let found: Value = serde_json::from_str(&ending.stdout).expect("JSON");
        assert_eq!(found["h_over_spacing"], 1.2, "{row}");
        assert!((gamma(&found) - max).abs() < 1e-4, "{row}: {found}");
    }
}

#[test]
fn bad_particle_files() {
    let refuse = |content: &str, parts: &[&str]| {
        let desk = Desk::new().with("p.csv", content);
        let mut all = vec!["p.csv"];
        all.extend(parts);
        desk.refuse(&["quality", "p.csv", "--spacing", "0.1"], &all);
    };
    refuse("", &["empty"]);
    refuse("x,y\n", &["no particles"]);
    refuse("a,b\n1,2\n", &["no column \"x\""]);
    refuse("x,y\n0,0\n0,nan\n", &["p.csv:3", "finite"]);
    refuse("x,y\n0,0\n1,1e300\n", &["finite number"]);
    refuse("x,y,volume\n0,0,-1\n", &["volume -1"]);
    refuse(
        "x,y,m,rho\n0,0,1,1000\n1,0,1,0\n",
        &["m = 1 and rho = 0", "volume"],
    );
    refuse("1,2,3,4\n", &["p.csv:1", "which are x and y"]);
    refuse("x,y,kind\n0,0,frozn\n", &["did you mean \"frozen\"?"]);
    refuse("x,y\n0,0\n0.1,0\n0.2,0\n", &["nothing can be measured"]);
    refuse("x,y,kind\n0,0,frozen\n", &["nothing can be measured"]);
    let desk = Desk::new()
        .with("p.csv", "x,y\n0,0\n")
        .with("p.vtu", "<VTKFile")
        .with("p.npy", "1 2 3")
        .with("p.xyz", "1 2 3");
    desk.refuse(
        &["quality", "nothing.csv", "--spacing", "0.1"],
        &["nothing.csv", "no such file"],
    );
    desk.refuse(&["quality", "p.vtu", "--spacing", "0.1"], &["p.vtu", "VTU"]);
    desk.refuse(
        &["quality", "p.npy", "--spacing", "0.1"],
        &["p.npy", "numpy.save"],
    );
    desk.refuse(
        &["quality", "p.xyz", "--spacing", "0.1"],
        &["p.xyz", "vtu, csv"],
    );
    desk.refuse(&["quality", "p.csv", "--spacing", "0"], &["--spacing is 0"]);
    desk.refuse(
        &["quality", "p.csv", "--spacing", "0.1", "--kernel", "quint"],
        &["did you mean \"quintic\"?"],
    );
    desk.refuse(
        &[
            "quality",
            "p.csv",
            "--spacing",
            "0.1",
            "--h-over-spacing",
            "nan",
        ],
        &["--h-over-spacing is NaN"],
    );
}
