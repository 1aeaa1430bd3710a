//! Pressure and density of a weakly compressible fluid (Cole's and Tait's equation).

use crate::medium::Medium;

/// γ, as for water.
const EXPONENT: i32 = 7;

impl<const D: usize> Medium<D> {
    /// p = (c²ρ₀/γ)((ρ/ρ₀)^γ − 1) with γ = 7.
    pub fn pressure_at(&self, density: f64) -> f64 {
        self.stiffness() * ((density / self.density).powi(EXPONENT) - 1.0)
    }

    /// The density of that pressure: masses of a flow that begins under it are this times the volumes.
    pub fn density_at(&self, pressure: f64) -> f64 {
        let ratio = 1.0 + pressure / self.stiffness();
        self.density * ratio.powf(1.0 / f64::from(EXPONENT))
    }

    fn stiffness(&self) -> f64 {
        self.density * self.sound_speed * self.sound_speed / f64::from(EXPONENT)
    }
}
