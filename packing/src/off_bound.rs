//! Places that are too near to a bound, or beyond it.

use sphpack_geometry::Closest;
use sphpack_neighbors::point;

/// `p` moved straight off a bound until it is `floor` (scene units) within; none where it is that far already. `bound` is the
/// nearest place of the bound, its normal the way out, its distance negative within.
#[inline]
pub(crate) fn off_bound<const D: usize>(
    p: [f64; D],
    bound: &Closest<D>,
    floor: f64,
) -> Option<[f64; D]> {
    let lacking = bound.distance + floor;
    let inward = point::scale(bound.normal, -1.0);
    (lacking > 0.0).then(|| point::add_scaled(p, lacking, inward))
}
