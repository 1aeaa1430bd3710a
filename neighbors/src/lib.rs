//! Who is near whom: neighbours of particles in two and three dimensions.
//!
//! - [`CellList`]: for sets that move. Flat arrays, a skin so that one list lasts several steps, optional periodic
//!   axes; the pair loop runs over blocks of [`LANES`] particles against their shared candidates.
//! - [`KdTree`]: for sets that stand still. Nearest points and points within a radius.
//! - [`point`], [`Bounds`], [`Domain`]: arithmetic on `[f64; D]`, boxes, boxes with periodic axes.
//! - [`Odometer`], [`place_of`]: loops over the places of a grid.
//! - [`gauss`], [`random`]: nodes of a rule for integrals; numbers that look random.
//! - [`words`]: places and boxes as people read them.
//!
//! Invariants: the answer never depends on the number of threads; a list that is up to date is not built again, and
//! using one does not allocate.

mod block;
mod bounds;
mod cell_list;
mod cells;
mod clusters;
mod domain;
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

pub use block::{Block, Blocks, GROUP, SHELLS};
pub use bounds::Bounds;
pub use cell_list::{CellList, Slot};
pub use domain::Domain;
pub use kd_tree::{Found, KdTree, KdTreeError};
pub use odometer::{Odometer, place_of};

/// Particles in a block: eight doubles fill an AVX-512 register, or two AVX ones.
pub const LANES: usize = 8;
