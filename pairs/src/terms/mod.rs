//! The terms of this crate.

mod density;
mod gradient;
mod repulsion;
mod sized;
mod variation;

pub use density::{Density, DensitySum};
pub use gradient::{Gradient, TargetGradient};
pub use repulsion::{Repulsion, RepulsionSum};
pub use sized::{
    DensityBy, DensityBySum, Gather, Length, Mean, Scatter, SizedRepulsion, SizedRepulsionSum,
};
pub use variation::{Variation, VariationSum};
