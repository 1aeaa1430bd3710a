//! Points spread over a surface in space: corners, sharp edges, then everything between.

use rayon::prelude::*;

use super::candidates::Candidates;
use super::{features, relax, thinning};
use crate::GeometryError;
use crate::surface::{Closest, Surface};

/// Candidates per point.
const CANDIDATES: usize = 6;

/// `count` points spread evenly over `surface`. `near` answers like [`Surface::closest`] near the surface, perhaps
/// less exactly and faster; `strew` gives so many candidates for a spacing.
pub(crate) fn spread<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    count: usize,
    near: &(impl Fn([f64; D]) -> Closest<D> + Sync),
    strew: impl FnOnce(f64, usize) -> Candidates<D>,
) -> Result<Vec<Closest<D>>, GeometryError> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let rough = (surface.measure() / count as f64).sqrt();
    let mut sites = features::occupied(surface, rough, count);
    if sites.len() == count {
        return Ok(sites);
    }
    let candidates = strew(rough, CANDIDATES * count);
    if candidates.point.is_empty() {
        return Err(GeometryError::BadParameter {
            shape: "sample",
            name: "area of the surface",
            value: candidates.area,
            needs: "large enough to be found between points of a grid",
        });
    }
    let spacing = (candidates.area / count as f64).sqrt();
    let held = sites.len();
    let kept = thinning::keep_evenest(&candidates, &sites, count - held, spacing);
    let start: Vec<Closest<D>> = kept
        .par_iter()
        .with_min_len(64)
        .map(|&i| near(candidates.point[i]))
        .collect();
    sites.extend(start);
    relax::even_out(&mut sites, held, spacing, near);
    sites[held..]
        .par_iter_mut()
        .with_min_len(64)
        .for_each(|site| {
            *site = Closest {
                distance: 0.0,
                ..surface.closest(site.point)
            };
        });
    Ok(sites)
}
