//! Marks of the chart: a colour and a shape for each method, told apart also in print and by who does not see red or green.

use sphpack::scene::{Finish, Method};

use super::points::{Factor, Point};
use crate::drawing::{CIRCLE, DIAMOND, DOWN, SQUARE, UP};

/// How points of one kind are drawn.
pub(super) struct Shape {
    pub(super) name: &'static str,
    pub(super) colour: &'static str,
    pub(super) fill: &'static str,
    /// Around the point, in the units of a path.
    pub(super) path: &'static str,
}

const PENTAGON: &str = "M0-5L4.8-1.5L2.9 4H-2.9L-4.8-1.5z";
const CROSS: &str = "M-4-4L4 4M-4 4L4-4";
const PLUS: &str = "M-5 0H5M0-5V5";
const STAR: &str = "M0-6L1.5-1.5H6L2.4 1.2L3.8 5.6L0 2.9L-3.8 5.6L-2.4 1.2L-6-1.5H-1.5z";

const fn full(name: &'static str, colour: &'static str, path: &'static str) -> Shape {
    Shape {
        name,
        colour,
        fill: colour,
        path,
    }
}

/// Colours are Okabe and Ito's; the first is that of whatever changes a setting of the default.
pub(super) const SHAPES: [Shape; 13] = [
    Shape {
        name: "balanced even, one setting changed",
        colour: "#0072b2",
        fill: "white",
        path: CIRCLE,
    },
    full("balanced even (the default)", "#0072b2", CIRCLE),
    full("balanced consistent", "#0072b2", SQUARE),
    full("balanced both", "#0072b2", DIAMOND),
    full("balanced calm", "#0072b2", UP),
    full("hybrid", "#d55e00", SQUARE),
    full("standard", "#009e73", UP),
    full("coupled", "#cc79a7", DIAMOND),
    full("relaxation", "#56b4e9", DOWN),
    full("complex", "#e69f00", PENTAGON),
    full("agitated", "#000000", CROSS),
    full("clipped", "#777777", PLUS),
    Shape {
        name: "triangulated",
        colour: "#000000",
        fill: "#f0e442",
        path: STAR,
    },
];

/// A point's place among [`SHAPES`].
pub(super) fn shape(point: &Point) -> usize {
    let packing = &point.scene.packing;
    if point.factor != Factor::Method {
        return 0;
    }
    match (packing.method, packing.finish) {
        (Method::Balanced, Finish::Even) => 1,
        (Method::Balanced, Finish::Consistent) => 2,
        (Method::Balanced, Finish::Both) => 3,
        (Method::Balanced, Finish::Calm) => 4,
        (method, _) => (SHAPES.iter())
            .position(|shape| shape.name == method.name())
            .unwrap_or(0),
    }
}
