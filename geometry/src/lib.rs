//! What a body is: outlines in the plane, meshes and shapes in space, and what every method asks of them.
//!
#![doc = include_str!("../README.md")]
//!
//! ## Where to find what
//!
//! | what | type |
//! |---|---|
//! | the interface | [`Surface`], with [`Closest`], [`Feature`], [`Features`] |
//! | 2-D: polygons, sampled curves, airfoils | [`Outline`] |
//! | 3-D: closed triangle meshes | [`Mesh`] |
//! | files: STL, OBJ, PLY; rows of x,y, airfoils, SVG | [`Mesh::read`], [`Outline::read`], [`BodyFormat`], [`Solid`] |
//! | triangles with defects: check, mend, join | [`Soup`], [`Soup::read`], [`FastWinding`] |
//! | loops with defects: check, mend, join | [`Sketch`], [`Sketch::read`] |
//! | by formula | [`Ball`], [`Ellipsoid`], [`Cuboid`], [`Cylinder`], [`Torus`] |
//! | adaptors over any surface | [`Placed`] (by a [`Similarity`]), [`LevelInset`], [`Repeated`] (in a periodic box), [`Continued`] (beyond a box's sides) |
//! | layers of wall points, inside a body or around it | [`wall_layers`] |
//! | distances on a grid, and Booleans of them | [`LevelSet`], [`cut_on_grid`] |
//! | points: even ([`Surface::sample`]), by a weight, for thin bodies | [`sample_weighted`], [`sample_particles`], [`thickness()`] |
//! | underneath | [`Bvh`] |
//! | classical inside tests | [`angle_sum`], [`winding_number`], [`crossing_number`] |
//!
//! Invariants: geometry knows no particles and no kernels; bodies are immutable; no input makes it panic, and no bytes
//! make a reader run on or take more memory than in proportion to them; equal input gives equal bits, whatever the
//! number of threads. Lengths are scene units: those of the caller's numbers.

mod bvh;
mod continued;
mod error;
mod level_inset;
mod level_set;
mod mesh;
mod moments;
mod outline;
mod placed;
mod read;
mod repeated;
mod sample;
mod sampling;
mod segment;
#[cfg(all(test, feature = "serde"))]
mod serde_tests;
mod shapes;
mod similarity;
mod sketch;
mod soup;
mod surface;
mod thickness;
mod thin;
mod wall;
mod winding;

pub use bvh::{Bvh, Nearest};
pub use continued::{Continued, within_window};
pub use error::{
    CutError, GeometryError, InsetError, LoopSide, MeshError, OutlineError, ParameterError,
    ReadError,
};
pub use level_inset::LevelInset;
pub use level_set::{LevelSet, cut_on_grid};
pub use mesh::{EDGE_DEGREES, Mesh};
pub use moments::{MomentSums, Moments};
pub use outline::{
    CORNER_DEGREES, MITRE_LIMIT, Outline, angle_sum, crossing_number, winding_number,
};
pub use placed::Placed;
pub use read::{BodyFormat, FLATTENING_OVER_SIZE, Solid};
pub use repeated::Repeated;
pub use sample::{polygons, sample_weighted};
pub use sampling::SAGITTA_OVER_SIZE;
pub use shapes::{Ball, Cuboid, Cylinder, Ellipsoid, Torus};
pub use similarity::Similarity;
pub use sketch::{
    LoopRole, MendedOutline, OutlineDefect, OutlineDefectKind, OutlineRepair, OutlineReport,
    RepairedSketch, Sketch, SketchLoop,
};
pub use soup::{
    Defect, DefectKind, Hole, HoleLimit, Mended, MeshReport, Repair, Repaired, Shell, ShellRole,
    Soup,
};
pub use surface::{Closest, Feature, Features, Surface};
pub use thickness::thickness;
pub use thin::{SurfaceSamples, Thin, sample_particles, sample_thin};
pub use wall::{WallLayer, WallPoint, WallSide, WallSpec, wall_layers};
pub use winding::FastWinding;
