//! Files that cannot be written, and command lines that make no sense.

use crate::{CYLINDER, Desk};

fn desk() -> Desk {
    Desk::new().with("scene.toml", CYLINDER)
}

#[test]
fn endings_must_be_known() {
    let refuse = |arguments: &[&str], parts: &[&str]| {
        let mut all = vec!["pack", "scene.toml"];
        all.extend(arguments);
        desk().refuse(&all, parts);
    };
    refuse(
        &["-o", "out.xyz"],
        &["out.xyz", "vtu, csv, npz, vtp, vtk, ply"],
    );
    refuse(&["-o", "out.vtx"], &["did you mean \"vtu\"?"]);
    refuse(&["-o", "out"], &["out", "vtu, csv"]);
    refuse(&["--picture", "out.jpg"], &["out.jpg", "png, svg"]);
    refuse(&["--report", "out.txt"], &["out.txt", ".json"]);
    let sphere = "spacing = 0.2\n[domain]\nmargin = 1\n[[body]]\nshape = { sphere = { center = [0, 0, 0], radius = 1 } }\n";
    Desk::new().with("sphere.toml", sphere).refuse(
        &["pack", "sphere.toml", "--picture", "out.svg"],
        &["out.svg", ".png"],
    );
}

#[test]
fn folders_must_be_there_and_writable() {
    desk().refuse(
        &["pack", "scene.toml", "-o", "no/such/out.vtu"],
        &["no/such", "create it"],
    );
    desk().refuse(
        &["pack", "scene.toml", "-o", "scene.toml/out.vtu"],
        &["scene.toml"],
    );
    let desk = desk();
    std::fs::create_dir(desk.path().join("folder.vtu")).expect("a folder");
    desk.refuse(
        &["pack", "scene.toml", "-o", "folder.vtu"],
        &["folder.vtu", "is a folder"],
    );
    if cfg!(target_os = "linux") {
        desk.refuse(
            &["pack", "scene.toml", "-o", "/proc/out.vtu"],
            &["/proc", "nothing can be written"],
        );
    }
}

#[test]
fn nothing_is_replaced_without_force() {
    let desk = desk().with("scene.vtu", "precious");
    desk.refuse(&["pack", "scene.toml"], &["scene.vtu", "--force"]);
    assert_eq!(desk.read("scene.vtu"), b"precious");
    desk.refuse(
        &["pack", "scene.toml", "-o", "a.csv", "--report", "scene.vtu"],
        &["scene.vtu"],
    );
    desk.refuse(
        &["pack", "scene.toml", "-o", "a.csv", "-o", "./a.csv"],
        &["twice"],
    );
    desk.succeed(&["pack", "scene.toml", "--force", "--quiet"]);
    assert!(desk.read("scene.vtu").starts_with(b"<?xml"));
    desk.refuse(&["init", "scene.toml"], &["scene.toml", "--force"]);
    // Not even force replaces an input.
    let body = Desk::new().with("out.csv", "0,0\n1,0\n1,1\n0,1\n");
    body.refuse(
        &[
            "pack",
            "out.csv",
            "--spacing",
            "0.1",
            "-o",
            "out.csv",
            "--force",
        ],
        &["input"],
    );
}

#[test]
fn command_lines_are_checked() {
    let desk = desk();
    for (arguments, part) in [
        (
            &["pack", "scene.toml", "--threads", "0"][..],
            "--threads is 0",
        ),
        (
            &["pack", "scene.toml", "--threads", "100000"],
            "from 1 to 1024",
        ),
        (
            &["pack", "scene.toml", "--method", "relaxed"],
            "no method is called",
        ),
    ] {
        desk.refuse(arguments, &[part]);
    }
    for arguments in [
        &["pack"][..],
        &["pack", "scene.toml", "--threads", "many"],
        &["pack", "scene.toml", "--unknown"],
        &["list", "colours"],
        &["frobnicate"],
    ] {
        let ending = desk.run(arguments);
        assert_eq!(ending.status, Some(2), "{arguments:?}");
        assert_eq!(desk.files(), ["scene.toml"]);
    }
}
