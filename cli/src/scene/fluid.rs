//! What is between the bodies.

use serde::{Deserialize, Serialize};

/// What is between the bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct FluidSpec {
    /// Physical density.
    pub density: f64,
    /// Whether fluid particles are written.
    pub fill: bool,
    /// Gravity and state equation, for columns of pressure and density of the fluid at rest (Bouscasse et al., §III).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hydrostatic: Option<Hydrostatic>,
}

/// Fluid at rest under gravity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Hydrostatic {
    /// Acceleration, scene units over time squared, one entry per axis.
    pub gravity: Vec<f64>,
    /// Height of the free surface above the origin, against gravity, scene units.
    pub level: f64,
    /// Speed of sound c of the state equation p = ρ₀c²/γ ((ρ/ρ₀)^γ − 1), in the units of gravity.
    pub sound_speed: f64,
    /// Its exponent γ.
    #[serde(default = "seven")]
    pub exponent: f64,
}

impl Default for FluidSpec {
    fn default() -> Self {
        Self {
            density: 1.0,
            fill: true,
            hydrostatic: None,
        }
    }
}

/// Of water.
fn seven() -> f64 {
    7.0
}
