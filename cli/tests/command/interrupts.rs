//! Ctrl-C.
#![cfg(unix)]

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

use serde_json::Value;

use crate::{CYLINDER, Desk};

/// A packing that would go on for long, at work.
fn at_work(desk: &Desk) -> Child {
    let mut child = desk
        .command(&[
            "pack",
            "scene.toml",
            "-o",
            "out.csv",
            "--report",
            "out.json",
        ])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut lines = BufReader::new(child.stderr.take().expect("piped")).lines();
    let is_at_work = lines
        .by_ref()
        .map_while(Result::ok)
        .any(|line| line.contains("evaluation"));
    assert!(is_at_work, "progress is told");
    // The rest must be read, or the command cannot go on talking.
    std::thread::spawn(move || lines.map_while(Result::ok).for_each(drop));
    child
}

fn desk() -> Desk {
    let endless = CYLINDER
        .replace(
            "1e-3",
            "1e-300\nmethod = \"hybrid\"\nmax_iterations = 1000000000",
        )
        .replace("spacing = 0.2", "spacing = 0.1");
    Desk::new().with("scene.toml", endless)
}

fn interrupt(child: &Child) {
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("kill is there");
    assert!(sent.success());
}

#[test]
fn the_first_writes_what_there_is() {
    let desk = desk();
    let mut child = at_work(&desk);
    interrupt(&child);
    assert_eq!(child.wait().expect("an end").code(), Some(130));
    let files = ["out.checkpoint", "out.csv", "out.json", "scene.toml"];
    assert_eq!(desk.files(), files);
    let report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    assert_eq!(report["converged"], false);
    assert_eq!(report["stop_reason"], "interrupted");
    let rows = desk.read("out.csv").iter().filter(|&&b| b == b'\n').count();
    let number = |kind: &str| report["particles"][kind].as_u64().expect("a number");
    assert_eq!(number("total") - number("frozen"), rows as u64 - 1);
}

#[test]
fn before_particles_move_it_ends_at_once() {
    // So many squares in one another take minutes to be told apart.
    let squares: String = (1..40_000)
        .map(|n| {
            let x = f64::from(n) * 1e-3;
            format!("{x},{x}\n-{x},{x}\n-{x},-{x}\n{x},-{x}\n\n")
        })
        .collect();
    let desk = Desk::new().with("squares.csv", squares);
    let mut child = desk
        .command(&["pack", "squares.csv", "--spacing", "0.5", "-o", "out.csv"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut lines = BufReader::new(child.stderr.take().expect("piped")).lines();
    assert!(
        (lines.by_ref().map_while(Result::ok)).any(|line| line.contains("bodies")),
        "progress is told"
    );
    interrupt(&child);
    let rest: Vec<String> = lines.map_while(Result::ok).collect();
    assert_eq!(child.wait().expect("an end").code(), Some(130));
    assert!(rest.concat().contains("nothing was written"), "{rest:?}");
    assert_eq!(desk.files(), ["squares.csv"]);
}

#[test]
fn the_second_ends_at_once() {
    let desk = desk();
    let mut child = at_work(&desk);
    interrupt(&child);
    let _ = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .stderr(Stdio::null())
        .status();
    assert_eq!(child.wait().expect("an end").code(), Some(130));
    assert!(
        desk.files().iter().all(|name| !name.starts_with('.')),
        "{:?}",
        desk.files()
    );
}
