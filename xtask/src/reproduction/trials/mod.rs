//! Trials that need no packed scene, each judged by sums over all pairs that share nothing with the library's.

mod brute;
mod captured;
mod displaced;

use std::collections::BTreeMap;

pub(crate) use captured::Captured;
pub(crate) use displaced::Displaced;

use super::row::Measure;

/// What is tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Trial {
    /// A lattice with one particle off its site.
    Displaced(Displaced),
    /// A cylinder, with another interval between captures.
    Captured(Captured),
}

impl From<Displaced> for Trial {
    fn from(trial: Displaced) -> Self {
        Self::Displaced(trial)
    }
}

impl From<Captured> for Trial {
    fn from(trial: Captured) -> Self {
        Self::Captured(trial)
    }
}

impl Trial {
    /// What it is, in a line.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Displaced(trial) => trial.words(),
            Self::Captured(trial) => trial.words(),
        }
    }

    /// What tells it from the other one of a ratio.
    pub(crate) fn short(&self) -> String {
        match self {
            Self::Displaced(trial) => trial.lattice.name().to_owned(),
            Self::Captured(trial) => format!("every {} iterations", trial.every),
        }
    }

    /// Its figures.
    pub(crate) fn figures(&self) -> Result<BTreeMap<Measure, f64>, String> {
        match self {
            Self::Displaced(trial) => Ok(trial.figures()),
            Self::Captured(trial) => trial.figures(),
        }
    }
}
