//! Bodies that pass the sides of the box, lie on them or meet their images; voids that cut; thin parts that must hold water.

use std::f64::consts::PI;

use serde_json::Value;

use crate::{Desk, stl};

fn scene(spacing: f64, domain: &str, bodies: &str) -> String {
    format!("spacing = {spacing}\n[domain]\n{domain}\n{bodies}")
}

/// Packs, and gives the report.
fn pack(desk: &Desk, name: &str) -> Value {
    desk.succeed(&[
        "pack", name, "-o", "out.csv", "--report", "out.json", "--force",
    ]);
    serde_json::from_slice(&desk.read("out.json")).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// Packed as evenly as a body that stands free, and every volume right.
#[track_caller]
fn check(report: &Value, volumes: &[f64], within: f64) {
    let linf = number(&report["density"]["linf"]);
    let closest = number(&report["closest_pair_over_spacing"]);
    assert!(linf < 5e-3 && closest > 0.75, "{linf} {closest}");
    let bodies = report["bodies"].as_array().expect("a list");
    assert_eq!(bodies.len(), volumes.len());
    for (body, exact) in bodies.iter().zip(volumes) {
        let [whole, packed] = ["volume_true", "volume"].map(|key| number(&body[key]));
        assert!((whole - exact).abs() <= within, "{whole}, not {exact}");
        assert!(
            (packed - exact).abs() <= 1e-2 * exact,
            "{packed}, not {exact}"
        );
    }
}

const OPEN: &str = "min = [0, 0]\nmax = [3, 2]";
const CHANNEL: &str = "min = [0, 0]\nmax = [3, 2]\nperiodic = [true, false]";
const CELL: &str = "min = [0, 0]\nmax = [3, 2]\nperiodic = [true, true]";

#[test]
fn floors_walls_and_the_whole_box() {
    let floor = "[[body]]\nshape = { box = { min = [0, 0], max = [3, 0.53] } }\n";
    let whole = "[[body]]\nshape = { box = { min = [0, 0], max = [3, 2] } }\n";
    for (number, domain) in [OPEN, CHANNEL].into_iter().enumerate() {
        let desk = Desk::new().with("floor.toml", scene(0.1, domain, floor));
        let report = pack(&desk, "floor.toml");
        check(&report, &[1.59], 1e-9);
        // A row on the floor's upper side, and on no other.
        assert_eq!(report["particles"]["fixed"], 0, "{number}");
        assert_eq!(report["particles"]["boundary"], 30, "{number}");
        // Wherever a surface would be, there is none.
        for depth in ["\"exact\"", "0.2", "0.5", "0.6", "1.3"] {
            let at = format!("{whole}surface = {depth}\n");
            let desk = Desk::new().with("whole.toml", scene(0.1, domain, &at));
            let report = pack(&desk, "whole.toml");
            check(&report, &[6.0], 1e-9);
            assert_eq!(report["particles"]["boundary"], 0, "{depth}");
            assert_eq!(report["particles"]["fluid"], 0, "{depth}");
        }
    }
}

#[test]
fn what_passes_a_side_is_cut_and_told() {
    let bodies = "[[body]]\nname = \"pile\"\nshape = { box = { min = [0.9, -1.0], max = [1.6, 1.1] } }\n\
                  [[body]]\nname = \"disc\"\nshape = { circle = { center = [3.0, 1.0], radius = 0.6 } }\n";
    let desk = Desk::new().with("cut.toml", scene(0.1, OPEN, bodies));
    let report = pack(&desk, "cut.toml");
    check(&report, &[0.77, 0.5 * PI * 0.36], 1e-6);
    let warnings = report["warnings"].to_string();
    for part in [
        "\\\"pile\\\" reaches beyond the lower y side",
        "\\\"disc\\\" reaches beyond the upper x side",
    ] {
        assert!(warnings.contains(part), "{warnings}");
    }
    // The published methods refuse it, and name the cure.
    let hybrid = scene(0.1, OPEN, bodies) + "[packing]\nmethod = \"hybrid\"\n";
    let desk = desk.with("hybrid.toml", hybrid);
    desk.refuse(
        &["pack", "hybrid.toml"],
        &[
            "hybrid.toml",
            "\"pile\"",
            "reaches outside the domain",
            "balanced",
        ],
    );
    let away =
        "[[body]]\nname = \"away\"\nshape = { circle = { center = [5.0, 1.0], radius = 0.6 } }\n";
    let desk = desk.with("away.toml", scene(0.1, OPEN, away));
    desk.refuse(
        &["pack", "away.toml"],
        &["away.toml", "\"away\"", "outside the domain"],
    );
}

#[test]
fn what_passes_a_periodic_side_comes_back() {
    let disc = "[[body]]\nshape = { circle = { center = [3.1, -0.1], radius = 0.6 } }\n";
    let desk = Desk::new().with("disc.toml", scene(0.1, CELL, disc));
    let report = pack(&desk, "disc.toml");
    check(&report, &[PI * 0.36], 1e-6);
    assert_eq!(report["warnings"].as_array().map(Vec::len), Some(0));
}

#[test]
fn what_is_much_longer_than_the_box_is_refused() {
    let strip =
        "[[body]]\nname = \"strip\"\nshape = { box = { min = [-1e9, 0.5], max = [1e9, 1.0] } }\n";
    let long = "[[body]]\nname = \"strip\"\nshape = { box = { min = [0, 0.5], max = [4, 1.0] } }\n";
    let desk = Desk::new()
        .with("long.toml", scene(0.1, CHANNEL, strip))
        .with(
            "many.toml",
            scene(0.1, CHANNEL, &strip.replace("1e9", "1e3")),
        )
        .with("twice.toml", scene(0.1, CHANNEL, long))
        .with(
            "hybrid.toml",
            scene(0.1, CHANNEL, long) + "[packing]\nmethod = \"hybrid\"\n",
        );
    desk.refuse(
        &["pack", "long.toml"],
        &["\"strip\"", "times as large as the domain"],
    );
    desk.refuse(
        &["pack", "many.toml"],
        &["\"strip\"", "times as long", "along x"],
    );
    desk.refuse(
        &["pack", "hybrid.toml"],
        &["\"strip\"", "meets its own images", "balanced"],
    );
    // Over itself it is endless.
    let report = pack(&desk, "twice.toml");
    check(&report, &[1.5], 1e-9);
}

/// A tube along z, open to nothing: its ends lie on the sides, as single precision has them.
fn tube(length: f64) -> Vec<[[f32; 3]; 3]> {
    let place = |k: u32, z: f64| {
        let (sin, cos) = (2.0 * PI * f64::from(k) / 48.0).sin_cos();
        [0.7 + 0.35 * cos, 0.7 + 0.35 * sin, z]
    };
    (0..48)
        .flat_map(|k| {
            let [a, b] = [0.0, length].map(|z| place(k, z));
            let [c, d] = [0.0, length].map(|z| place(k + 1, z));
            let [low, high] = [0.0, length].map(|z| [0.7, 0.7, z]);
            [[low, c, a], [high, b, d], [a, c, d], [a, d, b]]
        })
        .map(|triangle| triangle.map(|corner| corner.map(|x| x as f32)))
        .collect()
}

#[test]
fn a_tube_of_the_periods_length_is_endless() {
    // 1.3 is none of the numbers of single precision.
    let desk = Desk::new().with("tube.stl", stl(&tube(1.3))).with(
        "tube.toml",
        scene(
            0.1,
            "min = [0, 0, 0]\nmax = [1.4, 1.4, 1.3]\nperiodic = [false, false, true]",
            "[[body]]\nshape = { file = \"tube.stl\" }\n",
        ),
    );
    let report = pack(&desk, "tube.toml");
    let area = 24.0 * 0.35 * 0.35 * (PI / 24.0).sin();
    check(&report, &[1.3 * area], 1e-5);
    assert_eq!(report["particles"]["fixed"], 0);
}

#[test]
fn a_void_of_higher_precedence_cuts() {
    let bodies = |more: &str| {
        format!(
            "[[body]]\nname = \"block\"\nshape = {{ box = {{ min = [0.8, 0.6], max = [2.2, 1.5] }} }}\n\
             [[body]]\nname = \"bore\"\nrole = \"void\"\n{more}shape = {{ box = {{ min = [1.2, 1.1], max = [1.8, 1.8] }} }}\n"
        )
    };
    let desk = Desk::new()
        .with("cut.toml", scene(0.1, OPEN, &bodies("precedence = 1\n")))
        .with("cross.toml", scene(0.1, OPEN, &bodies("")));
    let report = pack(&desk, "cut.toml");
    let block = &report["bodies"][0];
    assert!((number(&block["volume_true"]) - 1.02).abs() < 1e-9);
    assert!((number(&block["volume"]) - 1.02).abs() < 5e-3);
    desk.refuse(
        &["pack", "cross.toml"],
        &[
            "\"bore\" crosses the surface",
            "\"block\"",
            "precedence = 1",
        ],
    );
}

#[test]
fn thin_parts_hold_water() {
    let strip = |thin: &str| {
        let body = format!(
            "[[body]]\nname = \"strip\"\nthin = \"{thin}\"\nrotate_degrees = 17\nshape = {{ box = {{ min = [0.9, 0.4], max = [2.6, 0.43] }} }}\n"
        );
        scene(0.1, OPEN, &body)
    };
    let other = strip("watertight") + "[packing]\nmethod = \"hybrid\"\n";
    let desk = Desk::new()
        .with("mass.toml", strip("mass"))
        .with("tight.toml", strip("watertight"))
        .with("hybrid.toml", other);
    let report = pack(&desk, "mass.toml");
    assert!((number(&report["bodies"][0]["volume"]) - 0.051).abs() < 5e-3);
    let report = pack(&desk, "tight.toml");
    assert!(report["warnings"].to_string().contains("times its mass"));
    let volume = number(&report["bodies"][0]["volume"]);
    assert!((volume - 0.17).abs() < 0.015, "{volume}");
    // No hole along it wider than 1.2 spacings.
    let text = String::from_utf8(desk.read("out.csv")).expect("text");
    let (sin, cos) = (17.0_f64).to_radians().sin_cos();
    let mut along: Vec<f64> = (text.lines())
        .filter(|line| line.contains(",solid,"))
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            let [x, y]: [f64; 2] = [1, 2].map(|k: usize| fields[k].parse().expect("a number"));
            x * cos + y * sin
        })
        .collect();
    along.sort_by(f64::total_cmp);
    assert!(
        along.windows(2).all(|pair| pair[1] - pair[0] < 0.12),
        "{along:?}"
    );
    assert!(
        along[0] - 0.9 < 0.06 && 2.6 - along[along.len() - 1] < 0.06,
        "{along:?}"
    );
    desk.refuse(
        &["pack", "hybrid.toml"],
        &["hybrid.toml:7:", "\"strip\"", "watertight", "balanced"],
    );
}
