//! Gaps: between two bodies, between nested shells, and slits in one body.

use super::super::case::{Body, Case};
use super::super::shape::Shape;
use super::panel::{Axis, Panel};
use super::scenes::{OFF, alone, circle, loops, rectangle, scene, turned};

const WIDTHS: &[f64] = &[
    0.0, 0.01, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5,
    1.7, 2.0, 2.2, 2.5, 2.8, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0,
];

pub(super) const PLANE: Panel = Panel {
    title: "In the plane",
    x: Axis::numbers("width of the gap, ∆s (0: the bodies touch)", WIDTHS),
    y: Axis::words(
        "between",
        &[
            "flat sides",
            "flat sides, turned",
            "corner and side",
            "two discs",
            "disc in a ring",
            "slit in a block",
        ],
    ),
    home: 6.0,
    only: None,
    case,
};

fn case(width: f64, between: f64) -> Case {
    let polygon = |points: Vec<[f64; 2]>| Shape::Polygon { points };
    let two = |first: Shape, second: Shape| {
        scene(
            2,
            vec![Body::new("first", first), Body::new("second", second)],
        )
    };
    let disc = |x: f64, radius: f64| Shape::Circle {
        center: [OFF[0] + x, OFF[1]],
        radius,
    };
    // The second begins where the first ends and `width` more, in the same numbers, so that touching is exact.
    match between as usize {
        0 => two(
            polygon(rectangle([-2.5, 0.25], [5.0, 7.5])),
            polygon(rectangle([width + 2.5, 0.25], [5.0, 7.5])),
        ),
        1 => two(
            polygon(turned(&rectangle([-2.5, 0.0], [5.0, 7.5]), 25.0)),
            polygon(turned(&rectangle([width + 2.5, 0.0], [5.0, 7.5]), 25.0)),
        ),
        2 => two(
            polygon(vec![
                [width, 0.25],
                [width + 5.0, -4.75],
                [width + 5.0, 5.25],
            ]),
            polygon(rectangle([-2.5, 0.0], [5.0, 10.0])),
        ),
        3 => two(disc(-4.0, 4.0), disc(4.0 + width, 4.0)),
        4 => two(
            loops(vec![
                circle(OFF, 4.0 + width + 3.0),
                circle(OFF, 4.0 + width),
            ]),
            Shape::Polygon {
                points: circle(OFF, 4.0),
            },
        ),
        _ => slit(width),
    }
}

/// A block, 10 ∆s high, with a slit of 6 ∆s from above; without one where it has no width.
fn slit(width: f64) -> Case {
    let (half, right) = (0.5 * width, 0.5 * width + 4.0);
    let mut points = vec![[-right, -5.0], [right, -5.0], [right, 5.0]];
    if width > 0.0 {
        points.extend([[half, 5.0], [half, -1.0], [-half, -1.0], [-half, 5.0]]);
    }
    points.push([-right, 5.0]);
    alone(
        2,
        Shape::Polygon {
            points: turned(&points, 10.0),
        },
    )
}
