//! `sphpack check`.

use serde_json::Value;

use crate::{Desk, cube, stl};

/// A cube without its last side.
fn open() -> Vec<u8> {
    stl(&cube()[..10])
}

#[test]
fn a_clean_body() {
    let desk = Desk::new().with("cube.stl", stl(&cube()));
    let words = desk.succeed(&["check", "cube.stl"]).stdout;
    for part in [
        "1 × 1 × 1",
        "12 triangles, 8 vertices",
        "volume 1",
        "as it is",
    ] {
        assert!(words.contains(part), "{words}");
    }
    assert!(!words.contains("defects"), "{words}");
    let json = desk.succeed(&["check", "cube.stl", "--json", "--spacing", "2"]);
    let found: Value = serde_json::from_str(&json.stdout).expect("JSON");
    assert_eq!(found["can_be_packed"], true);
    assert_eq!(found["mesh"]["shells"][0]["role"], "body");
    assert_eq!(found["thin"]["part_of_surface"], 1.0);
    assert_eq!(found["volume"], 1.0);
    assert_eq!(desk.files(), ["cube.stl"]);
}

#[test]
fn far_from_the_origin_corners_are_told_apart() {
    let far = |triangles: &[[[f32; 3]; 3]]| {
        let moved: Vec<_> = (triangles.iter())
            .map(|corners| corners.map(|[x, y, z]| [x + 30_000.25, y, z - 0.5]))
            .collect();
        Desk::new().with("far.stl", stl(&moved))
    };
    let words = far(&cube()).succeed(&["check", "far.stl"]).stdout;
    assert_eq!(
        words
            .matches("from (30000.25, 0, -0.5) to (30001.25, 1, 0.5)")
            .count(),
        2,
        "{words}"
    );
    let words = far(&cube()[..10]).run(&["check", "far.stl"]).stdout;
    for part in [
        "across, near (30001.25, 0.5, 0)",
        "the first near (30001.25, ",
    ] {
        assert!(words.contains(part), "{words}");
    }
}

#[test]
fn every_defect_has_a_count_and_a_place() {
    let mut triangles = cube();
    triangles[4].swap(0, 1);
    triangles.push(triangles[0]);
    triangles.push([triangles[0][0], triangles[0][0], triangles[0][1]]);
    let desk = Desk::new().with("body.stl", stl(&triangles));
    let ending = desk.succeed(&["check", "body.stl", "--report", "found.json"]);
    for part in [
        "1 triangles that are there more than once",
        "1 triangles that use a vertex twice",
        "face opposite ways, the first near (",
        "mended",
        "1 of 12 triangles faced the other way",
        "pack` mends this by itself",
    ] {
        assert!(ending.stdout.contains(part), "{}", ending.stdout);
    }
    let found: Value = serde_json::from_slice(&desk.read("found.json")).expect("JSON");
    assert_eq!(found["repairs"].as_array().map(Vec::len), Some(3));
    assert_eq!(found["mesh"]["defects"][0]["kind"], "non-manifold");
    assert_eq!(found["mesh"]["defects"][0]["count"], 3);
}

#[test]
fn large_holes_are_closed_when_asked() {
    let desk = Desk::new().with("open.stl", open());
    let ending = desk.run(&["check", "open.stl"]);
    assert_eq!(ending.status, Some(2), "{ending:?}");
    for part in [
        "4 edges with one triangle",
        "1.414 across",
        "--fill-holes 1.428",
        "`sphpack check open.stl --repair OUT.stl --wrap 0.01`",
    ] {
        assert!(ending.stdout.contains(part), "{}", ending.stdout);
    }
    // Nothing is written unless it is a body then.
    let ending = desk.run(&["check", "open.stl", "--repair", "mended.stl"]);
    assert_eq!(ending.status, Some(2));
    assert_eq!(desk.files(), ["open.stl"]);
    let all = [
        "check",
        "open.stl",
        "--repair",
        "mended.stl",
        "--fill-holes",
        "1.5",
    ];
    let words = desk.succeed(&all).stdout;
    assert!(
        words.contains("1 hole was closed with 2 triangles"),
        "{words}"
    );
    let words = desk.succeed(&["check", "mended.stl"]).stdout;
    assert!(
        words.contains("as it is") && words.contains("volume 1"),
        "{words}"
    );
    desk.refuse(&all, &["mended.stl", "exists", "--force"]);
    let mut forced = all.to_vec();
    forced.push("--force");
    desk.succeed(&forced);
    desk.succeed(&["pack", "mended.stl", "--spacing", "0.2", "--quiet"]);
}

#[test]
fn outlines() {
    let desk = Desk::new()
        .with("square.csv", "0,0\n1,0\n1,1\n0,1\n")
        .with("bow-tie.csv", "0,0\n2,2\n2,0\n0,1\n");
    let words = desk
        .succeed(&["check", "square.csv", "--spacing", "0.1"])
        .stdout;
    for part in ["perimeter 4, area 1", "nothing is thinner", "as it is"] {
        assert!(words.contains(part), "{words}");
    }
    let refused = desk.run(&["check", "bow-tie.csv", "--repair", "out.csv"]);
    assert_eq!(refused.status, Some(2));
    for part in [
        "1 pair of sides",
        "undecided",
        "cannot be packed",
        "in the order",
    ] {
        assert!(refused.stdout.contains(part), "{}", refused.stdout);
    }
    assert!(!desk.files().contains(&"out.csv".to_owned()));
    for (arguments, part) in [
        (&["--repair", "out.stl"][..], "name it .csv"),
        (&["--repair", "out.csv", "--wrap", "1"], "for meshes"),
        (&["--repair", "out.csv", "--fill-holes", "1"], "for meshes"),
    ] {
        let whole = [&["check", "square.csv"], arguments].concat();
        desk.refuse(&whole, &[part]);
    }
}

/// Two squares that overlap, one of them with a spike, one there twice, and a line.
const DIRTY: &str =
    "0,0\n2,0\n3,0\n2,0\n2,2\n0,2\n\n1,1\n3,1\n3,3\n1,3\n\n3,1\n3,3\n1,3\n1,1\n\n5,5\n6,6\n7,7\n";

#[test]
fn dirty_outlines() {
    let desk = Desk::new().with("dirty.csv", DIRTY);
    let words = desk.succeed(&["check", "dirty.csv"]).stdout;
    for part in [
        "1 pair of loops that overlap, near (2, 1), in loop 1",
        "1 loop that is there already",
        "1 spike",
        "1 loop without area",
        "2 loops that overlapped were joined",
        "area 7",
        "mends this by itself",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    let json = desk.succeed(&["check", "dirty.csv", "--json"]).stdout;
    let json: Value = serde_json::from_str(&json).unwrap();
    let outline = &json["outline"];
    assert_eq!(outline["defects"].as_array().unwrap().len(), 4);
    assert_eq!(outline["defects"][0]["kind"], "overlap");
    assert_eq!(outline["loops"][2]["role"], "nothing");
    assert_eq!(json["repairs"].as_array().unwrap().len(), 4);
    desk.succeed(&["check", "dirty.csv", "--repair", "mended.csv"]);
    let words = desk.succeed(&["check", "mended.csv"]).stdout;
    assert!(words.contains("can be packed as it is"), "{words}");
    assert!(words.contains("area 7"), "{words}");
    let run = desk.succeed(&[
        "pack",
        "dirty.csv",
        "--spacing",
        "0.5",
        "--report",
        "report.json",
    ]);
    assert!(run.stderr.contains("were joined"), "{}", run.stderr);
    let report: Value = serde_json::from_slice(&desk.read("report.json")).unwrap();
    assert_eq!(report["bodies"][0]["volume_true"], 7.0);
    assert_eq!(report["bodies"][0]["repairs"].as_array().unwrap().len(), 4);
}

#[test]
fn what_makes_no_sense() {
    let desk = Desk::new().with("cube.stl", stl(&cube()));
    for (arguments, part) in [
        (&["--spacing", "0"][..], "--spacing is 0"),
        (&["--fill-holes", "1"], "--repair"),
        (&["--wrap", "0.1"], "--repair"),
        (&["--wrap", "-1", "--repair", "out.stl"], "--wrap is -1"),
        (
            &["--wrap", "1e-9", "--repair", "out.stl"],
            "cell = 0.000000001",
        ),
        (
            &["--wrap", "1", "--fill-holes", "1", "--repair", "out.stl"],
            "leave out --fill-holes",
        ),
        (&["--repair", "out.obj"], "name it .stl"),
        (&["--repair", "cube.stl", "--force"], "input"),
        (&["--report", "out.txt"], "name it .json"),
    ] {
        let mut all = vec!["check", "cube.stl"];
        all.extend(arguments);
        desk.refuse(&all, &[part]);
    }
    desk.refuse(&["check", "nothing.stl"], &["no such file"]);
}
