//! The second pass of a levelling evaluation: the gradient of a field that targets carry.

use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use sphpack_kernels::{Kernel, Profile, SMALLEST_Q, WithKernel};
use sphpack_neighbors::{Block, CellList, LANES, Slot};

use super::{Constants, Walk};
use crate::repulsion::Repulsion;

/// Σ_j w_j ∇_iW_ij over the targets j near every target i, with the weights w of the slots; sources that are no
/// targets are left out. To be called like [`super::PairLoop`].
pub(crate) struct GradientLoop<'a, const D: usize> {
    pub(crate) list: &'a CellList<D>,
    pub(crate) slots: &'a [Slot],
    /// What the positions were multiplied by.
    pub(crate) unit: f64,
    /// The instructions to use.
    pub(crate) level: Level,
    /// One entry per target slot.
    pub(crate) out: &'a mut [[f64; D]],
}

impl<const D: usize> WithKernel<D> for GradientLoop<'_, D> {
    type Output = ();

    fn call<K: Kernel<D>>(self, kernel: K) {
        let level = self.level;
        let h = kernel.smoothing_length();
        let unit = self.unit;
        let constants = Constants {
            smallest: SMALLEST_Q * SMALLEST_Q * h * h,
            inverse: 1.0 / h,
            value_scale: 0.0,
            slope_scale: kernel.scale() / h * K::Profile::SLOPE * unit.powi(D as i32 + 1),
            repulsion: Repulsion::new(h / unit, 0.0).in_unit(unit),
        };
        let slots = self.slots;
        self.list.for_each_block(self.out, |block, out| {
            dispatch!(level, simd => block_gradients::<_, K::Profile, D>(simd, &constants, slots, block, out));
        });
    }
}

// Plain loops, as in the first pass.
#[inline(always)]
fn block_gradients<S: Simd, P: Profile<D>, const D: usize>(
    simd: S,
    constants: &Constants,
    slots: &[Slot],
    block: Block<'_>,
    out: &mut [[f64; D]],
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let mut walk = Walk::new(simd, constants, slots, &block);
            for group in block.full(0, true) {
                walk.add::<P, 0>(walk.full(group));
            }
            for group in block.full(1, true) {
                walk.add::<P, 0>(walk.full(group));
            }
            for group in block.full(2, true) {
                walk.add::<P, 1>(walk.full(group));
            }
            for group in block.full(3, true) {
                walk.add::<P, 2>(walk.full(group));
            }
            for group in block.split(true) {
                walk.add::<P, 2>(walk.split(group));
            }
            let scale = f64x8::splat(simd, constants.slope_scale);
            let mut gradient = [[0.0; LANES]; D];
            for k in 0..D {
                gradient[k] = (scale * walk.gradient[k]).into();
            }
            for (lane, out) in out.iter_mut().enumerate() {
                *out = std::array::from_fn(|k| gradient[k][lane]);
            }
        },
    );
}
