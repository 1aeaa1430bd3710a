//! How what was summed up changes when particles move.

use std::time::Instant;

use sphpack_pairs::VariationSum;

use super::{Forces, first, sums_of};

impl<const D: usize> Forces<D> {
    /// Sums up a [`Variation`](sphpack_pairs::Variation) where the particles of the last evaluation are, of these columns:
    /// a number and the D coordinates of a vector for every particle. Particles have one size, and no levelling.
    pub(crate) fn vary(&mut self, columns: &[Vec<f64>]) {
        let start = Instant::now();
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        self.gathered.add_fields(&self.list, &columns);
        self.variation
            .resize(self.list.targets(), VariationSum::default());
        let pairs = sums_of(
            self.shape,
            self.smoothing_length,
            &self.list,
            &self.gathered,
            self.level,
        );
        pairs.vary::<D>(&mut self.variation);
        self.force_seconds += start.elapsed().as_secs_f64();
    }

    /// What [`Forces::vary`] found for particle `i`: of the density, and of the kernel gradient sum. Zero for those that
    /// are no targets.
    #[inline]
    pub(crate) fn variation(&self, i: usize) -> (f64, [f64; D]) {
        (self.list.slot_of(i)).map_or((0.0, [0.0; D]), |slot| {
            let VariationSum { density, gradient } = self.variation[slot];
            (density, first(gradient))
        })
    }
}
