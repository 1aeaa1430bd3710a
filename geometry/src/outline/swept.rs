//! What the sides of an outline sweep as they move, joined piece by piece.
//!
//! Where sides are much shorter than their way, each strip crosses hundreds of others, most of them inside what is swept
//! anyhow. The strips of a few neighbours are joined first, then two such regions that are near each other, and so on:
//! what is inside is gone before it meets the rest, and all takes O(n log n).

use std::ops::Range;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use sphpack_neighbors::{Bounds, point};

use super::offset::Turn;
use super::{Outline, engine};
use crate::GeometryError;
use crate::segment::cross;

type Loops = Vec<Vec<[f64; 2]>>;

/// A chain has at most this many sides. It also ends behind a corner at which strips cross: where they all cross each
/// other, two times two are joined faster than four (13,000 sides of a starfish: by twos 0.6 s, by eights 1.2 s, by 32
/// 6 s).
const CHAIN: usize = 64;

/// Sectors between strips are filled with triangles of at most this angle.
const FAN_DEGREES: f64 = 20.0;

/// What may be swept has at most so many points per point of the outline.
const MOST_PER_POINT: usize = 64;

impl Outline {
    /// What the sides sweep as they move by `distance`.
    ///
    /// # Errors
    /// [`GeometryError::TooTangled`].
    pub(super) fn swept(&self, distance: f64) -> Result<Loops, GeometryError> {
        let mut chains: Vec<Chain> = Vec::new();
        for range in self.starts.windows(2) {
            let mut first = range[0];
            for end in first + 1..=range[1] {
                let is_last = end == range[1];
                let is_crossed = || matches!(self.turn([end - 1, end], distance), Turn::Crossed(_));
                if is_last || end - first == CHAIN || is_crossed() {
                    chains.push(self.chain(first..end, range, distance));
                    first = end;
                }
            }
        }
        let most = MOST_PER_POINT * self.points.len();
        joined(&mut chains, most).ok_or(GeometryError::TooTangled {
            distance: distance.abs(),
        })
    }
}

/// What a few neighbouring sides sweep.
struct Chain {
    loops: Loops,
    center: [f64; 2],
}

impl Outline {
    /// What `sides` of the loop in `range` sweep, and the side after them: chains overlap by a whole strip, for borders
    /// that only touch leave cracks where they are rounded.
    fn chain(&self, sides: Range<usize>, range: &[usize], distance: f64) -> Chain {
        let after = |i: usize| self.next[i] as usize;
        let before = |i: usize| if i > range[0] { i - 1 } else { range[1] - 1 };
        let (first, last) = (sides.start, after(sides.end - 1));
        let mut around = Vec::with_capacity(4 * sides.len() + 8);
        around.extend_from_slice(&self.points[sides.clone()]);
        around.extend([self.points[last], self.points[after(last)]]);
        let mut loops = Vec::new();
        let path = |i: usize| self.turn([before(i), i], distance).path(self.points[i]);
        // Back along the moved sides.
        around.extend(path(after(last)).as_slice().first());
        for k in (sides.start + 1..=sides.end).rev() {
            let i = if k < sides.end { k } else { last };
            let turn = self.turn([before(i), i], distance);
            around.extend(turn.path(self.points[i]).as_slice().iter().rev());
            if let Turn::Crossed(ends) = turn {
                loops.push(fan(self.points[i], ends));
            }
        }
        around.extend(path(first).as_slice().last());
        let center = Bounds::of(&around).center();
        loops.push(around);
        Chain { loops, center }
    }
}

/// The sector about `vertex` between both `ends`, which are at the same distance. All of it is nearer to the vertex than the
/// sides move, so where the body is it is swept anyhow, by others; without it the far ends of strips would be combs, and
/// two combs cross at every pair of their teeth.
fn fan(vertex: [f64; 2], ends: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
    let [from, to] = ends.map(|end| point::sub(end, vertex));
    let angle = cross(from, to).atan2(point::dot(from, to));
    let steps = (angle.abs() / FAN_DEGREES.to_radians()).ceil().max(1.0);
    let mut points = vec![vertex, ends[0]];
    for k in 1..steps as usize {
        let (sin, cos) = (angle * k as f64 / steps).sin_cos();
        let arm = [cos * from[0] - sin * from[1], sin * from[0] + cos * from[1]];
        points.push(point::add(vertex, arm));
    }
    points.push(ends[1]);
    points
}

/// The regions of all chains, joined; `None` where that has too many points.
fn joined(chains: &mut [Chain], most: usize) -> Option<Loops> {
    if let [only] = chains {
        let loops = std::mem::take(&mut only.loops);
        return Some(union(&loops, &[]));
    }
    let mut spread = Bounds::EMPTY;
    for chain in chains.iter() {
        spread.include(chain.center);
    }
    let size = spread.size();
    let axis = usize::from(size[1] > size[0]);
    let middle = chains.len() / 2;
    chains.select_nth_unstable_by(middle, |a, b| a.center[axis].total_cmp(&b.center[axis]));
    let (left, right) = chains.split_at_mut(middle);
    let (left, right) = rayon::join(|| joined(left, most), || joined(right, most));
    let both = union(&left?, &right?);
    (both.iter().map(Vec::len).sum::<usize>() <= most).then_some(both)
}

/// The boundary of all places around which loops wind.
fn union(one: &[Vec<[f64; 2]>], other: &[Vec<[f64; 2]>]) -> Loops {
    engine::overlay(one, other, OverlayRule::Union, FillRule::NonZero)
        .into_iter()
        .flatten()
        .collect()
}
