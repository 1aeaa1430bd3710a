//! Quick answers near the level set, for callers with many points that they move about.

use sphpack_neighbors::point;

use super::{LevelInset, ON_SET, gradient};
use crate::surface::{Closest, Feature, Surface};

impl<const D: usize> LevelInset<D> {
    /// φ + depth at `p`, the direction in which it grows, and the point that these lead to: one query of the original.
    /// All exact from inside, and from outside where the straight way down ends on the level set; never more than the
    /// distance.
    pub(super) fn height(&self, p: [f64; D]) -> Closest<D> {
        let hit = self.surface.closest(p);
        let distance = hit.distance + self.depth;
        let normal = gradient(p, &hit);
        Closest {
            point: point::add_scaled(p, -distance, normal),
            normal,
            distance,
            feature: Feature::Smooth,
        }
    }

    /// The closest point, its features left out: where [`LevelInset::height`] leads, if a second query finds that on
    /// the level set, else [`Surface::closest`].
    pub(super) fn closest_nearby(&self, p: [f64; D]) -> Closest<D> {
        let found = self.height(p);
        let off = self.surface.closest(found.point).distance + self.depth;
        if off.abs() <= 1e-3 * found.distance.abs() + ON_SET * self.depth {
            found
        } else {
            self.closest(p)
        }
    }
}
