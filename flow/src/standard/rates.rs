//! The pair sums of standard weakly compressible SPH.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};
use sphpack_pairs::{Group, Scale, Targets, Term};

use crate::neighborhood::compiled;

/// With V = weights and Π_ij = −a (u_ij·r_ij)/(r² + ε):
///
/// - dρ_i/dt = ρ_i Σ_j V_j u_ij·∇W_ij,
/// - du_i/dt = −(1/ρ_i) Σ_j V_j (p_i + p_j + Π_ij) ∇W_ij, with Π between particles of fluid alone: walls are without friction.
///
/// Fields are the velocity (of walls the true one), pressure and density.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rates {
    /// a = α c h ρ₀.
    pub(crate) viscosity: f64,
    /// ε.
    pub(crate) softening: f64,
}

/// Fields per particle.
pub(crate) const fn stride(dimension: usize) -> usize {
    dimension + 2
}

/// What a particle finds. Coordinates beyond D are zero.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct RateSum {
    /// du/dt, without body force.
    pub(crate) acceleration: [f64; 3],
    /// dρ/dt.
    pub(crate) density: f64,
    /// The force per volume of its own that it has on walls.
    pub(crate) on_walls: [f64; 3],
}

/// The targets' own fields, and the sums without the slope's scale.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RateLanes<S: Simd> {
    velocity: [f64x8<S>; 3],
    pressure: f64x8<S>,
    density: f64x8<S>,
    /// Σ V_j (p_i + p_j + Π) ∇W, and what of it is fluid's.
    push: [[f64x8<S>; 3]; 2],
    /// Σ V_j u_ij·∇W.
    divergence: f64x8<S>,
}

impl Term for Rates {
    type Sum = RateSum;
    type Lanes<S: Simd> = RateLanes<S>;

    fn in_unit(&self, unit: f64) -> Self {
        // (u·r)/(r² + ε) is one over a length.
        Self {
            viscosity: self.viscosity * unit,
            softening: self.softening * unit * unit,
        }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> RateLanes<S> {
        let zero = f64x8::splat(targets.simd, 0.0);
        let dimension = targets.fields() - 2;
        let mut velocity = [zero; 3];
        for k in 0..dimension {
            velocity[k] = targets.field(k);
        }
        RateLanes {
            velocity,
            pressure: targets.field(dimension),
            density: targets.field(dimension + 1),
            push: [[zero; 3]; 2],
            divergence: zero,
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut RateLanes<S>, group: &Group<'_, S, D>) {
        let simd = group.simd;
        let zero = f64x8::splat(simd, 0.0);
        let viscosity = f64x8::splat(simd, self.viscosity);
        let softening = f64x8::splat(simd, self.softening);
        let mut velocity = [[zero; GROUP]; D];
        for k in 0..D {
            velocity[k] = group.field(k);
        }
        let pressure = group.field(D);
        let gradient = group.own.slope * group.inverse;
        for j in 0..GROUP {
            let x = group.apart[j];
            let mut closing = zero;
            for k in 0..D {
                closing = (sums.velocity[k] - velocity[k][j]).mul_add(x[k], closing);
            }
            let along = group.weight[j] * gradient.0[j];
            let mut together = sums.pressure + pressure[j];
            if group.are_targets {
                together -= viscosity * closing / (group.square[j] + softening);
            }
            let pushed = along * together;
            for k in 0..D {
                sums.push[0][k] = pushed.mul_add(x[k], sums.push[0][k]);
            }
            sums.divergence = along.mul_add(closing, sums.divergence);
        }
    }

    #[inline(always)]
    fn targets_are_done<S: Simd>(&self, sums: &mut RateLanes<S>) {
        sums.push[1] = sums.push[0];
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: RateLanes<S>, scale: &Scale<S>) -> [RateSum; LANES] {
        let zero = f64x8::splat(scale.slope.simd, 0.0);
        let per_density = zero - scale.slope / sums.density;
        let mut all = [RateSum::default(); LANES];
        for k in 0..3 {
            let acceleration: [f64; LANES] = (per_density * sums.push[0][k]).into();
            let on_walls = sums.push[0][k] - sums.push[1][k];
            let on_walls: [f64; LANES] = (scale.slope * on_walls).into();
            for lane in 0..LANES {
                all[lane].acceleration[k] = acceleration[lane];
                all[lane].on_walls[k] = on_walls[lane];
            }
        }
        let rate: [f64; LANES] = (scale.slope * sums.density * sums.divergence).into();
        for lane in 0..LANES {
            all[lane].density = rate[lane];
        }
        all
    }
}

compiled!(Rates);
