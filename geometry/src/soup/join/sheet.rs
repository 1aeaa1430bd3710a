//! The plane of a triangle that is cut.

use std::collections::BTreeMap;

use robust::{Coord, orient2d};

/// A triangle's plane, seen from the side it faces, and its points there.
pub(super) struct Sheet {
    pub(super) place: BTreeMap<u32, Coord<f64>>,
    pub(super) space: BTreeMap<u32, [f64; 3]>,
    /// The straight lines that each point is on: the sides 0, 1, 2, and 3 + the number of every triangle across.
    pub(super) on: BTreeMap<u32, Vec<u32>>,
}

impl Sheet {
    /// Twice the area of three points, its sign exact: positive counter-clockwise.
    pub(super) fn turn(&self, a: u32, b: u32, c: u32) -> f64 {
        orient2d(self.place[&a], self.place[&b], self.place[&c])
    }

    pub(super) fn direction(&self, a: u32, b: u32) -> f64 {
        let (p, q) = (self.place[&a], self.place[&b]);
        (q.y - p.y).atan2(q.x - p.x)
    }

    /// Whether two points are on one straight line of this triangle, so that no side of a part may run between them.
    pub(super) fn share_line(&self, a: u32, b: u32) -> bool {
        a == b
            || match (self.on.get(&a), self.on.get(&b)) {
                (Some(a), Some(b)) => a.iter().any(|line| b.contains(line)),
                _ => false,
            }
    }

    /// Twice the area of three points over their longest squared distance.
    pub(super) fn shape(&self, t: [u32; 3]) -> f64 {
        let p = t.map(|v| self.place[&v]);
        let longest = (0..3)
            .map(|k| {
                let (a, b) = (p[k], p[(k + 1) % 3]);
                (a.x - b.x).powi(2) + (a.y - b.y).powi(2)
            })
            .fold(0.0, f64::max);
        self.turn(t[0], t[1], t[2]) / longest
    }

    /// Twice the area of a cycle of points, positive counter-clockwise.
    pub(super) fn area(&self, cycle: &[u32]) -> f64 {
        let origin = self.place[&cycle[0]];
        let mut double = 0.0;
        for (i, v) in cycle.iter().enumerate() {
            let (p, q) = (self.place[v], self.place[&cycle[(i + 1) % cycle.len()]]);
            double += (p.x - origin.x) * (q.y - origin.y) - (q.x - origin.x) * (p.y - origin.y);
        }
        double
    }

    /// Whether two lines that share no end cross.
    pub(super) fn cross(&self, [a, b]: [u32; 2], [c, d]: [u32; 2]) -> bool {
        if a == c || a == d || b == c || b == d {
            return false;
        }
        let differ = |x: f64, y: f64| (x > 0.0 && y < 0.0) || (x < 0.0 && y > 0.0);
        differ(self.turn(a, b, c), self.turn(a, b, d))
            && differ(self.turn(c, d, a), self.turn(c, d, b))
    }

    pub(super) fn holds(&self, cycle: &[u32], v: u32) -> bool {
        let p = self.place[&v];
        let mut inside = false;
        for (i, a) in cycle.iter().enumerate() {
            let b = cycle[(i + 1) % cycle.len()];
            let (q, r) = (self.place[a], self.place[&b]);
            if (q.y > p.y) != (r.y > p.y) {
                let upward = r.y > q.y;
                inside ^= (self.turn(*a, b, v) > 0.0) == upward;
            }
        }
        inside
    }
}
