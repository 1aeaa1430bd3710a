//! Which particle belongs to which body, and which to the fluid.
//!
#![doc = include_str!("../README.md")]

mod flood;
mod labels;

#[cfg(test)]
mod tests;

pub use flood::separate_by_flood;
pub use labels::{Labels, SeparationError, Side, UnknownSide, separate, separate_with_on_surface};
