//! The short repulsion that keeps particles apart.

use crate::state::values;

/// α: the repulsion ends at α∆s (001 §3.1.2).
pub const REACH_OVER_SPACING: f64 = 0.95;

/// C, the middle of 001's range 0.004 … 0.006 (eq. 24).
pub const STRENGTH: f64 = 0.005;

/// The repulsion of 001 eqs. 15 and 16: the gradient of 12 k_r (c²/r³ − c/r²) with c = 2α∆s/3, between ∆s/2 and α∆s,
/// where it vanishes; constant below ∆s/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repulsion {
    /// 12 k_r.
    strength: f64,
    c: f64,
    reach: f64,
    core: f64,
}

values!(Repulsion {
    strength: f64,
    c: f64,
    reach: f64,
    core: f64
});

impl Repulsion {
    /// The repulsion at spacing ∆s with k_r = `strength` · ∆s · p_b, for p_b = 1 (001 eq. 24).
    pub fn new(spacing: f64, strength: f64) -> Self {
        Self::with_reach(spacing, strength, REACH_OVER_SPACING)
    }

    /// [`Repulsion::new`] that begins at another distance than 0.95 ∆s, in ∆s.
    pub fn with_reach(spacing: f64, strength: f64, reach_over_spacing: f64) -> Self {
        Self {
            strength: 12.0 * strength * spacing,
            c: 2.0 / 3.0 * reach_over_spacing * spacing,
            reach: reach_over_spacing * spacing,
            core: 0.5 * spacing,
        }
    }

    /// No repulsion at all.
    pub fn none() -> Self {
        Self {
            strength: 0.0,
            c: 0.0,
            reach: 0.0,
            core: 0.0,
        }
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

    /// The potential of [`Repulsion::force`]: zero from the reach on, linear below ∆s/2.
    #[inline]
    pub fn potential(&self, r: f64) -> f64 {
        if r >= self.reach {
            return 0.0;
        }
        let at = |r: f64| self.strength * self.c * (self.c / r - 1.0) / (r * r);
        at(r.max(self.core)) - at(self.reach) + self.force(r) * (self.core - r).max(0.0)
    }

    /// What a pair loop needs, for lengths multiplied by `unit`; forces come out in scene units.
    pub(crate) fn in_unit(&self, unit: f64) -> Coefficients {
        // Where nothing repels the core must not be zero: its inverse is a factor.
        let core = if self.reach > 0.0 {
            self.core * unit
        } else {
            1.0
        };
        let at_reach =
            self.strength * self.c * (self.c / self.reach - 1.0) / (self.reach * self.reach);
        Coefficients {
            reach_squared: self.reach * self.reach * unit * unit,
            core,
            inverse_core: 1.0 / core,
            c: self.c * unit,
            strength: self.strength * self.c * unit * unit * unit,
            energy_scale: 1.0 / unit,
            potential_at_reach: if self.reach > 0.0 {
                at_reach * unit
            } else {
                0.0
            },
        }
    }
}

/// [`Repulsion`] as a pair loop computes it, in a unit of length of its own: with i = 1/max(r, core) the force is
/// `strength` i³ (3ci − 2), and the potential, times the unit, `strength` i² (ci − 1) and what the core adds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coefficients {
    pub(crate) reach_squared: f64,
    pub(crate) core: f64,
    pub(crate) inverse_core: f64,
    pub(crate) c: f64,
    pub(crate) strength: f64,
    /// One over the unit.
    pub(crate) energy_scale: f64,
    /// The potential where the repulsion ends, times the unit.
    pub(crate) potential_at_reach: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn force_is_the_slope_of_the_potential(q in 0.01..1.1_f64, spacing in 1e-3..1e3_f64) {
            let repulsion = Repulsion::new(spacing, STRENGTH);
            let (r, step) = (q * spacing, 1e-6 * spacing);
            let slope = (repulsion.potential(r + step) - repulsion.potential(r - step)) / (2.0 * step);
            let scale = repulsion.force(0.0);
            prop_assert!((slope + repulsion.force(r)).abs() < 1e-4 * scale, "{slope} {}", repulsion.force(r));
            prop_assert!(repulsion.force(r) >= 0.0);
            // Scene units do not matter: k_r/p_b ∝ ∆s makes accelerations scale as 1/∆s, like the background pressure's.
            let other = Repulsion::new(1.0, STRENGTH).force(q) / spacing;
            prop_assert!((repulsion.force(r) - other).abs() <= 1e-12 * scale);
        }
    }

    #[test]
    fn the_printed_constant_below_half_the_spacing() {
        // 001 eq. 16, first line, with ∆s = 1: 192 k_r (3c² − c).
        let c = 2.0 * 0.95 / 3.0;
        let printed = 192.0 * STRENGTH * (3.0 * c * c - c);
        let ours = Repulsion::new(1.0, STRENGTH);
        assert!((ours.force(0.3) / printed - 1.0).abs() < 1e-12);
        assert!((ours.force(0.5) / printed - 1.0).abs() < 1e-12);
        assert!(ours.force(0.95 - 1e-9) < 1e-9 && ours.force(0.95) == 0.0);
        assert_eq!(Repulsion::none().force(0.0), 0.0);
        assert_eq!(Repulsion::none().potential(0.0), 0.0);
    }
}
