//! What one run of a flow gives, and runs that are kept.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::kept::Kept;
use crate::workspace::root;

/// The sources that a run depends on, beside those that pack.
const OWN: [&str; 13] = [
    "flow/src",
    "xtask/src/flow/run.rs",
    "xtask/src/flow/start.rs",
    "xtask/src/flow/vortices.rs",
    "xtask/src/flow/couette.rs",
    "xtask/src/flow/stream.rs",
    "xtask/src/flow/surface.rs",
    "xtask/src/flow/cylinder.rs",
    "xtask/src/flow/airfoil.rs",
    "xtask/src/flow/wing.rs",
    "xtask/src/flow/drop.rs",
    "xtask/src/flow/tank.rs",
    "xtask/src/flow/hull.rs",
];

/// Numbers and curves by their names.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Run {
    pub(super) numbers: BTreeMap<String, f64>,
    pub(super) curves: BTreeMap<String, Vec<[f64; 2]>>,
}

impl Run {
    /// A number that the run has.
    pub(super) fn number(&self, name: &str) -> f64 {
        self.numbers.get(name).copied().unwrap_or(f64::NAN)
    }

    pub(super) fn set(&mut self, name: &str, value: f64) {
        self.numbers.insert(name.to_owned(), value);
    }

    /// The value of a curve where x is nearest to this.
    pub(super) fn at(&self, curve: &str, x: f64) -> f64 {
        let points = self.curves.get(curve).map_or(&[][..], Vec::as_slice);
        (points.iter())
            .min_by(|a, b| (a[0] - x).abs().total_cmp(&(b[0] - x).abs()))
            .map_or(f64::NAN, |point| point[1])
    }

    pub(super) fn push(&mut self, curve: &str, x: f64, y: f64) {
        (self.curves.entry(curve.to_owned()).or_default()).push([x, y]);
    }
}

/// Runs that were made before by the same code are not made again.
pub(super) struct Runs {
    kept: Kept,
}

impl Runs {
    pub(super) fn open() -> Result<Self, String> {
        let folder = root().join("target/flow");
        Kept::open(Path::new(&folder), &OWN).map(|kept| Self { kept })
    }

    /// The run that `of` says all of.
    pub(super) fn get(
        &self,
        of: &str,
        make: impl FnOnce() -> Result<Run, String>,
    ) -> Result<Run, String> {
        let named = || make().map_err(|error| format!("{of}: {error}"));
        self.kept.once(of, named)
    }
}
