//! Loops over all whole-number places of a box, of any dimension.

/// The places from `from` up to, and without, `to`; the last axis runs fastest, as the innermost of nested loops does. None where
/// an axis has none.
///
/// ```
/// use sphpack_neighbors::Odometer;
/// let places: Vec<[i64; 2]> = Odometer::new([0, 5], [2, 7]).collect();
/// assert_eq!(places, [[0, 5], [0, 6], [1, 5], [1, 6]]);
/// ```
#[derive(Debug, Clone)]
pub struct Odometer<const D: usize> {
    from: [i64; D],
    to: [i64; D],
    next: Option<[i64; D]>,
}

impl<const D: usize> Odometer<D> {
    /// Begins at `from`.
    #[inline]
    #[must_use]
    pub fn new(from: [i64; D], to: [i64; D]) -> Self {
        let is_empty = (0..D).any(|k| from[k] >= to[k]);
        Self {
            from,
            to,
            next: (!is_empty).then_some(from),
        }
    }
}

impl<const D: usize> Iterator for Odometer<D> {
    type Item = [i64; D];

    #[inline]
    fn next(&mut self) -> Option<[i64; D]> {
        let here = self.next?;
        let mut next = here;
        for k in (0..D).rev() {
            next[k] += 1;
            if next[k] < self.to[k] {
                self.next = Some(next);
                return Some(here);
            }
            next[k] = self.from[k];
        }
        self.next = None;
        Some(here)
    }
}

/// Place `number` of a grid of so many places along every axis, from zero on; here the first axis runs fastest, and places can be
/// taken in any order. A number past the last place comes round again.
///
/// ```
/// use sphpack_neighbors::place_of;
/// let places: Vec<[usize; 2]> = (0..4).map(|n| place_of(n, [2, 2])).collect();
/// assert_eq!(places, [[0, 0], [1, 0], [0, 1], [1, 1]]);
/// ```
#[inline]
pub fn place_of<const D: usize>(number: usize, count: [usize; D]) -> [usize; D] {
    let mut rest = number;
    count.map(|count| {
        let place = rest % count;
        rest /= count;
        place
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn places_are_those_of_nested_loops(
            from in prop::array::uniform3(-5..5_i64),
            size in prop::array::uniform3(-1..5_i64),
        ) {
            let to = std::array::from_fn(|k| from[k] + size[k]);
            let mut nested = Vec::new();
            for i in from[0]..to[0] {
                for j in from[1]..to[1] {
                    for k in from[2]..to[2] {
                        nested.push([i, j, k]);
                    }
                }
            }
            prop_assert_eq!(Odometer::new(from, to).collect::<Vec<_>>(), nested);
            let plane: Vec<[i64; 2]> = (from[0]..to[0])
                .flat_map(|i| (from[1]..to[1]).map(move |j| [i, j]))
                .collect();
            let [from, to] = [from, to].map(|[a, b, _]| [a, b]);
            prop_assert_eq!(Odometer::new(from, to).collect::<Vec<_>>(), plane);
        }

        #[test]
        fn numbers_of_places_run_along_the_first_axis(count in prop::array::uniform3(1..6_usize)) {
            let mut number = 0;
            for k in 0..count[2] {
                for j in 0..count[1] {
                    for i in 0..count[0] {
                        prop_assert_eq!(place_of(number, count), [i, j, k]);
                        number += 1;
                    }
                }
            }
            prop_assert_eq!(place_of(number, count), [0; 3]);
        }
    }
}
