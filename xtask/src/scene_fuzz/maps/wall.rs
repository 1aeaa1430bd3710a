//! Bodies near the sides of the box, on them and beyond them, open and periodic.

use super::super::case::{Body, Case, Sides};
use super::super::shape::Shape;
use super::panel::{Axis, Panel};
use super::scenes::{rectangle, scene};

const DISTANCES: &[f64] = &[
    -6.0, -5.0, -4.0, -3.0, -2.0, -1.5, -1.0, -0.75, -0.5, -0.25, -0.1, 0.0, 0.1, 0.25, 0.5, 0.75,
    1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0,
];

pub(super) const PLANE: Panel = Panel {
    title: "In the plane: a square of 7 ∆s, a disc of 7 ∆s",
    x: Axis::numbers(
        "from the side of the box to the body, ∆s (negative: beyond it)",
        DISTANCES,
    ),
    y: Axis::words(
        "body and side",
        &[
            "square, open",
            "disc, open",
            "turned square, open",
            "square, two open sides",
            "square, periodic",
            "disc, periodic",
        ],
    ),
    home: 6.0,
    only: None,
    case,
};

/// The box.
const SIZE: [f64; 2] = [22.0, 18.0];

fn case(distance: f64, kind: f64) -> Case {
    let middle = 9.13;
    let square = |center: [f64; 2]| Shape::Polygon {
        points: rectangle(center, [7.0; 2]),
    };
    let disc = Shape::Circle {
        center: [distance + 3.5, middle],
        radius: 3.5,
    };
    let kind = kind as usize;
    let shape = match kind {
        1 | 5 => disc,
        // Its left corner is so far.
        2 => Shape::Polygon {
            points: [[0.0, 0.0], [3.5, -3.5], [7.0, 0.0], [3.5, 3.5]]
                .map(|[x, y]| [distance + x, middle + y])
                .to_vec(),
        },
        3 => square([distance + 3.5; 2]),
        _ => square([distance + 3.5, middle]),
    };
    let mut case = scene(2, vec![Body::new("body", shape)]);
    case.sides = Sides::Corners(vec![0.0; 2], SIZE.to_vec());
    case.periodic = vec![kind >= 4, false];
    case
}
