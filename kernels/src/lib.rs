//! Smoothing kernels for SPH in one, two and three dimensions.
//!
//! A kernel W(r, h) = σ h^−D w(r/h) weighs a neighbour at distance `r`; it is zero beyond its *support radius*, a fixed
//! multiple of the *smoothing length* `h`. All kernels here are positive, fall monotonically, integrate to one and have
//! a continuous slope; [`Cohesion`] is a force profile that borrows the name and is exempt.
//!
//! ```
//! use sphpack_kernels::{Kernel, Quintic};
//!
//! let w = Quintic::<2>::new(0.12); // smoothing length, scene units
//! assert_eq!(w.support(), 3.0 * 0.12);
//! let (value, slope) = (w.value(0.1), w.slope(0.1));
//! assert!(value > 0.0 && slope < 0.0);
//! assert_eq!(w.value(0.5), 0.0);
//! ```
//!
//! | type | support / h | order of smoothness | source |
//! |---|---|---|---|
//! | [`Quintic`] | 3 | C⁴ | spline M₆; paper 001 eq. 14 |
//! | [`Cubic`] | 2 | C² | spline M₄ |
//! | [`WendlandC2`] | 2 | C² | Wendland 1995; normalisations of Dehnen & Aly 2012, table 1 |
//! | [`WendlandC4`] | 2 | C⁴ | same |
//! | [`WendlandC6`] | 2 | C⁶ | same |
//! | [`Cohesion`] | 1 | C⁰ | Akinci et al. 2013; paper 001 eq. 29 |
//!
//! Invariants: nothing here allocates, nothing panics for finite input, and the crate depends on nothing.

mod cohesion;
mod cubic;
mod kernel;
mod kind;
mod number;
mod quintic;
mod wendland;

#[cfg(test)]
mod tests;

pub use cohesion::{Cohesion, CohesionPotential, CohesionProfile};
pub use cubic::{Cubic, CubicProfile};
pub use kernel::{Kernel, PIECES, Profile, SMALLEST_Q, Scaled};
pub use kind::{KernelKind, UnknownKernel, WithKernel};
pub use number::Number;
pub use quintic::{Quintic, QuinticProfile};
pub use wendland::{
    WendlandC2, WendlandC2Profile, WendlandC4, WendlandC4Profile, WendlandC6, WendlandC6Profile,
};
