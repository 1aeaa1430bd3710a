//! Kernels and smoothing lengths.

use super::super::case::Case;
use super::super::kernel::Kernel;
use super::super::shape::Shape;
use super::panel::{Axis, Panel};
use super::scenes::{alone, rectangle, turned};

const RATIOS: &[f64] = &[
    0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0, 2.1, 2.2, 2.3, 2.4, 2.5,
];

/// In the order of [`Kernel::ALL`].
const NAMES: &[&str] = &[
    "cubic",
    "quintic",
    "wendland-c2",
    "wendland-c4",
    "wendland-c6",
];

pub(super) const SQUARE: Panel = Panel {
    title: "In the plane: a square of 9 ∆s, turned by 20 degrees",
    x: Axis::numbers("h/∆s", RATIOS),
    y: Axis::words("kernel", NAMES),
    home: 2.5,
    only: None,
    case: |h, kernel| {
        let points = turned(&rectangle([0.0; 2], [9.0, 9.0]), 20.0);
        with(alone(2, Shape::Polygon { points }), h, kernel)
    },
};

pub(super) const BALL: Panel = Panel {
    title: "In space: a ball of 6 ∆s",
    x: Axis::numbers("h/∆s", &[0.8, 1.0, 1.2, 1.5, 2.0, 2.5]),
    y: Axis::words("kernel", NAMES),
    home: 2.5,
    only: None,
    case: |h, kernel| {
        let center = [0.1, 0.2, 0.3];
        with(
            alone(
                3,
                Shape::Sphere {
                    center,
                    radius: 3.0,
                },
            ),
            h,
            kernel,
        )
    },
};

fn with(mut case: Case, h: f64, kernel: f64) -> Case {
    case.kernel = Some(Kernel::ALL[kernel as usize]);
    case.h_over_spacing = Some(h);
    case
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_kernels() {
        assert_eq!(NAMES, Kernel::ALL.map(Kernel::name));
    }
}
