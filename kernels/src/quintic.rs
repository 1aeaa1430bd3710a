//! The quintic spline.

use std::f64::consts::PI;

use crate::kernel::{Profile, Scaled, per_dimension};

/// The quintic spline M₆, support 3h (paper 001 eq. 14; σ₃ of paper 000 eq. 3 is a misprint).
///
/// w(q) = (3−q)⁵₊ − 6(2−q)⁵₊ + 15(1−q)⁵₊ with σ = 1/120, 7/(478π), 1/(120π).
pub type Quintic<const D: usize> = Scaled<QuinticProfile, D>;

/// The shape of [`Quintic`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct QuinticProfile;

impl<const D: usize> Profile<D> for QuinticProfile {
    const SUPPORT: f64 = 3.0;
    const SIGMA: f64 = per_dimension(D, [1.0 / 120.0, 7.0 / (478.0 * PI), 1.0 / (120.0 * PI)]);

    #[inline(always)]
    fn value(q: f64) -> f64 {
        let (a, b, c) = ((3.0 - q).max(0.0), (2.0 - q).max(0.0), (1.0 - q).max(0.0));
        let (a2, b2, c2) = (a * a, b * b, c * c);
        a2 * a2 * a - 6.0 * (b2 * b2 * b) + 15.0 * (c2 * c2 * c)
    }

    #[inline(always)]
    fn slope_over_q(q: f64) -> f64 {
        let (a, b, c) = ((3.0 - q).max(0.0), (2.0 - q).max(0.0), (1.0 - q).max(0.0));
        let (a2, b2, c2) = (a * a, b * b, c * c);
        -5.0 * (a2 * a2 - 6.0 * (b2 * b2) + 15.0 * (c2 * c2)) / q
    }
}
