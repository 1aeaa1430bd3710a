//! All that a body is not.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, point};

use crate::level_inset::LevelInset;
use crate::surface::{Closest, Features, Surface};
use crate::{GeometryError, ParameterError};

/// The outside of a body, as far as a box around it: its insets are the body moved outward, round about convex corners. The box is no
/// surface.
#[derive(Debug, Clone)]
pub(super) struct Complement<const D: usize> {
    body: Arc<dyn Surface<D>>,
    bounds: Bounds<D>,
}

impl<const D: usize> Complement<D> {
    /// With insets down to `reach`, scene units.
    pub(super) fn new(body: Arc<dyn Surface<D>>, reach: f64) -> Self {
        // An inset's own box is less by its depth on every side, and has to hold it.
        let bounds = body.bounds().grown(2.5 * reach);
        Self { body, bounds }
    }
}

fn turned<const D: usize>(hit: Closest<D>) -> Closest<D> {
    Closest {
        normal: point::scale(hit.normal, -1.0),
        distance: -hit.distance,
        ..hit
    }
}

impl<const D: usize> Surface<D> for Complement<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        turned(self.body.closest(p))
    }

    fn closest_within(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
        self.body.closest_within(p, radius).map(turned)
    }

    fn inside(&self, p: [f64; D]) -> bool {
        !self.body.inside(p)
    }

    fn measure(&self) -> f64 {
        self.body.measure()
    }

    fn volume(&self) -> f64 {
        self.bounds.volume() - self.body.volume()
    }

    fn bounds(&self) -> Bounds<D> {
        self.bounds
    }

    fn features(&self) -> Features<D> {
        self.body.features()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        Ok(Arc::new(LevelInset::new(Arc::new(self.clone()), depth)?))
    }

    fn scatter(&self, count: usize) -> Vec<Closest<D>> {
        self.body.scatter(count).into_iter().map(turned).collect()
    }
}
