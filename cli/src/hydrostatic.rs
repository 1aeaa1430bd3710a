//! Fluid at rest under gravity: the pressure, density and mass that a simulation starts from (Bouscasse et al.,
//! §III).

use crate::scene::Hydrostatic;

/// What a fluid particle starts with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AtRest {
    /// p*, by the weight of the fluid above; 0 above the level.
    pub(crate) pressure: f64,
    /// ρ*, from the state equation p = ρ₀c²/γ ((ρ/ρ₀)^γ − 1).
    pub(crate) density: f64,
}

impl Hydrostatic {
    /// At the place `p`, for the density ρ₀ at no pressure. The depth is below the plane across gravity at the level.
    pub(crate) fn at(&self, p: [f64; 3], rest_density: f64) -> AtRest {
        let size = self.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        let along: f64 = self.gravity.iter().zip(p).map(|(g, x)| g * x).sum();
        // Gravity points down, the level is measured up.
        let depth = along / size + self.level;
        let pressure = rest_density * size * depth.max(0.0);
        let scale = rest_density * self.sound_speed * self.sound_speed / self.exponent;
        AtRest {
            pressure,
            density: rest_density * (1.0 + pressure / scale).powf(1.0 / self.exponent),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weight_of_the_column_above() {
        let water = Hydrostatic {
            gravity: vec![0.0, -9.81],
            level: 2.0,
            sound_speed: 50.0,
            exponent: 7.0,
        };
        let deep = water.at([0.3, 0.5, 0.0], 1000.0);
        assert!((deep.pressure - 1000.0 * 9.81 * 1.5).abs() < 1e-9);
        let back = 1000.0 * 2500.0 / 7.0 * ((deep.density / 1000.0).powi(7) - 1.0);
        assert!((back / deep.pressure - 1.0).abs() < 1e-12);
        let above = water.at([0.3, 2.5, 0.0], 1000.0);
        assert_eq!((above.pressure, above.density), (0.0, 1000.0));
    }
}
