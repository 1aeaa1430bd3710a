//! The quintic spline.

use std::f64::consts::PI;

use crate::Number;
use crate::kernel::{PIECES, Profile, Scaled, below, per_dimension};

/// The quintic spline M₆, support 3h (Negi & Ramachandran 2021, eq. 14; σ₃ in eq. 3 of their preprint is a
/// misprint).
///
/// w(q) = (3−q)⁵₊ − 6(2−q)⁵₊ + 15(1−q)⁵₊ with σ = 1/120, 7/(478π), 1/(120π).
pub type Quintic<const D: usize> = Scaled<QuinticProfile, D>;

/// The shape of [`Quintic`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct QuinticProfile;

impl<const D: usize> Profile<D> for QuinticProfile {
    const SUPPORT: f64 = 3.0;
    const SIGMA: f64 = per_dimension(D, [1.0 / 120.0, 7.0 / (478.0 * PI), 1.0 / (120.0 * PI)]);
    const STARTS: [f64; PIECES] = [0.0, 1.0, 2.0];
    const SLOPE: f64 = -5.0;

    // Value and slope share the fourth powers with their factors: w = Σ c_k (k−q)⁴ · (k−q), w' = −5 Σ c_k (k−q)⁴.
    #[inline(always)]
    fn value_and_slope<N: Number, const PIECE: usize>(r: N, inverse: N) -> (N, N) {
        let a = below(3.0, r, inverse);
        let a2 = a * a;
        let mut slope = a2 * a2;
        let mut value = slope * a;
        if PIECE < 2 {
            let b = below(2.0, r, inverse);
            let b2 = b * b;
            let b4 = b2 * b2 * r.constant(-6.0);
            slope = slope + b4;
            value = b4.multiply_add(b, value);
        }
        if PIECE < 1 {
            let c = below(1.0, r, inverse);
            let c2 = c * c;
            let c4 = c2 * c2 * r.constant(15.0);
            slope = slope + c4;
            value = c4.multiply_add(c, value);
        }
        (value, slope)
    }

    // −4 Σ c_k (k−q)³.
    #[inline(always)]
    fn curvature<N: Number, const PIECE: usize>(r: N, inverse: N) -> N {
        let a = below(3.0, r, inverse);
        let mut sum = a * a * a * r.constant(-4.0);
        if PIECE < 2 {
            let b = below(2.0, r, inverse);
            sum = (b * b * b).multiply_add(r.constant(24.0), sum);
        }
        if PIECE < 1 {
            let c = below(1.0, r, inverse);
            sum = (c * c * c).multiply_add(r.constant(-60.0), sum);
        }
        sum
    }
}
