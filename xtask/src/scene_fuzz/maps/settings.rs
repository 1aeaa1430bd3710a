//! What a scene can set: constants of the methods, where bodies lie on the lattice, seeds.

use super::super::case::{Body, Case, Sides};
use super::super::shape::Shape;
use super::panel::{Axis, Panel};
use super::scenes::{OFF, alone, rectangle, scene, turned};

const FACTORS: &[f64] = &[0.01, 0.03, 0.1, 0.3, 0.5, 1.0, 2.0, 3.0, 10.0, 30.0, 100.0];

pub(super) const BALANCED: Panel = Panel {
    title: "Constants of balanced",
    x: Axis::numbers("times the default", FACTORS),
    y: Axis::words(
        "setting",
        &[
            "levelling",
            "residual_tolerance",
            "max_iterations",
            "mass_spread",
        ],
    ),
    home: 1.0,
    only: Some("balanced"),
    case: |factor, key| {
        square(match key as usize {
            0 => vec![line("levelling", 10.0 * factor)],
            1 => vec![line("residual_tolerance", 1e-3 * factor)],
            2 => vec![most_iterations(factor)],
            _ => vec![
                "masses = \"corrected\"".to_owned(),
                line("mass_spread", 0.02 * factor),
            ],
        })
    },
};

pub(super) const HYBRID: Panel = Panel {
    title: "Constants of hybrid (001)",
    x: Axis::numbers(
        "times the default, or times what the paper has where that is off",
        FACTORS,
    ),
    y: Axis::words(
        "setting",
        &[
            "time_step",
            "capture, at first",
            "capture, later",
            "predicted (0.9)",
            "moving (6)",
            "projection_growth (1.5)",
            "velocity_tolerance",
            "max_iterations",
        ],
    ),
    home: 1.0,
    only: Some("hybrid"),
    case: |factor, key| {
        square(vec![match key as usize {
            0 => line("hybrid.time_step", factor),
            1 => format!("hybrid.capture = [{:?}, 0.65]", 0.5 * factor),
            2 => format!("hybrid.capture = [0.5, {:?}]", 0.65 * factor),
            3 => line("hybrid.predicted", 0.9 * factor),
            4 => line("hybrid.moving", 6.0 * factor),
            5 => line("hybrid.projection_growth", 1.5 * factor),
            6 => line("velocity_tolerance", 1e-4 * factor),
            _ => most_iterations(factor),
        }])
    },
};

pub(super) const COMPLEX: Panel = Panel {
    title: "Constants of complex",
    x: Axis::numbers("times the default", FACTORS),
    y: Axis::words(
        "setting",
        &["levelling", "residual_tolerance", "max_iterations"],
    ),
    home: 1.0,
    only: Some("complex"),
    case: |factor, key| {
        square(vec![match key as usize {
            0 => line("levelling", 1000.0 * factor),
            1 => line("residual_tolerance", 1e-3 * factor),
            _ => most_iterations(factor),
        }])
    },
};

pub(super) const LATTICE: Panel = Panel {
    title: "An airfoil, moved and turned on the lattice",
    x: Axis::numbers(
        "moved by, ∆s",
        &[0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9],
    ),
    y: Axis::numbers(
        "turned by, degrees",
        &[0.0, 5.0, 10.0, 20.0, 30.0, 45.0, 60.0, 80.0, 90.0],
    ),
    home: 0.0,
    only: None,
    case: |shift, degrees| {
        let mut body = Body::new("airfoil", airfoil());
        if degrees != 0.0 {
            body.rotate = Some(([0.0, 0.0, 1.0], degrees));
        }
        body.translate = Some(vec![16.0 + shift, 16.0 + 0.62 * shift]);
        let mut case = scene(2, vec![body]);
        // The lattice stays where it is.
        case.sides = Sides::Corners(vec![0.0; 2], vec![34.0; 2]);
        case
    },
};

pub(super) const SEED: Panel = Panel {
    title: "Seeds",
    x: Axis::numbers("seed", &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]),
    y: Axis::words("body", &["airfoil", "square", "disc"]),
    home: 0.0,
    only: None,
    case: |seed, body| {
        let mut case = match body as usize {
            0 => alone(2, airfoil()),
            1 => square(Vec::new()),
            _ => alone(
                2,
                Shape::Circle {
                    center: OFF,
                    radius: 5.0,
                },
            ),
        };
        case.packing.push(format!("seed = {seed}"));
        case
    },
};

fn airfoil() -> Shape {
    Shape::Naca {
        digits: "0015",
        chord: 16.0,
    }
}

/// A turned square with these lines among its settings.
fn square(lines: Vec<String>) -> Case {
    let points = turned(&rectangle([0.0; 2], [9.0, 9.0]), 20.0);
    let mut case = alone(2, Shape::Polygon { points });
    case.packing = lines;
    case
}

fn line(key: &str, value: f64) -> String {
    format!("{key} = {value:?}")
}

fn most_iterations(factor: f64) -> String {
    format!("max_iterations = {}", (20_000.0 * factor).round())
}
