//! Bodies that overlap, and which of them keeps the common part.

use std::f64::consts::PI;

use serde_json::Value;

use crate::{Desk, cube, stl};

/// A body of a scene; `more` are further keys.
fn body(name: &str, shape: &str, more: &str) -> String {
    format!("[[body]]\nname = \"{name}\"\nshape = {{ {shape} }}\n{more}\n")
}

fn scene(spacing: f64, bodies: &[String]) -> String {
    format!(
        "spacing = {spacing}\n[domain]\nmargin = {}\n{}",
        4.0 * spacing,
        bodies.concat()
    )
}

const DISC: &str = "circle = { center = [0.0, 0.0], radius = 1.0 }";
const PLATE: &str = "box = { min = [0.0, -2.0], max = [2.0, 2.0] }";

/// Packs, and gives true and packed volumes.
fn volumes(desk: &Desk, name: &str) -> Vec<(f64, f64)> {
    desk.succeed(&[
        "pack", name, "-o", "out.csv", "--report", "out.json", "--force",
    ]);
    let report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    report["bodies"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|body| {
            let number = |key: &str| body[key].as_f64().expect("a number");
            (number("volume_true"), number("volume"))
        })
        .collect()
}

#[track_caller]
fn check(found: &[(f64, f64)], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (&(exact, packed), &wanted) in found.iter().zip(expected) {
        assert!((exact - wanted).abs() <= tolerance, "{exact}, not {wanted}");
        assert!((packed / exact - 1.0).abs() < 0.05, "{packed}, not {exact}");
    }
}

#[test]
fn the_higher_one_keeps_the_room() {
    let desk = Desk::new()
        .with(
            "disc.toml",
            scene(
                0.1,
                &[
                    body("disc", DISC, "precedence = 1"),
                    body("plate", PLATE, ""),
                ],
            ),
        )
        .with(
            "plate.toml",
            scene(
                0.1,
                &[
                    body("disc", DISC, "precedence = -1"),
                    body("plate", PLATE, ""),
                ],
            ),
        );
    check(&volumes(&desk, "disc.toml"), &[PI, 8.0 - 0.5 * PI], 2e-6);
    check(&volumes(&desk, "plate.toml"), &[0.5 * PI, 8.0], 2e-6);
}

#[test]
fn three_bodies_and_a_placed_one() {
    let strip = |more: &str| {
        body(
            "strip",
            "box = { min = [-3.0, -0.25], max = [3.0, 0.25] }",
            more,
        )
    };
    let wide = "circle = { center = [0.0, 0.0], radius = 0.5 }";
    let desk = Desk::new().with(
        "scene.toml",
        scene(
            0.1,
            &[
                strip("precedence = 2"),
                body("plate", PLATE, ""),
                body("disc", wide, "scale = 2.0\nprecedence = 1"),
            ],
        ),
    );
    // The part of a unit disc with |y| < 1/4.
    let band = 0.5 * (1.0_f64 - 0.0625).sqrt() + 2.0 * 0.25_f64.asin();
    check(
        &volumes(&desk, "scene.toml"),
        &[3.0, 8.0 - 0.5 * PI - (1.0 - 0.5 * band), PI - band],
        2e-6,
    );
}

#[test]
fn meshes_and_boxes() {
    let low = body("cube", "file = \"cube.stl\"", "");
    let high = |shape: &str| body("other", shape, "precedence = 3");
    let desk = Desk::new()
        .with("cube.stl", stl(&cube()))
        .with(
            "box.toml",
            scene(
                0.1,
                &[
                    low.clone(),
                    high("box = { min = [0.5, 0.45, 0.4], max = [1.5, 1.4, 1.3] }"),
                ],
            ),
        )
        .with(
            "mesh.toml",
            scene(
                0.1,
                &[
                    low.clone(),
                    high("file = \"cube.stl\"") + "translate = [0.5, 0.55, 0.6]\n",
                ],
            ),
        )
        .with(
            "ball.toml",
            scene(
                0.1,
                &[
                    low.clone(),
                    high("sphere = { center = [1.0, 1.0, 1.0], radius = 0.5 }"),
                ],
            ),
        )
        .with(
            "away.toml",
            scene(
                0.1,
                &[
                    low,
                    high("sphere = { center = [2.0, 1.0, 1.0], radius = 0.5 }"),
                ],
            ),
        );
    check(
        &volumes(&desk, "box.toml"),
        &[1.0 - 0.5 * 0.55 * 0.6, 1.0 * 0.95 * 0.9],
        1e-9,
    );
    check(
        &volumes(&desk, "mesh.toml"),
        &[1.0 - 0.5 * 0.45 * 0.4, 1.0],
        1e-9,
    );
    let octant = PI / 48.0;
    check(
        &volumes(&desk, "ball.toml"),
        &[1.0 - octant, 8.0 * octant],
        1e-3,
    );
    desk.succeed(&["pack", "away.toml", "--dry-run"]);
}

/// The volume that balls of radii `r` and `s` at distance `d` have in common.
fn lens(r: f64, s: f64, d: f64) -> f64 {
    PI * (r + s - d).powi(2) * (d * d + 2.0 * d * (r + s) - 3.0 * (r - s).powi(2)) / (12.0 * d)
}

#[test]
fn balls_are_cut_by_level_sets() {
    let desk = Desk::new().with(
        "balls.toml",
        scene(
            0.1,
            &[
                body(
                    "low",
                    "sphere = { center = [0.0, 0.0, 0.0], radius = 0.5 }",
                    "",
                ),
                body(
                    "high",
                    "sphere = { center = [0.3, 0.4, 0.33], radius = 0.4 }",
                    "precedence = 1",
                ),
            ],
        ),
    );
    let ball = |r: f64| 4.0 / 3.0 * PI * r * r * r;
    let exact = ball(0.5) - lens(0.5, 0.4, (0.25_f64 + 0.33 * 0.33).sqrt());
    let found = volumes(&desk, "balls.toml");
    eprintln!("volume {:+.4} %", 100.0 * (found[0].0 / exact - 1.0));
    check(&found, &[exact, ball(0.4)], 0.001 * exact);
}

#[test]
fn shapes_by_formula_are_cut_by_level_sets() {
    let cut = |low: &str, high: &str| {
        let desk = Desk::new().with(
            "scene.toml",
            scene(
                0.1,
                &[body("low", low, ""), body("high", high, "precedence = 1")],
            ),
        );
        volumes(&desk, "scene.toml")[0]
    };
    // Three quarters, a half, a half and a hole through the middle.
    for (low, high, exact) in [
        (
            "ellipsoid = { center = [0.0, 0.0, 0.0], semi_axes = [0.6, 0.4, 0.5] }",
            "box = { min = [-1.0, 0.0, 0.0], max = [1.0, 1.0, 1.0] }",
            0.12 * PI,
        ),
        (
            "cylinder = { start = [0.0, 0.0, -0.5], end = [0.0, 0.0, 0.5], radius = 0.4 }",
            "box = { min = [0.0, -1.0, -1.0], max = [1.0, 1.0, 1.0] }",
            0.08 * PI,
        ),
        (
            "torus = { center = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], major = 0.6, minor = 0.3 }",
            "box = { min = [-1.0, 0.0, -1.0], max = [1.0, 1.0, 1.0] }",
            PI * PI * 0.6 * 0.09,
        ),
        (
            "box = { min = [-0.5, -0.5, -0.5], max = [0.5, 0.5, 0.5] }",
            "cylinder = { start = [0.0, 0.0, -1.0], end = [0.0, 0.0, 1.0], radius = 0.3 }",
            1.0 - 0.09 * PI,
        ),
    ] {
        let (volume, packed) = cut(low, high);
        let off = volume / exact - 1.0;
        eprintln!("{low}: {:+.4} %", 100.0 * off);
        assert!(off.abs() < 5e-3, "{low}: {volume}, not {exact}");
        assert!((packed / volume - 1.0).abs() < 0.05, "{low}: {packed}");
    }
}

#[test]
fn shallow_overlaps_are_cut_too() {
    let block = body(
        "block",
        "box = { min = [-3.0, -1.0], max = [-0.991, 1.0] }",
        "",
    );
    let cube = |min: f64, more: &str| {
        let shape = format!("box = {{ min = [{min:?}, 0.0, 0.0], max = [1.6, 1.0, 1.0] }}");
        body("cube", &shape, more)
    };
    let desk = Desk::new()
        .with(
            "plane.toml",
            scene(0.1, &[block, body("disc", DISC, "precedence = 1")]),
        )
        .with(
            "space.toml",
            scene(
                0.1,
                &[
                    body(
                        "low",
                        "box = { min = [0.0, 0.0, 0.0], max = [1.0, 1.0, 1.0] }",
                        "",
                    ),
                    cube(0.991, "precedence = 1"),
                ],
            ),
        );
    // By 0.09 ∆s: the cap of the disc beyond x = −0.991.
    let half = 0.991_f64.acos();
    let cap = half - half.sin() * half.cos();
    check(
        &volumes(&desk, "plane.toml"),
        &[2.009 * 2.0 - cap, PI],
        2e-6,
    );
    // What cuts is grown by 10⁻⁶ of its size where its edges meet the diagonals of the other's faces.
    check(&volumes(&desk, "space.toml"), &[0.991, 0.609], 2e-6);
}

#[test]
fn what_is_refused() {
    let desk = Desk::new()
        .with(
            "equal.toml",
            scene(
                0.1,
                &[
                    body("disc", DISC, "precedence = 1"),
                    body("plate", PLATE, "precedence = 1"),
                ],
            ),
        )
        .with(
            "nothing.toml",
            scene(
                0.1,
                &[
                    body("dot", "circle = { center = [1.0, 0.0], radius = 0.4 }", ""),
                    body("plate", PLATE, "precedence = 1"),
                ],
            ),
        )
        .with(
            "container.toml",
            scene(
                0.1,
                &[body("disc", DISC, "role = \"container\"\nprecedence = 1")],
            ),
        )
        .with(
            "half.toml",
            scene(0.1, &[body("disc", DISC, "precedence = 0.5")]),
        );
    for (name, parts) in [
        (
            "equal.toml",
            &["\"disc\" and \"plate\" overlap", "precedence = "][..],
        ),
        (
            "nothing.toml",
            &[
                "nothing is left of body \"dot\"",
                "\"plate\"",
                "raise its precedence",
            ],
        ),
        (
            "container.toml",
            &[
                "container.toml:8:",
                "body \"disc\": precedence is for solid bodies",
            ],
        ),
        ("half.toml", &["half.toml:7:14", "0.5"]),
    ] {
        let mut parts = parts.to_vec();
        parts.push(name);
        desk.refuse(&["pack", name], &parts);
    }
}
