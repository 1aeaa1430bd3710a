//! Sums over a list in one call.

use fearless_simd::Level;
use sphpack_kernels::Kernel;
use sphpack_neighbors::CellList;

use crate::gathered::Gathered;
use crate::term::Term;
use crate::walk::walk;

/// What particles have: a position and a weight each, a kernel, and whatever a term reads.
#[derive(Debug, Clone, Copy)]
pub struct Fields<'a, K, const D: usize> {
    kernel: K,
    positions: &'a [[f64; D]],
    weights: &'a [f64],
    smoothing_lengths: Option<&'a [f64]>,
    more: &'a [&'a [f64]],
}

impl<'a, K: Kernel<D>, const D: usize> Fields<'a, K, D> {
    /// Particles of one smoothing length, the kernel's (scene units). Weights are usually their volumes, or their masses.
    pub fn new(kernel: K, positions: &'a [[f64; D]], weights: &'a [f64]) -> Self {
        Self {
            kernel,
            positions,
            weights,
            smoothing_lengths: None,
            more: &[],
        }
    }

    /// Particles that have each their own smoothing length, of the same kernel. Their list must be made by
    /// [`CellList::update_each`] with [`Kernel::support`] over the smoothing length times these, or more.
    #[must_use]
    pub fn with_smoothing_lengths(self, smoothing_lengths: &'a [f64]) -> Self {
        Self {
            smoothing_lengths: Some(smoothing_lengths),
            ..self
        }
    }

    /// Fields of one number per particle, which a term reads by their numbers.
    #[must_use]
    pub fn with_more(self, more: &'a [&'a [f64]]) -> Self {
        Self { more, ..self }
    }
}

/// Sums over the pairs of a list.
#[derive(Debug, Clone, Copy)]
pub struct Pairs<'a, const D: usize> {
    list: &'a CellList<D>,
    level: Level,
}

impl<'a, const D: usize> Pairs<'a, D> {
    /// Over a list that is up to date. A list with [`crate::shells`] is faster for kernels in pieces; without them all is
    /// right.
    pub fn new(list: &'a CellList<D>) -> Self {
        Self {
            list,
            level: Level::new(),
        }
    }

    /// With these vector instructions, which the machine must have.
    #[must_use]
    pub fn with_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The sums of every particle, in their order; the default for those that are no targets. Allocates; for sums over and
    /// over again there are [`Gathered`] and [`crate::walk`].
    ///
    /// # Panics
    /// Where a field is shorter than the set that the list was made of.
    pub fn sum<T: Term, K: Kernel<D>>(&self, term: &T, fields: &Fields<'_, K, D>) -> Vec<T::Sum> {
        let mut gathered = Gathered::default();
        match fields.smoothing_lengths {
            None => gathered.gather(
                self.list,
                fields.positions,
                fields.weights,
                fields.kernel.smoothing_length(),
            ),
            Some(each) => gathered.gather_each(self.list, fields.positions, fields.weights, each),
        }
        gathered.add_fields(self.list, fields.more);
        let mut by_slot = vec![T::Sum::default(); self.list.targets()];
        let blocks = self.list.blocks();
        walk(
            self.level,
            fields.kernel,
            term,
            blocks,
            &gathered,
            &mut by_slot,
        );
        let mut sums = vec![T::Sum::default(); fields.positions.len()];
        for (&i, sum) in self.list.target_particles().iter().zip(by_slot) {
            sums[i as usize] = sum;
        }
        sums
    }
}
