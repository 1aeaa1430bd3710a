//! How particles settle: lattices, forces, capture, methods and measures.
//!
//! A [`Problem`] is a box, a spacing and bodies; a method, [`Balanced`] or [`Hybrid`], turns it into a [`Packed`] set
//! of particles; [`Packed::quality`] says how good it is.
//!
//! ```
//! use sphpack_geometry::Ball;
//! use sphpack_neighbors::Domain;
//! use sphpack_packing::{Balanced, Method, Problem, Silent};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let cylinder = Ball::new([0.0, 0.0], 1.0)?;
//! let problem = Problem::new(Domain::new([-2.0, -2.0], [2.0, 2.0]), 0.4).body("cylinder", cylinder);
//! let packed = Balanced::default().pack(&problem, &mut Silent)?;
//! let quality = packed.quality(&packed.fields(problem.kernel, problem.h_over_spacing));
//! assert!(quality.density.linf < 0.01);
//! assert!(quality.surface[0].max_distance_over_spacing < 1e-9);
//! # Ok(())
//! # }
//! ```
//!
//! Invariants: results have the same bits for any number of threads; the loop over iterations allocates only where a
//! neighbour list is built anew or a particle is captured; nothing here reads or writes files.

mod agitated;
pub mod balanced;
mod clipped;
pub mod closest_pair;
mod complex;
mod confined;
pub mod confinement;
mod coupled;
mod course;
pub mod depths;
pub mod estimate;
mod fluid_side;
pub mod forces;
mod hybrid;
pub mod lattice;
pub mod masses;
mod method;
pub mod minimise;
mod motion;
pub mod observer;
pub mod on_surface;
pub mod pace;
pub mod packed;
pub mod particles;
mod ppa;
mod predicted;
pub mod problem;
mod put_back;
pub mod quality;
mod relaxation;
pub mod seeding;
mod slabs;
mod standard;
mod state;
mod triangulated;
mod watch;

#[cfg(test)]
mod published;
#[cfg(test)]
mod resumed;
#[cfg(test)]
mod tests;

pub use agitated::{Agitated, Agitators};
pub use balanced::{Balanced, Band};
pub use clipped::Clipped;
pub use closest_pair::ClosestPair;
pub use complex::Complex;
pub use confinement::Confinement;
pub use coupled::Coupled;
pub use depths::Depths;
pub use estimate::{Estimate, Work};
pub use hybrid::Hybrid;
pub use lattice::{Lattice, UnknownLattice};
pub use masses::{MassCorrection, correct_masses};
pub use method::Method;
pub use minimise::{Finish, MinimiserKind, Settling, UnknownMinimiser};
pub use observer::{Keeper, Observer, Phase, Progress, Sample, Silent};
pub use packed::{Omitted, Packed, ParticleSurface, Seconds, StopReason};
pub use particles::{Kind, Particles, UnknownKind};
pub use ppa::Ppa;
pub use problem::{Body, FrozenLayout, PackingError, Problem};
pub use quality::{DensityQuality, Fields, Quality, ResidualQuality, SurfaceQuality};
pub use relaxation::Relaxation;
pub use standard::Standard;
pub use state::Damaged;
pub use triangulated::Triangulated;
