//! Outputs as a set, what is kept where they cannot be written, and what is said on standard output.
#![cfg(unix)]

use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::os::unix::fs::PermissionsExt;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, SystemTime};

use sphpack::files::Columns;

use crate::{CYLINDER, Desk};

fn desk() -> Desk {
    Desk::new().with("scene.toml", CYLINDER)
}

/// A packing that would go on for long, at work.
fn at_work(desk: &Desk, outputs: &[&str]) -> Child {
    let endless = CYLINDER.replace(
        "1e-3",
        "1e-300\nmethod = \"hybrid\"\nmax_iterations = 1000000000",
    );
    fs::write(desk.path().join("endless.toml"), endless).expect("a scene");
    let mut child = desk
        .command(&[&["pack", "endless.toml"], outputs].concat())
        .env("TMPDIR", desk.path())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut lines = BufReader::new(child.stderr.as_mut().expect("piped")).lines();
    assert!(
        (lines.by_ref().map_while(Result::ok)).any(|line| line.contains("evaluation")),
        "progress is told"
    );
    child
}

/// Asks for the end, and gives the status and what was said until then.
fn end(child: Child) -> (Option<i32>, String) {
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.expect("kill is there").success());
    let output = child.wait_with_output().expect("an end");
    (
        output.status.code(),
        String::from_utf8(output.stderr).expect("text"),
    )
}

#[test]
fn a_name_taken_meanwhile_undoes_the_set() {
    let desk = Desk::new().with("a.csv", "precious");
    let a = desk.path().join("a.csv");
    fs::set_permissions(&a, fs::Permissions::from_mode(0o640)).expect("a mode");
    let child = at_work(
        &desk,
        &[
            "-o", "a.csv", "-o", "b.vtu", "--report", "c.json", "--force",
        ],
    );
    fs::create_dir_all(desk.path().join("b.vtu/inside")).expect("a folder");
    let (status, said) = end(child);
    assert_eq!(status, Some(1), "{said}");
    for part in [
        "cannot write b.vtu: a folder of that name is in the way",
        "kept as a.rescued.csv, b.rescued.vtu, c.rescued.json; files that were there are as they were",
    ] {
        assert!(said.contains(part), "{said} lacks {part}");
    }
    assert_eq!(desk.read("a.csv"), b"precious");
    assert_eq!(
        fs::metadata(&a).expect("it").permissions().mode() & 0o777,
        0o640
    );
    assert_eq!(
        desk.files(),
        [
            // Of the run that was stopped.
            "a.checkpoint",
            "a.csv",
            "a.rescued.csv",
            "b.rescued.vtu",
            "b.vtu",
            "c.rescued.json",
            "endless.toml"
        ]
    );
    let read = |name: &str| Columns::read(&desk.path().join(name)).expect("columns");
    assert_eq!(
        read("a.rescued.csv").numbers["x"],
        read("b.rescued.vtu").numbers["x"]
    );
}

#[test]
fn particles_outlive_their_folder() {
    let desk = Desk::new();
    let folder = desk.path().join("sub");
    fs::create_dir(&folder).expect("a folder");
    let child = at_work(&desk, &["-o", "sub/a.csv"]);
    fs::remove_dir(&folder).expect("it is empty");
    let (status, said) = end(child);
    assert_eq!(status, Some(1), "{said}");
    let all = desk.files();
    let kept = all
        .iter()
        .find(|name| name.contains("rescued"))
        .expect("a file");
    assert!(
        said.contains("cannot write sub/a.csv") && said.contains(kept),
        "{said}"
    );
    assert!(Columns::read(&desk.path().join(kept)).is_ok());
}

#[test]
fn leftovers_of_killed_runs_go_away() {
    let desk = desk();
    let put = |name: &str| {
        let file = File::create(desk.path().join(name)).expect("a file");
        let when = SystemTime::now() - Duration::from_secs(3600);
        file.set_modified(when).expect("a time");
    };
    put(".sphpack-4194304000-1-abc.unfinished");
    put(".sphpack-4194304000-1-abc.complete");
    put(".sphpack-4194304000-0.replaced");
    put("other.checkpoint");
    desk.succeed(&["pack", "scene.toml", "-q"]);
    let kept = [
        ".sphpack-4194304000-0.replaced",
        ".sphpack-4194304000-1-abc.complete",
        "other.checkpoint",
        "scene.toml",
        "scene.vtu",
    ];
    let all = desk.files();
    if cfg!(target_os = "linux") {
        assert_eq!(all, kept);
    }
}

#[test]
fn every_format_can_be_measured() {
    let desk = desk();
    desk.succeed(&["pack", "scene.toml", "-q", "-o", "p.vtk", "-o", "p.vtu"]);
    let measured = |name: &str| desk.succeed(&["quality", name, "--spacing", "0.2"]).stdout;
    assert_eq!(measured("p.vtk"), measured("p.vtu"));
    let whole = desk.read("p.vtk");
    for part in [whole.len() / 3, whole.len() - 5] {
        let desk = Desk::new().with("cut.vtk", &whole[..part]);
        desk.refuse(
            &["quality", "cut.vtk", "--spacing", "0.2"],
            &["cut.vtk", "damaged"],
        );
    }
}

#[test]
fn names_that_no_file_can_have() {
    let desk = desk();
    fs::create_dir(desk.path().join("folder.vtu")).expect("a folder");
    fs::create_dir(desk.path().join("sub")).expect("a folder");
    let made = Command::new("mkfifo")
        .arg(desk.path().join("pipe.csv"))
        .status();
    assert!(made.expect("mkfifo is there").success());
    let long = "x".repeat(300) + ".vtu";
    for (name, part) in [
        (".", "no file name"),
        ("..", "no file name"),
        ("sub/", "the name of a folder"),
        (".vtu", "an ending without a name"),
        ("out", "no ending"),
        ("/dev/full", "no ending"),
        ("folder.vtu", "is a folder"),
        ("pipe.csv", "a pipe or a device"),
        ("scene.toml/out.vtu", "scene.toml"),
        (&long, "too long"),
        ("sub/none/out.vtu", "the folder sub/none does not exist"),
    ] {
        desk.refuse(&["pack", "scene.toml", "--force", "-o", name], &[part]);
    }
    for option in ["--report", "--picture"] {
        desk.refuse(
            &["pack", "scene.toml", option, ".json"],
            &["an ending without a name"],
        );
    }
    desk.refuse(&["init", "--force", "/dev/full"], &["a pipe or a device"]);
    desk.refuse(&["init", "--force", &long], &["too long"]);
    assert_eq!(desk.run(&["pack", "scene.toml", "-o", ""]).status, Some(2));
}

#[test]
fn the_working_directory_may_be_gone() {
    let desk = desk();
    let scene = desk.path().join("scene.toml");
    let gone = desk.path().join("gone");
    fs::create_dir(&gone).expect("a folder");
    let script = "rmdir ../gone && exec \"$0\" \"$@\"";
    let output = Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_sphpack"), "pack"])
        .arg(scene)
        .current_dir(gone)
        .output()
        .expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("the working directory"), "{said}");
}

#[test]
fn silence_still_says_why() {
    let desk = desk().with("sub.csv", "").with(
        "endless.toml",
        CYLINDER.replace("1e-3", "1e-300\nmax_iterations = 3"),
    );
    for (arguments, status) in [
        (&["pack", "none.toml", "-q"][..], 2),
        (&["pack", "scene.toml", "-q", "-o", "sub.csv/out.csv"], 2),
        (&["pack", "endless.toml", "-q"], 3),
    ] {
        let ending = desk.run(arguments);
        assert_eq!(ending.status, Some(status), "{ending:?}");
        assert_eq!(ending.stderr.lines().count(), 1, "{ending:?}");
    }
}

#[test]
fn control_characters_are_shown_as_escapes() {
    let desk = desk();
    let ending = desk.run(&["pack", "no\u{1b}[31m\nsuch.toml"]);
    assert_eq!(ending.status, Some(2));
    assert_eq!(ending.stderr.lines().count(), 1, "{}", ending.stderr);
    assert!(
        ending.stderr.contains("no\\u{1b}[31m\\nsuch.toml"),
        "{}",
        ending.stderr
    );
    let ending = desk.succeed(&["pack", "scene.toml", "-o", "a\u{7}.csv"]);
    assert!(ending.stdout.contains("a\\u{7}.csv") && !ending.stdout.contains('\u{7}'));
    let long = "y".repeat(10_000);
    for (arguments, part) in [
        (&["pack", "scene.toml", "--method", &long][..], "is called"),
        (
            &["pack", "scene.toml", "-o", &format!("out.{long}")],
            "there are vtu",
        ),
        (
            &["pack", "scene.toml", "-o", &format!("{long}/out.vtu")],
            "out.vtu: ",
        ),
        (
            &["quality", "scene.csv", "--spacing", "1", "--kernel", &long],
            "--kernel",
        ),
        (&["pack", "scene.toml", "--threads", &long], "invalid"),
    ] {
        let ending = desk.run(arguments);
        assert_eq!(ending.status, Some(2));
        assert!(
            ending.stderr.contains('…') && ending.stderr.len() < 700,
            "{}",
            ending.stderr
        );
        assert!(ending.stderr.contains(part), "{}", ending.stderr);
    }
}

#[test]
fn standard_output_counts() {
    let desk = desk();
    if cfg!(target_os = "linux") {
        for arguments in [
            &["list", "methods"][..],
            &["--help"],
            &["init"],
            &["pack", "scene.toml"],
        ] {
            let full = File::options()
                .write(true)
                .open("/dev/full")
                .expect("a device");
            let output = desk
                .command(arguments)
                .stdout(full)
                .output()
                .expect("it starts");
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
            assert!(said.contains("standard output cannot be written"), "{said}");
        }
        assert_eq!(desk.files(), ["scene.toml", "scene.vtu"]);
    }
    // Whoever has stopped reading has had enough.
    for arguments in [
        &["list", "methods"][..],
        &["pack", "scene.toml", "--force", "-q"],
    ] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = desk
            .command(arguments)
            .stdout(writer)
            .output()
            .expect("it starts");
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        assert!(output.stderr.is_empty(), "{output:?}");
    }
}
