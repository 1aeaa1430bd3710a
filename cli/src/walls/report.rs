//! What is known about a wall, for machines.

use serde::Serialize;
use sphpack_neighbors::KdTree;

use super::Wall;

/// The content of report.json's `bodies[].wall`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WallReport {
    /// Layer by layer, from the surface on.
    pub layers: Vec<LayerReport>,
    /// Smallest distance of a particle of the wall from any other, in ∆s.
    pub closest_pair_over_spacing: f64,
    /// Farthest that a place of the layers was found from all of the wall's particles, in ∆s.
    pub hole_over_spacing: f64,
    /// By how much of it the particles' volume is off that between the surface and the far side of the layers.
    pub volume_error: f64,
}

/// A layer: what is from k to k + 1 spacings deep in the wall.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LayerReport {
    /// Its particles.
    pub count: usize,
    /// As many as its volume asks for, rounded.
    pub target_count: usize,
    /// Those of them that are on no level set: they fill what would be holes.
    pub between: usize,
    /// Volume between its sides.
    pub volume: f64,
    /// Distance to the nearest other particle of the layer, in ∆s: the mean.
    pub spacing_mean_over_spacing: f64,
    /// Its coefficient of variation.
    pub spacing_cv: f64,
}

impl WallReport {
    pub(crate) fn new<const D: usize>(
        wall: &Wall<D>,
        closest_pair_over_spacing: f64,
        hole_over_spacing: f64,
    ) -> Self {
        let spacing = wall.of.spec.spacing;
        let layers = (wall.layers.iter())
            .map(|layer| {
                let places: Vec<[f64; D]> = layer.points.iter().map(|at| at.point).collect();
                let [mean, cv] = spread(&places);
                LayerReport {
                    count: places.len(),
                    target_count: (layer.volume / spacing.powi(D as i32)).round() as usize,
                    between: layer.between,
                    volume: layer.volume,
                    spacing_mean_over_spacing: mean / spacing,
                    spacing_cv: cv,
                }
            })
            .collect();
        let asked: f64 = wall.layers.iter().map(|layer| layer.volume).sum();
        Self {
            layers,
            closest_pair_over_spacing: finite(closest_pair_over_spacing),
            hole_over_spacing: finite(hole_over_spacing),
            volume_error: finite((wall.volume() - asked).abs() / asked),
        }
    }
}

/// JSON has no infinities: 0 for figures of too few particles.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

/// Mean and coefficient of variation of the distances to the nearest other point; 0 of fewer than two.
fn spread<const D: usize>(places: &[[f64; D]]) -> [f64; 2] {
    let Ok(tree) = KdTree::new(places) else {
        return [0.0; 2];
    };
    let gaps: Vec<f64> = (places.iter())
        .filter_map(|&p| tree.nearest_n(p, 2).get(1).map(|found| found.distance))
        .collect();
    let count = gaps.len().max(1) as f64;
    // A sum of nothing is −0.
    let mean = gaps.iter().fold(0.0, |sum, gap| sum + gap) / count;
    let variance = gaps.iter().map(|gap| (gap - mean).powi(2)).sum::<f64>() / count;
    [mean, finite(variance.sqrt() / mean)]
}
