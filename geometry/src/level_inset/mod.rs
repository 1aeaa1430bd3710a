//! The level set φ = −depth of any surface.

mod anchors;
mod contents;
mod nearby;
mod planes;
#[cfg(test)]
mod tests;

use std::sync::{Arc, OnceLock};

use sphpack_neighbors::{Bounds, point};

use crate::surface::{Closest, Feature, Features, Surface};
use crate::thickness::Touching;
use crate::{CORNER_DEGREES, GeometryError, InsetError, ParameterError};
use anchors::Anchors;
pub(crate) use contents::{cut, halves, integrate_within};
use planes::{Plane, Planes};

/// Most projections per query; one or two suffice away from creases, five or so at them.
const MAX_PROJECTIONS: usize = 20;

/// Most steps along a curved crease.
const MAX_WALK: usize = 12;

/// A point is on the level set when φ + depth is below this × depth.
const ON_SET: f64 = 1e-9;

/// Answers farther than this, in parts of the height above the level set or of the depth, are compared with points known to be on it:
/// at the corner of a cube it is 1.7.
const FAR: f64 = 2.0;

/// Places that are higher than this above the level set, in depths, may be in a wall that is too thin for it.
const NEAR: f64 = 0.05;

/// Sides whose outward normals have a cosine below this are those of a wall; between others a wedge leads down to a crease.
const WALL: f64 = -0.996;

/// A way down that ends so far from the level set, in depths, has missed it.
const LOST: f64 = 1e-2;

/// How far below a found point, in parts of the depth, the other side of a crease is looked for.
const PROBE: f64 = 1e-4;

/// The body φ ≤ −`depth`, φ the signed distance of another surface: that body with a layer of `depth` taken off.
///
/// - From inside, the closest point and the distance are exact: on the way to the closest point of the original, up
///   to `depth` before it.
/// - From outside they are exact too wherever the straight way down ends on the level set. Near a crease (a sharp
///   convex edge of the original, or where its medial axis is met) the nearest planes tangent to the level set are
///   intersected until the point is on all of them (Newton on the active set): exact for flat sides, the nearest
///   point found for curved ones.
/// - [`Feature::Edge`] and [`Feature::Corner`] are given where sides meet that differ by more than
///   [`CORNER_DEGREES`](crate::CORNER_DEGREES), within 10⁻⁴ × the depth.
///
/// - Beside parts too thin to have a level set, where no way down ends on it, the point is the nearest one to be found from a thousand
///   or more known ones.
///
/// A query costs two to three queries of the original surface, some ten near creases, twenty more beside such parts.
///
/// ```
/// use std::sync::Arc;
/// use sphpack_geometry::{Ellipsoid, LevelInset, Surface};
///
/// let egg = Arc::new(Ellipsoid::new([0.0; 3], [3.0, 2.0, 1.0])?);
/// let inner = LevelInset::new(egg, 0.25)?; // no ellipsoid any more
/// assert!((inner.closest([0.0, 0.0, 4.0]).distance - 3.25).abs() < 1e-9);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct LevelInset<const D: usize> {
    surface: Arc<dyn Surface<D>>,
    depth: f64,
    /// Whether the original has corners or sharp edges.
    sharp: bool,
    /// Measure and volume, once known.
    contents: OnceLock<(f64, f64)>,
    /// Once asked for.
    anchors: OnceLock<Option<Anchors<D>>>,
}

/// |φ + depth| at a point, the point, and the normal there.
type Found<const D: usize> = (f64, [f64; D], [f64; D]);

impl<const D: usize> LevelInset<D> {
    /// `surface` moved inward by `depth` (scene units). Its measure and volume are integrated numerically when first
    /// asked for: within 10⁻³ for bodies that are smooth on the scale of 1/64 of their size, 10⁻² with sharp edges.
    ///
    /// # Errors
    /// [`InsetError::Vanished`] where no point deeper than `depth` is found, [`GeometryError::Parameter`] for a
    /// depth that is negative or not finite.
    pub fn new(surface: Arc<dyn Surface<D>>, depth: f64) -> Result<Self, GeometryError> {
        ParameterError::check_depth(depth)?;
        if !contents::reaches(surface.as_ref(), depth) {
            return Err(InsetError::Vanished { depth }.into());
        }
        let features = surface.features();
        Ok(Self {
            sharp: !(features.corners.is_empty() && features.edges.is_empty()),
            surface,
            depth,
            contents: OnceLock::new(),
            anchors: OnceLock::new(),
        })
    }

    /// [`LevelInset::new`] where its length or area and its area or volume are known.
    ///
    /// # Errors
    /// As [`LevelInset::new`].
    pub fn with_contents(
        surface: Arc<dyn Surface<D>>,
        depth: f64,
        measure: f64,
        volume: f64,
    ) -> Result<Self, GeometryError> {
        let inset = Self::new(surface, depth)?;
        // A fresh cell is empty, so this cannot fail.
        let _ = inset.contents.set((measure.max(0.0), volume.max(0.0)));
        Ok(inset)
    }

    fn contents(&self) -> (f64, f64) {
        *self
            .contents
            .get_or_init(|| contents::integrate(self.surface.as_ref(), self.depth))
    }

    /// The answer to `p`, whose closest point on the original is `hit`; and whether it is on the level set.
    fn answer(&self, p: [f64; D], hit: Closest<D>) -> (Closest<D>, bool) {
        let height = hit.distance + self.depth;
        let tolerance = ON_SET * self.depth;
        if height < -tolerance {
            // Inside: straight towards the original surface.
            let down = point::scale(point::sub(p, hit.point), -1.0 / hit.distance);
            let normal = point::scale(down, -1.0);
            let found = Closest {
                point: point::add_scaled(hit.point, self.depth, down),
                normal,
                distance: height,
                feature: Feature::Smooth,
            };
            return (self.with_feature(found, Planes::default()), true);
        }
        let mut planes = Planes::default();
        let straight = self.descend(p, (p, hit), &mut planes, true);
        let (off, q, normal) = if straight.0 <= tolerance {
            straight
        } else {
            self.walk(p, straight, &mut planes)
        };
        let outside = height > 0.0;
        let distance = point::distance(p, q);
        let found = Closest {
            point: q,
            normal,
            distance: if outside { distance } else { -distance },
            feature: Feature::Smooth,
        };
        planes.keep_touching(q, 10.0 * tolerance);
        (
            self.with_feature(found, planes),
            off <= 1e-3 * self.depth.max(f64::MIN_POSITIVE),
        )
    }

    /// [`LevelInset::answer`], unless the way down missed the level set, or led so far that another part of it may be nearer.
    fn answer_anywhere(&self, p: [f64; D], hit: Closest<D>) -> (Closest<D>, bool) {
        let height = hit.distance + self.depth;
        if height > NEAR * self.depth
            && hit.distance < 0.0
            && self.is_in_wall(p, &hit)
            && let Some(found) = self.closest_from_afar(p, true, f64::INFINITY)
        {
            return (found, true);
        }
        let (found, is_on_set) = self.answer(p, hit);
        if is_on_set && found.distance.abs() <= FAR * height.abs().max(self.depth) {
            return (found, is_on_set);
        }
        let nearer = if is_on_set {
            found.distance.abs()
        } else {
            f64::INFINITY
        };
        match self.closest_from_afar(p, height > 0.0, nearer) {
            Some(other) => (other, true),
            None => (found, is_on_set),
        }
    }

    /// Whether `p`, inside the original, is between two sides that are nearly parallel and too near to each other for a level set.
    fn is_in_wall(&self, p: [f64; D], hit: &Closest<D>) -> bool {
        let Some(inward) = point::unit(point::sub(p, hit.point)) else {
            return false;
        };
        let ball = Touching::at(self.surface.as_ref(), hit.point, inward, self.depth);
        (ball.elsewhere).is_some_and(|normal| point::dot(normal, inward) > -WALL)
    }

    /// From `x` (with its closest point on the original) down to the level set by projection onto its tangent planes,
    /// of `p` (`from_p`) or of the last point. Returns the best point met: |φ + depth|, the point, the normal.
    fn descend(
        &self,
        p: [f64; D],
        (mut x, mut at): ([f64; D], Closest<D>),
        planes: &mut Planes<D>,
        from_p: bool,
    ) -> Found<D> {
        let mut best = (f64::INFINITY, x, at.normal);
        for _ in 0..MAX_PROJECTIONS {
            let f = at.distance + self.depth;
            let normal = gradient(x, &at);
            if f.abs() < best.0 {
                best = (f.abs(), x, normal);
            }
            if f.abs() <= ON_SET * self.depth {
                break;
            }
            planes.add(Plane {
                normal,
                offset: point::dot(normal, x) - f,
            });
            x = planes.project(if from_p { p } else { x });
            if !point::is_finite(x) {
                break;
            }
            at = self.surface.closest(x);
        }
        best
    }

    /// Along a curved crease: down to it from `best`, then towards `p` while that brings the point nearer.
    fn walk(&self, p: [f64; D], best: Found<D>, planes: &mut Planes<D>) -> Found<D> {
        let from = |x: [f64; D], planes: &mut Planes<D>| {
            self.descend(p, (x, self.surface.closest(x)), planes, false)
        };
        let mut here = from(best.1, planes);
        if here.0 > best.0 {
            return best;
        }
        if here.0 > LOST * self.depth {
            return here;
        }
        for _ in 0..MAX_WALK {
            let along = point::sub(planes.project_on_all(p), here.1);
            if point::norm(along) <= 1e-7 * self.depth {
                break;
            }
            let step = (0..6).find_map(|halvings| {
                let mut trial = *planes;
                let start = point::add_scaled(here.1, 0.5_f64.powi(halvings), along);
                let there = from(start, &mut trial);
                let nearer = point::distance(p, there.1) < point::distance(p, here.1);
                (there.0 <= here.0.max(ON_SET * self.depth) && nearer).then_some((there, trial))
            });
            let Some((there, trial)) = step else {
                break;
            };
            (here, *planes) = (there, trial);
        }
        here
    }

    /// `found` with its feature and the mean normal, where several sides meet there.
    fn with_feature(&self, mut found: Closest<D>, mut sides: Planes<D>) -> Closest<D> {
        let probe = PROBE * self.depth;
        if self.sharp && sides.len() < D {
            sides.add(Plane {
                normal: found.normal,
                offset: point::dot(found.normal, found.point),
            });
            // Just below a crease the nearest side is another one.
            while sides.len() < D {
                let below = point::add_scaled(found.point, -probe, sides.mean_normal());
                let at = self.surface.closest(below);
                let normal = gradient(below, &at);
                if sides.holds(normal) || at.distance + self.depth < -1.01 * probe {
                    break;
                }
                sides.add(Plane {
                    normal,
                    offset: point::dot(normal, found.point),
                });
            }
        }
        let different = sides.count_different(CORNER_DEGREES.to_radians().cos());
        if different >= 2 {
            found.normal = sides.mean_normal();
            found.feature = if different >= D {
                Feature::Corner
            } else {
                Feature::Edge
            };
        }
        found
    }
}

/// Direction in which the signed distance grows at `x`, whose closest point is `hit`.
pub(crate) fn gradient<const D: usize>(x: [f64; D], hit: &Closest<D>) -> [f64; D] {
    let away = point::sub(x, hit.point);
    let length = point::norm(away);
    // Too near the surface the difference is rounding.
    if length > 1e-9 * (point::norm(x) + point::norm(hit.point)) {
        point::scale(away, hit.distance.signum() / length)
    } else {
        hit.normal
    }
}

impl<const D: usize> Surface<D> for LevelInset<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        self.answer_anywhere(p, self.surface.closest(p)).0
    }

    fn closest_within(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
        let hit = self.surface.closest_within(p, radius + self.depth)?;
        if (hit.distance + self.depth).abs() > radius {
            return None;
        }
        let (found, on_set) = self.answer_anywhere(p, hit);
        (on_set && found.distance.abs() <= radius).then_some(found)
    }

    fn inside(&self, p: [f64; D]) -> bool {
        self.surface.inside(p) && self.surface.closest_within(p, self.depth).is_none()
    }

    fn measure(&self) -> f64 {
        self.contents().0
    }

    fn volume(&self) -> f64 {
        self.contents().1
    }

    /// The original's box less the depth on every side: not always the smallest.
    fn bounds(&self) -> Bounds<D> {
        self.surface.bounds().grown(-self.depth)
    }

    /// Where the original's corners and sharp convex edges end up. Reflex edges leave none: the level set is round
    /// there.
    fn features(&self) -> Features<D> {
        let original = self.surface.features();
        let mut corners: Vec<[f64; D]> = Vec::new();
        let near = 1e-6 * self.depth;
        for c in original.corners {
            let (hit, on_set) = self.answer(c, self.surface.closest(c));
            let new = corners
                .iter()
                .all(|&k| point::distance(k, hit.point) > near);
            if on_set && hit.feature == Feature::Corner && new {
                corners.push(hit.point);
            }
        }
        let mut edges = Vec::new();
        for edge in original.edges {
            let mut run: Vec<[f64; D]> = Vec::new();
            for c in edge {
                let (hit, on_set) = self.answer(c, self.surface.closest(c));
                if on_set && hit.feature != Feature::Smooth {
                    if run
                        .last()
                        .is_none_or(|&last| point::distance(last, hit.point) > near)
                    {
                        run.push(hit.point);
                    }
                } else if !run.is_empty() {
                    edges.push(std::mem::take(&mut run));
                }
            }
            edges.push(run);
        }
        edges.retain(|run| run.len() > 1);
        Features { corners, edges }
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        Self::new(self.surface.clone(), self.depth + depth)
            .map(|inset| Arc::new(inset) as Arc<dyn Surface<D>>)
            .map_err(|_| InsetError::Vanished { depth }.into())
    }

    fn sample(&self, count: usize) -> Result<Vec<Closest<D>>, GeometryError> {
        crate::sample::evenly_near(self, count, &|p| self.height(p), &|p| {
            self.closest_nearby(p)
        })
    }
}
