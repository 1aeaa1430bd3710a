//! Runs that are killed or stopped, and gone on with.

use std::fs;
use std::process::Stdio;
use std::time::Duration;

use serde_json::Value;

use crate::{CYLINDER, Desk};

/// A packing of a second or so.
fn scene() -> String {
    CYLINDER
        .replace("1e-3", "1e-4\nmethod = \"hybrid\"")
        .replace("spacing = 0.2", "spacing = 0.1")
}

const PACK: [&str; 6] = [
    "pack",
    "scene.toml",
    "-o",
    "out.csv",
    "--report",
    "out.json",
];

/// The report without what is different in every run.
fn figures(desk: &Desk) -> Value {
    let mut report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    let object = report.as_object_mut().expect("an object");
    object.remove("seconds");
    let audit = object["audit"].as_object_mut().expect("an object");
    audit.remove("seconds");
    object.remove("peak_memory_bytes");
    for sample in object["history"].as_array_mut().expect("a list") {
        sample.as_object_mut().expect("an object").remove("seconds");
    }
    report
}

/// Starts a run and kills it as soon as it has left a checkpoint.
fn kill(desk: &Desk, more: &[&str], checkpoint: &str) {
    let arguments = [&PACK[..], &["--checkpoint-every", "0.01"], more].concat();
    let mut child = desk
        .command(&arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts");
    while !desk.path().join(checkpoint).exists() {
        assert!(child.try_wait().expect("a process").is_none(), "it ended");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("it can be killed");
    child.wait().expect("an end");
}

/// Names on the desk, without what a killed run was just writing.
fn files(desk: &Desk) -> Vec<String> {
    let mut files = desk.files();
    files.retain(|name| !name.ends_with(".unfinished"));
    files
}

#[test]
fn a_killed_run_goes_on_to_the_same_bytes() {
    let desk = Desk::new().with("scene.toml", scene());
    desk.succeed(&PACK);
    let (rows, report) = (desk.read("out.csv"), figures(&desk));
    fs::remove_file(desk.path().join("out.csv")).expect("it is there");
    fs::remove_file(desk.path().join("out.json")).expect("it is there");
    kill(&desk, &[], "out.checkpoint");
    assert_eq!(files(&desk), ["out.checkpoint", "scene.toml"]);
    // Whoever does not know is told, and loses nothing.
    let plain = desk.succeed(&[
        "pack",
        "scene.toml",
        "-o",
        "out.vtu",
        "--checkpoint",
        "b.checkpoint",
    ]);
    assert!(!plain.stderr.contains("--resume"), "{}", plain.stderr);
    let resumed = desk.succeed(&[&PACK[..], &["--resume"]].concat());
    let told = "going on from out.checkpoint: ";
    assert!(resumed.stderr.contains(told), "{}", resumed.stderr);
    assert!(desk.read("out.csv") == rows, "the same bytes");
    assert_eq!(figures(&desk), report);
    assert_eq!(
        files(&desk),
        ["out.csv", "out.json", "out.vtu", "scene.toml"]
    );
}

#[test]
fn a_checkpoint_that_is_not_asked_for_is_told_of_and_left_alone() {
    let desk = Desk::new().with("scene.toml", scene());
    kill(&desk, &[], "out.checkpoint");
    let other = scene().replace("radius = 1.0", "radius = 0.9");
    let desk = desk.with("scene.toml", other);
    let before = desk.read("out.checkpoint");
    let plain = desk.succeed(&[&PACK[..], &["--checkpoint-every", "0"]].concat());
    assert!(
        plain
            .stderr
            .contains("out.checkpoint is left of a run that did not end: --resume"),
        "{}",
        plain.stderr
    );
    assert!(desk.read("out.checkpoint") == before);
    // Of the scene itself it would lead to what is there.
    let desk = desk.with("scene.toml", scene());
    desk.succeed(&["pack", "scene.toml", "-o", "out.vtu", "--quiet"]);
    assert_eq!(
        files(&desk),
        ["out.csv", "out.json", "out.vtu", "scene.toml"]
    );
}

#[test]
fn checkpoints_of_something_else_are_refused() {
    let desk = Desk::new().with("scene.toml", scene());
    let resume = [&PACK[..], &["--resume"]].concat();
    desk.refuse(
        &resume,
        &["out.checkpoint: there is no checkpoint", "without --resume"],
    );
    kill(
        &desk,
        &["--checkpoint", "mine.checkpoint"],
        "mine.checkpoint",
    );
    let mine = [&resume[..], &["--checkpoint", "mine.checkpoint"]].concat();
    let again = [&PACK[..], &["--checkpoint", "mine.checkpoint"]].concat();
    desk.refuse(
        &again,
        &["the file exists; --resume goes on from it, --force replaces it"],
    );
    let odd = [&PACK[..], &["--checkpoint", "mine.csv"]].concat();
    desk.refuse(&odd, &["name it .checkpoint"]);
    let seeded = [&mine[..], &["--seed", "7"]].concat();
    desk.refuse(&seeded, &["another scene: packing.seed was 0 and is 7 now"]);
    let mut bytes = desk.read("mine.checkpoint");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    let desk = desk.with("mine.checkpoint", &bytes);
    desk.refuse(&mine, &["the checkpoint is damaged", "begin anew"]);
    bytes[20] = 9;
    let desk = desk.with("mine.checkpoint", &bytes);
    desk.refuse(&mine, &["by another version of sphpack, of format 9"]);
    let desk = desk.with("mine.checkpoint", "x,y\n0,0\n");
    desk.refuse(&mine, &["this is no checkpoint"]);
}

#[cfg(unix)]
#[test]
fn a_stopped_run_goes_on_to_the_same_bytes() {
    let desk = Desk::new().with("scene.toml", scene());
    desk.succeed(&PACK);
    let rows = desk.read("out.csv");
    let force = [&PACK[..], &["--force"]].concat();
    let mut child = desk
        .command(&[&force[..], &["--checkpoint-every", "0.2"]].concat())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts");
    while !desk.path().join("out.checkpoint").exists() {
        assert!(child.try_wait().expect("a process").is_none(), "it ended");
        std::thread::sleep(Duration::from_millis(1));
    }
    let kill = ["-INT", &child.id().to_string()].map(str::to_owned);
    std::process::Command::new("kill")
        .args(kill)
        .status()
        .expect("kill is there");
    assert_eq!(child.wait().expect("an end").code(), Some(130));
    assert_eq!(
        desk.files(),
        ["out.checkpoint", "out.csv", "out.json", "scene.toml"]
    );
    desk.succeed(&[&force[..], &["--resume"]].concat());
    assert!(desk.read("out.csv") == rows, "the same bytes");
    assert_eq!(desk.files(), ["out.csv", "out.json", "scene.toml"]);
}
