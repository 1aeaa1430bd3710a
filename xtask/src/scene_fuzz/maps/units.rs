//! Scenes in other units, and far from the origin.

use super::super::case::{Body, Case, Sides};
use super::super::shape::Shape;
use super::panel::{Axis, Panel};
use super::scenes::scene;

const UNITS: &[f64] = &[
    1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6,
];

const SHIFTS: &[f64] = &[0.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8, 1e10, 1e12];

pub(super) const PLANE: Panel = Panel {
    title: "In the plane: a disc and an airfoil",
    x: Axis::numbers("∆s in the scene's unit", UNITS),
    y: Axis::numbers("from the origin, ∆s", SHIFTS),
    home: 1.0,
    only: None,
    case: plane,
};

pub(super) const SPACE: Panel = Panel {
    title: "In space: a ball",
    x: Axis::numbers("∆s in the scene's unit", &[1e-6, 1e-3, 1.0, 1e3, 1e6]),
    y: Axis::numbers("from the origin, ∆s", &[0.0, 1e3, 1e6]),
    home: 1.0,
    only: None,
    case: space,
};

fn placed(mut case: Case, unit: f64, shift: f64, size: &[f64]) -> Case {
    case.spacing = unit;
    // Along no diagonal.
    let along = [1.0, 0.7, -0.4];
    case.origin = along[..size.len()]
        .iter()
        .map(|x| x * shift * unit)
        .collect();
    case.sides = Sides::Corners(vec![0.0; size.len()], size.to_vec());
    case
}

fn plane(unit: f64, shift: f64) -> Case {
    let disc = Body::new(
        "disc",
        Shape::Circle {
            center: [11.2, 9.6],
            radius: 3.0,
        },
    );
    let mut airfoil = Body::new(
        "airfoil",
        Shape::Naca {
            digits: "0015",
            chord: 14.0,
        },
    );
    airfoil.translate = Some(vec![5.0, 4.9]);
    placed(scene(2, vec![disc, airfoil]), unit, shift, &[24.0, 18.0])
}

fn space(unit: f64, shift: f64) -> Case {
    let ball = Shape::Sphere {
        center: [6.1, 6.2, 5.9],
        radius: 2.7,
    };
    let case = scene(3, vec![Body::new("ball", ball)]);
    placed(case, unit, shift, &[12.0, 12.0, 12.0])
}
