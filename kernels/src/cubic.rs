//! The cubic spline.

use std::f64::consts::PI;

use crate::Number;
use crate::kernel::{PIECES, Profile, Scaled, below, per_dimension};

/// The cubic spline M₄, support 2h: w(q) = ¼(2−q)³₊ − (1−q)³₊ with σ = 2/3, 10/(7π), 1/π.
pub type Cubic<const D: usize> = Scaled<CubicProfile, D>;

/// The shape of [`Cubic`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CubicProfile;

impl<const D: usize> Profile<D> for CubicProfile {
    const SUPPORT: f64 = 2.0;
    const SIGMA: f64 = per_dimension(D, [2.0 / 3.0, 10.0 / (7.0 * PI), 1.0 / PI]);
    const STARTS: [f64; PIECES] = [0.0, 1.0, 1.0];
    const SLOPE: f64 = -3.0;

    #[inline(always)]
    fn value_and_slope<N: Number, const PIECE: usize>(r: N, inverse: N) -> (N, N) {
        let a = below(2.0, r, inverse);
        let mut slope = r.constant(0.25) * a * a;
        let mut value = slope * a;
        if PIECE < 1 {
            let b = below(1.0, r, inverse);
            let b2 = b * b;
            slope = slope - b2;
            value = value - b2 * b;
        }
        (value, slope)
    }

    #[inline(always)]
    fn curvature<N: Number, const PIECE: usize>(r: N, inverse: N) -> N {
        let mut sum = below(2.0, r, inverse) * r.constant(-0.5);
        if PIECE < 1 {
            sum = below(1.0, r, inverse).multiply_add(r.constant(2.0), sum);
        }
        sum
    }
}
