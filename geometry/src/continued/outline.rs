//! Outlines that go on beyond the sides of a box.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, Domain, point};

use super::window::{holds, part_of_way};
use super::{Continued, Reach, Whole, into, moved_by, parts_by_images, slack, snapped};
use crate::outline::Outline;
use crate::outline::booleans::{Filled, resolved};
use crate::sample::{Candidates, Ring, along};
use crate::segment::Segment;
use crate::surface::{Closest, Features, Surface};
use crate::{GeometryError, ParameterError};

type Loop = Vec<[f64; 2]>;

impl Outline {
    /// What of the body lies in the box, going on beyond its sides; `None` where it does not pass one, nor has a face on an open one or
    /// faces on both of two periodic ones. O(n log n) for n points and their images.
    pub fn continued(&self, domain: &Domain<2>) -> Option<Continued<2>> {
        let (shift, bounds) = into(self.bounds(), domain);
        let reach = [0, 1].map(|axis| Reach::of(&bounds, domain, axis));
        let slack = slack(domain);
        let snap = |p: &[f64; 2]| snapped(point::add(*p, shift), domain, slack);
        let mut loops: Vec<Loop> = (self.loops())
            .map(|points| points.iter().map(snap).collect())
            .collect();
        let mut goes_on = false;
        for axis in (0..2).filter(|&axis| !domain.periodic[axis]) {
            let more = beyond(&loops, domain, axis);
            goes_on |= !more.is_empty() || reach[axis].passes != [false; 2];
            if !more.is_empty() {
                loops.extend(more);
                loops = resolved(&loops, Filled::Positive);
                // The engine's own grid has moved them.
                for p in loops.iter_mut().flatten() {
                    *p = snapped(*p, domain, slack);
                }
            }
        }
        for axis in 0..2 {
            goes_on |= reach[axis].periods > 0;
        }
        if !goes_on {
            return None;
        }
        for axis in (0..2).filter(|&axis| domain.periodic[axis]) {
            let images = with_images(&loops, domain, axis, reach[axis].periods.max(1));
            loops = resolved(&images, Filled::Positive);
            for p in loops.iter_mut().flatten() {
                *p = snapped(*p, domain, slack);
            }
        }
        if loops.is_empty() {
            return None;
        }
        let whole = Self::assemble(loops);
        Some(Continued::new(Arc::new(whole), domain))
    }
}

/// Rectangles that carry on the faces on the sides of an open axis, or beyond them, as far as the box is large: a face less than
/// ∆s/2 beyond a side would have its particles in the box.
fn beyond(loops: &[Loop], domain: &Domain<2>, axis: usize) -> Vec<Loop> {
    let Bounds { min, max } = domain.bounds;
    let (other, far, slack) = (1 - axis, domain.bounds.diagonal(), slack(domain));
    let mut more = Vec::new();
    for points in loops {
        for (i, a) in points.iter().enumerate() {
            let b = &points[(i + 1) % points.len()];
            for (side, out) in [(min[axis], -1.0), (max[axis], 1.0)] {
                // The body is on the left of its sides: only faces that look out of the box.
                let normal = if axis == 0 { b[1] - a[1] } else { a[0] - b[0] };
                let is_level = (a[axis] - b[axis]).abs() <= slack;
                if !is_level || (a[axis] - side) * out < 0.0 || normal * out <= 0.0 {
                    continue;
                }
                let level = if out > 0.0 {
                    a[axis].min(b[axis])
                } else {
                    a[axis].max(b[axis])
                };
                let place = |along: f64, away: f64| {
                    let mut p = [0.0; 2];
                    (p[other], p[axis]) = (along, level + away * out);
                    p
                };
                let [low, high] = [a[other].min(b[other]), a[other].max(b[other])];
                let mut one = vec![
                    place(low, 0.0),
                    place(high, 0.0),
                    place(high, far),
                    place(low, far),
                ];
                if crate::segment::signed_area(&one) < 0.0 {
                    one.reverse();
                }
                more.push(one);
            }
        }
    }
    more
}

/// The loops and their images up to so many periods away.
fn with_images(loops: &[Loop], domain: &Domain<2>, axis: usize, periods: usize) -> Vec<Loop> {
    let Bounds { min, max } = domain.bounds;
    let count = periods as i32;
    let mut all = Vec::with_capacity(loops.len() * (2 * periods + 1));
    for step in -count..=count {
        let moved = |p: &[f64; 2]| {
            let mut p = *p;
            p[axis] = moved_by(p[axis], step, [min[axis], max[axis]]);
            p
        };
        all.extend(
            loops
                .iter()
                .map(|points| -> Loop { points.iter().map(moved).collect() }),
        );
    }
    all
}

impl Outline {
    /// Its sides, loop by loop.
    fn sides_of_loops(&self) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
        (0..self.points().len()).map(|i| self.side(i))
    }

    /// The parts of its sides within the box.
    fn sides_in(&self, domain: &Domain<2>) -> Vec<Segment> {
        self.sides_of_loops()
            .filter_map(|[a, b]| {
                let [from, to] = part_of_way(a, b, domain)?;
                let way = point::sub(b, a);
                let ends = [from, to].map(|t| point::add_scaled(a, t, way));
                (ends[0] != ends[1]).then(|| Segment::new(ends[0], ends[1]))
            })
            .collect()
    }

    /// Its loops within the box, open where they pass a side.
    fn rings_in(&self, domain: &Domain<2>) -> Vec<Ring<2>> {
        let slack = slack(domain);
        let corners = self.is_corner();
        let mut rings = Vec::new();
        let mut first = 0;
        for points in self.loops() {
            let count = points.len();
            let parts: Vec<Option<[f64; 2]>> = (0..count)
                .map(|i| part_of_way(points[i], points[(i + 1) % count], domain))
                .collect();
            let is_corner =
                |i: usize| corners[first + i % count] && holds(points[i % count], domain, slack);
            // Goes on without a break from the side before.
            let joins = |i: usize| {
                let before = parts[(i + count - 1) % count];
                before.is_some_and(|part| part[1] == 1.0)
                    && parts[i % count].is_some_and(|part| part[0] == 0.0)
            };
            let begins = (0..count).filter(|&i| parts[i].is_some() && !joins(i));
            let mut is_broken = false;
            for begin in begins {
                is_broken = true;
                let place = |i: usize, t: f64| {
                    let (a, b) = (points[i % count], points[(i + 1) % count]);
                    if t == 1.0 {
                        b
                    } else {
                        point::add_scaled(a, t, point::sub(b, a))
                    }
                };
                let mut ring = Ring {
                    is_open: true,
                    ..Ring::default()
                };
                let start = parts[begin].map_or(0.0, |part| part[0]);
                ring.points.push(place(begin, start));
                ring.corner.push(false);
                for i in begin..begin + count {
                    let Some([_, to]) = parts[i % count] else {
                        break;
                    };
                    ring.points.push(place(i, to));
                    let goes_on = i + 1 < begin + count && joins(i + 1);
                    ring.corner.push(goes_on && is_corner(i + 1));
                    if !goes_on {
                        break;
                    }
                }
                rings.push(ring);
            }
            if !is_broken && parts.iter().any(Option::is_some) {
                rings.push(Ring {
                    points: points.to_vec(),
                    corner: (0..count).map(is_corner).collect(),
                    is_open: false,
                });
            }
            first += count;
        }
        rings
    }
}

impl Whole<2> for Outline {
    fn contents(&self, domain: &Domain<2>) -> (f64, f64) {
        let length = self.sides_in(domain).iter().map(Segment::length).sum();
        let Bounds { min, max } = domain.bounds;
        // ∮ x dy with x and y kept within the box: exact on pieces between the lines where either begins to be.
        let mut area = 0.0;
        for [a, b] in self.sides_of_loops() {
            let step = point::sub(b, a);
            let mut cuts = vec![0.0, 1.0];
            for k in 0..2 {
                for side in [min[k], max[k]] {
                    let t = (side - a[k]) / step[k];
                    if t > 0.0 && t < 1.0 {
                        cuts.push(t);
                    }
                }
            }
            cuts.sort_by(f64::total_cmp);
            let kept = |t: f64, k: usize| (a[k] + t * step[k]).clamp(min[k], max[k]) - min[k];
            for cut in cuts.windows(2) {
                let mean = 0.5 * (kept(cut[0], 0) + kept(cut[1], 0));
                area += mean * (kept(cut[1], 1) - kept(cut[0], 1));
            }
        }
        (length, area)
    }

    fn moved_in(&self, depth: f64) -> Result<Arc<dyn Whole<2>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        Ok(Arc::new(self.offset(-depth)?))
    }

    fn parts_in(&self, domain: &Domain<2>) -> Vec<Arc<dyn Whole<2>>> {
        let (parts, groups) = parts_by_images(self.pieces(), domain);
        if groups.len() < 2 {
            return Vec::new();
        }
        (groups.into_iter())
            .map(|group| {
                let loops = group
                    .into_iter()
                    .flat_map(|i| parts[i].loops().map(<[_]>::to_vec));
                Arc::new(Self::assemble(loops.collect())) as Arc<dyn Whole<2>>
            })
            .collect()
    }

    fn features_in(&self, domain: &Domain<2>) -> Features<2> {
        let slack = slack(domain);
        let mut features = self.features();
        features.corners.retain(|&c| holds(c, domain, slack));
        features
    }

    fn scattered_in(&self, domain: &Domain<2>, count: usize) -> Candidates<2> {
        let place = |side: &Segment, before: f64| {
            (
                point::add_scaled(side.start, before, side.edge),
                side.normal,
            )
        };
        Candidates::systematic(count, &self.sides_in(domain), Segment::length, place)
    }

    fn sample_in(
        &self,
        surface: &Continued<2>,
        count: usize,
    ) -> Result<Vec<Closest<2>>, GeometryError> {
        Ok(along(surface, &self.rings_in(&surface.domain), count))
    }
}
