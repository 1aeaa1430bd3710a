//! Corners: sectors of a disc with an angle at their tip, wedges and cones.

use super::super::case::Case;
use super::super::meshes::prism;
use super::super::shape::{MeshFormat, Shape};
use super::panel::{Axis, Panel};
use super::scenes::{OFF, alone, arc, turned};

/// Interior angles in degrees, reflex ones above 180.
const ANGLES: &[f64] = &[
    2.0, 4.0, 6.0, 8.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 135.0, 150.0,
    165.0, 178.0, 182.0, 195.0, 210.0, 240.0, 270.0, 300.0, 330.0, 345.0, 352.0, 356.0, 358.0,
];

const SIDES: &[f64] = &[3.0, 4.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0];

pub(super) const PLANE: Panel = Panel {
    title: "In the plane: a sector of a disc",
    x: Axis::numbers("angle inside the body at its tip, degrees", ANGLES),
    y: Axis::numbers("length of the sides, ∆s", SIDES),
    home: 90.0,
    only: None,
    case: sector,
};

pub(super) const WEDGE: Panel = Panel {
    title: "In space: a wedge, 5 ∆s wide",
    x: Axis::numbers("angle of the edge, degrees", SPACE_ANGLES),
    y: Axis::numbers("length of the sides, ∆s", SPACE_SIDES),
    home: 150.0,
    only: None,
    case: wedge,
};

pub(super) const CONE: Panel = Panel {
    title: "In space: a cone of 24 sides",
    x: Axis::numbers("opening angle, degrees", SPACE_ANGLES),
    y: Axis::numbers("length of the sides, ∆s", SPACE_SIDES),
    home: 150.0,
    only: None,
    case: cone,
};

const SPACE_ANGLES: &[f64] = &[5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0];

const SPACE_SIDES: &[f64] = &[3.0, 5.0, 8.0];

/// How bodies are turned, in degrees: along no axis.
const TURN: f64 = 20.0;

fn sector(angle: f64, side: f64) -> Case {
    let mut points = vec![[0.0, 0.0]];
    points.extend(arc([0.0, 0.0], side, [-0.5 * angle, 0.5 * angle]));
    alone(
        2,
        Shape::Polygon {
            points: turned(&points, TURN),
        },
    )
}

fn wedge(angle: f64, side: f64) -> Case {
    let (sin, cos) = (0.5 * angle).to_radians().sin_cos();
    let triangle = turned(
        &[
            [0.0, 0.0],
            [side * cos, -side * sin],
            [side * cos, side * sin],
        ],
        TURN,
    );
    let (points, triangles) = prism(&triangle, &[[0, 1, 2]], [0.0, 5.0]);
    mesh(points, triangles)
}

fn cone(angle: f64, side: f64) -> Case {
    const COUNT: usize = 24;
    let (sin, cos) = (0.5 * angle).to_radians().sin_cos();
    let mut points = vec![[OFF[0], OFF[1], 0.0], [OFF[0], OFF[1], side * cos]];
    for k in 0..COUNT {
        let (y, x) = (std::f64::consts::TAU * k as f64 / COUNT as f64).sin_cos();
        points.push([OFF[0] + side * sin * x, OFF[1] + side * sin * y, side * cos]);
    }
    let triangles = (0..COUNT).flat_map(|k| {
        let (a, b) = (2 + k, 2 + (k + 1) % COUNT);
        [[0, b, a], [1, a, b]]
    });
    mesh(points, triangles.collect())
}

fn mesh(points: Vec<[f64; 3]>, triangles: Vec<[usize; 3]>) -> Case {
    alone(
        3,
        Shape::Mesh {
            points,
            triangles,
            format: MeshFormat::StlText,
        },
    )
}
