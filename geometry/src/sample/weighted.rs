//! Points spread over a surface more densely here than there.

use rayon::prelude::*;
use sphpack_neighbors::point;

use super::candidates::Candidates;
use super::curve::along_weighted;
use super::local::Local;
use super::sheet::settle;
use super::{features, trace};
use crate::surface::{Closest, Surface};
use crate::{GeometryError, ParameterError};

/// Scattered points per point that is wanted.
const CANDIDATES: usize = 8;

/// The least distance between points is this part of the greatest, at least.
const LEAST_SPACING: f64 = 0.01;

/// From this ratio of the greatest weight to the mean on, candidates are scattered by weight.
const UNEVEN: f64 = 2.0;

/// Most points that are scattered, to have enough where the weight is great.
const MOST_SCATTERED: usize = 1 << 21;

/// Features nearer than this many spacings share one point.
const CROWDED: f64 = 0.7;

/// `count` points on the surface, as [`Surface::sample`], their number per area in proportion to `weight` (any unit;
/// negative ones count as 0, and what would part points by more than a hundred times the least distance as that). Features come first, as far apart
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
    let Scattered {
        hits,
        weights,
        greatest,
        mean,
    } = scattered(surface, count, weight);
    if !(greatest > 0.0 && greatest.is_finite()) {
        return Err(ParameterError::OutOfRange {
            of: "sample",
            name: "greatest weight",
            value: greatest,
            needs: "positive and finite",
        }
        .into());
    }
    let least = least_weight(D) * greatest;
    let root = 1.0 / (D as f64 - 1.0);
    let spacing = (surface.measure() / count as f64).powf(root);
    let local = |w: f64| Local::even(spacing * (mean / w.max(least)).powf(root));
    let closest_together = local(greatest).spacing;
    if D == 2 && surface.window().is_none() {
        let look = |p| surface.closest(p);
        let corners = surface.features().corners;
        let rings = trace::rings(&surface.bounds(), &look, &corners, closest_together);
        let of = |p| weight(&surface.closest(p)).max(least);
        return Ok(along_weighted(surface, &rings, &of, count));
    }
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

/// Points scattered over a surface.
struct Scattered<const D: usize> {
    hits: Vec<Closest<D>>,
    weights: Vec<f64>,
    /// The greatest weight, and the mean over the surface.
    greatest: f64,
    mean: f64,
}

/// Scattered points, some [`CANDIDATES`] for every point wherever it is wanted: more are scattered where the weight differs, and where
/// it is small some are left out.
fn scattered<const D: usize>(
    surface: &dyn Surface<D>,
    count: usize,
    weight: &(dyn Fn(&Closest<D>) -> f64 + Sync),
) -> Scattered<D> {
    let take = |count: usize| {
        let hits = surface.scatter(count);
        let weights: Vec<f64> = (hits.par_iter().with_min_len(64))
            .map(|hit| weight(hit).max(0.0))
            .collect();
        let greatest = weights.iter().copied().fold(0.0, f64::max);
        let least = least_weight(D) * greatest;
        let mean = weights.iter().map(|w| w.max(least)).sum::<f64>() / weights.len().max(1) as f64;
        Scattered {
            hits,
            weights,
            greatest,
            mean,
        }
    };
    let wanted = CANDIDATES * count;
    let all = take(wanted);
    let times = (all.greatest / all.mean).min(MOST_SCATTERED as f64 / wanted as f64);
    // A curve is not sampled by its candidates.
    if D == 2 || times.is_nan() || times < UNEVEN {
        return all;
    }
    let mut all = take((times * wanted as f64) as usize);
    let least = least_weight(D) * all.greatest;
    let share = wanted as f64 / (all.mean * all.weights.len() as f64);
    let mut owed = 0.0;
    (all.hits, all.weights) = (all.hits.into_iter().zip(all.weights))
        .filter(|(_, weight)| {
            owed += (share * weight.max(least)).min(1.0);
            let is_kept = owed >= 1.0;
            owed -= f64::from(u8::from(is_kept));
            is_kept
        })
        .unzip();
    all
}

/// Weights below this part of the greatest count as so much.
fn least_weight(dimension: usize) -> f64 {
    LEAST_SPACING.powi(dimension as i32 - 1)
}
