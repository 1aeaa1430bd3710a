//! `method = "auto"`: what a run says of what it picks, and whether that was enough.

use serde_json::Value;

use crate::Desk;

fn desk(accuracy: &str) -> Desk {
    let scene = format!(
        "spacing = 0.1\n[domain]\nmin = [-1.0, -1.0]\nmax = [1.0, 1.0]\n\
         [[body]]\nshape = {{ circle = {{ center = [0.0, 0.0], radius = 0.5 }} }}\n\
         [packing]\nmethod = \"auto\"\naccuracy = {{ {accuracy} }}\n"
    );
    Desk::new().with("scene.toml", scene)
}

const PACK: [&str; 6] = [
    "pack",
    "scene.toml",
    "-o",
    "out.ply",
    "--report",
    "out.json",
];

fn auto(desk: &Desk) -> Value {
    let report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    // The scene of the report packs the same without the table.
    assert_eq!(report["scene"]["packing"]["method"], "balanced");
    assert_eq!(report["scene"]["packing"]["accuracy"], Value::Null);
    report["auto"].clone()
}

#[test]
fn an_accuracy_that_is_reached() {
    let desk = desk("linf = 0.02");
    let before = desk.succeed(&["pack", "scene.toml", "--dry-run"]);
    assert!(before.stdout.contains("auto takes"), "{}", before.stdout);
    let ending = desk.succeed(&PACK);
    assert!(ending.stderr.contains("auto takes"), "{}", ending.stderr);
    for part in ["auto takes", "accuracy   reached: linf", "0.02 asked for"] {
        assert!(
            ending.stdout.contains(part),
            "{} lacks {part}",
            ending.stdout
        );
    }
    let auto = auto(&desk);
    assert_eq!(auto["reached"], true);
    assert_eq!(auto["measure"], "linf");
    assert_eq!(auto["asked"], 0.02);
    assert!(auto["measured"].as_f64().expect("a number") <= 0.02);
    let text = String::from_utf8_lossy(&desk.read("out.ply")).into_owned();
    assert!(
        text.contains("stop_reason converged"),
        "the file's own mark"
    );
}

#[test]
fn an_accuracy_that_is_not_reached() {
    let desk = desk("linf = 1e-9");
    let ending = desk.run(&PACK);
    assert_eq!(ending.status, Some(3), "{ending:?}");
    assert!(
        ending.stderr.contains("the most accurate that is charted"),
        "{ending:?}"
    );
    for part in [
        "NOT reached: linf is",
        "worst at (",
        "use a smaller spacing",
    ] {
        assert!(
            ending.stdout.contains(part),
            "{} lacks {part}",
            ending.stdout
        );
    }
    let auto = auto(&desk);
    assert_eq!(auto["reached"], false);
    assert_eq!(auto["worst_at"].as_array().expect("a place").len(), 2);
    let text = String::from_utf8_lossy(&desk.read("out.ply")).into_owned();
    assert!(
        text.contains("stop_reason inaccurate"),
        "the file's own mark"
    );
    let quiet = desk.run(&["pack", "scene.toml", "-o", "out.ply", "--force", "-q"]);
    assert_eq!((quiet.status, quiet.stdout.as_str()), (Some(3), ""));
    assert_eq!(quiet.stderr.lines().count(), 1, "{}", quiet.stderr);
    assert!(
        quiet.stderr.contains("not as accurate as asked: linf is"),
        "{}",
        quiet.stderr
    );
}
