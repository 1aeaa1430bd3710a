//! The fluid, and how far a time step may go.

/// What is the same for all particles of a flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium<const D: usize> {
    /// The smoothing length h of the quintic spline; 1.2 particle spacings in the papers.
    pub smoothing_length: f64,
    /// The density ρ₀ at no pressure.
    pub density: f64,
    /// The speed of sound c: ten times the largest speed expected in the flow, so that the density varies by one per cent.
    pub sound_speed: f64,
    /// The body force per mass, gravity for one.
    pub force: [f64; D],
}

/// The Courant number that pressure waves get. The papers have 0.25.
pub const COURANT: f64 = 0.4;

impl<const D: usize> Medium<D> {
    /// ∆t = min(C h/(c + U), 0.125 h²/ν, 0.25 √(h/g)) for the largest speed U and the kinematic viscosity ν; C is [`COURANT`], or
    /// as the papers have it.
    pub fn time_step(&self, courant: f64, fastest: f64, viscosity: f64) -> f64 {
        let h = self.smoothing_length;
        let force = self.force.iter().map(|g| g * g).sum::<f64>().sqrt();
        // A quotient by zero is infinite and binds nothing.
        (courant * h / (self.sound_speed + fastest))
            .min(0.125 * h * h / viscosity)
            .min(0.25 * (h / force).sqrt())
    }
}
