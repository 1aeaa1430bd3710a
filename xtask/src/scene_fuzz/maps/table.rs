//! All maps, declared: what each is about, its panels, and pins on both sides of its edge.

use super::outcome::Outcome::{self, Degraded, Passes, Refused, Said};
use super::panel::{Map, Pin};
use super::{
    corner, curvature, dirt, gap, kernels, parts, resolution, settings, thin, units, wall,
};

const fn pin(panel: usize, at: [f64; 2], outcome: Outcome) -> Pin {
    Pin { panel, at, outcome }
}

/// In the order of the page.
pub(super) const MAPS: [Map; 12] = [
    Map {
        name: "corner",
        title: "Corners",
        about: "How sharp a corner may be, inside the body (a tip) and outside it (a notch), and how long its sides must be.",
        panels: &[corner::PLANE],
        pins: &[pin(0, [2.0, 3.0], Degraded), pin(0, [8.0, 3.0], Passes)],
    },
    Map {
        name: "edge",
        title: "Edges and tips in space",
        about: "How sharp an edge and the tip of a cone may be.",
        panels: &[corner::WEDGE, corner::CONE],
        pins: &[pin(1, [5.0, 3.0], Degraded), pin(0, [90.0, 3.0], Passes)],
    },
    Map {
        name: "thin",
        title: "Thin bodies",
        about: "How thin a strip or a plate may be.",
        panels: &[thin::STRIP, thin::PLATE],
        pins: &[pin(0, [0.02, 0.0], Degraded), pin(0, [0.05, 0.0], Passes)],
    },
    Map {
        name: "gap",
        title: "Gaps",
        about: "How near two bodies, two shells or the sides of a slit may come.",
        panels: &[gap::PLANE],
        pins: &[pin(0, [0.2, 4.0], Said), pin(0, [0.3, 0.0], Passes)],
    },
    Map {
        name: "parts",
        title: "Small parts",
        about: "How small the parts of a body may be, how near each other, and how many.",
        panels: &[parts::DISTANCE, parts::NUMBER],
        pins: &[pin(0, [0.3, 2.0], Degraded), pin(0, [1.0, 2.0], Passes)],
    },
    Map {
        name: "curvature",
        title: "Round walls",
        about: "How small the radius of a wall may be, seen from inside and from outside.",
        panels: &[curvature::PLANE, curvature::SPACE],
        pins: &[pin(0, [0.3, 0.0], Refused), pin(0, [0.7, 1.0], Passes)],
    },
    Map {
        name: "resolution",
        title: "Resolution",
        about: "How many particles a whole body must have along its length. (The bunny of the papers is no row: it needs a file.)",
        panels: &[resolution::PLANE, resolution::SPACE],
        pins: &[pin(0, [5.0, 0.0], Degraded), pin(0, [30.0, 0.0], Passes)],
    },
    Map {
        name: "wall",
        title: "Sides of the box",
        about: "How near a side of the box a body may come, on it, beyond it, and across a periodic seam.",
        panels: &[wall::PLANE],
        pins: &[pin(0, [0.1, 0.0], Degraded), pin(0, [0.5, 0.0], Passes)],
    },
    Map {
        name: "dirt",
        title: "Damaged meshes",
        about: "What may be wrong with a mesh. What is packed is judged by the sound mesh.",
        panels: &[dirt::BALL, dirt::CUBE],
        pins: &[pin(0, [30.0, 0.0], Refused), pin(0, [0.0, 0.0], Passes)],
    },
    Map {
        name: "parameters",
        title: "Settings",
        about: "What happens where a constant of a method is not what it should be, and whether place, turn and seed matter.",
        panels: &[
            settings::BALANCED,
            settings::HYBRID,
            settings::COMPLEX,
            settings::LATTICE,
            settings::SEED,
        ],
        pins: &[pin(0, [100.0, 3.0], Refused), pin(0, [30.0, 3.0], Passes)],
    },
    Map {
        name: "kernel",
        title: "Kernels",
        about: "Which kernels pack at which smoothing length.",
        panels: &[kernels::SQUARE, kernels::BALL],
        pins: &[pin(0, [0.8, 2.0], Degraded), pin(0, [1.0, 2.0], Passes)],
    },
    Map {
        name: "units",
        title: "Units and places",
        about: "Whether the unit of length and the distance from the origin matter.",
        panels: &[units::PLANE, units::SPACE],
        pins: &[pin(0, [1.0, 1e12], Said), pin(0, [1.0, 1e10], Passes)],
    },
];
