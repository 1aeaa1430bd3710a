//! Flows by smoothed particle hydrodynamics: with as much physics as it takes to see what a packing does to a flow.
//!
#![doc = include_str!("../README.md")]

mod edac;
mod eulerian;
mod fringe;
mod medium;
mod neighborhood;
mod parallel;
mod particles;
mod softening;
mod standard;
mod unstable;
mod walls;

pub use edac::{Edac, EdacRate, EdacSettings};
pub use eulerian::{Eulerian, EulerianSettings};
pub use fringe::Fringe;
pub use medium::{COURANT, Medium};
pub use particles::Particles;
pub use standard::{Standard, StandardRate, StandardSettings};
pub use unstable::Unstable;
