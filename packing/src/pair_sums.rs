//! The pair loop: density, its gradient and the repulsion, eight particles at a time against shared candidates.

use std::ops::{Add, Div, Mul, Sub};

use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use sphpack_kernels::{Kernel, Number, WithKernel};
use sphpack_neighbors::{Block, CellList, LANES, Slot};

use crate::repulsion::Repulsion;

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

/// Runs the pair loop over all targets of `list`; to be called through [`sphpack_kernels::KernelKind::with`].
pub(crate) struct PairLoop<'a, const D: usize> {
    pub(crate) list: &'a CellList<D>,
    pub(crate) slots: &'a [Slot],
    pub(crate) repulsion: Repulsion,
    /// One entry per target slot.
    pub(crate) out: &'a mut [Sums<D>],
}

impl<const D: usize> WithKernel<D> for PairLoop<'_, D> {
    type Output = ();

    fn call<K: Kernel<D>>(self, kernel: K) {
        let level = Level::new();
        let (slots, repulsion, targets) = (self.slots, self.repulsion, self.list.targets());
        self.list.for_each_block(self.out, |block, out| {
            dispatch!(level, simd => block_sums(simd, kernel, repulsion, targets, slots, block, out));
        });
    }
}

// A closure that does vector arithmetic must be inlined by force, or the vector instructions cannot be inlined into
// it: so plain loops here, no `from_fn` or `map` over vectors.
#[inline(always)]
fn block_sums<S: Simd, K: Kernel<D>, const D: usize>(
    simd: S,
    kernel: K,
    repulsion: Repulsion,
    targets: usize,
    slots: &[Slot],
    block: Block<'_>,
    out: &mut [Sums<D>],
) {
    simd.vectorize(
        #[inline(always)]
        || {
            // Lanes beyond a short block repeat its last particle and are dropped at the end.
            let last = block.len - 1;
            let zero = f64x8::splat(simd, 0.0);
            let mut x = [zero; D];
            for k in 0..D {
                let lanes: [f64; LANES] =
                    std::array::from_fn(|lane| slots[block.first_slot + lane.min(last)][k]);
                x[k] = lanes.simd_into(simd);
            }
            let reach_squared = f64x8::splat(simd, repulsion.reach() * repulsion.reach());
            let mut gamma = zero;
            let mut others = zero;
            let mut gradient = [zero; D];
            out.fill(Sums::ZERO);
            for &candidate in block.candidates {
                let source = &slots[candidate as usize];
                let mut d = [zero; D];
                let mut r_squared = zero;
                for k in 0..D {
                    d[k] = x[k] - f64x8::splat(simd, source[k]);
                    r_squared = d[k].mul_add(d[k], r_squared);
                }
                let weight = f64x8::splat(simd, source[3]);
                let (value, slope_over_r) = kernel.value_and_slope_over_r(Lanes(r_squared));
                gamma = weight.mul_add(value.0, gamma);
                let scaled = weight * slope_over_r.0;
                for k in 0..D {
                    gradient[k] = scaled.mul_add(d[k], gradient[k]);
                }
                let is_other = candidate as usize >= targets;
                if is_other {
                    others = weight.mul_add(value.0, others);
                }
                if r_squared.simd_lt(reach_squared).any_true() {
                    let mut apart = [[0.0; LANES]; D];
                    for k in 0..D {
                        apart[k] = d[k].into();
                    }
                    repel(repulsion, is_other, &apart, &r_squared.into(), out);
                }
            }
            let gamma: [f64; LANES] = gamma.into();
            let others: [f64; LANES] = others.into();
            let mut slope = [[0.0; LANES]; D];
            for k in 0..D {
                slope[k] = gradient[k].into();
            }
            for (lane, sums) in out.iter_mut().enumerate() {
                sums.gamma = gamma[lane];
                sums.gamma_of_others = others[lane];
                sums.gradient = std::array::from_fn(|k| slope[k][lane]);
            }
        },
    );
}

/// Eight numbers side by side, for the kernels.
#[derive(Clone, Copy)]
struct Lanes<S: Simd>(f64x8<S>);

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl<S: Simd> Number for Lanes<S> {
    #[inline(always)]
    fn constant(self, c: f64) -> Self {
        Self(f64x8::splat(self.0.simd, c))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn at_least(self, c: f64) -> Self {
        Self(self.0.max(f64x8::splat(self.0.simd, c)))
    }

    #[inline(always)]
    fn multiply_add(self, b: Self, c: Self) -> Self {
        Self(self.0.mul_add(b.0, c.0))
    }
}

/// Adds the repulsion of one candidate to the lanes that it is near to. Out of the hot loop: few candidates are.
#[inline(never)]
fn repel<const D: usize>(
    repulsion: Repulsion,
    is_other: bool,
    d: &[[f64; LANES]; D],
    r_squared: &[f64; LANES],
    out: &mut [Sums<D>],
) {
    for (lane, sums) in out.iter_mut().enumerate() {
        if r_squared[lane] > 0.0 && r_squared[lane] < repulsion.reach() * repulsion.reach() {
            let r = r_squared[lane].sqrt();
            let push = repulsion.acceleration(std::array::from_fn::<_, D, _>(|k| d[k][lane]), r);
            for k in 0..D {
                sums.repulsion[k] += push[k];
            }
            let share = if is_other { 1.0 } else { 0.5 };
            sums.repulsion_energy += share * repulsion.potential(r);
        }
    }
}
