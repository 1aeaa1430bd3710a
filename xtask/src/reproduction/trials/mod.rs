//! Trials that need no packed scene, each judged by sums over all pairs that share nothing with the library's.

mod brute;
mod displaced;

use std::collections::BTreeMap;

pub(crate) use displaced::Displaced;

use super::row::Measure;

/// What is tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Trial {
    /// A lattice with one particle off its site.
    Displaced(Displaced),
}

impl From<Displaced> for Trial {
    fn from(trial: Displaced) -> Self {
        Self::Displaced(trial)
    }
}

impl Trial {
    /// What it is, in a line.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Displaced(trial) => trial.words(),
        }
    }

    /// What tells it from the other one of a ratio.
    pub(crate) fn short(&self) -> String {
        match self {
            Self::Displaced(trial) => trial.lattice.name().to_owned(),
        }
    }

    /// Its figures.
    pub(crate) fn figures(&self) -> BTreeMap<Measure, f64> {
        match self {
            Self::Displaced(trial) => trial.figures(),
        }
    }
}
