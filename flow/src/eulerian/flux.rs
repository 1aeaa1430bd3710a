//! What goes from particle to particle: the fluxes of an acoustic Riemann problem with a limiter.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};
use sphpack_pairs::{Group, Scale, Targets, Term};

use super::correction::{entries, entry};
use crate::medium::Medium;
use crate::neighborhood::compiled;

/// With e = r_ij/r, J = −e·(u_i − u_j) and the limiter L = min(15 max(J, 0)/c, 1), what is between two particles is
///
/// - p* = ½(p_i + p_j) + ½ρ₀c J L,
/// - u* = ½(u_i + u_j) − e ½(p_i − p_j) max(L², L₀)/(ρ₀c),
/// - ρ* = ½(ρ_i + ρ_j);
///
/// and between one and a wall, which has p_j = p_i, ρ_j = ρ_i, u_j = 2u_w − u_i and e its normal, by the same formulas
/// u* = u_w, ρ* = ρ_i.
#[derive(Debug, Clone, Copy)]
struct Riemann {
    /// ρ₀c.
    impedance: f64,
    /// 15/c.
    limit: f64,
    /// L₀.
    damping: f64,
}

/// d(m_i u_i)/dt over V_i: −2 Σ_j V_j [ρ* u*⊗u* + p* I]·∇W̃_ij + 2 Σ_j V_j μ u_ij (dW/dr)/(r + 0.01h), the friction twice that along
/// walls, which are half as far; ∇W̃_ij = ½(B_i + B_j)∇W_ij, and B_i ∇W_ij there.
///
/// Fields of the fluid are velocity, pressure, density, and the correction B; of walls velocity and normal, zero for e_ij.
#[derive(Debug, Clone, Copy)]
pub(super) struct Momentum {
    riemann: Riemann,
    /// μ.
    viscosity: f64,
    /// 0.01 h.
    softening: f64,
}

/// dm_i/dt over V_i: −2 Σ_j V_j ρ* u*·∇W̃_ij. Fields are the same.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mass {
    riemann: Riemann,
}

/// Fields per particle.
pub(super) const fn stride(dimension: usize) -> usize {
    dimension + 2 + entries(dimension)
}

/// What a particle's momentum finds, per volume of its own. Coordinates beyond D are zero.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MomentumSum {
    /// All of it.
    pub(super) rate: [f64; 3],
    /// What it has on walls by pressure, and by friction.
    pub(super) on_walls: [[f64; 3]; 2],
}

impl Momentum {
    /// Of a fluid of kinematic viscosity ν, with L₀.
    pub(super) fn new<const D: usize>(medium: &Medium<D>, viscosity: f64, damping: f64) -> Self {
        Self {
            riemann: Riemann::new(medium, damping),
            viscosity: medium.density * viscosity,
            softening: 0.01 * medium.smoothing_length,
        }
    }
}

impl Mass {
    pub(super) fn new<const D: usize>(medium: &Medium<D>, damping: f64) -> Self {
        Self {
            riemann: Riemann::new(medium, damping),
        }
    }
}

impl Riemann {
    fn new<const D: usize>(medium: &Medium<D>, damping: f64) -> Self {
        Self {
            impedance: medium.density * medium.sound_speed,
            limit: 15.0 / medium.sound_speed,
            damping,
        }
    }

    /// L of J.
    #[inline(always)]
    fn limiter<S: Simd>(&self, simd: S, closing: f64x8<S>) -> f64x8<S> {
        let limited = closing.max(f64x8::splat(simd, 0.0)) * f64x8::splat(simd, self.limit);
        limited.min(f64x8::splat(simd, 1.0))
    }

    /// p* of both pressures' sum.
    #[inline(always)]
    fn pressure<S: Simd, const D: usize>(
        &self,
        simd: S,
        together: f64x8<S>,
        between: &Between<S, D>,
    ) -> f64x8<S> {
        let jump = f64x8::splat(simd, self.impedance) * between.closing * between.limiter;
        f64x8::splat(simd, 0.5) * (together + jump)
    }

    /// By what u* is less than the mean velocity, along e.
    #[inline(always)]
    fn slower<S: Simd>(&self, simd: S, apart: f64x8<S>, limiter: f64x8<S>) -> f64x8<S> {
        let damping = (limiter * limiter).max(f64x8::splat(simd, self.damping));
        f64x8::splat(simd, 0.5 / self.impedance) * apart * damping
    }
}

/// A particle's own fields.
#[derive(Debug, Clone, Copy)]
struct Own<S: Simd> {
    velocity: [f64x8<S>; 3],
    pressure: f64x8<S>,
    density: f64x8<S>,
    correction: [f64x8<S>; 6],
}

impl<S: Simd> Own<S> {
    #[inline(always)]
    fn of(targets: &Targets<'_, S>) -> Self {
        let zero = f64x8::splat(targets.simd, 0.0);
        let dimension = if targets.fields() == stride(2) { 2 } else { 3 };
        let mut own = Self {
            velocity: [zero; 3],
            pressure: targets.field(dimension),
            density: targets.field(dimension + 1),
            correction: [zero; 6],
        };
        for k in 0..dimension {
            own.velocity[k] = targets.field(k);
        }
        for k in 0..entries(dimension) {
            own.correction[k] = targets.field(dimension + 2 + k);
        }
        own
    }
}

/// The sources' fields.
#[derive(Debug, Clone, Copy)]
struct Theirs<S: Simd, const D: usize> {
    velocity: [[f64x8<S>; GROUP]; D],
    pressure: [f64x8<S>; GROUP],
    density: [f64x8<S>; GROUP],
    correction: [[f64x8<S>; GROUP]; 6],
    normal: [[f64x8<S>; GROUP]; D],
}

impl<S: Simd, const D: usize> Theirs<S, D> {
    #[inline(always)]
    fn of(group: &Group<'_, S, D>) -> Self {
        let zero = f64x8::splat(group.simd, 0.0);
        let mut theirs = Self {
            velocity: [[zero; GROUP]; D],
            pressure: [zero; GROUP],
            density: [zero; GROUP],
            correction: [[zero; GROUP]; 6],
            normal: [[zero; GROUP]; D],
        };
        for k in 0..D {
            theirs.velocity[k] = group.field(k);
        }
        if group.are_targets {
            theirs.pressure = group.field(D);
            theirs.density = group.field(D + 1);
            for k in 0..entries(D) {
                theirs.correction[k] = group.field(D + 2 + k);
            }
        } else {
            for k in 0..D {
                theirs.normal[k] = group.field(D + k);
            }
        }
        theirs
    }

    /// Both corrections' sum; a wall has the particle's own.
    #[inline(always)]
    fn correction(&self, own: &Own<S>, j: usize, are_targets: bool) -> [f64x8<S>; 6] {
        let mut both = own.correction;
        for k in 0..entries(D) {
            both[k] += if are_targets {
                self.correction[k][j]
            } else {
                own.correction[k]
            };
        }
        both
    }

    /// e: the wall's normal where it has one, else the way from the source.
    #[inline(always)]
    fn direction(&self, group: &Group<'_, S, D>, j: usize) -> [f64x8<S>; D] {
        let mut direction = group.apart[j];
        for along in &mut direction {
            *along *= group.inverse.0[j];
        }
        if !group.are_targets {
            let mut square = f64x8::splat(group.simd, 0.0);
            for k in 0..D {
                square = self.normal[k][j].mul_add(self.normal[k][j], square);
            }
            let has_one = square.simd_gt(f64x8::splat(group.simd, 0.5));
            for k in 0..D {
                direction[k] = has_one.select(self.normal[k][j], direction[k]);
            }
        }
        direction
    }
}

/// What is between a particle and a source.
#[derive(Debug, Clone, Copy)]
struct Between<S: Simd, const D: usize> {
    /// J, and L of it.
    closing: f64x8<S>,
    limiter: f64x8<S>,
    /// u_i − u_j, of a wall u_i − u_w.
    difference: [f64x8<S>; D],
    /// u*.
    velocity: [f64x8<S>; D],
    /// (B_i + B_j) r_ij.
    corrected: [f64x8<S>; D],
    /// ρ* u* · that.
    flux: f64x8<S>,
}

impl<S: Simd, const D: usize> Between<S, D> {
    #[inline(always)]
    fn of(
        riemann: &Riemann,
        own: &Own<S>,
        theirs: &Theirs<S, D>,
        group: &Group<'_, S, D>,
        j: usize,
    ) -> Self {
        let simd = group.simd;
        let zero = f64x8::splat(simd, 0.0);
        let half = f64x8::splat(simd, 0.5);
        let direction = theirs.direction(group, j);
        let mut difference = [zero; D];
        let mut closing = zero;
        for k in 0..D {
            difference[k] = own.velocity[k] - theirs.velocity[k][j];
            closing -= direction[k] * difference[k];
        }
        let mut velocity = [zero; D];
        let mut density = own.density;
        if !group.are_targets {
            // The wall's image of the particle has another velocity: twice the difference.
            closing += closing;
        }
        let limiter = riemann.limiter(simd, closing);
        if group.are_targets {
            density = half * (own.density + theirs.density[j]);
            let slower = riemann.slower(simd, own.pressure - theirs.pressure[j], limiter);
            for k in 0..D {
                let mean = half * (own.velocity[k] + theirs.velocity[k][j]);
                velocity[k] = mean - slower * direction[k];
            }
        } else {
            for k in 0..D {
                velocity[k] = theirs.velocity[k][j];
            }
        }
        let correction = theirs.correction(own, j, group.are_targets);
        let mut corrected = [zero; D];
        let mut flux = zero;
        for row in 0..D {
            for column in 0..D {
                let entry = correction[entry(D, row, column)];
                corrected[row] = entry.mul_add(group.apart[j][column], corrected[row]);
            }
            flux = velocity[row].mul_add(corrected[row], flux);
        }
        Self {
            closing,
            limiter,
            difference,
            velocity,
            corrected,
            flux: density * flux,
        }
    }
}

/// Of the momentum, without the slope's scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct MomentumLanes<S: Simd> {
    own: Own<S>,
    /// Σ V_j [ρ* u*⊗u* + p* I]·(B_i + B_j)∇W, and what of it is fluid's.
    pushed: [[f64x8<S>; 3]; 2],
    /// Σ V_j 2μ u_ij (dW/dr)/(r + 0.01h), likewise.
    rubbed: [[f64x8<S>; 3]; 2],
}

impl Term for Momentum {
    type Sum = MomentumSum;
    type Lanes<S: Simd> = MomentumLanes<S>;

    fn in_unit(&self, unit: f64) -> Self {
        // 1/(r + 0.01h) is one over a length.
        Self {
            viscosity: self.viscosity * unit,
            softening: self.softening * unit,
            ..*self
        }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> MomentumLanes<S> {
        let zero = f64x8::splat(targets.simd, 0.0);
        MomentumLanes {
            own: Own::of(targets),
            pushed: [[zero; 3]; 2],
            rubbed: [[zero; 3]; 2],
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut MomentumLanes<S>, group: &Group<'_, S, D>) {
        let simd = group.simd;
        let constant = |c: f64| f64x8::splat(simd, c);
        // A wall is half as far as its image of the particle.
        let friction = constant(self.viscosity * if group.are_targets { 2.0 } else { 4.0 });
        let softening = constant(self.softening);
        let own = sums.own;
        let theirs = Theirs::of(group);
        let gradient = group.own.slope * group.inverse;
        for j in 0..GROUP {
            let between = Between::of(&self.riemann, &own, &theirs, group, j);
            let together = if group.are_targets {
                own.pressure + theirs.pressure[j]
            } else {
                own.pressure + own.pressure
            };
            let pressure = (self.riemann).pressure(simd, together, &between);
            let along = group.weight[j] * gradient.0[j];
            let distance = group.square[j] * group.inverse.0[j];
            let rub = friction * group.weight[j] * group.own.slope.0[j] / (distance + softening);
            for k in 0..D {
                let carried = between.flux * between.velocity[k];
                let push = pressure.mul_add(between.corrected[k], carried);
                sums.pushed[0][k] = along.mul_add(push, sums.pushed[0][k]);
                sums.rubbed[0][k] = rub.mul_add(between.difference[k], sums.rubbed[0][k]);
            }
        }
    }

    #[inline(always)]
    fn targets_are_done<S: Simd>(&self, sums: &mut MomentumLanes<S>) {
        sums.pushed[1] = sums.pushed[0];
        sums.rubbed[1] = sums.rubbed[0];
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: MomentumLanes<S>, scale: &Scale<S>) -> [MomentumSum; LANES] {
        let mut all = [MomentumSum::default(); LANES];
        for k in 0..3 {
            let rate = scale.slope * (sums.rubbed[0][k] - sums.pushed[0][k]);
            let thrust = scale.slope * (sums.pushed[0][k] - sums.pushed[1][k]);
            let drag = scale.slope * (sums.rubbed[1][k] - sums.rubbed[0][k]);
            let [rate, thrust, drag]: [[f64; LANES]; 3] = [rate.into(), thrust.into(), drag.into()];
            for lane in 0..LANES {
                all[lane].rate[k] = rate[lane];
                all[lane].on_walls[0][k] = thrust[lane];
                all[lane].on_walls[1][k] = drag[lane];
            }
        }
        all
    }
}

compiled!(Momentum);

/// Of the mass, without the slope's scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct MassLanes<S: Simd> {
    own: Own<S>,
    sum: f64x8<S>,
}

impl Term for Mass {
    type Sum = f64;
    type Lanes<S: Simd> = MassLanes<S>;

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> MassLanes<S> {
        MassLanes {
            own: Own::of(targets),
            sum: f64x8::splat(targets.simd, 0.0),
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut MassLanes<S>, group: &Group<'_, S, D>) {
        let theirs = Theirs::of(group);
        let gradient = group.own.slope * group.inverse;
        for j in 0..GROUP {
            let between = Between::of(&self.riemann, &sums.own, &theirs, group, j);
            let along = group.weight[j] * gradient.0[j];
            sums.sum = along.mul_add(between.flux, sums.sum);
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: MassLanes<S>, scale: &Scale<S>) -> [f64; LANES] {
        (f64x8::splat(scale.slope.simd, 0.0) - scale.slope * sums.sum).into()
    }
}

compiled!(Mass);
