//! A mesh that goes on beyond the sides of a box, moved inward.

use std::sync::{Arc, OnceLock};

use sphpack_neighbors::{Bounds, Domain};

use super::super::features::features_in;
use super::super::window::holds;
use super::super::{Continued, Whole};
use super::contents;
use crate::GeometryError;
use crate::level_inset::{LevelInset, integrate_within};
use crate::mesh::{Mesh, vanished};
use crate::sample::{Candidates, QUICK, THOROUGH, spread};
use crate::surface::{Closest, Features, Surface};

/// The level set of a mesh beyond a box too.
#[derive(Debug, Clone)]
pub(super) struct Moved {
    mesh: Arc<Mesh>,
    depth: f64,
    inset: LevelInset<3>,
    /// Area and volume within the box, once asked for.
    contents: OnceLock<(f64, f64)>,
}

impl Moved {
    pub(super) fn new(mesh: Arc<Mesh>, depth: f64) -> Result<Self, GeometryError> {
        let body: Arc<dyn Surface<3>> = mesh.clone();
        Ok(Self {
            inset: LevelInset::new(body, depth)?,
            mesh,
            depth,
            contents: OnceLock::new(),
        })
    }

    fn candidates(
        &self,
        domain: &Domain<3>,
        spacing: f64,
        count: usize,
        search: crate::sample::Search,
    ) -> Candidates<3> {
        let near = |p| self.inset.closest(p);
        Candidates::in_window(domain, &near, spacing, count, search)
    }
}

impl Surface<3> for Moved {
    fn closest(&self, p: [f64; 3]) -> Closest<3> {
        self.inset.closest(p)
    }

    fn closest_within(&self, p: [f64; 3], radius: f64) -> Option<Closest<3>> {
        self.inset.closest_within(p, radius)
    }

    fn inside(&self, p: [f64; 3]) -> bool {
        self.inset.inside(p)
    }

    fn measure(&self) -> f64 {
        self.inset.measure()
    }

    fn volume(&self) -> f64 {
        self.inset.volume()
    }

    fn bounds(&self) -> Bounds<3> {
        self.inset.bounds()
    }

    fn features(&self) -> Features<3> {
        self.inset.features()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<3>>, GeometryError> {
        self.inset.inset(depth)
    }
}

impl Whole<3> for Moved {
    fn contents(&self, domain: &Domain<3>) -> (f64, f64) {
        *self.contents.get_or_init(|| {
            let all = contents::of(&self.mesh, domain);
            let is_within = |p| holds(p, domain, 0.0);
            vanished::contents_of(&self.mesh, self.depth, &is_within, all.volume)
                .or_else(|| all.moved_in(self.depth))
                .unwrap_or_else(|| integrate_within(self.mesh.as_ref(), self.depth, &domain.bounds))
        })
    }

    fn moved_in(&self, depth: f64) -> Result<Arc<dyn Whole<3>>, GeometryError> {
        Ok(Arc::new(Self::new(self.mesh.clone(), self.depth + depth)?))
    }

    fn parts_in(&self, _: &Domain<3>) -> Vec<Arc<dyn Whole<3>>> {
        Vec::new()
    }

    fn features_in(&self, domain: &Domain<3>) -> Features<3> {
        features_in(self.inset.features(), domain)
    }

    fn scattered_in(&self, domain: &Domain<3>, count: usize) -> Candidates<3> {
        let spacing = (self.contents(domain).0 / count.max(1) as f64).sqrt();
        let mut found = self.candidates(domain, spacing, count, THOROUGH);
        for (p, n) in found.point.iter_mut().zip(&mut found.normal) {
            let hit = self.inset.closest(*p);
            (*p, *n) = (hit.point, hit.normal);
        }
        let kept: Vec<bool> = (found.point.iter())
            .map(|&p| holds(p, domain, 0.0))
            .collect();
        let mut keep = kept.iter();
        found.point.retain(|_| keep.next().is_some_and(|k| *k));
        let mut keep = kept.iter();
        found.normal.retain(|_| keep.next().is_some_and(|k| *k));
        found
    }

    fn sample_in(
        &self,
        surface: &Continued<3>,
        count: usize,
    ) -> Result<Vec<Closest<3>>, GeometryError> {
        let scatter = |spacing, wanted| self.candidates(&surface.domain, spacing, wanted, QUICK);
        spread(surface, count, &|p| surface.closest(p), scatter)
    }
}

#[cfg(test)]
mod tests;
