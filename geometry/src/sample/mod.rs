//! Points spread evenly over any surface, features first.

mod candidates;
mod curve;
mod features;
mod local;
pub(crate) mod patches;
mod polygon;
mod polyline;
mod ranked;
mod relax;
mod sheet;
mod thinning;
mod trace;
mod weighted;

#[cfg(test)]
mod tests;

use rayon::prelude::*;
use sphpack_neighbors::point;

use crate::surface::{Closest, Feature, Surface};
use crate::{GeometryError, ParameterError};

pub(crate) use candidates::{Candidates, QUICK, Search, THOROUGH};
pub(crate) use curve::{Ring, along};
pub(crate) use features::occupied;
pub(crate) use local::Local;
pub use polygon::polygons;
pub(crate) use sheet::{settle, spread};
pub(crate) use thinning::keep_evenest;
pub use weighted::sample_weighted;

/// [`Surface::sample`] for a surface of which nothing but its answers is known.
///
/// # Errors
/// As [`evenly_near`].
pub(crate) fn evenly<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    count: usize,
) -> Result<Vec<Closest<D>>, GeometryError> {
    let closest = |p| surface.closest(p);
    evenly_near(surface, count, &closest, &closest)
}

/// [`evenly`], where `look` tells the signed distance, the direction in which it grows and the point that these lead
/// to, and `near` the closest point of a place near the surface, both perhaps faster than [`Surface::closest`].
///
/// # Errors
/// [`GeometryError::Parameter`] unless `D` is 2 or 3.
pub(crate) fn evenly_near<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    count: usize,
    look: &impl Fn([f64; D]) -> Closest<D>,
    near: &(impl Fn([f64; D]) -> Closest<D> + Sync),
) -> Result<Vec<Closest<D>>, GeometryError> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let bounds = surface.bounds();
    match D {
        2 => {
            let spacing = surface.measure() / count as f64;
            let corners = surface.features().corners;
            let rings = trace::rings(&bounds, look, &corners, spacing);
            Ok(along(surface, &rings, count))
        }
        3 => spread(surface, count, near, |spacing, wanted| {
            Candidates::in_boxes(&bounds, look, spacing, wanted, QUICK)
        }),
        _ => Err(ParameterError::OutOfRange {
            of: "sample",
            name: "dimension",
            value: D as f64,
            needs: "2 or 3",
        }
        .into()),
    }
}

/// [`Surface::scatter`] for a surface of which nothing but its answers is known.
pub(crate) fn scattered<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    count: usize,
) -> Vec<Closest<D>> {
    if count == 0 || D < 2 {
        return Vec::new();
    }
    let near = |p| surface.closest(p);
    let bounds = surface.bounds();
    let spacing = (surface.measure() / count as f64).powf(1.0 / (D as f64 - 1.0));
    // A tube much thinner than its points are apart is a curve: by its area alone one of radius 3·10⁻⁹ took 36 s. Of
    // a thread that the smallest boxes do not resolve, parts may have up to 1.7 times as many points as others.
    let spacing = spacing.max(0.25 * point::norm(bounds.size()) / count as f64);
    let mut hits = Candidates::in_boxes(&bounds, &near, spacing, count, THOROUGH).hits();
    hits.par_iter_mut().with_min_len(64).for_each(|hit| {
        let found = surface.closest(hit.point);
        hit.point = found.point;
        // At a corner or an edge the piece's own side counts.
        if found.feature == Feature::Smooth {
            hit.normal = found.normal;
        }
    });
    hits
}
