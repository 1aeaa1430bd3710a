//! Wendland's kernels, support 2h; with s = q/2. The 1-D members are other polynomials than those of 2-D and 3-D.
//! Normalisations: Dehnen & Aly (2012), table 1, rescaled from the support radius to h = half of it.

use std::f64::consts::PI;

use crate::kernel::{Profile, Scaled, per_dimension};

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

impl<const D: usize> Profile<D> for WendlandC2Profile {
    const SUPPORT: f64 = 2.0;
    const SIGMA: f64 = per_dimension(D, [5.0 / 8.0, 7.0 / (4.0 * PI), 21.0 / (16.0 * PI)]);

    #[inline(always)]
    fn value(q: f64) -> f64 {
        let s = 0.5 * q;
        let t = (1.0 - s).max(0.0);
        let t2 = t * t;
        if D == 1 {
            t2 * t * (1.0 + 3.0 * s)
        } else {
            t2 * t2 * (1.0 + 4.0 * s)
        }
    }

    #[inline(always)]
    fn slope_over_q(q: f64) -> f64 {
        let t = (1.0 - 0.5 * q).max(0.0);
        // dw/dq / q = (dw/ds / s) / 4
        if D == 1 {
            -3.0 * t * t
        } else {
            -5.0 * t * t * t
        }
    }
}

impl<const D: usize> Profile<D> for WendlandC4Profile {
    const SUPPORT: f64 = 2.0;
    const SIGMA: f64 = per_dimension(D, [3.0 / 4.0, 9.0 / (4.0 * PI), 495.0 / (256.0 * PI)]);

    #[inline(always)]
    fn value(q: f64) -> f64 {
        let s = 0.5 * q;
        let t = (1.0 - s).max(0.0);
        let (t2, s2) = (t * t, s * s);
        if D == 1 {
            t2 * t2 * t * (1.0 + 5.0 * s + 8.0 * s2)
        } else {
            t2 * t2 * t2 * (1.0 + 6.0 * s + (35.0 / 3.0) * s2)
        }
    }

    #[inline(always)]
    fn slope_over_q(q: f64) -> f64 {
        let s = 0.5 * q;
        let t = (1.0 - s).max(0.0);
        let t4 = (t * t) * (t * t);
        if D == 1 {
            -3.5 * (1.0 + 4.0 * s) * t4
        } else {
            -(14.0 / 3.0) * (1.0 + 5.0 * s) * t4 * t
        }
    }
}

impl<const D: usize> Profile<D> for WendlandC6Profile {
    const SUPPORT: f64 = 2.0;
    const SIGMA: f64 = per_dimension(D, [55.0 / 64.0, 39.0 / (14.0 * PI), 1365.0 / (512.0 * PI)]);

    #[inline(always)]
    fn value(q: f64) -> f64 {
        let s = 0.5 * q;
        let t = (1.0 - s).max(0.0);
        let t2 = t * t;
        let t4 = t2 * t2;
        if D == 1 {
            t4 * t2 * t * (1.0 + s * (7.0 + s * (19.0 + s * 21.0)))
        } else {
            t4 * t4 * (1.0 + s * (8.0 + s * (25.0 + s * 32.0)))
        }
    }

    #[inline(always)]
    fn slope_over_q(q: f64) -> f64 {
        let s = 0.5 * q;
        let t = (1.0 - s).max(0.0);
        let t2 = t * t;
        let t6 = t2 * t2 * t2;
        if D == 1 {
            -1.5 * (3.0 + s * (18.0 + s * 35.0)) * t6
        } else {
            -5.5 * (1.0 + s * (7.0 + s * 16.0)) * t6 * t
        }
    }
}
