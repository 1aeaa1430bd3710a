//! Points that stand for particles on a body's surface, also where the body is thinner than a particle.

mod medial;
mod shares;
mod spread;
#[cfg(test)]
mod tests;

use crate::surface::{Closest, Surface};
use crate::thickness::{Touching, through};
use crate::{GeometryError, ParameterError};
use rayon::prelude::*;
use shares::{HARDLY, Shares};
use sphpack_neighbors::point;

/// Points at which the thickness of a body is probed before it is taken as thick: this many per point of its surface,
/// within these bounds.
const PROBES_PER_POINT: f64 = 0.5;
const FEWEST_PROBES: f64 = 256.0;
const MOST_PROBES: f64 = 4096.0;

/// A body is thin somewhere where its thickness is below this part of the limit.
const THIN: f64 = 0.99;

/// An outline whose thin parts have no medial points and would have fewer points than a thick body's by no more than
/// this, and by no more than this part of all, counts as thick: by arc length points are evener than by pushing.
const FEW_POINTS: f64 = 2.0;
const SMALL_PART: f64 = 0.02;

/// How many points parts get that are thinner than a particle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum Thin {
    /// As many as their volume asks for.
    #[default]
    Mass,
    /// As many as a sheet one spacing thick, so that nothing passes between them; they stand for more than the volume there.
    Watertight,
}

/// What [`sample_particles`] gives.
#[derive(Debug, Clone, Default, PartialEq)]
#[must_use]
pub struct SurfaceSamples<const D: usize> {
    /// Points on the particle surface, features first, as [`Surface::sample`] gives them.
    pub on_surface: Vec<Closest<D>>,
    /// Points midway between the sides where the body is so thin that no particle surface is left.
    pub medial: Vec<[f64; D]>,
    /// Area (2-D) or volume (3-D) of the parts that the medial points stand for: each part's within half a particle's
    /// of their number times `spacing`^D, unless there is no room for so many clear of the particle surface, which
    /// then has the others.
    pub medial_volume: f64,
    /// What of that is more than the body has there ([`Thin::Watertight`]).
    pub excess: f64,
}

/// Points for the particles that hold a body's surface, which is `depth` (scene units) inside the body, for particles
/// of the volume `spacing`^D: on `inset`, which is [`Surface::inset`] of the body by `depth` (`None` where that
/// vanished), and along the middle of what is too thin to have one.
///
/// - A body that is nowhere thinner than 2 × `spacing` (`depth` = 0: than `spacing`), as far as a few thousand probes
///   tell, gets what `inset.sample(round(area / spacing^(D−1)))` gives, to the bit. So does
///   an outline where thin parts, a few sharp corners, would make a difference of less than two points
///   and 2 %.
/// - Elsewhere a side carries only its half of the thickness t: min(1, t/(2 `spacing`)) / `spacing`^(D−1) points per
///   area (`depth` = 0: min(1, t/`spacing`), each particle counting half there). Thin parts are so full of them that
///   points on both sides keep apart from each other too.
/// - Where the body is thinner than 2 × `depth` its mass is on the line or sheet midway between the sides, in
///   proportion to the thickness, on to within a spacing of the tip. Each part gets the nearest whole number of
///   particles: none for one that holds less than half a particle. Wedges of 60° and more have none: the corner of the
///   inset is within a spacing of their tip.
///
/// All together hold the volume that is less than `spacing` deep (the whole body where it is thinner than 2 ×
/// `spacing`), to half a particle: the particles inside are as many as the rest of the volume asks for. [`thickness`]
/// says what counts as thin. Deterministic for any number of threads. Cost: [`Surface::sample`] of the inset, and
/// where there are thin parts about 40 more queries of the body per point.
///
/// The idea is this project's own; the thickness is by shrinking balls (see [`thickness`]).
///
/// [`thickness`]: crate::thickness()
///
/// ```
/// use sphpack_geometry::{Outline, Surface, sample_particles};
/// let wing = Outline::naca("0015", 1.0)?;
/// let inset = wing.inset(0.01)?;
/// let points = sample_particles(&wing, Some(inset.as_ref()), 0.02, 0.01)?;
/// // One particle for the tail, which the inset surface ends before.
/// assert_eq!(points.medial.len(), 1);
/// assert!((points.medial_volume / 0.02_f64.powi(2) - 1.0).abs() < 0.5);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
///
/// # Errors
/// As [`Surface::sample`], and [`GeometryError::Parameter`] for a spacing that is not positive, a depth that is
/// negative, or a depth of 0 without a surface.
pub fn sample_particles<const D: usize>(
    body: &dyn Surface<D>,
    inset: Option<&dyn Surface<D>>,
    spacing: f64,
    depth: f64,
) -> Result<SurfaceSamples<D>, GeometryError> {
    sample_thin(body, inset, spacing, depth, Thin::Mass)
}

/// [`sample_particles`] where thin parts get as many points as `thin` says. A part that is [`Thin::Watertight`] has one
/// per `spacing`^(D−1) where it is thinner than the spacing; [`SurfaceSamples::excess`] says how much more than its own
/// volume they stand for.
///
/// # Errors
/// As [`sample_particles`].
pub fn sample_thin<const D: usize>(
    body: &dyn Surface<D>,
    inset: Option<&dyn Surface<D>>,
    spacing: f64,
    depth: f64,
    thin: Thin,
) -> Result<SurfaceSamples<D>, GeometryError> {
    ParameterError::check_positive("sample", "spacing", spacing)?;
    ParameterError::check_depth(depth)?;
    if depth == 0.0 && inset.is_none() {
        return Err(ParameterError::OutOfRange {
            of: "sample",
            name: "depth",
            value: depth,
            needs: "positive where there is no surface",
        }
        .into());
    }
    let area_each = spacing.powi(D as i32 - 1);
    if let Some(surface) = inset {
        let count = surface.measure() / area_each;
        // Half the thickness a side needs to carry all its points, and to have a particle surface.
        let full = if depth > 0.0 { spacing } else { 0.5 * spacing }.max(depth);
        if !is_thin(body, count, 2.0 * full) {
            return as_if_thick(surface, count);
        }
    }
    // The inset of a sheet a spacing thick is two sides in one place. Over these points spread less evenly than along the middle: five
    // of the random plates of `cargo xtask bodies` had holes.
    let inset = inset.filter(|surface| {
        let count = surface.measure() / area_each;
        D == 2 || thin == Thin::Mass || depth == 0.0 || !is_sheet(body, count, depth)
    });
    let shares = Shares::new(body, inset, (spacing, depth), thin)?;
    let counts = shares.counts();
    if let Some(surface) = inset {
        let count = surface.measure() / area_each;
        let none = counts.medial.iter().all(|&n| n == 0);
        let lacking = 1.0 - shares.mean_density();
        if D == 2 && none && lacking < SMALL_PART && lacking * count < FEW_POINTS {
            return as_if_thick(surface, count);
        }
    }
    let on_surface = match inset {
        Some(surface) => spread::over(body, surface, &shares, counts.on_surface)?,
        None => Vec::new(),
    };
    let medial = medial::along((body, inset), &shares, &counts, &on_surface)?;
    Ok(SurfaceSamples {
        on_surface,
        medial,
        medial_volume: counts.medial_volume,
        excess: counts.excess,
    })
}

/// What a body gets that is nowhere thin.
fn as_if_thick<const D: usize>(
    surface: &dyn Surface<D>,
    count: f64,
) -> Result<SurfaceSamples<D>, GeometryError> {
    Ok(SurfaceSamples {
        on_surface: surface.sample(count.round() as usize)?,
        ..SurfaceSamples::default()
    })
}

/// Some points of a body's surface.
fn probes<const D: usize>(body: &dyn Surface<D>, count: f64) -> Vec<Closest<D>> {
    let probes = (PROBES_PER_POINT * count).clamp(FEWEST_PROBES, MOST_PROBES);
    body.scatter(probes as usize)
}

/// Whether the body is thinner than `limit` somewhere, as far as some points of it tell.
fn is_thin<const D: usize>(body: &dyn Surface<D>, count: f64, limit: f64) -> bool {
    (probes(body, count).par_iter().with_min_len(64))
        .any(|hit| through(body, hit.point, point::scale(hit.normal, -1.0), limit) < THIN * limit)
}

/// Whether the body is hardly thicker than two depths anywhere, likewise.
fn is_sheet<const D: usize>(body: &dyn Surface<D>, count: f64, depth: f64) -> bool {
    let most = HARDLY * depth;
    (probes(body, count).par_iter().with_min_len(64)).all(|hit| {
        let inward = point::scale(hit.normal, -1.0);
        Touching::at(body, hit.point, inward, 2.0 * most).radius <= most
    })
}
