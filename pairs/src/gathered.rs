//! Positions, weights and sizes in the order of a list's slots.

use sphpack_neighbors::{CellList, Slot};

/// The sources of a sum as its loop reads them: kept between sums, so that nothing is allocated again.
#[derive(Debug, Clone, Default)]
pub struct Gathered {
    pub(crate) slots: Vec<Slot>,
    /// What the positions were multiplied by.
    pub(crate) unit: f64,
    /// h of every source, in the unit, and 1/h; empty where all have one.
    pub(crate) sizes: Vec<[f64; 2]>,
    /// More fields, `stride` numbers for every slot.
    pub(crate) more: Vec<f64>,
    pub(crate) stride: usize,
}

/// The unit of the pair loop's lengths, in which h, or the least of many, is between 1 and 2: single precision can hold every
/// squared distance there. A power of two, so that no position is rounded.
pub fn unit(smoothing_length: f64) -> f64 {
    (-smoothing_length.log2().floor()).exp2()
}

impl Gathered {
    /// Positions and weights, one per particle, for one h of all (scene units). O(n), parallel.
    pub fn gather<const D: usize>(
        &mut self,
        list: &CellList<D>,
        positions: &[[f64; D]],
        weights: &[f64],
        smoothing_length: f64,
    ) {
        self.unit = unit(smoothing_length);
        list.gather(positions, weights, self.unit, &mut self.slots);
        self.sizes.clear();
        self.stride = 0;
    }

    /// [`Gathered::gather`] where every particle has its own h.
    pub fn gather_each<const D: usize>(
        &mut self,
        list: &CellList<D>,
        positions: &[[f64; D]],
        weights: &[f64],
        smoothing_lengths: &[f64],
    ) {
        let least = (smoothing_lengths.iter().copied()).fold(f64::INFINITY, f64::min);
        let unit = unit(least);
        self.unit = unit;
        list.gather(positions, weights, unit, &mut self.slots);
        let size = |i: usize, _| {
            let h = smoothing_lengths[i] * unit;
            [h, 1.0 / h]
        };
        list.gather_with(size, [1.0; 2], &mut self.sizes);
        self.stride = 0;
    }

    /// Other weights for what is gathered already, one per particle.
    pub fn weigh<const D: usize>(&mut self, list: &CellList<D>, weights: &[f64]) {
        list.weigh(weights, &mut self.slots);
    }

    /// Room for `stride` fields of every slot, the padding slot's last, which must be zero: for whoever keeps the slots' particles
    /// ([`CellList::sources`]) and fills it in parallel. What was written before is still there where the size is the same.
    pub fn fields_mut(&mut self, stride: usize) -> &mut [f64] {
        self.stride = stride;
        self.more.resize(stride * self.slots.len(), 0.0);
        &mut self.more
    }

    /// More fields, each with one number per particle; images have their particle's.
    ///
    /// # Panics
    /// Where a field is shorter than the set.
    pub fn add_fields<const D: usize>(&mut self, list: &CellList<D>, fields: &[&[f64]]) {
        self.stride = fields.len();
        self.more.clear();
        for (i, _) in list.sources() {
            self.more.extend(fields.iter().map(|field| field[i]));
        }
        self.more.extend(fields.iter().map(|_| 0.0));
    }
}
