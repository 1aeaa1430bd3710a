//! A pressure against uneven density.

use crate::state::values;

/// A pressure against uneven density: p = p_b (1 + κ (Γ − Γ₀)) in place of the background pressure alone, with the
/// energy ½ κ Σ_i V_i (Γ_i − Γ₀)² beside that of the background (linear where p would leave 0 … 2 p_b).
///
/// Where an interior is disordered the background pressure alone rests with Γ above 1, by 0.1 to 0.2 % in the mean;
/// a particle has D ways to go and one Γ, so tiny moves (0.02 ∆s) level it. Evaluations take a second pass over the
/// pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Levelling {
    /// κ, dimensionless.
    pub stiffness: f64,
    /// Γ₀, that of the perfect lattice.
    pub target: f64,
    /// Deviations up to this are ignored; of larger ones what is beyond counts.
    pub leeway: f64,
}

impl Levelling {
    /// Without leeway; none where the stiffness is 0.
    pub fn new(stiffness: f64, target: f64) -> Option<Self> {
        (stiffness > 0.0).then_some(Self {
            stiffness,
            target,
            leeway: 0.0,
        })
    }

    /// By how much Γ is too large, or too small if negative, and as much of it as makes pressure: that stays between
    /// zero and 2 p_b. Where density cannot be level, as between bodies nearer than ∆s, more would only tear particles
    /// apart.
    pub(crate) fn excess(self, gamma: f64) -> [f64; 2] {
        let off = gamma - self.target;
        let excess = off - off.clamp(-self.leeway, self.leeway);
        let most = 1.0 / self.stiffness;
        [excess, excess.clamp(-most, most)]
    }
}

values!(Levelling {
    stiffness: f64,
    target: f64,
    leeway: f64
});
