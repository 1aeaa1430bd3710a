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
use crate::segment::cross;
use crate::{GeometryError, InsetError};

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
    /// [`InsetError::TooTangled`].
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
        joined(&mut chains, most).ok_or(
            InsetError::TooTangled {
                distance: distance.abs(),
            }
            .into(),
        )
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

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use sphpack_neighbors::random::Congruential;

    use super::*;
    use crate::surface::Surface;
    use crate::winding_number;

    /// Numbers from 0 to 1, always the same.
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut random = Congruential::new(seed);
        move || random.unit()
    }

    /// `count` points around the origin, at radii that `radius` gives.
    fn ragged(count: usize, mut radius: impl FnMut(usize) -> f64) -> Outline {
        let at = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
            let r = radius(k);
            [r * cos, r * sin]
        };
        Outline::polygon(&(0..count).map(at).collect::<Vec<_>>()).unwrap()
    }

    /// Every corner's place, and the wedge that is swept where the sides part there.
    fn wedges(outline: &Outline, distance: f64) -> Vec<(Turn, [f64; 2], Vec<[f64; 2]>)> {
        let of = |(before, &i): (usize, &u32)| {
            let (i, vertex) = (i as usize, outline.points[i as usize]);
            let [into, out_of] = [before, i].map(|k| outline.sides[k].normal);
            let turn = outline.turn([before, i], distance);
            let [a, b] = [into, out_of].map(|n| point::add_scaled(vertex, distance, n));
            let wedge = match turn {
                Turn::Mitred(tip) if cross(into, out_of) * distance > 0.0 => {
                    vec![vertex, a, tip, b]
                }
                Turn::Bevelled(_) => vec![vertex, a, b],
                _ => Vec::new(),
            };
            (turn, vertex, wedge)
        };
        outline.next.iter().enumerate().map(of).collect()
    }

    /// Whether a side's strip holds `p`.
    fn in_strip(outline: &Outline, distance: f64, p: [f64; 2]) -> bool {
        outline.sides.iter().any(|side| {
            let from = point::sub(p, side.start);
            let along = point::dot(from, side.edge) * side.inverse_square;
            let way = point::dot(from, side.normal) / distance;
            (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&way)
        })
    }

    /// The offset against brute force, on a raster of places and at each of its points.
    fn check(outline: &Outline, distance: f64) {
        let name = format!("{} sides, {distance}", outline.points.len());
        let wedges = wedges(outline, distance);
        let bevels: Vec<[f64; 2]> = (wedges.iter())
            .filter(|(turn, ..)| matches!(turn, Turn::Bevelled(_)))
            .map(|&(_, vertex, _)| vertex)
            .collect();
        let depth = distance.abs();
        let moved = outline.offset(distance);
        let bounds = outline.bounds().grown(1.1 * distance.max(0.0));
        let side = if outline.points.len() > 1000 { 14 } else { 24 };
        let size = bounds.size();
        for k in 0..side * side {
            let step = |n: usize| (n as f64 + 0.4321) / side as f64;
            let p = [
                bounds.min[0] + step(k % side) * size[0],
                bounds.min[1] + step(k / side) * size[1],
            ];
            let near = |o: &Outline| o.closest(p).distance;
            let is_in = moved.as_ref().is_ok_and(|o| o.inside(p));
            if near(outline).abs() < 1e-9 || moved.as_ref().is_ok_and(|o| near(o).abs() < 1e-9) {
                continue;
            }
            let in_wedge = |wedge: &[[f64; 2]]| !wedge.is_empty() && winding_number(wedge, p) != 0;
            let is_swept =
                in_strip(outline, distance, p) || wedges.iter().any(|(.., wedge)| in_wedge(wedge));
            let expected = if distance < 0.0 {
                outline.inside(p) && !is_swept
            } else {
                outline.inside(p) || is_swept
            };
            // What is nearer than the distance is swept, but for what is behind a bevel.
            let is_between = expected == (distance < 0.0) && near(outline).abs() < depth;
            assert!(is_in == expected || is_between, "{name}: {p:?}, {expected}");
        }
        for &p in moved.iter().flat_map(|o| o.points()) {
            if bevels.iter().all(|&v| point::distance(v, p) > depth) {
                let distance = outline.closest(p).distance.abs();
                assert!(distance >= depth - 1e-9, "{name}: {distance} at {p:?}");
            }
        }
    }

    #[test]
    fn any_ratio_of_distance_and_sides() {
        for k in 0..40 {
            let ratio = 10.0_f64.powf(-2.0 + 4.0 * f64::from(k) / 39.0);
            let side = if ratio < 1.0 { 0.2 } else { 0.1 / ratio };
            let depth = ratio * side;
            let mut random = numbers(k as u64 + 1);
            let rough = side * [0.3, 1.0, 5.0, 20.0][k as usize % 4];
            let outline = ragged((TAU / side) as usize, |_| 1.0 + rough.min(0.6) * random());
            check(&outline, -depth);
            check(&outline, depth);
        }
    }

    #[test]
    fn sides_much_shorter_than_the_distance() {
        let spiky = ragged(3000, |k| if k % 2 == 0 { 1.0 } else { 1.2 });
        let teeth = Outline::zigzag(1.0, 1.0, 0.5, 10_000).unwrap();
        for outline in [spiky, teeth] {
            check(&outline, -0.05);
            check(&outline, 0.05);
        }
        let starfish = Outline::starfish([0.0; 2], 0.563_745, 0.208_665, 5).unwrap();
        check(&starfish, -0.2);
        check(&starfish, 0.5);
        assert!(matches!(
            starfish.offset(-0.5),
            Err(GeometryError::Inset(InsetError::Vanished { .. }))
        ));
    }

    #[test]
    fn the_same_for_any_number_of_threads() {
        let mut random = numbers(7);
        let outline = ragged(2000, |_| 1.0 + 0.02 * random());
        let points = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let moved = pool.build().unwrap().install(|| outline.offset(-0.05));
            moved.unwrap().points().to_vec()
        };
        assert_eq!(points(1), points(3));
    }
}
