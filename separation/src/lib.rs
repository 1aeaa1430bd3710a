//! Which particle belongs to which body, and which to the fluid.
//!
//! Plain slices in, labels out: this crate knows nothing of how the particles came to be.
//!
//! - [`separate`]: the procedure of paper 001 §3.1.7. Particles near a surface are classified by it, the others take
//!   the label of a neighbour that has one.
//! - [`separate_by_inside_tests`]: asks each surface about each particle (signed angle or ray shooting in the papers).
//!
//! Both agree; the first asks the surface about a layer of particles only.
//!
//! ```
//! use std::sync::Arc;
//! use sphpack_geometry::{Ball, Surface};
//! use sphpack_separation::{Side, separate};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let ball: Arc<dyn Surface<2>> = Arc::new(Ball::new([0.0, 0.0], 1.0)?);
//! let points = [[0.0, 0.0], [0.5, 0.0], [1.2, 0.0]];
//! let labels = separate(&points, &[None; 3], &[ball], 0.6)?;
//! assert_eq!(labels.side, [Side::Solid, Side::Solid, Side::Fluid]);
//! assert_eq!(labels.body[0], Some(0));
//! # Ok(())
//! # }
//! ```

mod flood;
mod labels;

#[cfg(test)]
mod tests;

pub use flood::separate;
pub use labels::{Labels, SeparationError, Side, separate_by_inside_tests};
