//! Lattice dynamics: the waves that a perfect lattice carries under background pressure, and which of them lower its energy.

mod cell;
mod matrix;
mod zone;

#[cfg(test)]
mod tests;

pub(crate) use cell::PrimitiveCell;
pub(crate) use matrix::{Crystal, Mode};
pub(crate) use zone::softest;

/// A lattice is stable where its least eigenvalue over the greatest is above this: below, it is negative beyond rounding.
pub(crate) const UNSTABLE: f64 = -1e-9;
