//! The two particles that are nearest to each other, by distance and by size.

use rayon::prelude::*;
use sphpack_neighbors::{Domain, KdTree};

use crate::slabs::{self, Slab};

/// Which two particles are nearest to each other; periodic images count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosestPair<const D: usize> {
    /// The smallest distance, scene units; infinite where there is no other particle.
    pub distance: f64,
    /// The smallest distance over the mean of both particles' sizes, V^(1/D), of pairs nearer than half of that (or another part that
    /// was asked for); infinite where there is none.
    pub crowded: f64,
    /// Where one of the two of `crowded` is.
    pub place: [f64; D],
}

/// Nearest neighbours of many sizes are within so many of them.
pub const NEIGHBORS_IN_SIZES: f64 = 1.5;

/// Pairs nearer than this, in the mean of both sizes, are two particles in the room of one.
pub const CROWDED: f64 = 0.5;

impl<const D: usize> ClosestPair<D> {
    const NONE: Self = Self {
        distance: f64::INFINITY,
        crowded: f64::INFINITY,
        place: [f64::NAN; D],
    };

    fn with(self, other: Self) -> Self {
        let first = if other.crowded < self.crowded {
            other
        } else {
            self
        };
        Self {
            distance: self.distance.min(other.distance),
            ..first
        }
    }

    /// Of the particles for which `is_asked` holds, the others being neighbours only; with one volume per particle.
    /// `likely` (scene units) is more than the smallest distance can sensibly be. Not finite positions are refused with NaN.
    /// O(n log n), parallel; the same bits for any number of threads.
    pub fn of(
        domain: &Domain<D>,
        positions: &[[f64; D]],
        volumes: &[f64],
        is_asked: impl Fn(usize) -> bool + Sync,
        likely: f64,
    ) -> Self {
        let limits = (likely, CROWDED);
        Self::by_slabs(domain, positions, volumes, is_asked, limits, slabs::MOST)
    }

    /// [`ClosestPair::of`] where particles differ in size: `crowded` is the smallest distance in sizes of all pairs nearer
    /// than `sizes` of them.
    pub fn by_size(
        domain: &Domain<D>,
        positions: &[[f64; D]],
        volumes: &[f64],
        is_asked: impl Fn(usize) -> bool + Sync,
        likely: f64,
        sizes: f64,
    ) -> Self {
        let limits = (likely, sizes);
        Self::by_slabs(domain, positions, volumes, is_asked, limits, slabs::MOST)
    }

    fn by_slabs(
        domain: &Domain<D>,
        positions: &[[f64; D]],
        volumes: &[f64],
        is_asked: impl Fn(usize) -> bool + Sync,
        (likely, crowded): (f64, f64),
        most: usize,
    ) -> Self {
        let size = |volume: f64| volume.max(0.0).powf(1.0 / D as f64);
        let largest = volumes
            .iter()
            .fold(0.0, |most: f64, &volume| most.max(size(volume)));
        let margin = likely.max(crowded * largest);
        let mut closest = Self::NONE;
        for Slab { order, is_inside } in slabs::slabs(domain, positions, margin, most) {
            let near: Vec<[f64; D]> = order.iter().map(|&i| domain.wrap(positions[i])).collect();
            let sizes: Vec<f64> = order.iter().map(|&i| size(volumes[i])).collect();
            let is_asked = |k: usize| is_inside[k] && is_asked(order[k]);
            closest = closest.with(Self::among(
                domain, &near, &sizes, is_asked, margin, crowded,
            ));
        }
        if closest.distance <= likely {
            return closest;
        }
        let all: Vec<[f64; D]> = positions.iter().map(|&p| domain.wrap(p)).collect();
        let sizes: Vec<f64> = volumes.iter().map(|&volume| size(volume)).collect();
        Self::among(
            domain,
            &all,
            &sizes,
            is_asked,
            domain.bounds.diagonal(),
            crowded,
        )
    }

    /// All at once, of points in the box; across periodic sides within `reach` only.
    fn among(
        domain: &Domain<D>,
        points: &[[f64; D]],
        sizes: &[f64],
        is_asked: impl Fn(usize) -> bool + Sync,
        reach: f64,
        crowded: f64,
    ) -> Self {
        let Ok(tree) = KdTree::new(points) else {
            return Self {
                distance: f64::NAN,
                ..Self::NONE
            };
        };
        (0..points.len())
            .into_par_iter()
            .with_min_len(1024)
            .map(|i| {
                let mut pair = Self::NONE;
                // The larger of two finds the other: a small one would look through all that is small as far as the largest see.
                let sight = crowded * sizes[i];
                for (number, image) in domain.images(points[i], reach).enumerate() {
                    if is_asked(i) {
                        // The own image has itself first.
                        let nearest = match number {
                            0 => tree.nearest_n(image, 2).get(1).copied(),
                            _ => tree.nearest(image),
                        };
                        let Some(nearest) = nearest else { continue };
                        pair.distance = pair.distance.min(nearest.distance);
                        if nearest.distance > sight {
                            continue;
                        }
                    }
                    for found in tree.within(image, sight) {
                        let j = found.index;
                        let over = 2.0 * found.distance / (sizes[i] + sizes[j]);
                        let own = number == 0 && j == i;
                        if own || over >= crowded.min(pair.crowded) {
                            continue;
                        }
                        let asked = [i.min(j), i.max(j)].into_iter().find(|&k| is_asked(k));
                        if let Some(asked) = asked {
                            pair.crowded = over;
                            pair.place = points[asked];
                        }
                    }
                }
                pair
            })
            .collect_vec_list()
            .into_iter()
            .flatten()
            .fold(Self::NONE, Self::with)
    }
}

#[cfg(test)]
mod tests {
    use sphpack_neighbors::{Bounds, point};

    use super::*;
    use crate::Lattice;

    /// A shaken lattice with volumes of many sizes, on a torus or not, slab by slab: as all pairs say.
    #[test]
    fn agrees_with_all_pairs() {
        let bounds = Bounds::new([0.0; 3], [14.0, 9.0, 9.0]);
        let mut positions = Lattice::Bcc.fill(bounds, 1.0).sites();
        for (i, p) in positions.iter_mut().enumerate() {
            p[0] = (p[0] + 0.2 * (i as f64).sin()).clamp(0.0, 14.0);
            p[1] += 0.1 * (3.0 * i as f64).sin();
        }
        // Two that are near each other across a side only, and two large ones that are nearest for their size in the box.
        positions[0] = [0.1, 4.0, 0.05];
        positions[5] = [0.1, 4.0, 8.7];
        positions[103] = [7.0, 4.0, 4.0];
        positions[203] = [7.8, 4.0, 4.0];
        let volumes: Vec<f64> = (0..positions.len())
            .map(|i| {
                if i % 100 == 3 {
                    8.0
                } else {
                    1.0 + 0.1 * (i as f64).cos()
                }
            })
            .collect();
        let is_asked = |i: usize| !i.is_multiple_of(7);
        for periodic in [true, false] {
            let domain = Domain {
                bounds,
                periodic: [periodic; 3],
            };
            let size = |i: usize| volumes[i].cbrt();
            let pairs = || {
                (0..positions.len())
                    .filter(|&i| is_asked(i))
                    .flat_map(|i| (0..positions.len()).map(move |j| (i, j)))
                    .filter(|(i, j)| i != j)
                    .map(|(i, j)| {
                        (
                            point::norm(domain.difference(positions[i], positions[j])),
                            size(i) + size(j),
                        )
                    })
            };
            let nearest = pairs().map(|(r, _)| r).fold(f64::INFINITY, f64::min);
            let crowded = pairs()
                .map(|(r, sizes)| 2.0 * r / sizes)
                .fold(f64::INFINITY, f64::min);
            assert!(crowded < CROWDED);
            for most in [usize::MAX, 300] {
                let found = ClosestPair::by_slabs(
                    &domain,
                    &positions,
                    &volumes,
                    is_asked,
                    (2.0, CROWDED),
                    most,
                );
                assert!(
                    (found.distance - nearest).abs() < 1e-14,
                    "{found:?} {nearest}"
                );
                assert!(
                    (found.crowded - crowded).abs() < 1e-14,
                    "{found:?} {crowded}"
                );
            }
        }
    }
}
