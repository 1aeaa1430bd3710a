//! Polylines measured by arc length.

use sphpack_neighbors::point;

/// A polyline and the way to each of its points.
#[derive(Debug, Clone)]
pub(super) struct Polyline<const D: usize> {
    points: Vec<[f64; D]>,
    /// Arc length from the first point to each.
    way: Vec<f64>,
}

impl<const D: usize> Polyline<D> {
    /// The polyline through `points`, at least one; a closed one repeats its first point at its end.
    pub(super) fn new(points: Vec<[f64; D]>) -> Self {
        let mut way = Vec::with_capacity(points.len());
        let mut sum = 0.0;
        for (i, &p) in points.iter().enumerate() {
            if i > 0 {
                sum += point::distance(points[i - 1], p);
            }
            way.push(sum);
        }
        Self { points, way }
    }

    pub(super) fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    pub(super) fn length(&self) -> f64 {
        self.way.last().copied().unwrap_or(0.0)
    }

    pub(super) fn is_closed(&self) -> bool {
        self.points.len() > 2 && self.points.first() == self.points.last()
    }

    /// Arc length from the first point to point `i`.
    pub(super) fn way(&self, i: usize) -> f64 {
        self.way[i]
    }

    /// The point so far along, and the direction (not of length one) of the side it is on.
    pub(super) fn at(&self, way: f64) -> ([f64; D], [f64; D]) {
        let i = self
            .way
            .partition_point(|&w| w <= way)
            .clamp(1, self.points.len().max(2) - 1);
        let (from, to) = (self.way[i - 1], self.way[i]);
        let part = if to > from {
            ((way - from) / (to - from)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let side = point::sub(self.points[i], self.points[i - 1]);
        (point::add_scaled(self.points[i - 1], part, side), side)
    }
}
