//! Strips and plates that are thinner than particles, or a few of them thick.

use super::super::case::{Body, Case};
use super::super::shape::Shape;
use super::panel::{Axis, Panel};
use super::scenes::{OFF, alone, rectangle, scene, turned};

const THICKNESSES: &[f64] = &[
    0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6,
    1.7, 1.8, 2.0, 2.2, 2.4, 2.5, 2.6, 2.8, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0,
];

pub(super) const STRIP: Panel = Panel {
    title: "In the plane: a strip, 14 ∆s long",
    x: Axis::numbers("thickness, ∆s", THICKNESSES),
    y: Axis::numbers("turned by, degrees", &[0.0, 5.0, 15.0, 30.0, 45.0]),
    home: 6.0,
    only: None,
    case: |thickness, degrees| {
        let points = turned(&rectangle([0.0; 2], [14.0, thickness]), degrees);
        alone(2, Shape::Polygon { points })
    },
};

const PLATE_THICKNESSES: &[f64] = &[
    0.05, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.5, 1.8, 2.0, 2.5, 3.0, 4.0, 6.0,
];

pub(super) const PLATE: Panel = Panel {
    title: "In space: a plate, 8 by 7 ∆s",
    x: Axis::numbers("thickness, ∆s", PLATE_THICKNESSES),
    y: Axis::numbers("turned by, degrees", &[0.0, 30.0]),
    home: 6.0,
    only: None,
    case: plate,
};

fn plate(thickness: f64, degrees: f64) -> Case {
    let shape = Shape::Box {
        min: vec![OFF[0] - 4.0, OFF[1] - 3.5, -0.5 * thickness],
        max: vec![OFF[0] + 4.0, OFF[1] + 3.5, 0.5 * thickness],
    };
    let mut body = Body::new("plate", shape);
    if degrees != 0.0 {
        body.rotate = Some(([1.0, 2.0, 0.5], degrees));
    }
    scene(3, vec![body])
}
