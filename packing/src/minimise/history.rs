//! What L-BFGS remembers, and the direction that it makes of it.

use std::collections::VecDeque;
use std::io::{self, Write};

use rayon::prelude::*;

use crate::state::{Damaged, State, Value, load_as_many, put_list};

/// The most pairs that can be remembered.
pub(super) const MOST_PAIRS: usize = 16;

/// Entries per task, and the fixed block of a sum.
const BLOCK: usize = 4096;

/// Rows of products: with the newest step, with the newest change of the gradient, with the force.
const ROWS: usize = 3;

/// A pair teaches nothing where step · change is below this part of |step| |change|.
const FLAT: f64 = 1e-8;

/// How one step changed the gradient. In single precision: the pairs are read twice per step and most of what a
/// minimiser reads at all, and a direction needs no more digits.
#[derive(Debug, Clone, Default)]
struct Pair<const D: usize> {
    step: Vec<[f32; D]>,
    change: Vec<[f32; D]>,
}

/// Pairs of steps and gradient changes, and the scalar products between them and with the force. All products that one
/// step of the two-loop recursion (Nocedal & Wright, Numerical Optimization, algorithm 7.4) asks for are known before
/// it begins, so it is a calculation with small numbers, and long vectors are passed over twice per step: once for the
/// products, once for their combination (Chen, Wang, Zhou: "Large-scale L-BFGS using MapReduce", NIPS 2014).
#[derive(Debug, Clone)]
pub(super) struct History<const D: usize> {
    pairs: Vec<Pair<D>>,
    /// Places in `pairs`, the oldest first.
    order: VecDeque<usize>,
    /// Products of the vectors: pair p has its step at 2p, its change at 2p + 1.
    products: Vec<[f64; 2 * MOST_PAIRS]>,
    /// Products with the force.
    with_force: [f64; 2 * MOST_PAIRS],
}

impl<const D: usize> Default for History<D> {
    fn default() -> Self {
        Self {
            pairs: Vec::new(),
            order: VecDeque::new(),
            products: vec![[0.0; 2 * MOST_PAIRS]; 2 * MOST_PAIRS],
            with_force: [0.0; 2 * MOST_PAIRS],
        }
    }
}

/// From which place to which, and the force before and after.
#[derive(Clone, Copy)]
pub(super) struct Taken<'a, const D: usize> {
    pub(super) from: &'a [[f64; D]],
    pub(super) to: &'a [[f64; D]],
    pub(super) force_before: &'a [[f64; D]],
    pub(super) force: &'a [[f64; D]],
}

impl<const D: usize> History<D> {
    pub(super) fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    pub(super) fn clear(&mut self) {
        self.order.clear();
    }

    /// Appends the pairs that are remembered, the oldest first, and all products.
    pub(super) fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.order.len().save(out)?;
        for &slot in &self.order {
            let Pair { step, change } = &self.pairs[slot];
            slot.save(out)?;
            step.save(out)?;
            change.save(out)?;
        }
        put_list(&self.products, out)?;
        self.with_force.save(out)
    }

    /// What was saved, of vectors of `count` entries.
    pub(super) fn load(&mut self, from: &mut &[u8], count: usize) -> Result<(), Damaged> {
        self.order.clear();
        for _ in 0..usize::take(from)? {
            let slot = usize::take(from)?;
            let (step, change) = <(Vec<_>, Vec<_>)>::take(from)?;
            let is_sound = slot < MOST_PAIRS
                && !self.order.contains(&slot)
                && [step.len(), change.len()] == [count; 2];
            if !is_sound {
                return Err(Damaged);
            }
            if slot >= self.pairs.len() {
                self.pairs.resize_with(slot + 1, Pair::default);
            }
            self.pairs[slot] = Pair { step, change };
            self.order.push_back(slot);
        }
        load_as_many(&mut self.products, from)?;
        self.with_force.load(from)
    }

    /// Remembers a step, unless it teaches nothing; of more than `memory` pairs the oldest is forgotten.
    pub(super) fn remember(&mut self, taken: Taken<'_, D>, memory: usize) {
        let slot = if self.order.len() >= memory.clamp(1, MOST_PAIRS) {
            self.order.pop_front().unwrap_or(0)
        } else {
            (0..MOST_PAIRS)
                .find(|slot| !self.order.contains(slot))
                .unwrap_or(0)
        };
        if slot >= self.pairs.len() {
            self.pairs.resize_with(slot + 1, Pair::default);
        }
        let Pair { step, change } = &mut self.pairs[slot];
        let difference = |out: &mut Vec<[f32; D]>, a: &[[f64; D]], b: &[[f64; D]]| {
            out.resize(a.len(), [0.0; D]);
            (out.par_iter_mut().zip(a).zip(b).with_min_len(BLOCK)).for_each(|((out, a), b)| {
                *out = std::array::from_fn(|k| (a[k] - b[k]) as f32);
            });
        };
        difference(step, taken.to, taken.from);
        difference(change, taken.force_before, taken.force);
        self.order.push_back(slot);
        let rows = self.rows(slot, taken.force);
        let (s, y) = (2 * slot, 2 * slot + 1);
        for (place, &other) in self.order.iter().enumerate() {
            for part in 0..2 {
                let row = rows[2 * place + part];
                for (own, product) in [s, y].into_iter().zip(row) {
                    self.products[own][2 * other + part] = product;
                    self.products[2 * other + part][own] = product;
                }
                self.with_force[2 * other + part] = row[2];
            }
        }
        let size = (self.products[s][s] * self.products[y][y]).sqrt();
        if self.products[s][y].is_nan() || self.products[s][y] <= FLAT * size {
            self.order.pop_back();
        }
    }

    /// The products of every vector, in the order of the pairs, with the step and the change at `slot` and the force.
    fn rows(&self, slot: usize, force: &[[f64; D]]) -> Vec<[f64; ROWS]> {
        let newest = &self.pairs[slot];
        let of_block = |block: usize| -> Vec<[f64; ROWS]> {
            let range = block * BLOCK..((block + 1) * BLOCK).min(force.len());
            let (step, change) = (&newest.step[range.clone()], &newest.change[range.clone()]);
            let force = &force[range.clone()];
            let mut rows = Vec::with_capacity(2 * self.order.len());
            for &other in &self.order {
                let Pair { step: s, change: y } = &self.pairs[other];
                for vector in [&s[range.clone()], &y[range.clone()]] {
                    // A sum for every axis: chains of additions that do not wait for each other.
                    let mut row = [[0.0; D]; ROWS];
                    for (((v, s), y), f) in vector.iter().zip(step).zip(change).zip(force) {
                        for k in 0..D {
                            let v = f64::from(v[k]);
                            row[0][k] += v * f64::from(s[k]);
                            row[1][k] += v * f64::from(y[k]);
                            row[2][k] += v * f[k];
                        }
                    }
                    rows.push(row.map(|axes| axes.iter().sum()));
                }
            }
            rows
        };
        let blocks: Vec<Vec<[f64; ROWS]>> = (0..force.len().div_ceil(BLOCK))
            .into_par_iter()
            .map(of_block)
            .collect();
        // One block after the other: the same bits for any number of threads.
        let mut sum = vec![[0.0; ROWS]; 2 * self.order.len()];
        for block in blocks {
            for (sum, row) in sum.iter_mut().zip(block) {
                for (sum, row) in sum.iter_mut().zip(row) {
                    *sum += row;
                }
            }
        }
        sum
    }

    /// Writes the inverse Hessian as remembered, times the force that came with the last pair; `first` is what stands
    /// for it while nothing is known.
    pub(super) fn direction(&self, force: &[[f64; D]], first: f64, out: &mut Vec<[f64; D]>) {
        let (weights, of_force) = self.weights(first);
        let vectors: Vec<(&[[f32; D]], f64)> = (self.order.iter())
            .flat_map(|&p| {
                let Pair { step, change } = &self.pairs[p];
                [
                    (&step[..], weights[2 * p]),
                    (&change[..], weights[2 * p + 1]),
                ]
            })
            .collect();
        out.resize(force.len(), [0.0; D]);
        out.par_chunks_mut(BLOCK)
            .enumerate()
            .for_each(|(block, out)| {
                let range = block * BLOCK..block * BLOCK + out.len();
                for (out, f) in out.iter_mut().zip(&force[range.clone()]) {
                    *out = f.map(|f| of_force * f);
                }
                for &(vector, weight) in &vectors {
                    for (out, v) in out.iter_mut().zip(&vector[range.clone()]) {
                        for k in 0..D {
                            out[k] += weight * f64::from(v[k]);
                        }
                    }
                }
            });
    }

    /// The two-loop recursion on coefficients: those of the vectors, and of the force.
    fn weights(&self, first: f64) -> ([f64; 2 * MOST_PAIRS], f64) {
        let mut weights = [0.0; 2 * MOST_PAIRS];
        let mut of_force = 1.0;
        let product = |vector: usize, weights: &[f64; 2 * MOST_PAIRS], of_force: f64| -> f64 {
            let others = self.order.iter().flat_map(|&p| [2 * p, 2 * p + 1]);
            of_force * self.with_force[vector]
                + others
                    .map(|other| weights[other] * self.products[vector][other])
                    .sum::<f64>()
        };
        let mut back = [0.0; MOST_PAIRS];
        for &p in self.order.iter().rev() {
            let (s, y) = (2 * p, 2 * p + 1);
            back[p] = product(s, &weights, of_force) / self.products[s][y];
            weights[y] -= back[p];
        }
        let scale = match self.order.back() {
            Some(&p) => self.products[2 * p][2 * p + 1] / self.products[2 * p + 1][2 * p + 1],
            None => first,
        };
        for weight in &mut weights {
            *weight *= scale;
        }
        of_force *= scale;
        for &p in &self.order {
            let (s, y) = (2 * p, 2 * p + 1);
            let again = product(y, &weights, of_force) / self.products[s][y];
            weights[s] += back[p] - again;
        }
        (weights, of_force)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use sphpack_neighbors::point;

    use super::*;

    /// Degrees of freedom of the dense update.
    const N: usize = 6;

    /// Entries of the long vectors, and those that are not zero: in two blocks.
    const LENGTH: usize = BLOCK + 1000;
    const PLACES: [usize; 2] = [10, BLOCK + 500];

    type Dense = [f64; N];

    fn dense_dot(a: &Dense, b: &Dense) -> f64 {
        (0..N).map(|i| a[i] * b[i]).sum()
    }

    /// A long vector with these entries in [`PLACES`].
    fn long(dense: &Dense) -> Vec<[f64; 3]> {
        let mut out = vec![[0.0; 3]; LENGTH];
        for (i, value) in dense.iter().enumerate() {
            out[PLACES[i / 3]][i % 3] = *value;
        }
        out
    }

    /// The inverse Hessian by the BFGS formula (Nocedal & Wright, eq. 6.17), times a vector. It begins as
    /// s·y/(y·y) times one, of the newest pair (eq. 7.20).
    fn dense_direction(pairs: &[(Dense, Dense)], force: &Dense) -> Dense {
        let (s, y) = &pairs[pairs.len() - 1];
        let scale = dense_dot(s, y) / dense_dot(y, y);
        let mut inverse = [[0.0; N]; N];
        for (i, row) in inverse.iter_mut().enumerate() {
            row[i] = scale;
        }
        for (s, y) in pairs {
            let rho = 1.0 / dense_dot(s, y);
            // 1 − ρ s yᵀ
            let left = |i: usize, j: usize| f64::from(u8::from(i == j)) - rho * s[i] * y[j];
            let mut updated = [[0.0; N]; N];
            for i in 0..N {
                for j in 0..N {
                    updated[i][j] = rho * s[i] * s[j];
                    for k in 0..N {
                        for l in 0..N {
                            updated[i][j] += left(i, k) * inverse[k][l] * left(j, l);
                        }
                    }
                }
            }
            inverse = updated;
        }
        inverse.map(|row| dense_dot(&row, force))
    }

    /// Remembers pairs of steps and changes; the newest comes with this force.
    fn remembered(pairs: &[(Dense, Dense)], force: &Dense, memory: usize) -> History<3> {
        let mut history = History::<3>::default();
        for (n, (step, change)) in pairs.iter().enumerate() {
            let is_newest = n + 1 == pairs.len();
            let after = if is_newest { *force } else { [0.5; N] };
            let before: Dense = std::array::from_fn(|i| after[i] + change[i]);
            let taken = Taken {
                from: &long(&[0.0; N]),
                to: &long(step),
                force_before: &long(&before),
                force: &long(&after),
            };
            history.remember(taken, memory);
        }
        history
    }

    fn check(history: &History<3>, force: &Dense, expected: &Dense) -> Result<(), TestCaseError> {
        let mut direction = Vec::new();
        // What stands for the Hessian while nothing is known is not asked for.
        history.direction(&long(force), f64::NAN, &mut direction);
        let size = dense_dot(expected, expected).sqrt();
        for (found, expected) in direction.iter().zip(long(expected)) {
            let off = point::distance(*found, expected);
            prop_assert!(off < 1e-9 * size, "{found:?}, not {expected:?}");
        }
        Ok(())
    }

    /// Numbers that single precision holds exactly, so that nothing is rounded where pairs are kept.
    fn short_number() -> impl Strategy<Value = f64> {
        (-512..=512_i32).prop_map(|n| f64::from(n) / 256.0)
    }

    fn dense() -> impl Strategy<Value = Dense> {
        proptest::array::uniform6(short_number())
    }

    /// A pair that curves upward by no less than a fifth of what it could, so that dense sums keep their digits.
    fn pair() -> impl Strategy<Value = (Dense, Dense)> {
        (dense(), dense()).prop_filter_map("it is flat", |(s, mut y)| {
            if dense_dot(&s, &y) < 0.0 {
                y = y.map(|y| -y);
            }
            let size = (dense_dot(&s, &s) * dense_dot(&y, &y)).sqrt();
            (dense_dot(&s, &y) > 0.2 * size.max(1.0)).then_some((s, y))
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn the_direction_is_that_of_a_dense_update(
            pairs in proptest::collection::vec(pair(), 1..8),
            force in dense(),
            memory in 1..6_usize,
        ) {
            prop_assume!(dense_dot(&force, &force) > 0.1);
            let history = remembered(&pairs, &force, memory);
            let kept = &pairs[pairs.len().saturating_sub(memory)..];
            check(&history, &force, &dense_direction(kept, &force))?;
        }

        /// H y = s for the newest pair.
        #[test]
        fn the_newest_change_comes_from_the_newest_step(
            pairs in proptest::collection::vec(pair(), 1..8),
            memory in 1..6_usize,
        ) {
            let (step, change) = pairs[pairs.len() - 1];
            check(&remembered(&pairs, &change, memory), &change, &step)?;
        }

        /// A pair of negative curvature leaves the others as they are, with the force that came with it.
        #[test]
        fn what_teaches_nothing_is_not_remembered(
            pairs in proptest::collection::vec(pair(), 1..4),
            flat in pair(),
            force in dense(),
        ) {
            prop_assume!(dense_dot(&force, &force) > 0.1);
            let mut with = pairs.clone();
            with.push((flat.0, flat.1.map(|y| -y)));
            let history = remembered(&with, &force, 8);
            check(&history, &force, &dense_direction(&pairs, &force))?;
        }
    }

    /// Before anything is known the direction is the force, scaled as the caller says.
    #[test]
    fn without_pairs_the_direction_is_the_force() {
        let mut direction = Vec::new();
        let force = [[1.0, -2.0, 0.5], [0.0, 4.0, 1.0]];
        History::<3>::default().direction(&force, 0.25, &mut direction);
        assert_eq!(direction, force.map(|f| f.map(|f| 0.25 * f)));
    }

    /// With exact searches along lines, six steps find the bottom of a quadratic bowl of six dimensions.
    #[test]
    fn a_bowl_has_its_bottom_found() {
        let stiffness = |i: usize, k: usize| 1.0 + (i * 3 + k) as f64 * 0.37;
        let force_at = |x: &[[f64; 3]]| -> Vec<[f64; 3]> {
            (x.iter().enumerate())
                .map(|(i, x)| std::array::from_fn(|k| -stiffness(i, k) * x[k]))
                .collect()
        };
        let mut history = History::<3>::default();
        let mut x = vec![[1.0, -2.0, 0.5], [0.3, 0.7, -1.1]];
        let mut direction = Vec::new();
        for round in 0..7 {
            let force = force_at(&x);
            history.direction(&force, 0.1, &mut direction);
            let slope: f64 = (0..2).map(|i| point::dot(direction[i], force[i])).sum();
            assert!(slope > 0.0, "{round}");
            // The exact minimum along the direction.
            let bend: f64 = (0..2)
                .flat_map(|i| (0..3).map(move |k| (i, k)))
                .map(|(i, k)| stiffness(i, k) * direction[i][k] * direction[i][k])
                .sum();
            let to: Vec<[f64; 3]> = (x.iter().zip(&direction))
                .map(|(x, d)| point::add_scaled(*x, slope / bend, *d))
                .collect();
            let after = force_at(&to);
            let taken = Taken {
                from: &x,
                to: &to,
                force_before: &force,
                force: &after,
            };
            history.remember(taken, 8);
            x = to;
        }
        let left = x.iter().map(|x| point::norm(*x)).fold(0.0, f64::max);
        assert!(left < 1e-5, "{left}");
    }
}
