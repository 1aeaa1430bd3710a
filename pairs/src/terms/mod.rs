//! The terms of this crate.

mod density;
mod gradient;
mod repulsion;

pub use density::{Density, DensitySum};
pub use gradient::{Gradient, TargetGradient};
pub use repulsion::{Repulsion, RepulsionSum};
