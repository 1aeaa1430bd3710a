//! Akinci's cohesion profile.

use std::f64::consts::PI;

use crate::Number;
use crate::kernel::{PIECES, Profile, Scaled, below};

/// The potential of the cohesion, for pair loops that sum slopes: R times its slope is [`Cohesion`]'s C, its value zero
/// from the support radius R on, which is its length h.
pub type CohesionPotential<const D: usize> = Scaled<CohesionProfile, D>;

/// The shape of [`CohesionPotential`]: with s = r/R, 32/π ∫ (1−s)³s³ + ((1−s)³s³ − 1/64 where s < ½) ds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CohesionProfile;

impl<const D: usize> Profile<D> for CohesionProfile {
    const SUPPORT: f64 = 1.0;
    // A potential has no integral of one; its scale is such that its slope is C/R.
    const SIGMA: f64 = 1.0;
    const STARTS: [f64; PIECES] = [0.0, 0.5, 0.5];
    const SLOPE: f64 = 32.0 / PI;

    #[inline(always)]
    fn value_and_slope<N: Number, const PIECE: usize>(r: N, inverse: N) -> (N, N) {
        // u³(1−u)³ with u = 1 − s, and its integral from 0 to u.
        let u = below(1.0, r, inverse);
        let s = r.constant(1.0) - u;
        let us = u * s;
        let mut slope = us * us * us;
        let u4 = u * u * (u * u);
        let part = u.multiply_add(r.constant(-1.0 / 7.0), r.constant(0.5));
        let part = part.multiply_add(u, r.constant(-0.6));
        let part = part.multiply_add(u, r.constant(0.25));
        let mut value = r.constant(0.0) - part * u4;
        if PIECE < 1 {
            // us = ¼ − t² with t = ½ − s: u³s³ − 1/64 = −t²(3/16 − ¾t² + t⁴), and its integral from 0 to t.
            let t = below(0.5, r, inverse);
            let t2 = t * t;
            let well = t2.multiply_add(r.constant(1.0), r.constant(-0.75));
            let well = well.multiply_add(t2, r.constant(3.0 / 16.0)) * t2;
            slope = slope - well;
            let deep = t2.multiply_add(r.constant(1.0 / 7.0), r.constant(-0.15));
            let deep = deep.multiply_add(t2, r.constant(1.0 / 16.0)) * t2 * t;
            value = value + deep;
        }
        (value * r.constant(32.0 / PI), slope)
    }

    // Of u³s³: 3 u²s² (u − s), and as much again where s < ½.
    #[inline(always)]
    fn curvature<N: Number, const PIECE: usize>(r: N, inverse: N) -> N {
        let u = below(1.0, r, inverse);
        let s = r.constant(1.0) - u;
        let us = u * s;
        let mut sum = us * us * (u - s) * r.constant(3.0);
        if PIECE < 1 {
            let t = below(0.5, r, inverse);
            let us = r.constant(0.25) - t * t;
            sum = (us * us * t).multiply_add(r.constant(6.0), sum);
        }
        sum
    }
}

/// The cohesion profile of Akinci et al. (2013), in the form of Negi & Ramachandran (2021), eq. 29.
///
/// With s = r/R and R the **support radius** (not a smoothing length):
/// C = 32/(π R^D) · (1−s)³s³ for ½ < s ≤ 1 and 32/(π R^D) · (2(1−s)³s³ − 1/64) for s ≤ ½.
/// It is negative (repels) near the origin, positive (attracts) farther out, and not a smoothing kernel: it does not
/// integrate to one and its slope jumps at s = 0.
///
/// ```
/// use sphpack_kernels::Cohesion;
///
/// let c = Cohesion::<3>::new(0.5); // zero from r = 0.5 on
/// assert!(c.value(0.05) < 0.0 && c.value(0.25) > 0.0);
/// assert_eq!(c.value(0.5), 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cohesion<const D: usize> {
    support: f64,
    scale: f64,
}

impl<const D: usize> Cohesion<D> {
    /// The profile of the given support radius (scene units, positive).
    #[must_use]
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
