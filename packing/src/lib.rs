//! How particles settle (work in progress).
pub mod lattice;
pub mod observer;
pub mod packed;
pub mod particles;
pub mod problem;
pub use lattice::Lattice;
pub use observer::{Observer, Phase, Progress, Sample, Silent};
pub use packed::{Packed, ParticleSurface, Seconds, StopReason};
pub use particles::{Kind, Particles};
pub use problem::{Body, Estimate, FrozenLayout, PackingError, Problem};
pub mod quality;
pub use quality::{DensityQuality, Fields, Quality, ResidualQuality, SurfaceQuality};
