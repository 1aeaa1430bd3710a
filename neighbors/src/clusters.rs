//! Cutting a set of points into compact blocks of equal size.

use crate::{Bounds, LANES};

/// Below this many points a part is not worth a task of its own.
const SERIAL_BELOW: usize = 8192;

/// Reorders `items` (indices into `points`) so that every [`LANES`] consecutive ones lie close together, and each half of
/// them closer: halved along the longest side, over and over, always at a multiple of [`LANES`], blocks at half of it. O(n log n), in parallel; the result does not
/// depend on the number of threads.
pub(crate) fn cluster<const D: usize>(points: &[[f64; D]], items: &mut [u32]) {
    if items.len() <= LANES / 2 {
        items.sort_unstable();
        return;
    }
    let mut bounds = Bounds::EMPTY;
    for &i in items.iter() {
        bounds.include(points[i as usize]);
    }
    let size = bounds.size();
    let mut axis = 0;
    for k in 1..D {
        if size[k] > size[axis] {
            axis = k;
        }
    }
    // Whole blocks on either side; a block into its halves.
    let unit = if items.len() > LANES {
        LANES
    } else {
        LANES / 2
    };
    let middle = items.len().div_ceil(unit) / 2 * unit;
    items.select_nth_unstable_by(middle, |&a, &b| {
        let (x, y) = (points[a as usize][axis], points[b as usize][axis]);
        x.total_cmp(&y).then(a.cmp(&b))
    });
    let parallel = items.len() > SERIAL_BELOW;
    let (left, right) = items.split_at_mut(middle);
    if parallel {
        rayon::join(|| cluster(points, left), || cluster(points, right));
    } else {
        cluster(points, left);
        cluster(points, right);
    }
}
