//! The summation density.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};

use crate::group::{Group, Scale, Targets};
use crate::term::Term;

/// Γ_i = Σ_j w_j W(r_ij, h_i), the particle itself included: with volumes as weights 1 where space is evenly filled, with
/// masses the density.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Density;

/// The sums of [`Density`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DensitySum {
    /// Over all sources.
    pub whole: f64,
    /// Over those that are no targets.
    pub of_others: f64,
}

impl Term for Density {
    type Sum = DensitySum;
    /// The sum, and what of it is targets'.
    type Lanes<S: Simd> = [f64x8<S>; 2];

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S> {
        [f64x8::splat(targets.simd, 0.0); 2]
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut Self::Lanes<S>, group: &Group<'_, S, D>) {
        for j in 0..GROUP {
            sums[0] = group.weight[j].mul_add(group.own.value.0[j], sums[0]);
        }
    }

    #[inline(always)]
    fn targets_are_done<S: Simd>(&self, sums: &mut Self::Lanes<S>) {
        sums[1] = sums[0];
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: Self::Lanes<S>, scale: &Scale<S>) -> [Self::Sum; LANES] {
        let whole: [f64; LANES] = (scale.value * sums[0]).into();
        let of_others: [f64; LANES] = (scale.value * (sums[0] - sums[1])).into();
        let mut all = [DensitySum::default(); LANES];
        for lane in 0..LANES {
            all[lane] = DensitySum {
                whole: whole[lane],
                of_others: of_others[lane],
            };
        }
        all
    }
}
