//! Meshes with defects, in every format: mended alike, or refused alike.

use serde_json::Value;

use crate::body_formats::{obj, ply};
use crate::dirty_meshes::{Triangles, sphere};
use crate::{Desk, stl};

/// The same triangles in every format, to the bit.
fn desk(triangles: &Triangles) -> (Desk, [&'static str; 3]) {
    let desk = Desk::new()
        .with("body.stl", stl(triangles))
        .with("body.obj", obj(triangles))
        .with("body.ply", ply(triangles));
    (desk, ["body.stl", "body.obj", "body.ply"])
}

/// What `check` finds, without the file's name and format.
fn found(desk: &Desk, name: &str) -> Value {
    let ending = desk.run(&["check", name, "--json", "--spacing", "0.1"]);
    let mut found: Value = serde_json::from_str(&ending.stdout).expect("JSON");
    assert_eq!(ending.status == Some(0), found["can_be_packed"] == true);
    let keys = found.as_object_mut().expect("an object");
    assert_eq!(keys.remove("file"), Some(name.into()));
    assert_eq!(keys.remove("format"), Some(name[5..].into()));
    found
}

#[test]
fn flips_and_a_small_hole_are_mended() {
    let mut triangles = sphere([0.0; 3]);
    triangles.swap_remove(1000);
    for t in triangles.iter_mut().skip(7).step_by(40) {
        t.swap(0, 1);
    }
    let (desk, names) = desk(&triangles);
    let mut reports = Vec::new();
    for name in names {
        let ending = desk.succeed(&[
            "pack",
            name,
            "--spacing",
            "0.1",
            "-o",
            "out.csv",
            "--report",
            "out.json",
            "--force",
        ]);
        let report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
        let body = &report["bodies"][0];
        let repairs = body["repairs"].as_array().expect("a list").clone();
        assert_eq!(repairs.len(), 2, "{name}: {repairs:?}");
        for (words, part) in repairs
            .iter()
            .zip(["faced the other way", "1 hole was closed"])
        {
            let words = words.as_str().expect("a sentence");
            assert!(words.contains(part), "{name}: {words}");
            let warning = format!("sphpack: warning: body \"body\": {words}");
            assert!(
                ending.stderr.contains(&warning),
                "{name}: {}",
                ending.stderr
            );
        }
        assert!(
            ending.stdout.contains("mesh, 5,119 triangles"),
            "{}",
            ending.stdout
        );
        reports.push((body.clone(), found(&desk, name)));
    }
    assert!(
        reports.windows(2).all(|pair| pair[0] == pair[1]),
        "{reports:?}"
    );
}

#[test]
fn large_holes_are_refused() {
    let capless: Triangles = sphere([0.0; 3])
        .into_iter()
        .filter(|t| t.iter().any(|p| p[2] <= 0.45))
        .collect();
    let (desk, names) = desk(&capless);
    for name in names {
        let cure = format!("sphpack check {name}");
        desk.refuse(
            &["pack", name, "--spacing", "0.1"],
            &[name, "not closed", "1 hole of", "near (", &cure],
        );
        assert_eq!(found(&desk, name), found(&desk, names[0]));
    }
}

#[test]
fn check_reads_what_pack_reads() {
    let desk = Desk::new()
        .with("square.csv", "x,y\n0,0\n1,0\n1,1\n0,1\n")
        .with(
            "square.dat",
            "a square\n3. 3.\n\n0 0\n0 1\n1 1\n\n0 0\n1 0\n1 1\n",
        )
        .with(
            "square.svg",
            "<svg viewBox='0 0 5 5'><rect x='1' y='1' width='1' height='1'/></svg>",
        )
        // Content counts, not the name.
        .with("square.stl", "0 0\n1 0\n1 1\n0 1\n");
    for (name, read) in [
        ("square.csv", "rows of x,y"),
        ("square.dat", "an airfoil's coordinates"),
        ("square.svg", "an SVG drawing"),
        ("square.stl", "rows of x,y"),
    ] {
        let words = desk.succeed(&["check", name]).stdout;
        for part in [read, "perimeter 4, area 1", "as it is"] {
            assert!(words.contains(part), "{name}: {words}");
        }
    }
}
