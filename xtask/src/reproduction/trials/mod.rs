//! Trials that need no packed scene, each judged by sums over all pairs that share nothing with the library's.

mod brute;
mod captured;
mod displaced;
mod elements;
mod repelled;
mod separated;
mod stirred;
mod walled;
mod winding;

use std::collections::BTreeMap;

pub(crate) use captured::Captured;
pub(crate) use displaced::Displaced;
pub(crate) use elements::Elements;
pub(crate) use repelled::Repelled;
pub(crate) use separated::Separated;
pub(crate) use stirred::{REVOLUTION, Stirred};
pub(crate) use walled::Walled;

use super::measure::Measure;
use crate::selection::Selection;

/// What is tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Trial {
    /// A lattice with one particle off its site.
    Displaced(Displaced),
    /// A cylinder, with another interval between captures.
    Captured(Captured),
    /// Points about a body, told apart.
    Separated(Separated),
    /// Two particles that repel each other.
    Repelled(Repelled),
    /// A lattice after an agitator.
    Stirred(Stirred),
    /// A lattice among frozen particles, one off its site.
    Walled(Walled),
    /// An airfoil of three elements, relaxed.
    Elements(Elements),
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

impl From<Separated> for Trial {
    fn from(trial: Separated) -> Self {
        Self::Separated(trial)
    }
}

impl From<Repelled> for Trial {
    fn from(trial: Repelled) -> Self {
        Self::Repelled(trial)
    }
}

impl From<Stirred> for Trial {
    fn from(trial: Stirred) -> Self {
        Self::Stirred(trial)
    }
}

impl From<Walled> for Trial {
    fn from(trial: Walled) -> Self {
        Self::Walled(trial)
    }
}

impl From<Elements> for Trial {
    fn from(trial: Elements) -> Self {
        Self::Elements(trial)
    }
}

impl Trial {
    /// What it is, in a line.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Displaced(trial) => trial.words(),
            Self::Captured(trial) => trial.words(),
            Self::Separated(trial) => trial.words(),
            Self::Repelled(trial) => trial.words(),
            Self::Stirred(trial) => trial.words(),
            Self::Walled(trial) => trial.words(),
            Self::Elements(trial) => trial.words(),
        }
    }

    /// What tells it from the other one of a ratio.
    pub(crate) fn short(&self) -> String {
        match self {
            Self::Displaced(trial) => trial.lattice.name().to_owned(),
            Self::Captured(trial) => format!("every {} iterations", trial.every),
            Self::Separated(trial) => trial.scene.to_owned(),
            Self::Repelled(trial) => trial.words(),
            Self::Stirred(trial) => trial.lattice.name().to_owned(),
            Self::Walled(trial) => trial.short().to_owned(),
            Self::Elements(trial) => trial.short(),
        }
    }

    /// Its figures; `None` where its body's file is not there.
    pub(crate) fn figures(
        &self,
        selection: &Selection,
    ) -> Result<Option<BTreeMap<Measure, f64>>, String> {
        match self {
            Self::Displaced(trial) => Ok(Some(trial.figures())),
            Self::Captured(trial) => trial.figures().map(Some),
            Self::Separated(trial) => trial.figures(selection),
            Self::Repelled(trial) => Ok(Some(trial.figures())),
            Self::Stirred(trial) => trial.figures().map(Some),
            Self::Walled(trial) => Ok(Some(trial.figures())),
            Self::Elements(trial) => trial.figures(selection),
        }
    }
}
