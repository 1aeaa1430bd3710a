//! The quintic spline.

use std::f64::consts::PI;

use crate::Number;
use crate::kernel::{Profile, Scaled, below, per_dimension};

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
    fn value<N: Number>(q: N) -> N {
        let (a, b, c) = (below(3.0, q), below(2.0, q), below(1.0, q));
        let (a2, b2, c2) = (a * a, b * b, c * c);
        let outer = (a2 * a2).multiply_add(a, q.constant(-6.0) * (b2 * b2 * b));
        (q.constant(15.0) * c2 * c2).multiply_add(c, outer)
    }

    #[inline(always)]
    fn slope_over_q<N: Number>(q: N) -> N {
        let (a, b, c) = (below(3.0, q), below(2.0, q), below(1.0, q));
        let (a2, b2, c2) = (a * a, b * b, c * c);
        let outer = (q.constant(30.0) * b2).multiply_add(b2, q.constant(-5.0) * a2 * a2);
        (q.constant(-75.0) * c2).multiply_add(c2, outer) / q
    }
}
