//! Scenes: what a person writes down to be packed with particles, and everything that is made of it.
//!
//! The command `sphpack` is a thin layer over this library; other programs use [`Scene`] and [`run`]:
//!
//! ```
//! use sphpack::{Options, Scene, run};
//! use sphpack_packing::Silent;
//!
//! let mut scene = Scene::parse(
//!     r#"
//!     spacing = 0.2
//!     [domain]
//!     min = [-2.0, -2.0]
//!     max = [2.0, 2.0]
//!     [[body]]
//!     name = "cylinder"
//!     shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
//!     "#,
//!     "cylinder.toml",
//! )?;
//! scene.packing.velocity_tolerance = 1e-3;
//! let outcome = run(&scene, &Options::default(), &mut Silent)?;
//! assert!(outcome.report.density.linf < 0.05);
//! assert_eq!(outcome.table.len(), outcome.report.particles.total);
//! # Ok::<(), sphpack::Error>(())
//! ```
//!
//! Invariants: only [`mod@files`] and the command write files, and those whole or not at all; no input makes anything
//! here panic; two and three dimensions part in one `match`, in [`run`].

mod audit;
mod beyond;
mod body_file;
mod checkpoint;
mod cloud;
pub mod command;
mod content;
mod corrected;
mod dimension;
mod error;
mod examined;
pub mod files;
mod findings;
mod hydrostatic;
mod labels;
mod memory;
mod methods;
mod overlap;
pub mod picture;
mod plan;
mod precedence;
mod report;
mod roles;
mod run;
pub mod scene;
mod shapes;
mod solution;
mod surroundings;
mod table;
mod units;

pub use audit::Audit;
pub use body_file::{ReadBody, body_format};
pub use cloud::{Cloud, CloudQuality};
pub use error::{BAD_INPUT, DONE, Error, FAILED, INTERRUPTED, NOT_CONVERGED};
pub use examined::{Examine, Examined, Mend, MendedBody, Thin};
pub use findings::{DefectFound, LoopFound, MeshFindings, OutlineFindings};
pub use plan::{Plan, plan};
pub use report::{
    BodyReport, Counts, Density, History, MassReport, Report, Residual, SCHEMA, SecondsReport,
    SurfaceReport,
};
pub use run::{Options, Outcome, run};
pub use scene::Scene;
pub use solution::{Packing, Solution};
pub use table::Table;
