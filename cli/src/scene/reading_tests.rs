//! What is meant by a scene that is written in another way: slips, a solver's words, units, JSON.

use super::*;
use crate::Error;

const DISC: &str = r#"spacing = 0.1
[domain]
min = [-2.0, -2.0]
max = [2, 2]
[[body]]
name = "disc"
shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
"#;

/// A body whose dimension its file says.
const PART: &str = r#"spacing = 0.1
domain = { margin = 1.0 }
[[body]]
shape = { file = "part.stl" }
"#;

#[track_caller]
fn parse(text: &str) -> Scene {
    Scene::parse(text, "s.toml").unwrap()
}

#[track_caller]
fn refuse(text: &str, line: usize, parts: &[&str]) {
    let error = Scene::parse(text, "s.toml").expect_err(text);
    assert!(matches!(error, Error::Scene { .. }));
    let message = error.to_string();
    assert!(message.starts_with(&format!("s.toml:{line}:")), "{message}");
    for part in parts {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

/// The disc with a line in place of another.
#[track_caller]
fn refuse_disc(from: &str, to: &str, line: usize, parts: &[&str]) {
    assert!(DISC.contains(from), "{from}");
    refuse(&DISC.replacen(from, to, 1), line, parts);
}

#[test]
fn values_of_the_wrong_kind_are_told_how_to_be_right() {
    refuse_disc("0.1", "\"0.1\"", 1, &["without quotes: spacing = 0.1"]);
    refuse_disc("1.0", "\"1\"", 7, &["without quotes: radius = 1"]);
    refuse_disc("[0.0, 0.0]", "0,1", 7, &["in brackets: center = [0, 1]"]);
    refuse_disc(
        "[0.0, 0.0]",
        "\"0, 1\"",
        7,
        &["without quotes: center = [0, 1]"],
    );
    refuse_disc(
        "[0.0, 0.0]",
        "[\"0\", 1]",
        7,
        &["center holds the text \"0\""],
    );
    refuse_disc("[2, 2]", "2", 4, &["max is the number 2", "max = [2, 2]"]);
    refuse_disc("0.1", "[0.1]", 1, &["spacing is a list", "one number"]);
    refuse_disc("\"disc\"", "1", 6, &["in quotes, such as name = \"1\""]);
    refuse_disc(
        "{ circle = { center = [0.0, 0.0], radius = 1.0 } }",
        "\"a.stl\"",
        7,
        &["shape = { file = \"a.stl\" }"],
    );
    refuse_disc(
        "shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }",
        "circle = 1",
        7,
        &["write shape = { circle"],
    );
    for (line, part) in [
        ("role = \"fluid\"", "between the bodies"),
        ("rotate = 3", "in braces: rotate = { axis"),
        ("surface = \"0.25\"", "surface = 0.25"),
        ("precedence = \"1\"", "precedence = 1"),
        ("[packing]\nseed = \"1\"", "seed = 1"),
        ("[packing]\nmax_iterations = 1.5", "whole number"),
        ("[fluid]\nfill = \"true\"", "fill = true"),
        ("[fluid]\nfill = 1", "fill = true or fill = false"),
        ("[output]\ninclude = \"free\"", "include = [\"free\"]"),
    ] {
        let number = 7 + line.lines().count();
        refuse(&format!("{DISC}{line}"), number, &[part]);
    }
    refuse_disc(
        "{ center = [0.0, 0.0], radius = 1.0 }",
        "1",
        7,
        &["in braces: shape = { circle = { center"],
    );
    refuse_disc(
        "[2, 2]",
        "[2, 2]\nperiodic = true",
        5,
        &["periodic = [true, true]"],
    );
}

#[test]
fn tables_and_lists_of_them() {
    refuse_disc("[[body]]", "[body]", 5, &["[[body]] instead of [body]"]);
    refuse_disc(
        "[domain]",
        "[[domain]]",
        2,
        &["[domain] instead of [[domain]]"],
    );
    refuse(
        &format!("{DISC}[refinement]\ncoarsest = 0.4\n[refinement.region]\nspacing = 0.1"),
        10,
        &["[[refinement.region]] instead of [refinement.region]"],
    );
    refuse(
        "spacing = 1\nbody = { name = \"a\" }",
        2,
        &["body = [{ … }]"],
    );
    refuse(
        &format!("{DISC}[[packing]]\nseed = 1"),
        8,
        &["[packing] instead of"],
    );
    refuse("spacing = 1\ndomain = 2", 2, &["domain is a table of keys"]);
}

#[test]
fn solvers_words_are_read_and_said() {
    for word in ["dp", "dx"] {
        let scene = parse(&DISC.replacen("spacing", word, 1));
        assert_eq!(scene.spacing, 0.1);
        assert_eq!(scene.notes, [format!("{word} is read as spacing")]);
    }
    let ratio = |words: &str| parse(&format!("{DISC}[packing]\n{words}")).packing;
    assert_eq!(ratio("hdx = 1.3").h_over_spacing, Some(1.3));
    assert_eq!(ratio("hdp = 1.3").h_over_spacing, Some(1.3));
    assert_eq!(ratio("h = 0.12").h_over_spacing, Some(1.2));
    assert_eq!(ratio("coefh = 0.7").h_over_spacing, Some(0.9899494936612));
    assert!(ratio("h = 0.12").given.has("h_over_spacing"));
    let json = serde_json::to_string(&parse(&format!("{DISC}[packing]\nh = 0.12"))).unwrap();
    assert!(
        json.contains("\"h_over_spacing\":1.2,") && !json.contains("\"h\""),
        "{json}"
    );
    let scene = parse(&format!("{DISC}[quality]\nhdx = 1.4"));
    assert_eq!(scene.judge().1, 1.4);
    assert_eq!(scene.notes, ["quality.hdx is read as h_over_spacing"]);
    // The dimension is known when files are opened.
    let mut scene = parse(&format!("{PART}[packing]\ncoefh = 0.7"));
    assert_eq!(scene.packing.h_over_spacing, None);
    scene.settle_diagonals(3);
    assert_eq!(scene.packing.h_over_spacing, Some(1.212435565298));
    assert_eq!(scene.packing.h_over_diagonal, None);
}

#[test]
fn two_words_for_the_same_are_refused() {
    refuse(
        &format!("dp = 0.1\n{DISC}"),
        1,
        &["dp and spacing are both given"],
    );
    refuse(
        "dp = 0.1\ndx = 0.1\n[domain]",
        1,
        &["dp and dx are both given"],
    );
    let packing =
        |words: &str, parts: &[&str]| refuse(&format!("{DISC}[packing]\n{words}"), 9, parts);
    packing(
        "hdx = 1.2\nh_over_spacing = 1.2",
        &["packing.hdx and packing.h_over_spacing"],
    );
    packing("h = 0.12\ncoefh = 1", &["packing.h and packing.coefh"]);
    // A length where a ratio is meant, and the reverse.
    packing(
        "h = 1.2",
        &["h_over_spacing is 12", "packing.h is read as a length"],
    );
    packing("hdx = \"1.2\"", &["without quotes: hdx = 1.2"]);
    refuse(
        &format!("{DISC}[packing]\nh = 0.12\n[refinement]\ncoarsest = 0.4"),
        9,
        &["packing.h is one length", "h_over_spacing"],
    );
}

#[test]
fn units_are_a_scale() {
    for (name, metres) in [
        ("m", 1.0),
        ("mm", 1e-3),
        ("in", 0.0254),
        ("ft", 0.3048),
        ("km", 1e3),
    ] {
        let scene = parse(&format!("{PART}units = \"{name}\""));
        assert_eq!(scene.body[0].scale, metres);
        assert!(scene.notes[0].contains(&format!("in {name} is read with scale = {metres}")));
    }
    let refuse = |words: &str, parts: &[&str]| refuse(&format!("{PART}{words}"), 5, parts);
    refuse(
        "units = \"mm\"\nscale = 2",
        &["units and scale are both given"],
    );
    refuse(
        "units = \"mmm\"",
        &["no unit is called \"mmm\"", "\"mm\"?", "km"],
    );
    refuse("units = 1", &["in quotes"]);
    let disc = format!("{DISC}units = \"mm\"");
    let message = Scene::parse(&disc, "s.toml").unwrap_err().to_string();
    assert!(
        message.contains("s.toml:8:") && message.contains("body's file"),
        "{message}"
    );
}

#[test]
fn the_same_scene_in_json() {
    let json = r#"{
  "spacing": 0.1,
  "domain": { "min": [-2.0, -2.0], "max": [2, 2] },
  "body": [
    { "name": "disc", "shape": { "circle": { "center": [0.0, 0.0], "radius": 1.0 } } }
  ]
}"#;
    let toml = parse(DISC);
    let mut scene = Scene::parse(json, "s.json").unwrap();
    scene.path = "s.toml".into();
    assert_eq!(scene, toml);
    // What a report writes is a scene again.
    let mut again = Scene::parse(&serde_json::to_string(&toml).unwrap(), "s.toml").unwrap();
    again.quality = toml.quality.clone();
    assert_eq!(again, toml);
    let place = |from: &str, to: &str| {
        let text = json.replacen(from, to, 1);
        assert_ne!(text, json);
        Scene::parse(&text, "s.json").unwrap_err().to_string()
    };
    for (from, to, parts) in [
        ("0.1", "\"0.1\"", ["s.json:2:14", "spacing = 0.1"]),
        ("0.1", "-1", ["s.json:2:14", "positive"]),
        ("\"spacing\"", "\"spacng\"", ["s.json:2:3", "\"spacing\"?"]),
        (
            "2] },",
            "2] }",
            ["s.json:4:3", "not JSON: expected `,` or `}`"],
        ),
        ("1.0", "-1.0", ["s.json:5:", "radius is -1"]),
    ] {
        let message = place(from, to);
        for part in parts {
            assert!(message.contains(part), "{to}: {message} lacks {part}");
        }
    }
    let words = Scene::read_from(
        json.replacen("spacing", "dp", 1).as_bytes(),
        "standard input",
    );
    let scene = words.unwrap();
    assert_eq!((scene.name.as_str(), scene.notes.len()), ("scene", 1));
    assert_eq!(scene.resolve(Path::new("a.stl")), Path::new("a.stl"));
    let empty = Scene::read_from(&b"\n"[..], "standard input").unwrap_err();
    assert!(empty.to_string().contains("there is no scene"));
}
