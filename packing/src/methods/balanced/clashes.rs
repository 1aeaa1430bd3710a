//! Surfaces that lie on each other, or nearly.

use sphpack_geometry::Closest;
use sphpack_neighbors::KdTree;

/// Points of different bodies are kept this far apart, in the mean of their spacings: where an earlier body has one, a later one has none.
const APART_OVER_SPACING: f64 = 0.6;

/// What bodies share of each other's surfaces, in points.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Clash {
    /// Points of this body that were left to an earlier one.
    pub(super) removed: usize,
    /// Points of this body's layer whose outer half is in another body, not in what is around.
    pub(super) shared: usize,
}

/// Takes away points that are too near to those of an earlier body: surfaces that touch carry one layer of particles,
/// which stands for both.
pub(super) fn resolve<const D: usize>(
    samples: &mut [Vec<Closest<D>>],
    spacings: &[f64],
) -> Vec<Clash> {
    let mut clashes = vec![Clash::default(); samples.len()];
    let mut taken: Vec<[f64; D]> = Vec::new();
    let mut owner: Vec<usize> = Vec::new();
    for body in 0..samples.len() {
        if let Ok(tree) = KdTree::new(&taken)
            && !taken.is_empty()
        {
            samples[body].retain(|point| {
                let near = tree.nearest_n(point.point, 1);
                let hit = near.first().filter(|hit| {
                    let spacing = 0.5 * (spacings[body] + spacings[owner[hit.index]]);
                    hit.distance < APART_OVER_SPACING * spacing
                });
                if let Some(hit) = hit {
                    clashes[owner[hit.index]].shared += 1;
                    clashes[body].shared += 1;
                    clashes[body].removed += 1;
                }
                hit.is_none()
            });
        }
        taken.extend(samples[body].iter().map(|point| point.point));
        owner.resize(taken.len(), body);
    }
    clashes
}
