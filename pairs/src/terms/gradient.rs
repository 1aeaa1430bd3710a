//! Sums of kernel gradients.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};

use crate::group::{Group, Scale, Targets};
use crate::lanes::Several;
use crate::term::Term;

/// Σ_j w_j ∇_iW(r_ij, h_i), with volumes as weights the kernel gradient sum, zero where space is evenly filled. Coordinates
/// beyond D are zero.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Gradient;

/// [`Gradient`] over sources that are targets alone: of a field that nobody else has.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct TargetGradient;

macro_rules! gradients {
    ($($name:ident, of others: $others:literal;)+) => {$(
        impl Term for $name {
            type Sum = [f64; 3];
            type Lanes<S: Simd> = [f64x8<S>; 3];

            const OTHERS: bool = $others;

            #[inline(always)]
            fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S> {
                [f64x8::splat(targets.simd, 0.0); 3]
            }

            #[inline(always)]
            fn add<S: Simd, const D: usize>(&self, sums: &mut Self::Lanes<S>, group: &Group<'_, S, D>) {
                let scaled = group.own.slope * group.inverse * Several(group.weight);
                for j in 0..GROUP {
                    for k in 0..D {
                        sums[k] = scaled.0[j].mul_add(group.apart[j][k], sums[k]);
                    }
                }
            }

            #[inline(always)]
            fn finish<S: Simd>(&self, sums: Self::Lanes<S>, scale: &Scale<S>) -> [Self::Sum; LANES] {
                let mut all = [[0.0; 3]; LANES];
                for k in 0..3 {
                    let lanes: [f64; LANES] = (scale.slope * sums[k]).into();
                    for lane in 0..LANES {
                        all[lane][k] = lanes[lane];
                    }
                }
                all
            }
        }
    )+};
}

gradients! {
    Gradient, of others: true;
    TargetGradient, of others: false;
}
