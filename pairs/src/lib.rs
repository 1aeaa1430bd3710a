//! Sums over pairs of particles, term by term.
//!
#![doc = include_str!("../README.md")]

mod fields;
mod gathered;
mod group;
mod lanes;
mod packing_sums;
mod term;
mod terms;
mod walk;

pub use fearless_simd;
pub use fields::{Fields, Pairs};
pub use gathered::{Gathered, unit};
pub use group::{Group, Scale, Targets, Values};
pub use lanes::Several;
pub use packing_sums::{PackingSum, PackingSums, PackingTerms, Shape, SizedSum};
pub use term::Term;
pub use terms::{
    Density, DensityBy, DensityBySum, DensitySum, Gather, Gradient, Length, Mean, Repulsion,
    RepulsionSum, Scatter, SizedRepulsion, SizedRepulsionSum, TargetGradient, Variation,
    VariationSum,
};
pub use walk::{shells, walk};
