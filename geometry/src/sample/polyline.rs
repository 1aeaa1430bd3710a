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

    /// [`Polyline::new`] measured by the integral of a weight, given at every point, in place of arc length.
    pub(super) fn weighted(points: Vec<[f64; D]>, weights: &[f64]) -> Self {
        let mut line = Self::new(points);
        let mut sum = 0.0;
        for i in 1..line.points.len() {
            let mean = 0.5 * (weights[i - 1] + weights[i]);
            sum += mean * point::distance(line.points[i - 1], line.points[i]);
            line.way[i] = sum;
        }
        line
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
