//! Who is near whom: neighbours of particles in two and three dimensions.
//!
#![doc = include_str!("../README.md")]

mod arranged;
mod block;
mod bounds;
mod cell_list;
mod cells;
mod clusters;
mod domain;
pub mod fire;
pub mod gauss;
mod kd_tree;
mod octaves;
mod odometer;
pub mod point;
pub mod random;
mod reaches;
mod search;
pub mod words;

#[cfg(test)]
mod tests;

pub use arranged::Arranged;
pub use block::{Block, Blocks, GROUP, SHELLS};
pub use bounds::Bounds;
pub use cell_list::{CellList, Slot};
pub use domain::Domain;
pub use kd_tree::{Found, KdTree, KdTreeError};
pub use odometer::{Odometer, place_of};

/// Particles in a block: eight doubles fill an AVX-512 register, or two AVX ones.
pub const LANES: usize = 8;
