//! The pair loop: density, its gradient and the repulsion, eight particles at a time against shared candidates.

use fearless_simd::{Level, Simd, dispatch, f64x4, f64x8, prelude::*};
use sphpack_kernels::{Kernel, Profile, SMALLEST_Q, WithKernel};
use sphpack_neighbors::{Block, CellList, GROUP, LANES, SHELLS, Slot};

use crate::repulsion::{Coefficients, Repulsion};

mod gradients;
mod lanes;
#[cfg(test)]
mod tests;

pub(crate) use gradients::GradientLoop;
use lanes::{Several, roots};

/// The sums of one particle over its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sums<const D: usize> {
    /// Γ_i = Σ_j V_j W_ij, the particle itself included.
    pub(crate) gamma: f64,
    /// Γ's part from sources that are no targets.
    pub(crate) gamma_of_others: f64,
    /// Σ_j V_j ∇_iW_ij.
    pub(crate) gradient: [f64; D],
    /// Acceleration by repulsion.
    pub(crate) repulsion: [f64; D],
    /// Repulsive energy: half of every pair with a target, the whole of every pair with another source.
    pub(crate) repulsion_energy: f64,
}

impl<const D: usize> Sums<D> {
    pub(crate) const ZERO: Self = Self {
        gamma: 0.0,
        gamma_of_others: 0.0,
        gradient: [0.0; D],
        repulsion: [0.0; D],
        repulsion_energy: 0.0,
    };
}

/// The unit of the pair loop's lengths, in which h is between 1 and 2: single precision can hold every squared distance
/// there. A power of two, so that no position is rounded.
pub(crate) fn unit(smoothing_length: f64) -> f64 {
    (-smoothing_length.log2().floor()).exp2()
}

/// In parts of h, a distance that is not near zero.
const APART: f64 = 1e-3;

/// The radii of the list's shells for a kernel: where the repulsion ends, where its second and third piece begin.
pub(crate) struct Shells {
    pub(crate) reach: f64,
}

impl<const D: usize> WithKernel<D> for Shells {
    type Output = [f64; SHELLS - 1];

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        let [_, second, third] = K::Profile::STARTS.map(|q| q * kernel.smoothing_length());
        // Beyond the first shell nothing repels; beyond the second no distance is near zero, where the roots fail.
        let second = second
            .max(self.reach)
            .max(APART * kernel.smoothing_length());
        [self.reach, second, third.max(second)]
    }
}

/// Runs the pair loop over all targets of `list`; to be called through [`sphpack_kernels::KernelKind::with`], in the
/// unit of the slots.
pub(crate) struct PairLoop<'a, const D: usize> {
    pub(crate) list: &'a CellList<D>,
    pub(crate) slots: &'a [Slot],
    /// What the positions were multiplied by.
    pub(crate) unit: f64,
    pub(crate) repulsion: Repulsion,
    /// The instructions to use.
    pub(crate) level: Level,
    /// One entry per target slot.
    pub(crate) out: &'a mut [Sums<D>],
}

impl<const D: usize> WithKernel<D> for PairLoop<'_, D> {
    type Output = ();

    fn call<K: Kernel<D>>(self, kernel: K) {
        let level = self.level;
        let h = kernel.smoothing_length();
        let unit = self.unit;
        let constants = Constants {
            smallest: SMALLEST_Q * SMALLEST_Q * h * h,
            inverse: 1.0 / h,
            value_scale: kernel.scale() * unit.powi(D as i32),
            slope_scale: kernel.scale() / h * K::Profile::SLOPE * unit.powi(D as i32 + 1),
            repulsion: self.repulsion.in_unit(unit),
        };
        let slots = self.slots;
        self.list.for_each_block(self.out, |block, out| {
            dispatch!(level, simd => block_sums::<_, K::Profile, D>(simd, &constants, slots, block, out));
        });
    }
}

/// What the loop needs to know about the kernel and the repulsion, in its unit of length.
struct Constants {
    /// Squared distances below this are taken at this.
    smallest: f64,
    /// 1/h.
    inverse: f64,
    /// From Σ w to Γ.
    value_scale: f64,
    /// From Σ w'/SLOPE to ∇Γ.
    slope_scale: f64,
    repulsion: Coefficients,
}

// A closure that does vector arithmetic must be inlined by force, or the vector instructions cannot be inlined into
// it: so plain loops here, no `from_fn` or `map` over vectors.
#[inline(always)]
fn block_sums<S: Simd, P: Profile<D>, const D: usize>(
    simd: S,
    constants: &Constants,
    slots: &[Slot],
    block: Block<'_>,
    out: &mut [Sums<D>],
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let mut walk = Walk::new(simd, constants, slots, &block);
            let mut of_targets = f64x8::splat(simd, 0.0);
            for are_targets in [true, false] {
                for group in block.full(0, are_targets) {
                    let near = walk.add::<P, 0>(walk.full(group));
                    walk.repel(&near, if are_targets { 0.5 } else { 1.0 });
                }
                for group in block.full(1, are_targets) {
                    walk.add::<P, 0>(walk.full(group));
                }
                for group in block.full(2, are_targets) {
                    walk.add::<P, 1>(walk.full(group));
                }
                for group in block.full(3, are_targets) {
                    walk.add::<P, 2>(walk.full(group));
                }
                for group in block.split(are_targets) {
                    walk.add::<P, 2>(walk.split(group));
                }
                if are_targets {
                    of_targets = walk.gamma;
                }
            }
            walk.finish(of_targets, out);
        },
    );
}

/// A block on its walk through its candidates.
struct Walk<'a, S: Simd, const D: usize> {
    simd: S,
    constants: &'a Constants,
    slots: &'a [Slot],
    /// Coordinates of the targets.
    x: [f64x8<S>; D],
    gamma: f64x8<S>,
    gradient: [f64x8<S>; D],
    repulsion: [f64x8<S>; D],
    repulsion_energy: f64x8<S>,
}

/// A group of candidates.
struct Sources<S: Simd, const D: usize> {
    at: [[f64x8<S>; D]; GROUP],
    weight: [f64x8<S>; GROUP],
}

/// How far a group is from the targets.
struct Near<S: Simd, const D: usize> {
    apart: [[f64x8<S>; D]; GROUP],
    square: [f64x8<S>; GROUP],
    /// 1/r.
    inverse: Several<S>,
}

impl<'a, S: Simd, const D: usize> Walk<'a, S, D> {
    /// A walk that has not begun. Lanes beyond a short block repeat its last particle and are dropped at the end.
    #[inline(always)]
    fn new(simd: S, constants: &'a Constants, slots: &'a [Slot], block: &Block<'_>) -> Self {
        let last = block.len - 1;
        let zero = f64x8::splat(simd, 0.0);
        let mut x = [zero; D];
        for k in 0..D {
            let lanes: [f64; LANES] =
                std::array::from_fn(|lane| slots[block.first_slot + lane.min(last)][k]);
            x[k] = lanes.simd_into(simd);
        }
        Self {
            simd,
            constants,
            slots,
            x,
            gamma: zero,
            gradient: [zero; D],
            repulsion: [zero; D],
            repulsion_energy: zero,
        }
    }

    /// Candidates for all targets.
    #[inline(always)]
    fn full(&self, group: &[u32; GROUP]) -> Sources<S, D> {
        let zero = f64x8::splat(self.simd, 0.0);
        let mut sources = Sources {
            at: [[zero; D]; GROUP],
            weight: [zero; GROUP],
        };
        for j in 0..GROUP {
            let slot = &self.slots[group[j] as usize];
            for k in 0..D {
                sources.at[j][k] = f64x8::splat(self.simd, slot[k]);
            }
            sources.weight[j] = f64x8::splat(self.simd, slot[3]);
        }
        sources
    }

    /// Candidates for one half of the targets each.
    #[inline(always)]
    fn split(&self, group: &[u32; 2 * GROUP]) -> Sources<S, D> {
        let simd = self.simd;
        let zero = f64x8::splat(simd, 0.0);
        let mut sources = Sources {
            at: [[zero; D]; GROUP],
            weight: [zero; GROUP],
        };
        for j in 0..GROUP {
            let one = &self.slots[group[2 * j] as usize];
            let two = &self.slots[group[2 * j + 1] as usize];
            for k in 0..D {
                sources.at[j][k] =
                    simd.combine_f64x4(f64x4::splat(simd, one[k]), f64x4::splat(simd, two[k]));
            }
            sources.weight[j] =
                simd.combine_f64x4(f64x4::splat(simd, one[3]), f64x4::splat(simd, two[3]));
        }
        sources
    }

    /// Adds a group of which all are as far away as the kernel's piece begins.
    #[inline(always)]
    fn add<P: Profile<D>, const PIECE: usize>(&mut self, sources: Sources<S, D>) -> Near<S, D> {
        let simd = self.simd;
        let zero = f64x8::splat(simd, 0.0);
        let mut apart = [[zero; D]; GROUP];
        let mut square = [zero; GROUP];
        let weight = sources.weight;
        for j in 0..GROUP {
            for k in 0..D {
                apart[j][k] = self.x[k] - sources.at[j][k];
            }
        }
        for j in 0..GROUP {
            square[j] = apart[j][0] * apart[j][0];
        }
        for k in 1..D {
            for j in 0..GROUP {
                square[j] = apart[j][k].mul_add(apart[j][k], square[j]);
            }
        }
        let mut at_least = square;
        if PIECE == 0 {
            for j in 0..GROUP {
                at_least[j] = square[j].max(f64x8::splat(simd, self.constants.smallest));
            }
        }
        let (r, inverse) = roots(Several(at_least));
        let (value, slope) = P::value_and_slope::<_, PIECE>(r, self.constants.inverse);
        let scaled = slope * inverse * Several(weight);
        for j in 0..GROUP {
            self.gamma = weight[j].mul_add(value.0[j], self.gamma);
            for k in 0..D {
                self.gradient[k] = scaled.0[j].mul_add(apart[j][k], self.gradient[k]);
            }
        }
        Near {
            apart,
            square,
            inverse,
        }
    }

    /// Adds the repulsion of those of a group that are near to any lane; `share` of the energy is the targets'.
    #[inline(always)]
    fn repel(&mut self, near: &Near<S, D>, share: f64) {
        let simd = self.simd;
        let constant = |c: f64| f64x8::splat(simd, c);
        let c = &self.constants.repulsion;
        let zero = constant(0.0);
        for j in 0..GROUP {
            let square = near.square[j];
            let repelled = square.simd_lt(constant(c.reach_squared)) & square.simd_gt(zero);
            if repelled.any_true() {
                // 1/r and r, no nearer than the core.
                let i = near.inverse.0[j].min(constant(c.inverse_core));
                let inside = (constant(c.core) - square * near.inverse.0[j]).max(zero);
                let i2 = i * i;
                let force =
                    constant(c.strength) * i2 * i * (constant(3.0 * c.c) * i - constant(2.0));
                let force = repelled.select(force, zero);
                let push = force * near.inverse.0[j];
                for k in 0..D {
                    self.repulsion[k] = push.mul_add(near.apart[j][k], self.repulsion[k]);
                }
                let potential = constant(c.strength) * i2 * (constant(c.c) * i - constant(1.0));
                let potential = inside.mul_add(force, potential - constant(c.potential_at_reach));
                let potential = repelled.select(potential, zero);
                self.repulsion_energy = potential.mul_add(constant(share), self.repulsion_energy);
            }
        }
    }

    /// Writes the sums, each lane's to its particle.
    #[inline(always)]
    fn finish(self, of_targets: f64x8<S>, out: &mut [Sums<D>]) {
        let simd = self.simd;
        let scale = f64x8::splat(simd, self.constants.value_scale);
        let gamma: [f64; LANES] = (scale * self.gamma).into();
        let others: [f64; LANES] = (scale * (self.gamma - of_targets)).into();
        let scale = f64x8::splat(simd, self.constants.repulsion.energy_scale);
        let energy: [f64; LANES] = (scale * self.repulsion_energy).into();
        let scale = f64x8::splat(simd, self.constants.slope_scale);
        let mut gradient = [[0.0; LANES]; D];
        let mut repulsion = [[0.0; LANES]; D];
        for k in 0..D {
            gradient[k] = (scale * self.gradient[k]).into();
            repulsion[k] = self.repulsion[k].into();
        }
        for (lane, sums) in out.iter_mut().enumerate() {
            *sums = Sums {
                gamma: gamma[lane],
                gamma_of_others: others[lane],
                gradient: std::array::from_fn(|k| gradient[k][lane]),
                repulsion: std::array::from_fn(|k| repulsion[k][lane]),
                repulsion_energy: energy[lane],
            };
        }
    }
}
