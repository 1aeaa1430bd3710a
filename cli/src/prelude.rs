//! What a program needs that packs bodies of its own: `use sphpack::prelude::*`.
//!
//! Bodies are from [`geometry`], how they are packed from [`packing`], sums over pairs from [`pairs`], [`neighbors`] and
//! [`kernels`], labels from [`separation`]: the crates in full, for what is not named here.

pub use sphpack_geometry as geometry;
pub use sphpack_kernels as kernels;
pub use sphpack_neighbors as neighbors;
pub use sphpack_packing as packing;
pub use sphpack_pairs as pairs;
pub use sphpack_separation as separation;

pub use sphpack_geometry::{
    Ball, Closest, Cuboid, Cylinder, Ellipsoid, Feature, Mesh, Outline, Similarity, Surface, Torus,
};
pub use sphpack_kernels::{Cubic, Kernel, KernelKind, Quintic, WendlandC2, WendlandC4, WendlandC6};
pub use sphpack_neighbors::{Bounds, CellList, Domain, KdTree};
pub use sphpack_packing::{
    Balanced, Band, Finish, Graded, Kind, Lattice, Method, Packed, Particles, Problem, Quality,
    Refinement, Resolution, RunLog, Settling, Silent, Sizes, SpacingField, StopReason, Uniform,
};
pub use sphpack_pairs::{Density, Fields, Gradient, Pairs, Term};
pub use sphpack_separation::{Labels, Side, separate};

pub use crate::audit::{Audit, Audited, Unsound};
