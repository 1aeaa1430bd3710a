//! Bodies of several small parts.

use super::super::case::Case;
use super::panel::{Axis, Panel};
use super::scenes::{OFF, alone, loops, rectangle};

const SIZES: &[f64] = &[
    0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.5, 1.7, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0,
];

pub(super) const DISTANCE: Panel = Panel {
    title: "Four squares of one body",
    x: Axis::numbers("side of a square, ∆s", SIZES),
    y: Axis::numbers(
        "between squares, ∆s",
        &[0.1, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0],
    ),
    home: 10.0,
    only: None,
    case: |size, distance| squares(size, 2, distance),
};

pub(super) const NUMBER: Panel = Panel {
    title: "Squares of one body, 2 ∆s between them",
    x: Axis::numbers("side of a square, ∆s", SIZES),
    y: Axis::numbers("squares", &[1.0, 4.0, 9.0, 16.0]),
    home: 10.0,
    only: None,
    case: |size, number| squares(size, number.sqrt() as usize, 2.0),
};

/// Rows of squares, as many in each as there are rows.
fn squares(size: f64, rows: usize, distance: f64) -> Case {
    let at = |k: usize| k as f64 * (size + distance);
    let all = (0..rows * rows).map(|k| {
        let corner = [OFF[0] + at(k % rows), OFF[1] + at(k / rows)];
        rectangle(corner, [size; 2])
    });
    alone(2, loops(all.collect()))
}
