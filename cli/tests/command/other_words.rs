//! What a person writes who has another program in mind: slips, a solver's words, units, JSON, a scene from a pipe.

use std::io::Write;
use std::process::Stdio;

use crate::{CYLINDER, Desk, Ending, cube, stl};

const JSON: &str = r#"{
  "spacing": 0.2,
  "domain": { "min": [-2.0, -2.0], "max": [2.0, 2.0] },
  "body": [{ "name": "cylinder", "shape": { "circle": { "center": [0.0, 0.0], "radius": 1.0 } } }],
  "packing": { "velocity_tolerance": 1e-3 }
}
"#;

/// The command with a scene on its standard input.
fn piped(desk: &Desk, scene: &str, arguments: &[&str]) -> Ending {
    let mut command = desk.command(arguments);
    command.stdin(Stdio::piped());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command starts");
    // Who refuses the command line does not read it.
    let _ = child
        .stdin
        .take()
        .expect("a pipe")
        .write_all(scene.as_bytes());
    let output = child.wait_with_output().expect("it ends");
    Ending {
        status: output.status.code(),
        stdout: String::from_utf8(output.stdout).expect("text"),
        stderr: String::from_utf8(output.stderr).expect("text"),
    }
}

#[test]
fn slips_are_told_with_their_cures() {
    for (from, to, parts) in [
        (
            "[[body]]",
            "[body]",
            ["scene.toml:5:", "[[body]] instead of [body]"],
        ),
        ("[0.0, 0.0]", "0,1", ["scene.toml:7:", "center = [0, 1]"]),
        (
            "0.2",
            "\"0.2\"",
            ["scene.toml:1:11", "without quotes: spacing = 0.2"],
        ),
        (
            "[packing]",
            "role = \"fluid\"\n[packing]",
            ["scene.toml:8:", "between the bodies"],
        ),
        (
            "[packing]",
            "[packing]\nmethod = \"ppa\"",
            ["scene.toml:9:", "role \"void\""],
        ),
    ] {
        let desk = Desk::new().with("scene.toml", CYLINDER.replacen(from, to, 1));
        desk.refuse(&["pack", "scene.toml"], &parts);
    }
}

#[test]
fn numbers_on_the_command_line() {
    let desk = Desk::new().with("cube.stl", stl(&cube()));
    for (arguments, words) in [
        (["--spacing", "abc"], "it must be a number, such as 0.02"),
        (["--spacing", "0,1"], "with a point: 0.1"),
        (["--margin", "2mm"], "without a unit: 2"),
        (["--threads", "all"], "whole number"),
        (["--units", "mmm"], "did you mean \"mm\"?"),
    ] {
        let all = [&["pack", "cube.stl"][..], &arguments].concat();
        let ending = desk.run(&all);
        assert_eq!(ending.status, Some(2), "{ending:?}");
        assert!(ending.stderr.contains(words), "{}", ending.stderr);
    }
}

#[test]
fn solvers_words_are_said() {
    let text = CYLINDER.replacen("spacing", "dp", 1) + "hdx = 1.3\n";
    let desk = Desk::new().with("scene.toml", text);
    let ending = desk.succeed(&["pack", "scene.toml", "--report", "r.json", "-o", "p.csv"]);
    for said in [&ending.stdout, &ending.stderr] {
        assert!(said.contains("dp is read as spacing"), "{ending:?}");
        assert!(
            said.contains("packing.hdx is read as h_over_spacing"),
            "{ending:?}"
        );
    }
    let report: serde_json::Value = serde_json::from_slice(&desk.read("r.json")).expect("JSON");
    assert_eq!(report["scene"]["spacing"], 0.2);
    assert_eq!(report["scene"]["packing"]["h_over_spacing"], 1.3);
    assert!(report["scene"].get("dp").is_none() && report["scene"]["packing"].get("hdx").is_none());
    let quiet = desk.succeed(&["pack", "scene.toml", "-o", "q.csv", "-q"]);
    assert_eq!((quiet.stdout.as_str(), quiet.stderr.as_str()), ("", ""));
}

/// h = coefh √3 ∆s in space, which the file of the body tells.
#[test]
fn a_coefficient_waits_for_the_dimension() {
    let scene = |word: &str| {
        format!(
            "spacing = 0.25\ndomain = {{ margin = 0.5 }}\n[[body]]\nshape = {{ file = \"cube.stl\" }}\n[packing]\n{word}\n"
        )
    };
    let desk = Desk::new()
        .with("cube.stl", stl(&cube()))
        .with("coefh.toml", scene("coefh = 0.7"))
        .with("large.toml", scene("coefh = 4"));
    let ending = desk.succeed(&["pack", "coefh.toml", "--dry-run"]);
    assert!(ending.stdout.contains("coefh x sqrt(D)"), "{ending:?}");
    desk.refuse(
        &["pack", "large.toml", "--dry-run"],
        &["h_over_spacing is 6.9"],
    );
}

#[test]
fn units_of_a_file() {
    let large = cube()
        .iter()
        .map(|t| t.map(|p| p.map(|x| 1000.0 * x)))
        .collect::<Vec<_>>();
    let scene = "spacing = 0.2\ndomain = { margin = 0.5 }\n[[body]]\nname = \"part\"\nunits = \"mm\"\nshape = { file = \"part.stl\" }\n";
    let desk = Desk::new()
        .with("part.stl", stl(&large))
        .with("scene.toml", scene);
    let words = "its file in mm is read with scale = 0.001";
    let by_scene = desk.succeed(&["pack", "scene.toml", "--dry-run"]);
    let by_hand = desk.succeed(&[
        "pack",
        "part.stl",
        "--units",
        "mm",
        "--spacing",
        "0.2",
        "--dry-run",
    ]);
    for ending in [by_scene, by_hand] {
        assert!(ending.stdout.contains(words), "{ending:?}");
    }
    desk.refuse(
        &["pack", "part.stl", "--spacing", "0.1", "--dry-run"],
        &["--scale 0.001 makes it 10 spacings across (--units mm is the same)"],
    );
    let both = desk.run(&[
        "pack",
        "part.stl",
        "--units",
        "mm",
        "--scale",
        "2",
        "--spacing",
        "1",
    ]);
    assert!(
        both.status == Some(2) && both.stderr.contains("cannot be used with"),
        "{both:?}"
    );
    desk.refuse(
        &["pack", "scene.toml", "--units", "mm"],
        &["set a body's units in it"],
    );
}

#[test]
fn json_packs_to_the_same_particles() {
    let desk = Desk::new().with("a.toml", CYLINDER).with("b.json", JSON);
    desk.succeed(&["pack", "a.toml", "-o", "a.csv"]);
    desk.succeed(&["pack", "b.json", "-o", "b.csv"]);
    assert_eq!(desk.read("a.csv"), desk.read("b.csv"));
    for (name, scene) in [("c.csv", CYLINDER), ("d.csv", JSON)] {
        let ending = piped(&desk, scene, &["pack", "-", "-o", name]);
        assert_eq!(ending.status, Some(0), "{ending:?}");
        assert_eq!(desk.read("a.csv"), desk.read(name));
    }
}

#[test]
fn a_scene_from_a_pipe_is_checked() {
    let desk = Desk::new();
    let refused = |scene: &str, arguments: &[&str], words: &str| {
        let ending = piped(&desk, scene, arguments);
        assert_eq!(ending.status, Some(2), "{ending:?}");
        assert!(ending.stderr.contains(words), "{ending:?}");
    };
    let out = ["pack", "-", "-o", "a.csv"];
    refused(CYLINDER, &["pack", "-"], "-o OUT.vtu");
    refused("", &out, "standard input: there is no scene");
    refused("spacng = 1", &out, "standard input:1:1: unknown key");
    refused(
        "{\n\"spacing\": \"1\"}",
        &out,
        "standard input:2:12: spacing is the text",
    );
    refused(
        CYLINDER,
        &["pack", "-", "-o", "a.csv", "--spacing", "1"],
        "standard input is a scene",
    );
    assert_eq!(desk.files(), Vec::<String>::new());
}
