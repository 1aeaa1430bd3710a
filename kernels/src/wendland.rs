//! Wendland's kernels, support 2h; with s = q/2. The 1-D members are other polynomials than those of 2-D and 3-D.
//! Normalisations: Dehnen & Aly (2012), table 1, rescaled from the support radius to h = half of it.

use std::f64::consts::PI;

use crate::Number;
use crate::kernel::{PIECES, Profile, Scaled, per_dimension};

/// C2: (1−s)³(1+3s) in 1-D, (1−s)⁴(1+4s) in 2-D and 3-D; σ = 5/8, 7/(4π), 21/(16π).
pub type WendlandC2<const D: usize> = Scaled<WendlandC2Profile, D>;
/// C4: (1−s)⁵(1+5s+8s²) in 1-D, (1−s)⁶(1+6s+35s²/3) in 2-D and 3-D; σ = 3/4, 9/(4π), 495/(256π).
pub type WendlandC4<const D: usize> = Scaled<WendlandC4Profile, D>;
/// C6: (1−s)⁷(1+7s+19s²+21s³) in 1-D, (1−s)⁸(1+8s+25s²+32s³) in 2-D and 3-D; σ = 55/64, 39/(14π), 1365/(512π).
pub type WendlandC6<const D: usize> = Scaled<WendlandC6Profile, D>;

/// The shape of [`WendlandC2`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct WendlandC2Profile;

/// The shape of [`WendlandC4`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct WendlandC4Profile;

/// The shape of [`WendlandC6`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct WendlandC6Profile;

/// One formula from the centre to the support.
const ONE_PIECE: [f64; PIECES] = [0.0; PIECES];

/// 1 − s, s and q for s = q/2, the first cut at zero.
#[inline(always)]
fn inward<N: Number>(r: N, inverse: N) -> (N, N, N) {
    let q = r * inverse;
    let s = q * q.constant(0.5);
    ((q.constant(1.0) - s).positive(), s, q)
}

/// The slope of tⁿ q P(s), `power` being tⁿ⁻¹: tⁿ P − q tⁿ⁻¹ n P/2 + q tⁿ P′/2.
#[inline(always)]
fn slope_of<N: Number, const M: usize>(
    (t, s, q): (N, N, N),
    (n, power): (f64, N),
    coefficients: [f64; M],
) -> N {
    let p = polynomial(s, coefficients);
    let mut slope = s.constant(0.0);
    for k in (1..M).rev() {
        slope = slope.multiply_add(s, s.constant(0.5 * k as f64 * coefficients[k]));
    }
    let inner = (t - q * q.constant(0.5 * n)) * p;
    power * (q * t).multiply_add(slope, inner)
}

/// c₀ + c₁ s + c₂ s² + …
#[inline(always)]
fn polynomial<N: Number, const M: usize>(s: N, coefficients: [f64; M]) -> N {
    let mut sum = s.constant(0.0);
    for c in coefficients.into_iter().rev() {
        sum = sum.multiply_add(s, s.constant(c));
    }
    sum
}

impl<const D: usize> Profile<D> for WendlandC2Profile {
    const SUPPORT: f64 = 2.0;
    const SIGMA: f64 = per_dimension(D, [5.0 / 8.0, 7.0 / (4.0 * PI), 21.0 / (16.0 * PI)]);
    const STARTS: [f64; PIECES] = ONE_PIECE;
    const SLOPE: f64 = per_dimension(D, [-3.0, -5.0, -5.0]);

    #[inline(always)]
    fn value_and_slope<N: Number, const PIECE: usize>(r: N, inverse: N) -> (N, N) {
        let (t, s, q) = inward(r, inverse);
        let t2 = t * t;
        if D == 1 {
            (t2 * t * polynomial(s, [1.0, 3.0]), t2 * q)
        } else {
            (t2 * t2 * polynomial(s, [1.0, 4.0]), t2 * t * q)
        }
    }

    #[inline(always)]
    fn curvature<N: Number, const PIECE: usize>(r: N, inverse: N) -> N {
        let all @ (t, ..) = inward(r, inverse);
        if D == 1 {
            slope_of(all, (2.0, t), [1.0])
        } else {
            slope_of(all, (3.0, t * t), [1.0])
        }
    }
}

impl<const D: usize> Profile<D> for WendlandC4Profile {
    const SUPPORT: f64 = 2.0;
    const SIGMA: f64 = per_dimension(D, [3.0 / 4.0, 9.0 / (4.0 * PI), 495.0 / (256.0 * PI)]);
    const STARTS: [f64; PIECES] = ONE_PIECE;
    const SLOPE: f64 = per_dimension(D, [-3.5, -14.0 / 3.0, -14.0 / 3.0]);

    #[inline(always)]
    fn value_and_slope<N: Number, const PIECE: usize>(r: N, inverse: N) -> (N, N) {
        let (t, s, q) = inward(r, inverse);
        let t2 = t * t;
        let t4 = t2 * t2;
        if D == 1 {
            (
                t4 * t * polynomial(s, [1.0, 5.0, 8.0]),
                t4 * q * polynomial(s, [1.0, 4.0]),
            )
        } else {
            (
                t4 * t2 * polynomial(s, [1.0, 6.0, 35.0 / 3.0]),
                t4 * t * q * polynomial(s, [1.0, 5.0]),
            )
        }
    }

    #[inline(always)]
    fn curvature<N: Number, const PIECE: usize>(r: N, inverse: N) -> N {
        let all @ (t, ..) = inward(r, inverse);
        let t2 = t * t;
        if D == 1 {
            slope_of(all, (4.0, t2 * t), [1.0, 4.0])
        } else {
            slope_of(all, (5.0, t2 * t2), [1.0, 5.0])
        }
    }
}

impl<const D: usize> Profile<D> for WendlandC6Profile {
    const SUPPORT: f64 = 2.0;
    const SIGMA: f64 = per_dimension(D, [55.0 / 64.0, 39.0 / (14.0 * PI), 1365.0 / (512.0 * PI)]);
    const STARTS: [f64; PIECES] = ONE_PIECE;
    const SLOPE: f64 = per_dimension(D, [-4.5, -5.5, -5.5]);

    #[inline(always)]
    fn value_and_slope<N: Number, const PIECE: usize>(r: N, inverse: N) -> (N, N) {
        let (t, s, q) = inward(r, inverse);
        let t2 = t * t;
        let t4 = t2 * t2;
        if D == 1 {
            (
                t4 * t2 * t * polynomial(s, [1.0, 7.0, 19.0, 21.0]),
                t4 * t2 * q * polynomial(s, [1.0, 6.0, 52.5 / 4.5]),
            )
        } else {
            (
                t4 * t4 * polynomial(s, [1.0, 8.0, 25.0, 32.0]),
                t4 * t2 * t * q * polynomial(s, [1.0, 7.0, 16.0]),
            )
        }
    }

    #[inline(always)]
    fn curvature<N: Number, const PIECE: usize>(r: N, inverse: N) -> N {
        let all @ (t, ..) = inward(r, inverse);
        let t2 = t * t;
        let t4 = t2 * t2;
        if D == 1 {
            slope_of(all, (6.0, t4 * t), [1.0, 6.0, 52.5 / 4.5])
        } else {
            slope_of(all, (7.0, t4 * t2), [1.0, 7.0, 16.0])
        }
    }
}
