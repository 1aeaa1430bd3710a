//! Layers of points beside a surface, for the wall particles of solvers.

mod complement;
mod cover;
mod crowd;
mod shells;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use rayon::prelude::*;
use sphpack_neighbors::point;

use crate::level_inset::{LevelInset, gradient};
use crate::surface::Surface;
use crate::{GeometryError, InsetError, ParameterError};
use complement::Complement;
use cover::Room;
use crowd::Crowd;

/// Points nearer to each other than this, in ∆s, are in the room of one: between the two sides of a thin part the later one is left out.
const CROWDED: f64 = 0.6;

/// How far from its level set a point of a layer may be, in ∆s.
const ON_LEVEL: f64 = 1e-3;

/// How far points are looked for, in ∆s: farther than any hole's radius.
const REACH: f64 = 1.1;

/// A layer with less than this part of a particle's volume for each of its points shares that of its neighbour.
const HARDLY: f64 = 1e-6;

/// On which side of a surface a wall is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallSide {
    /// Inside the body: a solid in fluid.
    Inside,
    /// Outside of it: a container of fluid.
    Outside,
}

/// A point of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPoint<const D: usize> {
    /// Where it is.
    pub point: [f64; D],
    /// Unit normal of the surface at its closest point, out of the wall; where several are closest, of one of them.
    pub normal: [f64; D],
    /// How far that is, scene units.
    pub depth: f64,
}

/// A layer of a wall: what is from k to k + 1 spacings deep.
#[derive(Debug, Clone, PartialEq)]
pub struct WallLayer<const D: usize> {
    /// Its points: those on the level set (k + 1/2) `spacing` deep, or as they were given; then those between level sets.
    pub points: Vec<WallPoint<D>>,
    /// How many of them are on no level set: they fill what would be holes.
    pub between: usize,
    /// Area (2-D) or volume (3-D) that each stands for.
    pub volume_each: f64,
    /// Area or volume between k and k + 1 spacings.
    pub volume: f64,
}

/// A wall that is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallSpec {
    /// Where it is.
    pub side: WallSide,
    /// ∆s, scene units.
    pub spacing: f64,
    /// How many layers.
    pub layers: usize,
}

/// Points in layers along a `surface`, for the wall (dummy) particles of Adami, Hu & Adams (2012) or of modified dynamic
/// boundary conditions: evenly on the sets that are ∆s/2, 3∆s/2, … deep in the wall, by the exact distance, corners and
/// edges first ([`Surface::sample`]).
///
/// - Level sets are ∆s apart, so that points of different ones are too. Where two sides of one are nearer to each other
///   than 0.6 ∆s (the middle of a thin part), the later points are left out.
/// - Then whatever is farther than 0.9 ∆s (1.0 in space) from every point, such as a tip before the first level set,
///   gets one, if there is a place for it that is 0.6 ∆s from every other and from `others`.
/// - A layer's points share the room between its sides evenly: the volumes of all are that of all layers. It is found by
///   cells that are cut by the level sets' tangent planes, right to 10⁻³ of a shell.
/// - The first layer is `first` where that is given: an even set that is there already.
///
/// Deterministic for any number of threads. Cost: [`Surface::sample`] of every layer, and in space some 500 queries per
/// point for volumes and holes.
///
/// # References
/// Adami, Hu & Adams (2012), "A generalized wall boundary condition for smoothed particle hydrodynamics", J. Comput.
/// Phys. 231. How layers are sampled, thinned and filled is this project's own.
///
/// ```
/// use std::sync::Arc;
/// use sphpack_geometry::{Ball, Surface, WallSide, WallSpec, wall_layers};
/// let ball: Arc<dyn Surface<2>> = Arc::new(Ball::new([0.0; 2], 1.0)?);
/// let wall = WallSpec { side: WallSide::Outside, spacing: 0.1, layers: 3 };
/// let layers = wall_layers(&ball, &wall, None, &[])?;
/// let volume: f64 = layers.iter().map(|layer| layer.volume_each * layer.points.len() as f64).sum();
/// let exact = std::f64::consts::PI * (1.3_f64.powi(2) - 1.0);
/// assert!((volume / exact - 1.0).abs() < 1e-3);
/// assert!(layers[1].points.iter().all(|at| (at.depth - 0.15).abs() < 1e-6));
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
///
/// # Errors
/// As [`Surface::sample`], and [`GeometryError::Parameter`] for a spacing that is not positive.
pub fn wall_layers<const D: usize>(
    surface: &Arc<dyn Surface<D>>,
    spec: &WallSpec,
    first: Option<&[[f64; D]]>,
    others: &[[f64; D]],
) -> Result<Vec<WallLayer<D>>, GeometryError> {
    let WallSpec {
        side,
        spacing,
        layers,
    } = *spec;
    ParameterError::check_positive("wall", "spacing", spacing)?;
    let wall: Arc<dyn Surface<D>> = match side {
        WallSide::Inside => surface.clone(),
        WallSide::Outside => Arc::new(Complement::new(surface.clone(), spacing * layers as f64)),
    };
    let shells = shells::shells(wall.as_ref(), spacing, layers);
    let mut crowd = Crowd::new(REACH * spacing);
    let mut held = Crowd::new(REACH * spacing);
    others.iter().for_each(|&p| held.add(p));
    let mut points: Vec<Vec<[f64; D]>> = Vec::with_capacity(layers);
    for (layer, &measure) in shells.measure.iter().enumerate() {
        if let Some(first) = first.filter(|_| layer == 0) {
            first.iter().for_each(|&p| crowd.add(p));
            points.push(first.to_vec());
            continue;
        }
        let depth = (layer as f64 + 0.5) * spacing;
        let mut kept = on_level(&wall, spacing, depth, measure)?;
        kept.retain(|&p| {
            let least = CROWDED * spacing;
            let is_clear = crowd.nearest(p) >= least && held.nearest(p) >= least;
            if is_clear {
                crowd.add(p);
            }
            is_clear
        });
        points.push(kept);
    }
    let room = Room {
        wall: wall.as_ref(),
        spacing,
        layers,
    };
    let mut between = vec![0; layers];
    for p in room.fill(&mut crowd, &held) {
        let depth = -wall.closest(p).distance;
        let layer = ((depth / spacing).max(0.0) as usize).min(layers - 1);
        points[layer].push(p);
        between[layer] += 1;
    }
    let each = shares(&shells.volume, &points, spacing.powi(D as i32));
    Ok((points.into_iter().zip(between))
        .zip(shells.volume.iter().zip(each))
        .map(|((points, between), (&volume, volume_each))| WallLayer {
            points: seated(wall.as_ref(), &points),
            between,
            volume_each,
            volume,
        })
        .collect())
}

/// Even points of one level set, as many as its measure asks for; none where there is none.
fn on_level<const D: usize>(
    wall: &Arc<dyn Surface<D>>,
    spacing: f64,
    depth: f64,
    measure: f64,
) -> Result<Vec<[f64; D]>, GeometryError> {
    let count = (measure / spacing.powi(D as i32 - 1)).round() as usize;
    let level = match LevelInset::with_contents(wall.clone(), depth, measure, 0.0) {
        Ok(level) if count > 0 => level,
        Ok(_) | Err(GeometryError::Inset(InsetError::Vanished { .. })) => return Ok(Vec::new()),
        Err(other) => return Err(other),
    };
    let found = level.sample(count)?;
    let points: Vec<[f64; D]> = found.iter().map(|hit| hit.point).collect();
    Ok((points.into_par_iter().with_min_len(64))
        .filter(|&p| (wall.closest(p).distance + depth).abs() <= ON_LEVEL * spacing)
        .collect())
}

/// The volume of every layer's points, for them to have all of it: a layer without points, or hardly any room, shares with the one before it.
fn shares<const D: usize>(volume: &[f64], points: &[Vec<[f64; D]>], one: f64) -> Vec<f64> {
    let mut each = vec![0.0; volume.len()];
    let mut from = 0;
    while from < volume.len() {
        let mut to = from + 1;
        let (mut room, mut count) = (volume[from], points[from].len());
        let is_hard = |room: f64, count: usize| room <= HARDLY * one * count as f64;
        while to < volume.len()
            && (count == 0 || points[to].is_empty() || is_hard(volume[to], points[to].len()))
        {
            room += volume[to];
            count += points[to].len();
            to += 1;
        }
        each[from..to].fill(if count == 0 { 0.0 } else { room / count as f64 });
        from = to;
    }
    each
}

/// Points with what solvers read of them.
fn seated<const D: usize>(wall: &dyn Surface<D>, points: &[[f64; D]]) -> Vec<WallPoint<D>> {
    (points.par_iter().with_min_len(64))
        .map(|&p| {
            let hit = wall.closest(p);
            let normal = gradient(p, &hit);
            WallPoint {
                point: p,
                normal: point::unit(normal).unwrap_or(hit.normal),
                depth: -hit.distance,
            }
        })
        .collect()
}
