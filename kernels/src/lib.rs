//! Smoothing kernels for SPH in one, two and three dimensions.
//!
#![doc = include_str!("../README.md")]

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
