//! The fluid's side of bodies' surfaces, as the published methods bound it.

use crate::particles::{Kind, Particles};
use crate::problem::Problem;
use crate::seeding::Seeds;
use sphpack_geometry::{Closest, Feature};
use sphpack_neighbors::point;

impl<const D: usize> Seeds<D> {
    /// Adds to `solids` what is around them: the sites outside every body, and the frozen ones.
    pub(crate) fn surround(&self, problem: &Problem<D>, solids: &mut Particles<D>) {
        let lattice = &self.particles;
        let is_fluid = |p: [f64; D]| !problem.bodies.iter().any(|body| body.surface.inside(p));
        for i in 0..lattice.len() {
            let (p, kind) = (lattice.position[i], lattice.kind[i]);
            if kind == Kind::Frozen || is_fluid(p) {
                solids.push(p, kind, lattice.volume[i], None);
            }
        }
    }
}

/// The set `off` (scene units) outside of a body, seen from `p`, of which `hit` is the nearest place on the body's surface. The
/// normal points out of the fluid, and the distance is negative within the fluid.
///
/// The normal is straight from `hit` to `p` where `p` is outside. At an edge that points into the fluid the surface's own normals
/// jump: whoever is put back by them is pushed along the edge, and stays in motion.
pub(crate) fn around_body<const D: usize>(p: [f64; D], hit: Closest<D>, off: f64) -> Closest<D> {
    let away = point::unit(point::sub(p, hit.point)).filter(|_| hit.distance > 0.0);
    let normal = away.unwrap_or(hit.normal);
    Closest {
        point: point::add_scaled(hit.point, off, normal),
        normal: point::scale(normal, -1.0),
        distance: off - hit.distance,
        ..hit
    }
}

/// The surface of a body that holds the fluid, seen from `p`: as [`around_body`], from within.
pub(crate) fn within_body<const D: usize>(p: [f64; D], hit: Closest<D>) -> Closest<D> {
    let inward = point::unit(point::sub(p, hit.point)).filter(|_| hit.distance < 0.0);
    Closest {
        normal: inward.map_or(hit.normal, |inward| point::scale(inward, -1.0)),
        ..hit
    }
}

/// Of several bounds the one that `p` is farthest beyond; where there is none, one that is endlessly far away.
pub(crate) fn tightest<const D: usize>(
    p: [f64; D],
    bounds: impl Iterator<Item = Closest<D>>,
) -> Closest<D> {
    bounds
        .max_by(|a, b| a.distance.total_cmp(&b.distance))
        .unwrap_or(Closest {
            point: p,
            normal: [0.0; D],
            distance: f64::NEG_INFINITY,
            feature: Feature::Smooth,
        })
}
