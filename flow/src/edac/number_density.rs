//! How close particles are: σ.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};
use sphpack_pairs::{Group, Scale, Targets, Term};

use crate::neighborhood::compiled;

/// σ_i = Σ_j W_ij, the particle itself and walls included: the inverse of its volume.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NumberDensity;

impl Term for NumberDensity {
    type Sum = f64;
    type Lanes<S: Simd> = f64x8<S>;

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> f64x8<S> {
        f64x8::splat(targets.simd, 0.0)
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sum: &mut f64x8<S>, group: &Group<'_, S, D>) {
        // Padding is out of reach: its W is zero.
        for j in 0..GROUP {
            *sum += group.own.value.0[j];
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sum: f64x8<S>, scale: &Scale<S>) -> [f64; LANES] {
        (scale.value * sum).into()
    }
}

compiled!(NumberDensity);
