//! How density and kernel gradient sum change when particles move.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};

use crate::group::{Group, Scale, Targets};
use crate::term::Term;

/// The first variation of the summation density and of the kernel gradient sum, and its transpose, in one. Field 0 is a
/// number s, fields 1 … D a vector u; with weights w:
///
/// - `density` = Σ_j w_j ∇W_ij · (u_i − u_j),
/// - `gradient` = Σ_j w_j [(s_i + s_j) ∇W_ij + ∇∇W_ij (u_i − u_j)].
///
/// With w = V, s = 0 and displacements u these are the changes of Γ and ∇Γ. With s = a/V and u = b/V, V_i `gradient` is
/// the derivative of Σ a_i Γ_i + b_i · ∇Γ_i by the position of i, so long as all have one h: both sums are symmetric but
/// for the weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variation {
    /// The unit of lengths over the scene's.
    unit: f64,
}

impl Default for Variation {
    fn default() -> Self {
        Self { unit: 1.0 }
    }
}

/// The sums of [`Variation`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct VariationSum {
    /// Of the density.
    pub density: f64,
    /// Of the kernel gradient sum; coordinates beyond D are zero.
    pub gradient: [f64; 3],
}

/// Sums on their way, with the targets' own fields.
#[derive(Debug, Clone, Copy)]
pub struct VariationLanes<S: Simd> {
    number: f64x8<S>,
    vector: [f64x8<S>; 3],
    density: f64x8<S>,
    gradient: [f64x8<S>; 3],
}

impl Term for Variation {
    type Sum = VariationSum;
    type Lanes<S: Simd> = VariationLanes<S>;

    const CURVATURE: bool = true;

    fn in_unit(&self, unit: f64) -> Self {
        Self { unit }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S> {
        let zero = f64x8::splat(targets.simd, 0.0);
        let mut vector = [zero; 3];
        for k in 0..targets.fields() - 1 {
            vector[k] = targets.field(k + 1);
        }
        VariationLanes {
            number: targets.field(0),
            vector,
            density: zero,
            gradient: [zero; 3],
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut Self::Lanes<S>, group: &Group<'_, S, D>) {
        let simd = group.simd;
        let zero = f64x8::splat(simd, 0.0);
        let per_unit = f64x8::splat(simd, 1.0 / self.unit);
        let number = group.field(0);
        let mut between = [[zero; D]; GROUP];
        for k in 0..D {
            let theirs = group.field(k + 1);
            for j in 0..GROUP {
                between[j][k] = sums.vector[k] - theirs[j];
            }
        }
        for j in 0..GROUP {
            let inverse = group.inverse.0[j];
            let over_r = group.own.slope.0[j] * inverse;
            let mut along = zero;
            for k in 0..D {
                along = between[j][k].mul_add(group.apart[j][k], along);
            }
            let weight = group.weight[j];
            let weighted = weight * over_r;
            sums.density = weighted.mul_add(along, sums.density);
            let bent = (group.curvature.0[j] - over_r) * inverse * inverse * along;
            let own = (sums.number + number[j]) * per_unit;
            let across = weight * own.mul_add(over_r, bent);
            for k in 0..D {
                let sum = weighted.mul_add(between[j][k], sums.gradient[k]);
                sums.gradient[k] = across.mul_add(group.apart[j][k], sum);
            }
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: Self::Lanes<S>, scale: &Scale<S>) -> [Self::Sum; LANES] {
        let density: [f64; LANES] = (scale.slope * sums.density).into();
        let mut all = [VariationSum::default(); LANES];
        for k in 0..3 {
            let lanes: [f64; LANES] = (scale.over_r * sums.gradient[k]).into();
            for lane in 0..LANES {
                all[lane].gradient[k] = lanes[lane];
            }
        }
        for lane in 0..LANES {
            all[lane].density = density[lane];
        }
        all
    }
}
