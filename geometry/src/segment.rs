//! Straight sides of outlines: the nearest point of one, and whether two meet.

use sphpack_neighbors::{Bounds, point};

/// A side from `start` along `edge`, as queries read it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    pub(crate) start: [f64; 2],
    pub(crate) edge: [f64; 2],
    /// 1 / |edge|².
    pub(crate) inverse_square: f64,
    /// Unit normal to the right of `edge`: outward for a counter-clockwise loop.
    pub(crate) normal: [f64; 2],
}

impl Segment {
    /// From `a` to `b`, which must differ.
    pub(crate) fn new(a: [f64; 2], b: [f64; 2]) -> Self {
        let edge = point::sub(b, a);
        Self {
            start: a,
            edge,
            inverse_square: 1.0 / point::norm_squared(edge),
            normal: point::unit([edge[1], -edge[0]]).unwrap_or([0.0; 2]),
        }
    }

    /// Where along the segment (0 … 1) its nearest point to `p` is.
    #[inline(always)]
    pub(crate) fn parameter(&self, p: [f64; 2]) -> f64 {
        (point::dot(point::sub(p, self.start), self.edge) * self.inverse_square).clamp(0.0, 1.0)
    }

    /// Squared distance from `p`.
    #[inline(always)]
    pub(crate) fn distance_squared(&self, p: [f64; 2]) -> f64 {
        let t = self.parameter(p);
        point::distance_squared(p, point::add_scaled(self.start, t, self.edge))
    }

    /// Length.
    pub(crate) fn length(&self) -> f64 {
        point::norm(self.edge)
    }
}

/// `a × b`, positive where `b` is to the left of `a`.
#[inline(always)]
pub(crate) fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Positive where `c` is to the left of the line from `a` to `b`, twice the triangle's area.
#[inline(always)]
pub(crate) fn side_of(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    cross(point::sub(b, a), point::sub(c, a))
}

/// Where the closed segments `ab` and `cd` meet, if they do (one such point).
pub(crate) fn meeting(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> Option<[f64; 2]> {
    let (c_side, d_side) = (side_of(a, b, c), side_of(a, b, d));
    let (a_side, b_side) = (side_of(c, d, a), side_of(c, d, b));
    let between = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| Bounds::of(&[p, q]).contains(r);
    if c_side == 0.0 && between(a, b, c) {
        return Some(c);
    }
    if d_side == 0.0 && between(a, b, d) {
        return Some(d);
    }
    if a_side == 0.0 && between(c, d, a) {
        return Some(a);
    }
    if b_side == 0.0 && between(c, d, b) {
        return Some(b);
    }
    let crosses = (c_side > 0.0) != (d_side > 0.0) && (a_side > 0.0) != (b_side > 0.0);
    let flat = c_side == 0.0 || d_side == 0.0 || a_side == 0.0 || b_side == 0.0;
    (crosses && !flat).then(|| point::add_scaled(a, a_side / (a_side - b_side), point::sub(b, a)))
}

/// Signed area of a loop, positive counter-clockwise.
pub(crate) fn signed_area(points: &[[f64; 2]]) -> f64 {
    let Some(&origin) = points.first() else {
        return 0.0;
    };
    let mut twice = 0.0;
    for (i, &a) in points.iter().enumerate() {
        twice += side_of(origin, a, points[(i + 1) % points.len()]);
    }
    0.5 * twice
}
