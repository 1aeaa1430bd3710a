//! What a row's number is of: a packed scene, or a trial that needs no packing.

use super::setup::Setup;
use super::trials::Trial;

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Subject {
    /// A scene, packed.
    Packing(Setup),
    /// Something smaller.
    Trial(Trial),
}

impl From<Setup> for Subject {
    fn from(setup: Setup) -> Self {
        Self::Packing(setup)
    }
}

impl<T: Into<Trial>> From<T> for Subject {
    fn from(trial: T) -> Self {
        Self::Trial(trial.into())
    }
}

impl Subject {
    /// What it is, in a line.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Packing(setup) => setup.words(),
            Self::Trial(trial) => trial.words(),
        }
    }

    /// What tells it from the other one of a ratio.
    pub(crate) fn short(&self) -> String {
        match self {
            Self::Packing(setup) => setup.method_name(),
            Self::Trial(trial) => trial.short(),
        }
    }

    /// What [`Subject::words`] leaves out, where it tells rows apart.
    pub(crate) fn remark(&self) -> String {
        match self {
            Self::Packing(setup) if setup.tolerance != 1e-4 => {
                format!(" to {:e}", setup.tolerance)
            }
            _ => String::new(),
        }
    }

    /// Scene, ∆s and method, for a table with a column for each.
    pub(crate) fn columns(&self) -> [String; 3] {
        match self {
            Self::Packing(setup) => [
                setup.scene.to_owned(),
                setup.spacing.to_string(),
                setup.method_name(),
            ],
            Self::Trial(trial) => [
                format!("\"{}\"", trial.words()),
                String::new(),
                String::new(),
            ],
        }
    }

    /// The packing, where it is one.
    pub(crate) fn packing(&self) -> Option<&Setup> {
        match self {
            Self::Packing(setup) => Some(setup),
            Self::Trial(_) => None,
        }
    }
}
