//! Surfaces along which the field of spacings varies: where their particles sit, and how many there are.

use std::sync::Arc;

use rayon::prelude::*;
use sphpack_geometry::{
    Closest, Feature, Features, GeometryError, InsetError, Surface, sample_weighted,
};
use sphpack_neighbors::{Bounds, Domain, KdTree, point};

use crate::problem::Body;
use crate::resolution::Resolution;

/// Places of a surface that are asked for the field's spacing there: at first, by how much more where that does not tell the mean of
/// s^−(D−1) to [`MEAN`], and at most. Where a body is fine in spots, few places are in them.
const ASKED: usize = 4096;
const MORE: usize = 8;
const MOST_ASKED: usize = 1 << 15;

/// The standard error of that mean, as a part of it.
const MEAN: f64 = 5e-3;

/// Spacings along a surface that differ by no more than this part are one.
const UNIFORM: f64 = 0.01;

/// Differences of rounding.
const SAME: f64 = 1e-9;

/// What the field says along a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Along {
    /// The spacing that as many equal particles would have: the mean of s^−(D−1), to the power −1/(D−1). Scene units.
    pub(super) mean: f64,
    /// Whether it is the spacing everywhere.
    pub(super) is_uniform: bool,
}

impl Along {
    pub(super) fn of<const D: usize>(
        resolution: &Resolution<D>,
        surface: &dyn Surface<D>,
        fallback: f64,
    ) -> Self {
        let power = D as i32 - 1;
        let mut asked = ASKED;
        let mut spacings: Vec<f64>;
        loop {
            spacings = (surface.scatter(asked).par_iter().with_min_len(64))
                .map(|hit| resolution.at(hit.point).value)
                .collect();
            let count = spacings.len() as f64;
            let mean = spacings.iter().map(|s| s.powi(-power)).sum::<f64>() / count;
            let off = spacings
                .iter()
                .map(|s| (s.powi(-power) / mean - 1.0).powi(2));
            let error = off.sum::<f64>().sqrt() / count;
            asked *= MORE;
            if error.is_nan() || error <= MEAN || asked > MOST_ASKED {
                break;
            }
        }
        if spacings.is_empty() {
            return Self {
                mean: fallback,
                is_uniform: true,
            };
        }
        let sum: f64 = spacings.iter().map(|s| s.powi(-power)).sum();
        let mean = (sum / spacings.len() as f64).powf(-1.0 / f64::from(power));
        let off = (spacings.iter()).fold(0.0, |most: f64, s| most.max((s / mean - 1.0).abs()));
        Self {
            // One spacing is not the mean of its powers.
            mean: if off < SAME { spacings[0] } else { mean },
            is_uniform: off <= UNIFORM,
        }
    }
}

/// The set that lies inside a body's surface by a part of the spacing that the field has at the nearest place of that surface.
///
/// Exact on smooth surfaces whose radius of curvature is larger; its measure and volume are to first order.
#[derive(Debug, Clone)]
pub(super) struct FollowingInset<const D: usize> {
    body: Arc<dyn Surface<D>>,
    resolution: Resolution<D>,
    inset_over_spacing: f64,
    /// [`Along::mean`].
    mean: f64,
}

impl<const D: usize> FollowingInset<D> {
    pub(super) fn new(body: &Body<D>, resolution: &Resolution<D>, along: Along) -> Self {
        Self {
            body: body.surface.clone(),
            resolution: resolution.clone(),
            inset_over_spacing: body.inset_over_spacing,
            mean: along.mean,
        }
    }

    fn mean_depth(&self) -> f64 {
        self.inset_over_spacing * self.mean
    }

    fn depth(&self, on_body: [f64; D]) -> f64 {
        self.inset_over_spacing * self.resolution.at(on_body).value
    }

    /// The depth below a place of the body's surface, or where the body is thinner than twice that, half of its thickness; `out` is the
    /// direction outward.
    fn depth_at(&self, hit: &Closest<D>, out: [f64; D]) -> f64 {
        let depth = self.depth(hit.point);
        let height = |depth: f64| {
            let below = point::add_scaled(hit.point, -depth, out);
            -self.body.closest(below).distance
        };
        if depth == 0.0 || height(depth) > NEAREST * depth {
            return depth;
        }
        // Whether the place is still the nearest so deep below it; at an edge between facets the normal is their mean, and
        // the way down is longer than the depth all along.
        let slant = height(SHALLOW * depth) / (SHALLOW * depth);
        let is_nearest = |depth: f64| height(depth) > NEAREST * slant * depth;
        if is_nearest(depth) {
            return depth;
        }
        let (mut low, mut high) = (0.0, depth);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if is_nearest(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// What is nearest to a place of which the body's surface is nearest so.
    fn within(&self, place: [f64; D], hit: Closest<D>) -> Closest<D> {
        // The way from the one to the other: normals of outlines and meshes are means, and what is found along them is nearest
        // to another place of the surface.
        let away = point::sub(place, hit.point);
        let out = point::unit(point::scale(away, hit.distance.signum())).unwrap_or(hit.normal);
        let depth = self.depth_at(&hit, out);
        Closest {
            point: point::add_scaled(hit.point, -depth, out),
            distance: hit.distance + depth,
            ..hit
        }
    }

    /// Points for the particles: their number per area goes with s^−(D−1), corners and edges first.
    /// Where a body is so thin that points from both sides meet, one of them stays.
    pub(super) fn sample(&self) -> Result<Vec<Closest<D>>, GeometryError> {
        let power = D as i32 - 1;
        let spacing = |hit: &Closest<D>| self.resolution.at(hit.point).value;
        // The inset of a convex body is smaller: by as much as that of its mean depth.
        let inset = self.body.inset(self.mean_depth());
        let measure = inset.map_or(self.body.measure(), |inset| inset.measure());
        let count = (measure * self.mean.powi(-power)).round().max(1.0) as usize;
        let weight = |hit: &Closest<D>| spacing(hit).powi(-power);
        let on_body = sample_weighted(self.body.as_ref(), count, &weight)?;
        let (mut points, mut spacings): (Vec<Closest<D>>, Vec<f64>) = (Vec::new(), Vec::new());
        for hit in on_body {
            let own = spacing(&hit);
            points.push(self.pushed_in(hit));
            spacings.push(own);
        }
        let places: Vec<[f64; D]> = points.iter().map(|hit| hit.point).collect();
        let Ok(tree) = KdTree::new(&places) else {
            return Ok(points);
        };
        let mut is_kept = vec![true; points.len()];
        for i in 0..points.len() {
            let near = tree.within(places[i], APART * spacings[i]);
            is_kept[i] = near
                .iter()
                .all(|other| other.index >= i || !is_kept[other.index]);
        }
        let mut is_kept = is_kept.into_iter();
        points.retain(|_| is_kept.next().unwrap_or(true));
        Ok(points)
    }

    /// A point of the body's surface, moved into the body until it is as deep as it should be, or as the body is there.
    fn pushed_in(&self, hit: Closest<D>) -> Closest<D> {
        let depth = self.depth(hit.point);
        if depth == 0.0 {
            return hit;
        }
        let at = |way: f64| point::add_scaled(hit.point, -way, hit.normal);
        if hit.feature == Feature::Smooth {
            let inner = self.closest(at(self.depth_at(&hit, hit.normal)));
            return Closest {
                distance: 0.0,
                ..inner
            };
        }
        // From a corner the way is longer than the depth; in a body too small for it, as far as the way leads down.
        let height = |way: f64| -self.body.closest(at(way)).distance;
        let step = MITRE * depth / STEPS;
        let (mut low, mut deepest) = (0.0, 0.0);
        while low < MITRE * depth && deepest < depth {
            let next = height(low + step);
            if next <= deepest {
                break;
            }
            (low, deepest) = (low + step, next);
        }
        if deepest >= depth {
            let mut high = low;
            low -= step;
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if height(middle) < depth {
                    low = middle;
                } else {
                    high = middle;
                }
            }
        }
        Closest {
            point: at(low),
            distance: 0.0,
            ..hit
        }
    }
}

/// Points nearer to each other than this, in spacings, are one.
const APART: f64 = 0.6;

/// The corner of an inset is no farther from the body's than so many depths; it is looked for in so many steps.
const MITRE: f64 = 4.0;
const STEPS: f64 = 64.0;

/// A place is the nearest where the surface is this part of the way down away, or more.
const NEAREST: f64 = 1.0 - 1e-9;

/// So little of a depth is less than half of any thickness that counts.
const SHALLOW: f64 = 1e-3;

/// From a way of depths to one of their 10⁻¹⁰.
const HALVINGS: usize = 36;

impl<const D: usize> Surface<D> for FollowingInset<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        self.within(p, self.body.closest(p))
    }

    fn closest_within(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
        let deepest = self.inset_over_spacing * self.resolution.range()[1];
        let hit = self.body.closest_within(p, radius + deepest)?;
        let hit = self.within(p, hit);
        (hit.distance.abs() <= radius).then_some(hit)
    }

    fn inside(&self, p: [f64; D]) -> bool {
        self.body.inside(p) && self.closest(p).distance < 0.0
    }

    fn measure(&self) -> f64 {
        self.body.measure()
    }

    fn volume(&self) -> f64 {
        (self.body.volume() - self.body.measure() * self.mean_depth()).max(0.0)
    }

    fn bounds(&self) -> Bounds<D> {
        self.body.bounds()
    }

    fn features(&self) -> Features<D> {
        Features::default()
    }

    fn window(&self) -> Option<Domain<D>> {
        self.body.window()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        if depth == 0.0 {
            return Ok(Arc::new(self.clone()));
        }
        Err(InsetError::Vanished { depth }.into())
    }
}
