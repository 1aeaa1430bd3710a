//! How particles settle: lattices, forces, capture, methods and measures.
//!
#![doc = include_str!("../README.md")]
//!
//! Invariants: results have the same bits for any number of threads; the loop over iterations allocates only where a
//! neighbour list is built anew or a particle is captured; nothing here reads or writes files.

pub mod closest_pair;
pub mod confinement;
pub mod curvature;
pub mod depths;
pub mod estimate;
pub mod finest;
mod finish;
pub mod forces;
pub mod interpolation;
pub mod lattice;
mod levelling;
pub mod masses;
pub mod methods;
pub mod minimise;
pub mod observer;
mod off_bound;
pub mod on_surface;
pub mod pace;
pub mod packed;
pub mod particles;
pub mod problem;
pub mod quality;
pub mod refinement;
pub mod resolution;
pub mod run_log;
pub mod sampled_field;
pub mod seeding;
pub mod sizes;
mod slabs;
pub mod spacing_function;
mod state;
pub mod symmetric;

#[cfg(all(test, feature = "published"))]
mod resumed;
#[cfg(all(test, feature = "published"))]
mod tests;

pub use closest_pair::ClosestPair;
pub use confinement::Confinement;
pub use curvature::Curved;
pub use depths::Depths;
pub use estimate::{Estimate, Work};
pub use finest::Finest;
pub use interpolation::Interpolation;
pub use lattice::{Lattice, UnknownLattice};
pub use masses::{MassCorrection, correct_masses};
#[cfg(feature = "published")]
pub use methods::{
    Agitated, Agitators, Clipped, Complex, Coupled, Hybrid, Ppa, Relaxation, Standard, Triangulated,
};
pub use methods::{Balanced, Band, Method, MethodInfo, Moves};
pub use minimise::{Finish, MinimiserKind, Settling, UnknownMinimiser};
pub use observer::{HistoryPoint, Keeper, Observer, Progress, Silent, Stage};
pub use packed::{Omitted, Packed, ParticleSurface, Seconds, StopReason, SurfaceParticle};
pub use particles::{Kind, Particles, UnknownKind};
pub use problem::{Body, FrozenLayout, PackingError, Problem};
pub use quality::{DensityQuality, Fields, Quality, ResidualQuality, SurfaceQuality};
pub use refinement::{Graded, Refinement};
pub use resolution::{Resolution, Spacing, SpacingField, Uniform};
pub use run_log::RunLog;
pub use sampled_field::{FieldError, SampledField};
pub use sizes::Sizes;
pub use spacing_function::SpacingFunction;
pub use state::Damaged;
pub use symmetric::SymmetricDensity;
