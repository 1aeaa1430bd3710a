//! Points scattered over an ellipsoid by area.

use std::f64::consts::TAU;

use sphpack_neighbors::point;

use super::Ellipsoid;
use crate::sample::patches::{Patch, over};
use crate::surface::Closest;

/// Pieces around at least, so that area is right where a disk bends sharply.
const LEAST_AROUND: f64 = 16.0;

impl<const D: usize> Ellipsoid<D> {
    /// `count` points, each standing for the same area. The body is the image of the unit sphere, and that one of a square: along the
    /// longest axis, and around it; in the plane around only.
    pub(super) fn scattered(&self, count: usize) -> Vec<Closest<D>> {
        let mut axes: [usize; D] = std::array::from_fn(|k| k);
        axes.sort_by(|&a, &b| self.semi_axes[b].total_cmp(&self.semi_axes[a]));
        let direction = |[s, t]: [f64; 2]| {
            let (sin, cos) = (TAU * if D == 2 { s } else { t }).sin_cos();
            let z = 2.0 * s - 1.0;
            let r = (1.0 - z * z).max(0.0).sqrt();
            let parts = match D {
                2 => [cos, sin, 0.0],
                _ => [z, r * cos, r * sin],
            };
            let mut u = [0.0; D];
            for (&axis, part) in axes.iter().zip(parts) {
                u[axis] = part;
            }
            u
        };
        // In parts of the shortest axis, so that none overflows.
        let shortest = self.smallest();
        let normal = |u: [f64; D]| -> [f64; D] {
            std::array::from_fn(|k| u[k] * (shortest / self.semi_axes[k]))
        };
        let length = |k: usize| axes.get(k).map_or(1.0, |&axis| self.semi_axes[axis]);
        let patch = Patch {
            sides: match D {
                2 => [TAU * length(0), 1.0],
                _ => [2.0 * length(0), TAU * length(1)],
            },
            least: LEAST_AROUND,
            stretch: Box::new(|at| point::norm(normal(direction(at)))),
            at: Box::new(|at| {
                let u = direction(at);
                let x: [f64; D] = std::array::from_fn(|k| self.semi_axes[k] * u[k]);
                let out = normal(u);
                let out = point::unit(out).unwrap_or(out);
                (point::add(self.center, x), out)
            }),
        };
        over(&[patch], count)
    }
}
