//! The cubic spline.

use std::f64::consts::PI;

use crate::Number;
use crate::kernel::{Profile, Scaled, below, per_dimension};

/// The cubic spline M₄, support 2h: w(q) = ¼(2−q)³₊ − (1−q)³₊ with σ = 2/3, 10/(7π), 1/π.
pub type Cubic<const D: usize> = Scaled<CubicProfile, D>;

/// The shape of [`Cubic`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CubicProfile;

impl<const D: usize> Profile<D> for CubicProfile {
    const SUPPORT: f64 = 2.0;
    const SIGMA: f64 = per_dimension(D, [2.0 / 3.0, 10.0 / (7.0 * PI), 1.0 / PI]);

    #[inline(always)]
    fn value<N: Number>(q: N) -> N {
        let (a, b) = (below(2.0, q), below(1.0, q));
        q.constant(0.25) * a * a * a - b * b * b
    }

    #[inline(always)]
    fn slope_over_q<N: Number>(q: N) -> N {
        let (a, b) = (below(2.0, q), below(1.0, q));
        (q.constant(3.0) * b * b - q.constant(0.75) * a * a) / q
    }
}
