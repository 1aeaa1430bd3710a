//! Options of single methods; the others do not look at them.

use serde::{Deserialize, Serialize};
use sphpack_packing::{Agitated, Agitators, Hybrid};

use super::fault::{Checked, Key, fault, positive};

/// Lattices bear time steps of some ten times Negi & Ramachandran's (docs/stability.md), packings less.
const MOST_TIME_STEP: f64 = 10.0;

/// Of the method hybrid; its defaults are Negi & Ramachandran's algorithm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct HybridOptions {
    /// The part of N_s that becomes boundary particles at the start; 0: none, Negi & Ramachandran (2021), §3.1.9 have
    /// 0.9.
    pub predicted: f64,
    /// Free particles farther than this from every surface, in ∆s, stay on their lattice; `None`: all move.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moving: Option<f64>,
    /// After the capture phase, each capture follows the last by this factor more iterations.
    pub projection_growth: f64,
    /// Capture distances in ∆s, at first and after some passes that found none.
    pub capture: [f64; 2],
    /// The time step, as a multiple of Negi & Ramachandran's (2021, eq. 25).
    pub time_step: f64,
}

impl Default for HybridOptions {
    fn default() -> Self {
        let hybrid = Hybrid::default();
        Self {
            predicted: hybrid.predicted,
            moving: None,
            projection_growth: hybrid.projection_growth,
            capture: hybrid.capture_over_spacing,
            time_step: hybrid.time_step,
        }
    }
}

impl HybridOptions {
    /// The method with these options.
    pub(crate) fn apply(&self, hybrid: Hybrid) -> Hybrid {
        Hybrid {
            predicted: self.predicted,
            moving_over_spacing: self.moving.unwrap_or(f64::INFINITY),
            projection_growth: self.projection_growth,
            capture_over_spacing: self.capture,
            time_step: self.time_step,
            ..hybrid
        }
    }

    pub(super) fn check(&self) -> Checked {
        let at = |name| [Key::Name("packing"), Key::Name("hybrid"), Key::Name(name)];
        if !(0.0..=1.0).contains(&self.predicted) {
            return fault(
                &at("predicted"),
                format!(
                    "packing.hybrid.predicted is {}; it must be between 0 (none) and 1, such as 0.9",
                    self.predicted
                ),
            );
        }
        if let Some(moving) = self.moving {
            positive(&at("moving"), "packing.hybrid.moving", moving)?;
        }
        if !(self.projection_growth >= 1.0 && self.projection_growth.is_finite()) {
            return fault(
                &at("projection_growth"),
                format!(
                    "packing.hybrid.projection_growth is {}; it must be 1 (none) or more, such as 1.5",
                    self.projection_growth
                ),
            );
        }
        if !(self.capture.iter()).all(|capture| *capture > 0.0 && *capture <= 1.0) {
            return fault(
                &at("capture"),
                format!(
                    "packing.hybrid.capture is [{}, {}]; both must be between 0 and 1, such as [0.5, 0.65]",
                    self.capture[0], self.capture[1]
                ),
            );
        }
        if !(self.time_step > 0.0 && self.time_step <= MOST_TIME_STEP) {
            return fault(
                &at("time_step"),
                format!(
                    "packing.hybrid.time_step is {}; it must be above 0, and {MOST_TIME_STEP} at most: 1 is that of Negi & Ramachandran, try 4",
                    self.time_step
                ),
            );
        }
        Ok(())
    }
}

/// What the agitators of the method agitated do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum AgitatorsAre {
    /// They run on their curves.
    #[default]
    Turning,
    /// They stay on their sites.
    Resting,
    /// There are none.
    None,
}

/// Of the method agitated; its defaults are Negi & Ramachandran's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct AgitatedOptions {
    /// What agitators do.
    pub agitators: AgitatorsAre,
    /// Revolutions without a change on the surface until agitators become free particles.
    pub steady_revolutions: f64,
}

impl Default for AgitatedOptions {
    fn default() -> Self {
        Self {
            agitators: AgitatorsAre::default(),
            steady_revolutions: Agitated::default().steady_revolutions,
        }
    }
}

impl AgitatedOptions {
    /// The method with these options.
    pub(crate) fn apply(&self, agitated: Agitated) -> Agitated {
        Agitated {
            agitators: match self.agitators {
                AgitatorsAre::Turning => Agitators::Turning,
                AgitatorsAre::Resting => Agitators::Resting,
                AgitatorsAre::None => Agitators::None,
            },
            steady_revolutions: self.steady_revolutions,
            ..agitated
        }
    }

    pub(super) fn check(&self) -> Checked {
        positive(
            &[
                Key::Name("packing"),
                Key::Name("agitated"),
                Key::Name("steady_revolutions"),
            ],
            "packing.agitated.steady_revolutions",
            self.steady_revolutions,
        )
    }
}
