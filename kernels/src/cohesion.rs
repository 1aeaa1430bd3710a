//! Akinci's cohesion profile.

use std::f64::consts::PI;

/// The cohesion profile of Akinci et al. (2013), in the form of paper 001 eq. 29.
///
/// With s = r/R and R the **support radius** (not a smoothing length):
/// C = 32/(π R^D) · (1−s)³s³ for ½ < s ≤ 1 and 32/(π R^D) · (2(1−s)³s³ − 1/64) for s ≤ ½.
/// It is negative (repels) near the origin, positive (attracts) farther out, and not a smoothing kernel: it does not
/// integrate to one and its slope jumps at s = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cohesion<const D: usize> {
    support: f64,
    scale: f64,
}

impl<const D: usize> Cohesion<D> {
    /// The profile of the given support radius (scene units, positive).
    pub fn new(support: f64) -> Self {
        Self {
            support,
            scale: 32.0 / (PI * support.powi(D as i32)),
        }
    }

    /// The support radius: zero from here on.
    pub fn support(&self) -> f64 {
        self.support
    }

    /// C(r), for `r ≥ 0`.
    #[inline(always)]
    pub fn value(&self, r: f64) -> f64 {
        let s = r / self.support;
        let t = (1.0 - s).max(0.0) * s;
        let cube = t * t * t;
        self.scale
            * if s > 0.5 {
                cube
            } else {
                2.0 * cube - 1.0 / 64.0
            }
    }

    /// dC/dr, for `r ≥ 0`.
    #[inline(always)]
    pub fn slope(&self, r: f64) -> f64 {
        let s = r / self.support;
        if s >= 1.0 {
            return 0.0;
        }
        let t = (1.0 - s) * s;
        let cube_slope = 3.0 * t * t * (1.0 - 2.0 * s);
        self.scale / self.support
            * if s > 0.5 {
                cube_slope
            } else {
                2.0 * cube_slope
            }
    }

    /// The gradient of C for `difference` = x_i − x_j; zero (not NaN) where the two coincide.
    pub fn gradient(&self, difference: [f64; D]) -> [f64; D] {
        let r = difference.iter().map(|d| d * d).sum::<f64>().sqrt();
        if r == 0.0 {
            return [0.0; D];
        }
        let slope_over_r = self.slope(r) / r;
        difference.map(|d| slope_over_r * d)
    }
}
