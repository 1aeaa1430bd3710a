//! Many particles, looked at slab by slab: lists and trees then take the memory of a slab.

use sphpack_neighbors::{Bounds, Domain};

/// Particles that are looked at at once.
pub(crate) const MOST: usize = 1 << 21;

/// Particles in a slab of space and within a margin of it.
pub(crate) struct Slab {
    /// Their places among all, ascending.
    pub(crate) order: Vec<usize>,
    /// Which of them are in the slab itself: every particle is in one.
    pub(crate) is_inside: Vec<bool>,
}

/// The slabs of a set of particles, across its longest axis, of about `most` particles each if these are spread evenly.
/// One pass over all particles for each.
pub(crate) fn slabs<'a, const D: usize>(
    domain: &Domain<D>,
    positions: &'a [[f64; D]],
    margin: f64,
    most: usize,
) -> impl Iterator<Item = Slab> + use<'a, D> {
    let count = positions.len().div_ceil(most.max(1));
    let bounds = Bounds::of(positions);
    let size = bounds.size();
    let axis = (0..D).fold(0, |best, k| if size[k] > size[best] { k } else { best });
    let (low, width) = (bounds.min[axis], size[axis] / count.max(1) as f64);
    let period = (domain.periodic[axis]).then(|| domain.bounds.size()[axis]);
    (0..count).map(move |number| {
        let (from, to) = (
            low + width * number as f64,
            low + width * (number + 1) as f64,
        );
        let is_first_or = |x: f64| number == 0 || x >= from;
        let is_last_or = |x: f64| number + 1 == count || x < to;
        let is_near = |x: f64| from - margin <= x && x <= to + margin;
        let is_listed = |x: f64| {
            is_near(x) || period.is_some_and(|period| is_near(x - period) || is_near(x + period))
        };
        let order: Vec<usize> = (0..positions.len())
            .filter(|&i| is_listed(positions[i][axis]))
            .collect();
        let is_inside = (order.iter())
            .map(|&i| {
                let x = positions[i][axis];
                is_first_or(x) && is_last_or(x)
            })
            .collect();
        Slab { order, is_inside }
    })
}
