//! Round walls: convex and concave, down to radii below a spacing.

use super::super::case::{Body, Case, Role};
use super::super::shape::Shape;
use super::panel::{Axis, Panel};
use super::scenes::{OFF, alone, arc, circle, loops, rectangle, scene, turned};

const RADII: &[f64] = &[
    0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.7, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0,
    14.0, 20.0, 30.0, 50.0,
];

pub(super) const PLANE: Panel = Panel {
    title: "In the plane",
    x: Axis::numbers("radius, ∆s", RADII),
    y: Axis::words(
        "wall",
        &[
            "disc",
            "hole in a block",
            "tank",
            "round end of a strip",
            "round notch in a block",
        ],
    ),
    home: 10.0,
    only: None,
    case: plane,
};

pub(super) const SPACE: Panel = Panel {
    title: "In space",
    x: Axis::numbers("radius, ∆s", SPACE_RADII),
    y: Axis::words("wall", &["ball", "tank", "cylinder"]),
    home: 4.0,
    only: None,
    case: space,
};

const SPACE_RADII: &[f64] = &[0.5, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0];

fn tank(dimension: usize, shape: Shape) -> Case {
    let mut body = Body::new("tank", shape);
    body.role = Role::Container;
    scene(dimension, vec![body])
}

fn plane(radius: f64, wall: f64) -> Case {
    let disc = Shape::Circle {
        center: OFF,
        radius,
    };
    match wall as usize {
        0 => alone(2, disc),
        1 => {
            let size = 2.0 * radius + 8.0;
            alone(
                2,
                loops(vec![rectangle([0.0; 2], [size, size]), circle(OFF, radius)]),
            )
        }
        2 => tank(2, disc),
        3 => {
            let mut points = arc([4.0, 0.0], radius, [-90.0, 90.0]);
            points.extend(arc([-4.0, 0.0], radius, [90.0, 270.0]));
            let points = turned(&points, 20.0);
            alone(2, Shape::Polygon { points })
        }
        _ => {
            let width = radius + 4.0;
            let mut points = vec![
                [-width, -radius - 4.0],
                [width, -radius - 4.0],
                [width, 0.0],
            ];
            points.extend(arc([0.0; 2], radius, [0.0, -180.0]));
            points.push([-width, 0.0]);
            let points = turned(&points, 20.0);
            alone(2, Shape::Polygon { points })
        }
    }
}

fn space(radius: f64, wall: f64) -> Case {
    let ball = Shape::Sphere {
        center: [OFF[0], OFF[1], 0.2],
        radius,
    };
    match wall as usize {
        0 => alone(3, ball),
        1 => tank(3, ball),
        _ => alone(
            3,
            Shape::Cylinder {
                start: [OFF[0], OFF[1], -3.0],
                end: [OFF[0] + 1.0, OFF[1] + 2.0, 2.5],
                radius,
            },
        ),
    }
}
