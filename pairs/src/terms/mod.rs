//! The terms of this crate.

mod density;
mod gradient;
mod repulsion;
mod variation;

pub use density::{Density, DensitySum};
pub use gradient::{Gradient, TargetGradient};
pub use repulsion::{Repulsion, RepulsionSum};
pub use variation::{Variation, VariationSum};
