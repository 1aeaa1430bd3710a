//! [`Surface`] for outlines.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, point};

use super::{Outline, inside::crosses};
use crate::sample::{Candidates, Ring, along};
use crate::segment::{Segment, cross};
use crate::surface::{Closest, Feature, Features, Surface};
use crate::{GeometryError, Moments, ParameterError};

impl Outline {
    /// What side `i` answers to `p`, to which it is the nearest.
    fn answer(&self, i: usize, p: [f64; 2]) -> Closest<2> {
        let side = &self.sides[i];
        let after = self.next[i] as usize;
        let t = side.parameter(p);
        let vertex = if t <= 0.0 {
            Some(i)
        } else if t >= 1.0 {
            Some(after)
        } else {
            None
        };
        let Some(v) = vertex else {
            let q = point::add_scaled(side.start, t, side.edge);
            let from = if self.corner[i] {
                side.normal
            } else {
                self.node_normals[i]
            };
            let to = if self.corner[after] {
                side.normal
            } else {
                self.node_normals[after]
            };
            let normal = point::add_scaled(from, t, point::sub(to, from));
            let height = point::dot(point::sub(p, side.start), side.normal);
            return Closest {
                point: q,
                normal: point::unit(normal).unwrap_or(side.normal),
                distance: point::distance(p, q).copysign(height),
                feature: Feature::Smooth,
            };
        };
        let q = self.points[v];
        let away = point::sub(p, q);
        // The sides before and after `v`: one of them is `i`.
        let before = if v == i { self.before(v) } else { i };
        let (into, out) = (&self.sides[before], &self.sides[v]);
        // The points nearest to a vertex lie in the wedge between its sides' normals: outside at a convex vertex,
        // inside at a reflex one; the sum of the normals points out and decides.
        let sum = point::dot(away, into.normal) + point::dot(away, out.normal);
        let outside = if sum == 0.0 {
            cross(into.edge, out.edge) >= 0.0
        } else {
            sum > 0.0
        };
        let distance = point::norm(away);
        Closest {
            point: q,
            normal: self.node_normals[v],
            distance: if outside { distance } else { -distance },
            feature: if self.corner[v] {
                Feature::Corner
            } else {
                Feature::Smooth
            },
        }
    }

    /// The point before `v` in its loop.
    fn before(&self, v: usize) -> usize {
        let (k, place) = self.address(v);
        if place > 0 {
            v - 1
        } else {
            self.starts[k + 1] - 1
        }
    }
}

impl Surface<2> for Outline {
    fn closest(&self, p: [f64; 2]) -> Closest<2> {
        self.closest_within(p, f64::INFINITY)
            .unwrap_or_else(|| Closest {
                // Only for a `p` that is not a number.
                point: self.points[0],
                normal: self.node_normals[0],
                distance: f64::NAN,
                feature: Feature::Smooth,
            })
    }

    fn closest_within(&self, p: [f64; 2], radius: f64) -> Option<Closest<2>> {
        if radius < 0.0 {
            return None;
        }
        self.bvh
            .nearest(p, radius * radius, |i| self.sides[i].distance_squared(p))
            .map(|found| self.answer(found.index, p))
    }

    /// Counts the sides that a ray crosses, found in the tree; exact for rays through vertices.
    fn inside(&self, p: [f64; 2]) -> bool {
        let mut odd = false;
        self.bvh.visit(
            |b| b.min[1] <= p[1] && p[1] <= b.max[1] && p[0] <= b.max[0],
            |i| odd ^= crosses(self.points[i], self.points[self.next[i] as usize], p),
        );
        odd
    }

    fn measure(&self) -> f64 {
        self.length
    }

    fn volume(&self) -> f64 {
        self.area
    }

    fn moments(&self) -> Option<Moments<2>> {
        let sides =
            (0..self.points.len()).map(|i| [self.points[i], self.points[self.next[i] as usize]]);
        Moments::of_sides(self.bounds().center(), sides, |[a, b]| {
            0.5 * (a[0] * b[1] - a[1] * b[0])
        })
    }

    fn bounds(&self) -> Bounds<2> {
        self.bvh.bounds()
    }

    fn features(&self) -> Features<2> {
        Features {
            corners: (0..self.points.len())
                .filter(|&i| self.corner[i])
                .map(|i| self.points[i])
                .collect(),
            edges: Vec::new(),
        }
    }

    fn parts(&self) -> Vec<Arc<dyn Surface<2>>> {
        (self.pieces().into_iter())
            .map(|part| Arc::new(part) as Arc<dyn Surface<2>>)
            .collect()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<2>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        Ok(Arc::new(self.offset(-depth)?))
    }

    fn sample(&self, count: usize) -> Result<Vec<Closest<2>>, GeometryError> {
        let rings: Vec<Ring<2>> = self
            .starts
            .windows(2)
            .map(|r| Ring {
                points: self.points[r[0]..r[1]].to_vec(),
                corner: self.corner[r[0]..r[1]].to_vec(),
                is_open: false,
            })
            .collect();
        Ok(along(self, &rings, count))
    }

    fn scatter(&self, count: usize) -> Vec<Closest<2>> {
        let place = |side: &Segment, before: f64| {
            (
                point::add_scaled(side.start, before, side.edge),
                side.normal,
            )
        };
        Candidates::systematic(count, &self.sides, Segment::length, place).hits()
    }
}
