//! The SPH procedure of Negi & Ramachandran (2021), section 3.1.7.

use rayon::prelude::*;
use sphpack_geometry::Surface;
use sphpack_neighbors::KdTree;

use crate::labels::{Labels, SeparationError, check, combine};

/// Labels particles as Negi & Ramachandran (2021), section 3.1.7, do: those within `reach` of a surface by its exact
/// closest point (steps 1 and 2, with the surface in place of its nearest node, whose averaged normal misleads at sharp
/// tips), the others by a flood outward from that layer (step 3), each from a neighbour within `reach` that has its label.
///
/// A particle farther than `reach` from the surface and a neighbour nearer than `reach` to it are never on different
/// sides, so the flood makes no mistakes and its order does not matter; it goes layer by layer, by ascending index.
/// Particles that no neighbour reaches are asked about one by one, and so are those far outside of a body's box, where the answer
/// is nearest at hand. `reach` of about two spacings is a good choice.
///
/// `on_surface[i]` is the body on whose surface particle `i` sits, which it then belongs to. The labels are those of
/// [`separate_with_on_surface`](crate::separate_with_on_surface). O(n log n) for each body.
///
/// # Errors
/// A [`SeparationError`] for slices that do not fit together, positions that are not finite, or a senseless reach.
pub fn separate_by_flood<const D: usize>(
    positions: &[[f64; D]],
    on_surface: &[Option<u16>],
    bodies: &[&dyn Surface<D>],
    reach: f64,
) -> Result<Labels, SeparationError> {
    check(positions, on_surface, bodies.len())?;
    if !(reach > 0.0 && reach.is_finite()) {
        return Err(SeparationError::BadReach(reach));
    }
    let tree = KdTree::new(positions).map_err(|_| SeparationError::NotFinite { index: 0 })?;
    let held = (bodies.iter()).map(|body| flood(positions, *body, &tree, reach));
    Ok(combine(on_surface, held))
}

fn flood<const D: usize>(
    positions: &[[f64; D]],
    surface: &dyn Surface<D>,
    tree: &KdTree<D>,
    reach: f64,
) -> Vec<bool> {
    // Steps 1 and 2.
    let near = surface.closest_batch(positions, reach);
    let mut inside: Vec<Option<bool>> = near
        .into_iter()
        .map(|hit| hit.map(|hit| hit.distance < 0.0))
        .collect();
    // Step 3. A flood through all that is outside, once for each body, was most of the time that 27 balls took.
    let bounds = surface.bounds();
    let goes_on = |p, is_inside| is_inside || bounds.distance_squared(p) <= reach * reach;
    let mut layer: Vec<usize> = (0..positions.len())
        .filter(|&i| inside[i].is_some())
        .collect();
    while !layer.is_empty() {
        let reached: Vec<(usize, bool)> = layer
            .par_iter()
            .with_min_len(64)
            .flat_map_iter(|&i| {
                let label = inside[i].unwrap_or(false);
                let found = goes_on(positions[i], label).then(|| tree.within(positions[i], reach));
                let inside = &inside;
                (found.into_iter().flatten())
                    .filter(|hit| inside[hit.index].is_none())
                    .map(move |hit| (hit.index, label))
            })
            .collect();
        layer.clear();
        for (i, label) in reached {
            if inside[i].is_none() {
                inside[i] = Some(label);
                layer.push(i);
            }
        }
        layer.sort_unstable();
    }
    inside
        .into_par_iter()
        .zip(positions)
        .map(|(label, &p)| label.unwrap_or_else(|| surface.inside(p)))
        .collect()
}
