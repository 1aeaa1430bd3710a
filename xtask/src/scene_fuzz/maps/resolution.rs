//! Whole bodies at more and more particles across.

use std::f64::consts::TAU;

use super::super::case::Case;
use super::super::shape::Shape;
use super::panel::{Axis, Panel};
use super::scenes::{OFF, alone, circle, loops};

const LENGTHS: &[f64] = &[
    5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0, 17.0, 20.0, 25.0, 30.0, 40.0, 50.0, 70.0, 100.0, 140.0,
    200.0,
];

pub(super) const PLANE: Panel = Panel {
    title: "In the plane",
    x: Axis::numbers("length of the body, ∆s", LENGTHS),
    y: Axis::words(
        "body",
        &[
            "toothed wheel",
            "wheel with a bore",
            "airfoil 0012",
            "airfoil 4415",
            "starfish",
            "zigzag",
        ],
    ),
    home: 200.0,
    only: None,
    case: plane,
};

pub(super) const SPACE: Panel = Panel {
    title: "In space",
    x: Axis::numbers(
        "length of the body, ∆s",
        &[3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 14.0, 20.0],
    ),
    y: Axis::words("body", &["ball", "cube", "torus", "ellipsoid"]),
    home: 20.0,
    only: None,
    case: space,
};

/// A wheel: its radius at each place is that of its rim, or of the bottom between teeth, with straight flanks.
fn wheel(length: f64) -> Vec<[f64; 2]> {
    const TEETH: usize = 12;
    let [rim, bottom] = [0.5 * length, 0.38 * length];
    let corners = [(0.05, rim), (0.45, rim), (0.6, bottom), (0.9, bottom)];
    (0..TEETH)
        .flat_map(|tooth| corners.map(|(part, radius)| (tooth as f64 + part, radius)))
        .map(|(place, radius)| {
            let (sin, cos) = (TAU * place / TEETH as f64).sin_cos();
            [OFF[0] + radius * cos, OFF[1] + radius * sin]
        })
        .collect()
}

fn plane(length: f64, body: f64) -> Case {
    let naca = |digits| Shape::Naca {
        digits,
        chord: length,
    };
    let shape = match body as usize {
        0 => Shape::Polygon {
            points: wheel(length),
        },
        1 => {
            let bore = circle(OFF, 0.15 * length);
            loops(vec![wheel(length), bore])
        }
        2 => naca("0012"),
        3 => naca("4415"),
        4 => Shape::Starfish {
            center: OFF,
            radius: 0.38 * length,
            amplitude: 0.3,
            arms: 5,
        },
        _ => Shape::Zigzag {
            width: length,
            height: 0.4 * length,
            amplitude: 0.12 * length,
            teeth: 4,
        },
    };
    alone(2, shape)
}

fn space(length: f64, body: f64) -> Case {
    let center = [OFF[0], OFF[1], 0.2];
    let half = 0.5 * length;
    alone(
        3,
        match body as usize {
            0 => Shape::Sphere {
                center,
                radius: half,
            },
            1 => Shape::Box {
                min: center.map(|x| x - half).to_vec(),
                max: center.map(|x| x + half).to_vec(),
            },
            2 => Shape::Torus {
                center,
                axis: [1.0, 0.5, 2.0],
                major: 0.35 * length,
                minor: 0.15 * length,
            },
            _ => Shape::Ellipsoid {
                center,
                semi_axes: [half, 0.6 * half, 0.4 * half],
            },
        },
    )
}
