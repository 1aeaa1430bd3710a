//! The papers' methods, to compare with, and the pieces that only they use.

mod accelerations;
mod agitated;
mod captured;
mod clipped;
mod complex;
mod confined;
mod coupled;
mod fluid_side;
mod hybrid;
mod log;
mod motion;
mod ppa;
mod put_back;
mod relaxation;
mod standard;
#[cfg(test)]
mod tests;
mod triangulated;
mod watch;

pub use agitated::{Agitated, Agitators};
pub use clipped::Clipped;
pub use complex::Complex;
pub use coupled::Coupled;
pub use hybrid::Hybrid;
pub use ppa::Ppa;
pub use relaxation::Relaxation;
pub use standard::Standard;
pub use triangulated::Triangulated;
