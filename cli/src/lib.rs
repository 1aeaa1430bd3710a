//! Scenes: what a person writes down to be packed with particles, and everything that is made of it.
//!
//! The command `sphpack` is a thin layer over this library. Who packs bodies of a program's own takes the [`prelude`], which
//! is the crates of this workspace by one name:
//!
//! ```
//! use sphpack::prelude::*;
//!
//! let body = Mesh::read("../scenes/spot.stl")?.scaled(0.5)?;
//! let hit = body.closest([0.1, 0.2, 0.3]); // point, normal, signed distance, feature
//! let even = body.sample(500)?; // evenly spread, features first
//! let wing = Outline::naca("0015", 1.0)?;
//!
//! let packed = Problem::around(&wing, 0.04).margin(0.5).pack(&Balanced::default())?;
//! println!("{}", packed.quality()); // L∞ 0.0010, residual 2.1e-3 …
//! packed.audit()?;
//!
//! let w = Quintic::<2>::new(0.12);
//! let (value, slope) = w.value_and_slope(0.1);
//! let points = packed.positions();
//! let mut list = CellList::new(&packed.domain, w.support());
//! list.update(points);
//! for (j, shift) in list.neighbors(0) {
//!     // Anyone's loop: x_i − (x_j + shift) is the way from j, or an image of it, to i.
//! }
//! let fields = Fields::new(w, points, &packed.particles.volume);
//! let sums = Pairs::new(&list).sum(&(Density, Gradient), &fields); // the fast one
//! let labels = separate(points, &[&wing])?;
//! # assert!(hit.distance > 0.0 || hit.distance < 0.0);
//! # assert_eq!((even.len(), sums.len(), labels.side.len()), (500, points.len(), points.len()));
//! # assert!(value > 0.0 && slope < 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Who has scenes takes [`Scene`] and [`run`]:
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

#![cfg_attr(
    not(feature = "command"),
    allow(
        dead_code,
        unused_imports,
        reason = "some pieces are for the command alone"
    )
)]

mod asked;
mod audit;
pub mod auto;
mod beyond;
mod body_file;
mod checkpoint;
mod cloud;
mod cloud_report;
#[cfg(feature = "command")]
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
mod opened;
mod overlap;
pub mod picture;
mod places;
mod plan;
mod precedence;
pub mod prelude;
mod report;
mod roles;
mod room;
mod run;
pub mod scene;
mod shapes;
mod solution;
mod spacings;
mod surroundings;
mod table;
mod units;
pub mod view;
mod walls;

pub use audit::{Audit, Audited, Unsound};
pub use body_file::{ReadBody, body_format};
pub use cloud::{Cloud, CloudQuality};
pub use cloud_report::{CloudCounts, CloudReport};
pub use error::{BAD_INPUT, DONE, Error, FAILED, INTERRUPTED, NOT_CONVERGED};
pub use examined::{Examine, Examined, Mend, MendedBody, Thin};
pub use findings::{DefectFound, LoopFound, MeshFindings, OutlineFindings};
pub use plan::{Plan, plan};
pub use report::{BodyReport, Counts, MassReport, Report, SCHEMA, SecondsReport};
pub use run::{Options, Outcome, run};
pub use scene::Scene;
pub use solution::{Packing, Solution};
pub use table::{Shared, Table};
pub use walls::{LayerReport, WallReport};
