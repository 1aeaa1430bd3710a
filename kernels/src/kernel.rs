//! The kernel interface, and the one type that scales a dimensionless profile to a smoothing length.

use std::fmt::Debug;
use std::marker::PhantomData;

use crate::Number;

/// A radial smoothing kernel in `D` dimensions, fixed to a smoothing length.
///
/// Distances and smoothing lengths share a unit; values have that unit to the power −D.
///
/// ```
/// use sphpack_kernels::{Cubic, Kernel};
///
/// let w = Cubic::<3>::new(0.2);
/// let (value, slope_over_r) = w.value_and_slope_over_r(0.1 * 0.1);
/// assert!((value - w.value(0.1)).abs() < 1e-12 * value);
/// assert!((0.1 * slope_over_r - w.slope(0.1)).abs() < 1e-12 * value / 0.2);
/// // ∇W points to where W is larger: from x_i towards x_j.
/// assert!(w.gradient([0.1, 0.0, 0.0])[0] < 0.0);
/// ```
pub trait Kernel<const D: usize>: Copy + Debug + Send + Sync {
    /// The shape, in units of h. Pair loops work with it and scale sums instead of terms: W = [`Kernel::scale`] · w(q),
    /// dW/dr = [`Kernel::scale`] / h · w'(q).
    type Profile: Profile<D>;

    /// The smoothing length h.
    fn smoothing_length(&self) -> f64;

    /// σ/h^D.
    fn scale(&self) -> f64;

    /// The support radius: the kernel is zero from here on.
    fn support(&self) -> f64;

    /// W(r); 0 for `r` beyond the support. `r ≥ 0`.
    fn value(&self, r: f64) -> f64;

    /// dW/dr; 0 beyond the support and at `r = 0`.
    fn slope(&self, r: f64) -> f64;

    /// d²W/dr²; 0 beyond the support. At a join where it jumps, either side's.
    fn curvature(&self, r: f64) -> f64;

    /// [`Kernel::value`] and [`Kernel::slope`] together.
    #[inline]
    fn value_and_slope(&self, r: f64) -> (f64, f64) {
        (self.value(r), self.slope(r))
    }

    /// W and (dW/dr)/r from the **squared** distance, without branches: what a pair loop needs, since
    /// ∇W = (dW/dr)/r · (x_i − x_j). The second is finite at `r = 0`.
    fn value_and_slope_over_r(&self, r_squared: f64) -> (f64, f64);

    /// W(0), a particle's own share of its summation density.
    fn value_at_origin(&self) -> f64 {
        self.value(0.0)
    }

    /// ∇_iW_ij for `difference` = x_i − x_j; zero (not NaN) where the two coincide.
    fn gradient(&self, difference: [f64; D]) -> [f64; D] {
        let r_squared: f64 = difference.iter().map(|d| d * d).sum();
        let (_, slope_over_r) = self.value_and_slope_over_r(r_squared);
        difference.map(|d| slope_over_r * d)
    }

    /// ∇∇W for `difference` = x_i − x_j: (W″ − W′/r) e⊗e + (W′/r) I; (W′/r) I where the two coincide.
    fn hessian(&self, difference: [f64; D]) -> [[f64; D]; D] {
        let r_squared: f64 = difference.iter().map(|d| d * d).sum();
        let (_, over_r) = self.value_and_slope_over_r(r_squared);
        let along = if r_squared > 0.0 {
            (self.curvature(r_squared.sqrt()) - over_r) / r_squared
        } else {
            0.0
        };
        std::array::from_fn(|k| {
            std::array::from_fn(|l| {
                let both = along * difference[k] * difference[l];
                both + if k == l { over_r } else { 0.0 }
            })
        })
    }
}

/// The shape of a kernel in units of h: w(q) with q = r/h.
pub trait Profile<const D: usize>: Copy + Debug + Default + Send + Sync {
    /// Support radius in units of h.
    const SUPPORT: f64;
    /// The normalisation σ, so that ∫ σ w(|x|) dx = 1 over ℝ^D.
    const SIGMA: f64;
    /// Where each piece begins, in units of h, ascending from 0: from `STARTS[p]` on piece p is exact, and no dearer than
    /// the pieces before it.
    const STARTS: [f64; PIECES];
    /// The factor that [`Profile::value_and_slope`] leaves out of the slope.
    const SLOPE: f64;

    /// w(q) and w'(q)/[`Profile::SLOPE`] for q = r · `inverse` with `q ≥ STARTS[PIECE]`; zero for
    /// q ≥ [`Profile::SUPPORT`]. `inverse` is 1/h, which may differ from number to number.
    fn value_and_slope<N: Number, const PIECE: usize>(r: N, inverse: N) -> (N, N);

    /// w″(q)/[`Profile::SLOPE`], otherwise as [`Profile::value_and_slope`].
    fn curvature<N: Number, const PIECE: usize>(r: N, inverse: N) -> N;
}

/// How many pieces a profile may have.
pub const PIECES: usize = 3;

/// A profile scaled to a smoothing length; the concrete kernels are aliases of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scaled<P, const D: usize> {
    smoothing_length: f64,
    inverse: f64,
    scale: f64,
    slope_scale: f64,
    profile: PhantomData<P>,
}

impl<P: Profile<D>, const D: usize> Scaled<P, D> {
    /// The kernel of smoothing length `h` (scene units, positive).
    #[must_use]
    pub fn new(h: f64) -> Self {
        let scale = P::SIGMA / h.powi(D as i32);
        Self {
            smoothing_length: h,
            inverse: 1.0 / h,
            scale,
            slope_scale: scale * P::SLOPE / (h * h),
            profile: PhantomData,
        }
    }
}

/// Below this q the slope is taken at this q: the quotient w'(q)/q would lose its digits, its limit is reached.
pub const SMALLEST_Q: f64 = 1e-8;

impl<P: Profile<D>, const D: usize> Kernel<D> for Scaled<P, D> {
    type Profile = P;

    #[inline(always)]
    fn smoothing_length(&self) -> f64 {
        self.smoothing_length
    }

    #[inline(always)]
    fn scale(&self) -> f64 {
        self.scale
    }

    #[inline(always)]
    fn support(&self) -> f64 {
        P::SUPPORT * self.smoothing_length
    }

    #[inline(always)]
    fn value(&self, r: f64) -> f64 {
        self.scale * P::value_and_slope::<f64, 0>(r, self.inverse).0
    }

    #[inline(always)]
    fn slope(&self, r: f64) -> f64 {
        self.value_and_slope_over_r(r * r).1 * r
    }

    #[inline(always)]
    fn curvature(&self, r: f64) -> f64 {
        self.slope_scale * P::curvature::<f64, 0>(r, self.inverse)
    }

    #[inline(always)]
    fn value_and_slope_over_r(&self, r_squared: f64) -> (f64, f64) {
        let q_squared = r_squared * (self.inverse * self.inverse);
        let q = q_squared.at_least(SMALLEST_Q * SMALLEST_Q).sqrt();
        let (value, slope) = P::value_and_slope::<f64, 0>(q, 1.0);
        (self.scale * value, self.slope_scale * slope / q)
    }
}

/// Picks the entry of a table for 1, 2, 3 dimensions; other dimensions fail to compile.
pub(crate) const fn per_dimension(dimension: usize, table: [f64; 3]) -> f64 {
    assert!(
        dimension >= 1 && dimension <= 3,
        "kernels exist in 1, 2 and 3 dimensions"
    );
    table[dimension - 1]
}

/// max(join − r/h, 0), the piece of a spline below its join.
#[inline(always)]
pub(crate) fn below<N: Number>(join: f64, r: N, inverse: N) -> N {
    r.multiply_add(-inverse, r.constant(join)).positive()
}
