//! How fast FIRE goes: the part of the fast inertial relaxation engine that knows no particles.

/// The time step of FIRE and how much of the velocity is turned along the force (Bitzek, Koskinen, Gähler, Moseler, Gumbsch,
/// "Structural relaxation made simple", Physical Review Letters 97, 170201, 2006; their constants).
///
/// ```
/// use sphpack_neighbors::fire::Fire;
///
/// let mut fire = Fire::new(0.1, [0.01, 1.0]);
/// for _ in 0..6 {
///     fire.downhill();
/// }
/// assert!(fire.step > 0.1 && fire.mixing < 0.1);
/// fire.uphill();
/// assert!(fire.step < 0.1 && fire.mixing == 0.1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fire {
    /// The time step.
    pub step: f64,
    /// The part of the velocity that is turned along the force.
    pub mixing: f64,
    /// Steps since the last one uphill.
    pub patience: usize,
    /// The shortest and the longest step.
    range: [f64; 2],
}

const MIXING: f64 = 0.1;
const MIXING_DECAY: f64 = 0.99;
const GROWTH: f64 = 1.1;
const SHRINKAGE: f64 = 0.5;
const PATIENCE: usize = 5;

impl Fire {
    /// Begins with a step, which stays within a range.
    pub fn new(step: f64, range: [f64; 2]) -> Self {
        Self {
            step,
            mixing: MIXING,
            patience: 0,
            range,
        }
    }

    /// Velocity and force agree: steps grow after a few of these.
    pub fn downhill(&mut self) {
        self.patience += 1;
        if self.patience > PATIENCE {
            self.step = (self.step * GROWTH).min(self.range[1]);
            self.mixing *= MIXING_DECAY;
        }
    }

    /// Velocity and force are at odds: smaller steps again. The velocity should be dropped.
    pub fn uphill(&mut self) {
        self.patience = 0;
        self.step = (self.step * SHRINKAGE).max(self.range[0]);
        self.mixing = MIXING;
    }
}
