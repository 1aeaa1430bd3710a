//! Points of the level set, for places whose way down ends before it.

use std::sync::Arc;

use sphpack_neighbors::{KdTree, point};

use super::planes::Planes;
use super::{LevelInset, ON_SET, gradient};
use crate::surface::{Closest, Feature, Surface};

/// Points per depth^(D−1) of the original's surface, within these bounds.
const DENSITY: f64 = 1.0;
const FEWEST: f64 = 1000.0;
const MOST: f64 = 20_000.0;

/// Steps along the level set, of up to a depth each.
const STEPS: usize = 6;

/// Parts of the depth that do not count.
const CLOSE: f64 = 1e-3;

/// Scattered over the level set, each with the normal there.
#[derive(Debug, Clone)]
pub(super) struct Anchors<const D: usize> {
    points: Vec<([f64; D], [f64; D])>,
    tree: Arc<KdTree<D>>,
}

impl<const D: usize> LevelInset<D> {
    /// The points under some of the original's, where the body is thick enough for any.
    fn anchors(&self) -> Option<&Anchors<D>> {
        if self.anchors.get().is_none() {
            // Whoever asks first may be one of many threads that wait for each other: nobody waits for this one. What two of them
            // find is the same, and the second is dropped.
            let _ = self.anchors.set(self.scattered_anchors());
        }
        self.anchors.get()?.as_ref()
    }

    fn scattered_anchors(&self) -> Option<Anchors<D>> {
        let wanted = DENSITY * self.surface.measure() / self.depth.powi(D as i32 - 1);
        let feet = self.surface.scatter(wanted.clamp(FEWEST, MOST) as usize);
        let points: Vec<([f64; D], [f64; D])> = (feet.iter())
            .filter_map(|foot| {
                let below = point::add_scaled(foot.point, -self.depth, foot.normal);
                let at = self.surface.closest(below);
                let (off, found, normal) =
                    self.descend(below, (below, at), &mut Planes::default(), false);
                (off <= 10.0 * ON_SET * self.depth).then_some((found, normal))
            })
            .collect();
        let places: Vec<[f64; D]> = points.iter().map(|(at, _)| *at).collect();
        let tree = KdTree::new(&places).ok()?;
        Some(Anchors {
            points,
            tree: Arc::new(tree),
        })
    }

    /// The closest point where the body beside `p` is too thin to have a level set, so that no way down from `p` ends on
    /// it: from the nearest known point along the level set towards `p`. `None` where no known point is nearer than
    /// `nearer`. A minimum nearby, not surely the nearest point of all: off by less than the distance between known points.
    pub(super) fn closest_from_afar(
        &self,
        p: [f64; D],
        is_outside: bool,
        nearer: f64,
    ) -> Option<Closest<D>> {
        let anchors = self.anchors()?;
        let nearest = anchors.tree.nearest(p)?;
        if nearest.distance >= nearer {
            return None;
        }
        let mut distance = nearest.distance;
        let (mut here, mut normal) = anchors.points[nearest.index];
        let mut reach = self.depth;
        for _ in 0..STEPS {
            let way = point::sub(p, here);
            let along = point::add_scaled(way, -point::dot(way, normal), normal);
            let far = point::norm(along);
            if far <= CLOSE * self.depth || reach <= CLOSE * self.depth {
                break;
            }
            let aside = point::add_scaled(here, (reach / far).min(1.0), along);
            let at = self.surface.closest(aside);
            let down = gradient(aside, &at);
            let there = point::add_scaled(aside, -(at.distance + self.depth), down);
            let below = self.surface.closest(there);
            let is_on_set = (below.distance + self.depth).abs() <= CLOSE * self.depth;
            if is_on_set && point::distance(p, there) < distance {
                distance = point::distance(p, there);
                (here, normal) = (there, gradient(there, &below));
            } else {
                reach *= 0.25;
            }
        }
        let found = Closest {
            point: here,
            normal,
            distance: if is_outside { distance } else { -distance },
            feature: Feature::Smooth,
        };
        Some(self.with_feature(found, Planes::default()))
    }
}
