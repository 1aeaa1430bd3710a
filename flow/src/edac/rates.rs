//! The pair sums of EDAC with transport velocity.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};
use sphpack_pairs::{Group, Scale, Targets, Term};

use crate::neighborhood::compiled;

/// With V = weights, s_ij = V_i² + V_j² and L_ij = η_ij (r_ij·∇W_ij)/(r² + ε):
///
/// - m_i du_i/dt = Σ_j s_ij [−p_ij ∇W_ij + ½(A_i + A_j)·∇W_ij + L_ij u_ij],
/// - m_i ã_i = −p_b Σ_j s_ij ∇W_ij,
/// - dp_i/dt = ρ_i c² Σ_j V_j u_ij·∇W_ij + (1/m_i) Σ_j s_ij L^e_ij (p_i − p_j).
///
/// The mean pressure p̄_i leaves the sum: p_ij = (ρ_j p_i + ρ_i p_j)/(ρ_i + ρ_j) − p̄_i, so that it takes no pass of its own, and
/// what walls feel is at hand without it.
///
/// Fields of the fluid are the velocity u, ½ρ (ũ − u), which with u makes ½A, pressure, density; of walls the velocity that viscosity
/// sees, the true one, pressure, density.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rates {
    /// ν.
    pub(crate) viscosity: f64,
    /// ν_e.
    pub(crate) diffusivity: f64,
    /// c².
    pub(crate) sound_squared: f64,
    /// p_b.
    pub(crate) background: f64,
    /// ε.
    pub(crate) softening: f64,
    /// The square of the kernel's reach: whose pressures p̄ takes.
    pub(crate) support_squared: f64,
}

/// Fields per particle.
pub(crate) const fn stride(dimension: usize) -> usize {
    2 * dimension + 2
}

/// What a particle finds. Coordinates beyond D are zero.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct RateSum {
    /// du/dt, without body force.
    pub(crate) acceleration: [f64; 3],
    /// ã.
    pub(crate) transport: [f64; 3],
    /// dp/dt.
    pub(crate) pressure: f64,
    /// The force that it has on walls by its pressure, without p̄, and by friction.
    pub(crate) on_walls: [[f64; 3]; 2],
}

/// The targets' own fields, and the sums without the slope's scale.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RateLanes<S: Simd> {
    velocity: [f64x8<S>; 3],
    transport: [f64x8<S>; 3],
    pressure: f64x8<S>,
    density: f64x8<S>,
    volume: f64x8<S>,
    /// Σ s ∇W, and what of it is fluid's.
    crowding: [[f64x8<S>; 3]; 2],
    /// Of the momentum, without p̄ and without A_i; and what of it is fluid's.
    momentum: [[f64x8<S>; 3]; 2],
    /// Of the pressure between fluid and walls.
    thrust: [f64x8<S>; 3],
    /// Σ V_j u_ij·∇W.
    divergence: f64x8<S>,
    /// Of the pressure's diffusion, without ν_e.
    diffusion: f64x8<S>,
    /// Σ p_j, and of how many.
    pressures: f64x8<S>,
    count: f64x8<S>,
}

impl Term for Rates {
    type Sum = RateSum;
    type Lanes<S: Simd> = RateLanes<S>;

    fn in_unit(&self, unit: f64) -> Self {
        // (r·∇W)/(r² + ε) has a length less than ∇W: the viscosities take its unit.
        Self {
            viscosity: self.viscosity * unit,
            diffusivity: self.diffusivity * unit,
            softening: self.softening * unit * unit,
            support_squared: self.support_squared * unit * unit,
            ..*self
        }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> RateLanes<S> {
        let zero = f64x8::splat(targets.simd, 0.0);
        let dimension = (targets.fields() - 2) / 2;
        let mut velocity = [zero; 3];
        let mut transport = [zero; 3];
        for k in 0..dimension {
            velocity[k] = targets.field(k);
            transport[k] = targets.field(dimension + k);
        }
        RateLanes {
            velocity,
            transport,
            pressure: targets.field(2 * dimension),
            density: targets.field(2 * dimension + 1),
            volume: targets.weight(),
            crowding: [[zero; 3]; 2],
            momentum: [[zero; 3]; 2],
            thrust: [zero; 3],
            divergence: zero,
            diffusion: zero,
            pressures: zero,
            count: zero,
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut RateLanes<S>, group: &Group<'_, S, D>) {
        let simd = group.simd;
        let constant = |c: f64| f64x8::splat(simd, c);
        let (zero, one) = (constant(0.0), constant(1.0));
        let softening = constant(self.softening);
        // η_ij/ν has a factor 2.
        let twice_viscosity = constant(2.0 * self.viscosity);
        let support_squared = constant(self.support_squared);
        let mut velocity = [[zero; GROUP]; D];
        let mut transport = [[zero; GROUP]; D];
        for k in 0..D {
            velocity[k] = group.field(k);
            transport[k] = group.field(D + k);
        }
        let pressure = group.field(2 * D);
        let density = group.field(2 * D + 1);
        let gradient = group.own.slope * group.inverse;
        let own_squared = sums.volume * sums.volume;
        for j in 0..GROUP {
            let (x, square, weight) = (group.apart[j], group.square[j], group.weight[j]);
            let softened = square + softening;
            // One division serves both 1/(ρ_i + ρ_j) and 1/(r² + ε).
            let shared = one / ((sums.density + density[j]) * softened);
            let together = sums
                .pressure
                .mul_add(density[j], pressure[j] * sums.density);
            let pressure_between = together * (softened * shared);
            let along = gradient.0[j] * weight.mul_add(weight, own_squared);
            let drag = along * (sums.density * density[j] * (square * shared));
            let friction = twice_viscosity * drag;
            let mut closing = zero;
            if group.are_targets {
                let mut carried = zero;
                for k in 0..D {
                    let between = sums.velocity[k] - velocity[k][j];
                    closing = between.mul_add(x[k], closing);
                    carried = transport[k][j].mul_add(x[k], carried);
                    sums.momentum[0][k] = friction.mul_add(between, sums.momentum[0][k]);
                }
                let carried = along * carried;
                let pressed = -(along * pressure_between);
                for k in 0..D {
                    let sum = carried.mul_add(velocity[k][j], sums.momentum[0][k]);
                    sums.momentum[0][k] = pressed.mul_add(x[k], sum);
                }
            } else {
                let pressed = along * pressure_between;
                for k in 0..D {
                    let between = sums.velocity[k] - velocity[k][j];
                    closing = (sums.velocity[k] - transport[k][j]).mul_add(x[k], closing);
                    sums.momentum[0][k] = friction.mul_add(between, sums.momentum[0][k]);
                    sums.thrust[k] = pressed.mul_add(x[k], sums.thrust[k]);
                }
            }
            for k in 0..D {
                sums.crowding[0][k] = along.mul_add(x[k], sums.crowding[0][k]);
            }
            sums.divergence = (weight * gradient.0[j]).mul_add(closing, sums.divergence);
            sums.diffusion = drag.mul_add(sums.pressure - pressure[j], sums.diffusion);
            let is_near = square.simd_lt(support_squared);
            sums.count += is_near.select(one, zero);
            sums.pressures += is_near.select(pressure[j], zero);
        }
    }

    #[inline(always)]
    fn targets_are_done<S: Simd>(&self, sums: &mut RateLanes<S>) {
        sums.crowding[1] = sums.crowding[0];
        sums.momentum[1] = sums.momentum[0];
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: RateLanes<S>, scale: &Scale<S>) -> [RateSum; LANES] {
        let simd = scale.slope.simd;
        let constant = |c: f64| f64x8::splat(simd, c);
        let per_mass = scale.slope / (sums.density * sums.volume);
        let mean = sums.pressures / sums.count;
        let mut carried = constant(0.0);
        for k in 0..3 {
            carried = sums.transport[k].mul_add(sums.crowding[1][k], carried);
        }
        let mut all = [RateSum::default(); LANES];
        for k in 0..3 {
            let momentum = sums.momentum[0][k] - sums.thrust[k];
            let momentum = mean.mul_add(sums.crowding[0][k], momentum);
            let momentum = carried.mul_add(sums.velocity[k], momentum);
            let acceleration: [f64; LANES] = (per_mass * momentum).into();
            let push = per_mass * constant(-self.background);
            let transport: [f64; LANES] = (push * sums.crowding[0][k]).into();
            let thrust: [f64; LANES] = (scale.slope * sums.thrust[k]).into();
            let drag = sums.momentum[1][k] - sums.momentum[0][k];
            let drag: [f64; LANES] = (scale.slope * drag).into();
            for lane in 0..LANES {
                all[lane].acceleration[k] = acceleration[lane];
                all[lane].transport[k] = transport[lane];
                all[lane].on_walls[0][k] = thrust[lane];
                all[lane].on_walls[1][k] = drag[lane];
            }
        }
        let compression = scale.slope * sums.density * constant(self.sound_squared);
        let diffusion = per_mass * constant(2.0 * self.diffusivity);
        let rate: [f64; LANES] =
            (diffusion.mul_add(sums.diffusion, compression * sums.divergence)).into();
        for lane in 0..LANES {
            all[lane].pressure = rate[lane];
        }
        all
    }
}

compiled!(Rates);
