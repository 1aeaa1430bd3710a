//! What of straight and flat pieces lies in a box.

use sphpack_neighbors::{Bounds, Domain};

/// The part of the way from `a` to `b` (0 … 1) that lies in the box; `None` where it only touches it. What lies on a lower
/// periodic side is in, on an upper one or an open one out.
pub(super) fn part_of_way<const D: usize>(
    a: [f64; D],
    b: [f64; D],
    domain: &Domain<D>,
) -> Option<[f64; 2]> {
    let Bounds { min, max } = domain.bounds;
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for k in 0..D {
        let step = b[k] - a[k];
        if step == 0.0 {
            let is_in = a[k] > min[k] && a[k] < max[k] || domain.periodic[k] && a[k] == min[k];
            if !is_in {
                return None;
            }
            continue;
        }
        let (low, high) = ((min[k] - a[k]) / step, (max[k] - a[k]) / step);
        from = from.max(low.min(high));
        to = to.min(low.max(high));
    }
    (from < to).then_some([from, to])
}

/// Whether a place counts as within the box: not on an open side (to `slack`), and on one of two periodic ones.
pub(super) fn holds<const D: usize>(p: [f64; D], domain: &Domain<D>, slack: f64) -> bool {
    let Bounds { min, max } = domain.bounds;
    (0..D).all(|k| {
        if domain.periodic[k] {
            p[k] >= min[k] - slack && p[k] < max[k] - slack
        } else {
            p[k] > min[k] + slack && p[k] < max[k] - slack
        }
    })
}

/// The convex flat polygon's part where coordinate `axis` is at most (`sign` 1) or at least (−1) `side`.
pub(super) fn clipped<const D: usize>(
    polygon: &[[f64; D]],
    axis: usize,
    side: f64,
    sign: f64,
) -> Vec<[f64; D]> {
    let over = |p: &[f64; D]| sign * (p[axis] - side);
    let mut left = Vec::with_capacity(polygon.len() + 1);
    for (i, a) in polygon.iter().enumerate() {
        let b = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (over(a), over(b));
        if here <= 0.0 {
            left.push(*a);
        }
        if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
            let t = here / (here - there);
            let mut p = std::array::from_fn(|k| a[k] + t * (b[k] - a[k]));
            p[axis] = side;
            left.push(p);
        }
    }
    left
}
