//! Bodies of the plane: closed loops, any of them a hole where it lies within another.

use std::f64::consts::TAU;

use super::Point;

/// Chords within `fine` of a closed curve whose second derivative is at most `most`.
pub(super) fn curve(fine: f64, most: f64, at: impl Fn(f64) -> [f64; 2]) -> Vec<[f64; 2]> {
    let step = (8.0 * fine / most).sqrt();
    let count = (TAU / step).ceil().clamp(64.0, 6000.0) as usize;
    (0..count)
        .map(|k| at(TAU * k as f64 / count as f64))
        .collect()
}

/// Whether a place lies in a loop.
fn holds(points: &[[f64; 2]], p: [f64; 2]) -> bool {
    let sides = (0..points.len()).map(|k| [points[k], points[(k + 1) % points.len()]]);
    let crossed = sides.filter(|[a, b]| {
        (a[1] <= p[1]) != (b[1] <= p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

/// Closed loops.
#[derive(Debug, Clone)]
pub(super) struct Loops {
    loops: Vec<Vec<[f64; 2]>>,
}

impl Loops {
    pub(super) fn new(loops: Vec<Vec<[f64; 2]>>) -> Self {
        Self { loops }
    }

    fn sides(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        self.loops.iter().flat_map(|points| {
            (0..points.len()).map(|k| [points[k], points[(k + 1) % points.len()]])
        })
    }

    /// Where the line at height y goes in and out, in order.
    pub(super) fn crossings(&self, y: f64) -> Vec<f64> {
        let mut all: Vec<f64> = self
            .sides()
            .filter(|[a, b]| (a[1] <= y) != (b[1] <= y))
            .map(|[a, b]| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            .collect();
        all.sort_by(f64::total_cmp);
        all
    }

    pub(super) fn distance(&self, p: [f64; 2]) -> f64 {
        let mut is_inside = false;
        let mut nearest = f64::INFINITY;
        for [a, b] in self.sides() {
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let (px, py) = (p[0] - a[0], p[1] - a[1]);
            let length2 = dx * dx + dy * dy;
            let t = if length2 > 0.0 {
                ((px * dx + py * dy) / length2).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let (x, y) = (px - t * dx, py - t * dy);
            nearest = nearest.min(x * x + y * y);
            if (a[1] <= p[1]) != (b[1] <= p[1]) && (px < py / dy * dx) {
                is_inside = !is_inside;
            }
        }
        let nearest = nearest.sqrt();
        if is_inside { -nearest } else { nearest }
    }

    /// The area within: loops in an odd number of others are holes.
    pub(super) fn area(&self) -> f64 {
        let area = |points: &[[f64; 2]]| {
            let o = points[0];
            let twice: f64 = (0..points.len())
                .map(|k| {
                    let (a, b) = (points[k], points[(k + 1) % points.len()]);
                    (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1])
                })
                .sum();
            0.5 * twice.abs()
        };
        (self.loops.iter().enumerate())
            .map(|(own, points)| {
                let depth = (self.loops.iter().enumerate())
                    .filter(|(other, around)| *other != own && holds(around, points[0]))
                    .count();
                let sign = if depth % 2 == 0 { 1.0 } else { -1.0 };
                sign * area(points)
            })
            .sum()
    }

    pub(super) fn bounds(&self) -> [Point; 2] {
        let mut all = [
            [f64::INFINITY, f64::INFINITY, 0.0],
            [f64::NEG_INFINITY, f64::NEG_INFINITY, 0.0],
        ];
        for p in self.loops.iter().flatten() {
            for k in 0..2 {
                all[0][k] = all[0][k].min(p[k]);
                all[1][k] = all[1][k].max(p[k]);
            }
        }
        all
    }
}
