//! The short repulsion that keeps particles apart.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};

use crate::group::{Group, Scale, Targets};
use crate::term::Term;

/// A squared reach that rounding has made no shorter.
const ROUNDED: f64 = 1.0 + 1e-12;

/// The repulsion of Negi and Ramachandran (2021), eqs. 15 and 16: the gradient of 12 k_r (c²/r³ − c/r²) with
/// c = 2α∆s/3, between ∆s/2 and α∆s, where it vanishes; constant below ∆s/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repulsion {
    /// 12 k_r.
    strength: f64,
    c: f64,
    reach: f64,
    core: f64,
    /// The smoothing length of the particles that it is given for; of no meaning where all have one.
    size: f64,
    loops: Coefficients,
}

impl Repulsion {
    /// α: the repulsion ends at α∆s (Negi and Ramachandran 2021, §3.1.2).
    pub const REACH_OVER_SPACING: f64 = 0.95;

    /// C, the middle of the range 0.004 … 0.006 of Negi and Ramachandran (2021), eq. 24.
    pub const STRENGTH: f64 = 0.005;

    /// The repulsion at spacing ∆s with k_r = `strength` · ∆s · p_b, for p_b = 1 (their eq. 24).
    pub fn new(spacing: f64, strength: f64) -> Self {
        Self::with_reach(spacing, strength, Self::REACH_OVER_SPACING)
    }

    /// [`Repulsion::new`] that begins at another distance than 0.95 ∆s, in ∆s.
    pub fn with_reach(spacing: f64, strength: f64, reach_over_spacing: f64) -> Self {
        Self::of([
            12.0 * strength * spacing,
            2.0 / 3.0 * reach_over_spacing * spacing,
            reach_over_spacing * spacing,
            0.5 * spacing,
        ])
    }

    /// No repulsion at all.
    pub fn none() -> Self {
        Self::of([0.0; 4])
    }

    /// The repulsion of these [`Repulsion::parameters`].
    pub fn of(parameters: [f64; 4]) -> Self {
        let [strength, c, reach, core] = parameters;
        Self {
            strength,
            c,
            reach,
            core,
            size: 1.0,
            loops: Coefficients::of(parameters, 1.0),
        }
    }

    /// The same, given for particles of this smoothing length (scene units). In sums over particles of many sizes its
    /// lengths scale with the mean h of a pair, and the potential at a distance in these is the same for all.
    #[must_use]
    pub fn at_size(self, smoothing_length: f64) -> Self {
        Self {
            size: smoothing_length,
            ..self
        }
    }

    /// 12 k_r, c, reach and core (scene units): all that it is.
    pub fn parameters(&self) -> [f64; 4] {
        [self.strength, self.c, self.reach, self.core]
    }

    /// Zero from this distance on.
    #[inline(always)]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The acceleration that pushes two particles at distance `r` apart; never negative.
    #[inline]
    pub fn force(&self, r: f64) -> f64 {
        if r >= self.reach {
            return 0.0;
        }
        let r = r.max(self.core);
        let r3 = r * r * r;
        self.strength * self.c * (3.0 * self.c / r - 2.0) / r3
    }

    /// The smoothing length of the particles that it is given for, in the loop's unit.
    #[inline(always)]
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// Whether nothing repels.
    #[inline(always)]
    pub(crate) fn is_none(&self) -> bool {
        self.reach <= 0.0
    }

    /// From the loop's energies to the scene's.
    #[inline(always)]
    pub(crate) fn energy_scale(&self) -> f64 {
        self.loops.energy_scale
    }

    /// Whether it may act on any lane of pairs that are so much larger than those that it is given for; a division less than to
    /// find out by [`Repulsion::pair`].
    #[inline(always)]
    pub(crate) fn reaches<S: Simd>(&self, square: f64x8<S>, larger: f64x8<S>) -> bool {
        let reach = f64x8::splat(square.simd, self.loops.reach_squared * ROUNDED);
        square.simd_lt(reach * larger * larger).any_true()
    }

    /// Force and potential at a squared distance and the inverse of that distance, as the loop computes them: lane by lane, zero where
    /// nothing repels; `None` where no lane is repelled.
    #[inline(always)]
    pub(crate) fn pair<S: Simd>(
        &self,
        square: f64x8<S>,
        inverse: f64x8<S>,
    ) -> Option<[f64x8<S>; 2]> {
        let simd = square.simd;
        let constant = |c: f64| f64x8::splat(simd, c);
        let c = &self.loops;
        let zero = constant(0.0);
        let repelled = square.simd_lt(constant(c.reach_squared)) & square.simd_gt(zero);
        if !repelled.any_true() {
            return None;
        }
        // 1/r and r, no nearer than the core.
        let i = inverse.min(constant(c.inverse_core));
        let inside = (constant(c.core) - square * inverse).max(zero);
        let i2 = i * i;
        let force = constant(c.strength) * i2 * i * (constant(3.0 * c.c) * i - constant(2.0));
        let force = repelled.select(force, zero);
        let potential = constant(c.strength) * i2 * (constant(c.c) * i - constant(1.0));
        let potential = inside.mul_add(force, potential - constant(c.potential_at_reach));
        Some([force, repelled.select(potential, zero)])
    }

    /// The potential of [`Repulsion::force`]: zero from the reach on, linear below ∆s/2.
    #[inline]
    pub fn potential(&self, r: f64) -> f64 {
        if r >= self.reach {
            return 0.0;
        }
        let at = |r: f64| self.strength * self.c * (self.c / r - 1.0) / (r * r);
        at(r.max(self.core)) - at(self.reach) + self.force(r) * (self.core - r).max(0.0)
    }
}

/// [`Repulsion`] as a pair loop computes it, in a unit of length of its own: with i = 1/max(r, core) the force is
/// `strength` i³ (3ci − 2), and the potential, times the unit, `strength` i² (ci − 1) and what the core adds.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Coefficients {
    reach_squared: f64,
    core: f64,
    inverse_core: f64,
    c: f64,
    strength: f64,
    /// One over the unit.
    energy_scale: f64,
    /// The potential where the repulsion ends, times the unit.
    potential_at_reach: f64,
}

impl Coefficients {
    /// For lengths multiplied by `unit`; forces come out in scene units.
    fn of([strength, c, reach, core]: [f64; 4], unit: f64) -> Self {
        // Where nothing repels the core must not be zero: its inverse is a factor.
        let core = if reach > 0.0 { core * unit } else { 1.0 };
        let at_reach = strength * c * (c / reach - 1.0) / (reach * reach);
        Self {
            reach_squared: reach * reach * unit * unit,
            core,
            inverse_core: 1.0 / core,
            c: c * unit,
            strength: strength * c * unit * unit * unit,
            energy_scale: 1.0 / unit,
            potential_at_reach: if reach > 0.0 { at_reach * unit } else { 0.0 },
        }
    }
}

/// The sums of [`Repulsion`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RepulsionSum {
    /// Acceleration by repulsion; coordinates beyond D are zero.
    pub acceleration: [f64; 3],
    /// Repulsive energy: half of every pair with a target, the whole of every pair with another source.
    pub energy: f64,
}

/// Sums on their way.
#[derive(Debug, Clone, Copy)]
pub struct RepulsionLanes<S: Simd> {
    acceleration: [f64x8<S>; 3],
    energy: f64x8<S>,
}

impl Term for Repulsion {
    type Sum = RepulsionSum;
    type Lanes<S: Simd> = RepulsionLanes<S>;

    const OWN: bool = false;

    fn in_unit(&self, unit: f64) -> Self {
        Self {
            size: self.size * unit,
            loops: Coefficients::of(self.parameters(), unit),
            ..*self
        }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S> {
        let zero = f64x8::splat(targets.simd, 0.0);
        RepulsionLanes {
            acceleration: [zero; 3],
            energy: zero,
        }
    }

    /// Of those of a group that are near to any lane.
    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut Self::Lanes<S>, group: &Group<'_, S, D>) {
        if !group.is_near {
            return;
        }
        let simd = group.simd;
        // The part of the energy that is the targets'.
        let share = if group.are_targets { 0.5 } else { 1.0 };
        // Where sizes differ: by how much the pair is smaller than what the coefficients are for.
        let smaller = group.over_mean(self.size);
        for j in 0..GROUP {
            let mut square = group.square[j];
            let mut inverse = group.inverse.0[j];
            if let Some(smaller) = smaller {
                square = square * smaller[j] * smaller[j];
                inverse /= smaller[j];
            }
            let Some([force, potential]) = self.pair(square, inverse) else {
                continue;
            };
            let mut push = force * group.inverse.0[j];
            if let Some(smaller) = smaller {
                push *= smaller[j];
            }
            for k in 0..D {
                sums.acceleration[k] = push.mul_add(group.apart[j][k], sums.acceleration[k]);
            }
            sums.energy = potential.mul_add(f64x8::splat(simd, share), sums.energy);
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: Self::Lanes<S>, _: &Scale<S>) -> [Self::Sum; LANES] {
        let simd = sums.energy.simd;
        let energy: [f64; LANES] =
            (f64x8::splat(simd, self.loops.energy_scale) * sums.energy).into();
        let mut all = [RepulsionSum::default(); LANES];
        for k in 0..3 {
            let lanes: [f64; LANES] = sums.acceleration[k].into();
            for lane in 0..LANES {
                all[lane].acceleration[k] = lanes[lane];
            }
        }
        for lane in 0..LANES {
            all[lane].energy = energy[lane];
        }
        all
    }
}
