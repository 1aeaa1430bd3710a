//! What the scenes of all maps have in common.

use super::super::case::{Body, Case, Sides};
use super::super::shape::{OutlineFormat, Shape};

/// From bodies to the sides of the box, in ∆s.
const MARGIN: [f64; 2] = [6.0, 4.0];

/// What keeps bodies off places that are special on the lattice.
pub(super) const OFF: [f64; 2] = [0.137, 0.291];

/// A scene in which nothing but these bodies is out of the ordinary.
pub(super) fn scene(dimension: usize, bodies: Vec<Body>) -> Case {
    Case {
        dimension,
        // No power of 2, so that there is rounding.
        spacing: 0.1,
        origin: vec![0.0; dimension],
        sides: Sides::Margin(MARGIN[dimension - 2]),
        periodic: vec![false; dimension],
        bodies,
        fill: true,
        refinement: None,
        method: None,
        kernel: None,
        h_over_spacing: None,
        packing: Vec::new(),
        quality: None,
        include: Some(vec!["free", "boundary", "fixed", "frozen"]),
        prefix: String::new(),
    }
}

/// A scene of one body.
pub(super) fn alone(dimension: usize, shape: Shape) -> Case {
    scene(dimension, vec![Body::new("body", shape)])
}

/// Turned about the origin, counter-clockwise, and moved off the lattice.
pub(super) fn turned(points: &[[f64; 2]], degrees: f64) -> Vec<[f64; 2]> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let turn = |[x, y]: &[f64; 2]| [OFF[0] + cos * x - sin * y, OFF[1] + sin * x + cos * y];
    points.iter().map(turn).collect()
}

/// The corners of a rectangle about a place.
pub(super) fn rectangle(center: [f64; 2], size: [f64; 2]) -> Vec<[f64; 2]> {
    [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]
        .map(|[x, y]| [center[0] + x * size[0], center[1] + y * size[1]])
        .to_vec()
}

/// Points of an arc, both ends included, a side for every few degrees.
pub(super) fn arc(center: [f64; 2], radius: f64, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    const STEP: f64 = 3.0;
    let count = ((to - from).abs() / STEP).ceil().max(1.0) as usize;
    (0..=count)
        .map(|k| {
            let angle = (from + (to - from) * k as f64 / count as f64).to_radians();
            [
                center[0] + radius * angle.cos(),
                center[1] + radius * angle.sin(),
            ]
        })
        .collect()
}

/// A closed circle.
pub(super) fn circle(center: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let mut points = arc(center, radius, [0.0, 360.0]);
    points.pop();
    points
}

/// A body of several loops, those within others are holes.
pub(super) fn loops(loops: Vec<Vec<[f64; 2]>>) -> Shape {
    Shape::Outline {
        loops,
        format: OutlineFormat::Csv,
    }
}
