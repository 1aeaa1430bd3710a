//! Points spread over a surface more densely here than there.

use sphpack_neighbors::point;

use super::candidates::Candidates;
use super::features;
use super::local::Local;
use super::sheet::settle;
use crate::surface::{Closest, Surface};
use crate::{GeometryError, ParameterError};

/// Scattered points per point that is wanted.
const CANDIDATES: usize = 8;

/// Weights below this part of the greatest count as so much: distances between points differ by 100 (2-D) or 10 at most.
const LEAST_WEIGHT: f64 = 0.01;

/// Features nearer than this many spacings share one point.
const CROWDED: f64 = 0.7;

/// `count` points on the surface, as [`Surface::sample`], their number per area in proportion to `weight` (any unit;
/// negative ones count as 0, and less than a hundredth of the greatest as that). Features come first, as far apart
/// as the weight asks where they are.
///
/// Numbers in parts of the surface are right within a few per cent. Deterministic, as [`Surface::sample`].
///
/// ```
/// use sphpack_geometry::{Ball, Closest, sample_weighted};
///
/// // Three times as many points on the right half as on the left.
/// let ball = Ball::new([0.0; 3], 1.0)?;
/// let weight = |hit: &Closest<3>| if hit.point[0] > 0.0 { 3.0 } else { 1.0 };
/// let points = sample_weighted(&ball, 400, &weight)?;
/// let right = points.iter().filter(|hit| hit.point[0] > 0.0).count();
/// assert!(right > 280 && right < 320, "{right}");
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
///
/// # Errors
/// As [`Surface::sample`], and [`GeometryError::Parameter`] where no weight is positive.
pub fn sample_weighted<const D: usize>(
    surface: &dyn Surface<D>,
    count: usize,
    weight: &(dyn Fn(&Closest<D>) -> f64 + Sync),
) -> Result<Vec<Closest<D>>, GeometryError> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let hits = surface.scatter(CANDIDATES * count);
    let weights: Vec<f64> = hits.iter().map(|hit| weight(hit).max(0.0)).collect();
    let greatest = weights.iter().copied().fold(0.0, f64::max);
    if !(greatest > 0.0 && greatest.is_finite()) {
        return Err(ParameterError::OutOfRange {
            of: "sample",
            name: "greatest weight",
            value: greatest,
            needs: "positive and finite",
        }
        .into());
    }
    let least = LEAST_WEIGHT * greatest;
    let mean = weights.iter().map(|w| w.max(least)).sum::<f64>() / weights.len() as f64;
    let root = 1.0 / (D as f64 - 1.0);
    let spacing = (surface.measure() / count as f64).powf(root);
    let local = |w: f64| Local::even(spacing * (mean / w.max(least)).powf(root));
    let closest_together = local(greatest).spacing;
    let mut held: Vec<Closest<D>> = Vec::new();
    let mut locals: Vec<Local> = Vec::new();
    for site in features::occupied(surface, closest_together, count) {
        let here = local(weight(&site));
        let near =
            |other: &Closest<D>| point::distance(other.point, site.point) < CROWDED * here.spacing;
        if !held.iter().any(near) {
            held.push(site);
            locals.push(here);
        }
    }
    locals.extend(weights.iter().map(|&w| local(w)));
    let candidates = Candidates::of(&hits);
    let near = |p| surface.closest(p);
    let locals = (locals.as_slice(), spacing);
    Ok(settle(surface, held, &candidates, count, locals, &near))
}
