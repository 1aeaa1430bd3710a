//! Particles of many sizes, from the scene to files, figures and the picture.

use serde_json::Value;

use crate::Desk;

const SCENE: &str = r#"
spacing = 0.05
[refinement]
coarsest = 0.25
growth = 1.1
region = [{ shape = { circle = { center = [1.2, 0.6], radius = 0.15 } }, spacing = 0.04 }]
[domain]
min = [-1.5, -1.2]
max = [2.0, 1.3]
[[body]]
name = "coarse"
shape = { circle = { center = [-0.4, 0.0], radius = 0.6 } }
[[body]]
name = "fine"
spacing = 0.025
shape = { box = { min = [0.5, -0.3], max = [0.9, 0.2] } }
"#;

/// Rows of a CSV by name.
fn rows(text: &str) -> Vec<std::collections::HashMap<String, String>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    lines
        .map(|line| {
            let fields = line.split(',').map(str::to_owned);
            names
                .iter()
                .map(|&name| name.to_owned())
                .zip(fields)
                .collect()
        })
        .collect()
}

#[test]
fn particles_grow_away_from_bodies() {
    let desk = Desk::new().with("scene.toml", SCENE);
    desk.succeed(&[
        "pack",
        "scene.toml",
        "-o",
        "out.csv",
        "-o",
        "out.vtu",
        "--report",
        "out.json",
        "--picture",
        "out.png",
    ]);
    let text = String::from_utf8(desk.read("out.csv")).expect("text");
    let rows = rows(&text);
    let number = |row: &std::collections::HashMap<String, String>, name: &str| -> f64 {
        row[name].parse().expect("a number")
    };
    let volume = |wanted: &str| -> f64 {
        (rows.iter())
            .filter(|row| row["body"] == wanted)
            .map(|row| number(row, "volume"))
            .sum()
    };
    // To rounding: a disc by formula, a box, and the rest of the domain.
    let disc = std::f64::consts::PI * 0.36;
    for (body, exact) in [
        ("coarse", disc),
        ("fine", 0.2),
        ("", 3.5 * 2.5 - disc - 0.2),
    ] {
        assert!(
            (volume(body) / exact - 1.0).abs() < 1e-12,
            "{body}: {}",
            volume(body)
        );
    }
    for row in &rows {
        let (s, h) = (number(row, "spacing"), number(row, "h"));
        assert!((h / s - 1.2).abs() < 1e-12);
        let size = number(row, "volume").sqrt();
        assert!(
            (size / s - 1.0).abs() < if row["kind"] == "free" { 5e-3 } else { 0.08 },
            "{row:?}"
        );
    }
    let spacing = |kind: &str, body: &str| {
        let of = rows
            .iter()
            .filter(|row| row["kind"] == kind && row["body"] == body);
        of.map(|row| number(row, "spacing"))
            .fold(f64::INFINITY, f64::min)
    };
    assert!((spacing("fixed", "fine") - 0.025).abs() < 1e-9);
    let report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    let resolution = &report["resolution"];
    assert!(resolution["growth_max"].as_f64().expect("a number") <= 1.1 + 1e-12);
    assert!(resolution["ratio"].as_f64().expect("a number") > 5.0);
    assert!(report["density"]["linf"].as_f64().expect("a number") < 2.5e-3);
    // Written Γ is what anybody's measure finds, each particle by its own h.
    desk.succeed(&["pack", "scene.toml", "-o", "all.npz", "--force", "-q"]);
    for file in ["out.csv", "out.vtu", "all.npz"] {
        let ending = desk.succeed(&["quality", file, "--spacing", "0.025", "--json"]);
        let measured: Value = serde_json::from_str(&ending.stdout).expect("JSON");
        assert_eq!(measured["h_over_spacing"].as_f64(), Some(1.2), "{file}");
        // Without frozen rows what is near the edge is left out, the rest has its Γ.
        let messages = measured["audit"]["messages"].as_array().expect("a list");
        assert!(messages.is_empty(), "{file}: {messages:?}");
    }
}

#[test]
fn frozen_images_support_what_is_at_open_sides() {
    let scene =
        format!("{SCENE}\n[output]\ninclude = [\"free\", \"boundary\", \"fixed\", \"frozen\"]\n");
    let desk = Desk::new().with("scene.toml", scene);
    let (_, report) = packed(&desk);
    let ending = desk.succeed(&["quality", "out.csv", "--spacing", "0.025", "--json"]);
    let measured: Value = serde_json::from_str(&ending.stdout).expect("JSON");
    let linf = |of: &Value| of["density"]["linf"].as_f64().expect("a number");
    assert!(
        (linf(&measured) - linf(&report)).abs() < 1e-9,
        "{measured} {report}"
    );
    assert_eq!(
        measured["particles"]["left_out_near_edge"].as_u64(),
        Some(0)
    );
}

#[test]
fn the_dry_run_tells_how_many() {
    let desk = Desk::new().with("scene.toml", SCENE);
    let ending = desk.succeed(&["pack", "scene.toml", "--dry-run"]);
    assert!(
        ending.stdout.contains("times fewer than at the finest"),
        "{}",
        ending.stdout
    );
    let said = ending
        .stdout
        .lines()
        .find(|line| line.contains("particles "))
        .expect("a line");
    let said: f64 = said
        .split_whitespace()
        .nth(1)
        .expect("a number")
        .replace(',', "")
        .parse()
        .expect("a number");
    desk.succeed(&["pack", "scene.toml", "-o", "out.csv", "-q"]);
    let text = String::from_utf8(desk.read("out.csv")).expect("text");
    let packed = rows(&text).len() as f64;
    assert!((said / packed - 1.0).abs() < 0.05, "{said} {packed}");
}

const ELLIPSE: &str = r#"
spacing = 0.1
[refinement]
coarsest = 0.2
finest = 0.005
growth = 1.1
[domain]
margin = 0.6
[[body]]
name = "ellipse"
curvature = 10
shape = { ellipse = { center = [0.3, -0.2], semi_axes = [1.0, 0.25] } }
"#;

/// The spacings of surface particles whose place is as asked.
fn spacings(text: &str, is_asked: impl Fn([f64; 2]) -> bool) -> Vec<f64> {
    let number = |row: &std::collections::HashMap<String, String>, name: &str| -> f64 {
        row[name].parse().expect("a number")
    };
    (rows(text).iter())
        .filter(|row| row["kind"] != "free" && is_asked([number(row, "x"), number(row, "y")]))
        .map(|row| number(row, "spacing"))
        .collect()
}

/// The particles and the report of a scene that packs.
fn packed(desk: &Desk) -> (String, Value) {
    let outputs = ["-o", "out.csv", "--report", "out.json"];
    desk.succeed(&[&["pack", "scene.toml"], &outputs[..]].concat());
    let text = String::from_utf8(desk.read("out.csv")).expect("text");
    let report = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    (text, report)
}

#[test]
fn surfaces_are_finer_where_they_bend() {
    let desk = Desk::new().with("scene.toml", ELLIPSE);
    let (text, report) = packed(&desk);
    let tip = spacings(&text, |p| (p[0] - 0.3).abs() > 0.98);
    // b²/a is the radius at the tips: ten particles to it.
    let asked = 0.0625 / 10.0;
    assert!(tip.len() >= 4, "{tip:?}");
    for spacing in tip {
        assert!((0.8 * asked..1.3 * asked).contains(&spacing), "{spacing}");
    }
    let flank = spacings(&text, |p| (p[0] - 0.3).abs() < 0.2);
    assert!(flank.iter().all(|spacing| *spacing > 0.05), "{flank:?}");
    let figure = |path: &str| report.pointer(path).and_then(Value::as_f64).expect(path);
    assert!(figure("/density/linf") < 2.5e-3);
    assert_eq!(report["resolution"]["gamma"], "gather");
    // The mean of h is off by what the field causes, which gather is not.
    assert!(figure("/resolution/symmetric/linf") > 2.0 * figure("/density/linf"));
    assert!(figure("/resolution/symmetric/rest_rms") < figure("/resolution/symmetric/rms"));
    for (from, to, words) in [
        ("finest = 0.005\n", "", "refinement.finest"),
        ("curvature = 10", "curvature = 0", "particles per radius"),
    ] {
        let desk = Desk::new().with("scene.toml", ELLIPSE.replace(from, to));
        desk.refuse(&["pack", "scene.toml"], &[words]);
    }
}

#[test]
fn spacings_come_from_a_file() {
    let scene = r#"
spacing = 0.1
[refinement]
coarsest = 0.1
growth = 1.1
field = "spacing.csv"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[[body]]
name = "disc"
shape = { circle = { center = [0.0, 0.0], radius = 0.6 } }
"#;
    // Fine on the left, in rows of no order.
    let mut lines: Vec<String> = (0..441)
        .map(|k| {
            let k = (k * 100) % 441;
            let (x, y) = (
                f64::from(k % 21) / 10.0 - 1.0,
                f64::from(k / 21) / 10.0 - 1.0,
            );
            format!("{x},{y},{}", if x < -0.35 { 0.03 } else { 0.2 })
        })
        .collect();
    lines.insert(0, "x,y,spacing".to_owned());
    let field = lines.join("\n");
    let desk = Desk::new()
        .with("scene.toml", scene)
        .with("spacing.csv", &field);
    let (text, report) = packed(&desk);
    let [left, right] = [-1.0, 1.0].map(|side| spacings(&text, |p| side * p[0] > 0.52));
    assert!(
        left.len() > 4 && left.iter().all(|s| (s / 0.03 - 1.0).abs() < 0.02),
        "{left:?}"
    );
    assert!(
        right.len() > 2 && right.iter().all(|s| *s > 0.09),
        "{right:?}"
    );
    let growth = report["resolution"]["growth_max"]
        .as_f64()
        .expect("a number");
    assert!(growth < 1.13, "{growth}");
    for (content, words) in [
        (lines[..440].join("\n"), "no regular grid"),
        (
            field.replace("x,y,spacing", "x,y,s"),
            "no column \"spacing\"",
        ),
        (field.replace(",0.03", ",-0.03"), "not a positive number"),
    ] {
        let desk = Desk::new()
            .with("scene.toml", scene)
            .with("spacing.csv", content);
        desk.refuse(&["pack", "scene.toml"], &[words, "spacing.csv"]);
    }
}
