//! What can go wrong, and the exit status that says so.

use std::path::{Path, PathBuf};

use sphpack_geometry::{CutError, GeometryError, InsetError, ReadError};
use sphpack_packing::PackingError;

/// Exit status: everything asked for was done.
pub const DONE: u8 = 0;
/// Exit status: something that cannot be foreseen, a full disk for example.
pub const FAILED: u8 = 1;
/// Exit status: the input, or the command line, is wrong.
pub const BAD_INPUT: u8 = 2;
/// Exit status: the files are written, but the packing has not reached its tolerance.
pub const NOT_CONVERGED: u8 = 3;
/// Exit status: stopped by Ctrl-C; what there was is written.
pub const INTERRUPTED: u8 = 130;

/// Why a scene is not packed, or files are not written. One message each, with the cure.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Something in a scene file is wrong.
    #[error("{}{}: {message}", path.display(), place(*at))]
    Scene {
        /// The file.
        path: PathBuf,
        /// Line and column, counted from 1, where there is one.
        at: Option<(usize, usize)>,
        /// What is wrong, and the cure.
        message: String,
    },
    /// The scene can be read, but not packed.
    #[error("{}: {error}{}{}", path.display(), more(packing_cure(error)), more(advice.as_deref()))]
    Packing {
        /// The scene's file.
        path: PathBuf,
        /// What is wrong.
        error: Box<PackingError>,
        /// What else may help.
        advice: Option<String>,
    },
    /// A body cannot be built.
    #[error("{}: body \"{body}\": {}", path.display(), cured(error))]
    Body {
        /// The scene's file.
        path: PathBuf,
        /// The body's name.
        body: String,
        /// What is wrong.
        error: GeometryError,
    },
    /// An input file cannot be used.
    #[error("{}{}: {message}", path.display(), place(at.map(|line| (line, 0))))]
    Input {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1, where there is one.
        at: Option<usize>,
        /// What is wrong, and the cure.
        message: String,
    },
    /// The command line asks for something impossible.
    #[error("{0}")]
    Usage(String),
    /// A file cannot be written although everything looked well before.
    #[error("cannot write {}: {reason}; {left}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The operating system's reason, or what was found in the file.
        reason: String,
        /// What there is on the disk now.
        left: String,
    },
    /// The machine does not give what is needed.
    #[error("{0}")]
    System(String),
}

/// What there is where a file could not be written, and nothing else was complete.
const NOTHING_LEFT: &str = "nothing was left behind";

/// ":line:column", as far as known.
fn place(at: Option<(usize, usize)>) -> String {
    match at {
        None => String::new(),
        Some((line, 0)) => format!(":{line}"),
        Some((line, column)) => format!(":{line}:{column}"),
    }
}

/// What in a scene, or about a file, helps against what is wrong with a body. Geometry knows neither.
fn cure(error: &GeometryError) -> Option<&'static str> {
    match error {
        GeometryError::Inset(InsetError::Vanished { .. }) => {
            Some("use a smaller spacing, or surface = \"exact\"")
        }
        GeometryError::Inset(InsetError::TooTangled { .. }) => {
            Some("a smaller spacing or surface = \"exact\" helps too")
        }
        GeometryError::Cut(CutError::LostOnGrid { .. }) => Some(
            "move the bodies so that one passes the other's surface or stays well within it, use a smaller spacing, or give both as meshes, which are cut exactly",
        ),
        GeometryError::Read(ReadError::Unreadable { .. }) => {
            Some("check the path and the permissions")
        }
        GeometryError::InFile { error, .. } => cure(error),
        _ => None,
    }
}

/// What is wrong with a body, and the cure.
pub(crate) fn cured(error: &GeometryError) -> String {
    format!("{error}{}", more(cure(error)))
}

fn packing_cure(error: &PackingError) -> Option<&'static str> {
    match error {
        PackingError::Surface { error, .. } => cure(error),
        PackingError::OutsideDomain { .. } => Some("or use margin = … instead of min and max"),
        _ => None,
    }
}

/// What follows a message.
fn more(advice: Option<&str>) -> String {
    advice.map_or_else(String::new, |words| format!("; {words}"))
}

impl Error {
    /// The command's exit status for this error.
    pub fn status(&self) -> u8 {
        match self {
            Self::Write { .. } | Self::System(_) => FAILED,
            _ => BAD_INPUT,
        }
    }

    pub(crate) fn input(path: &Path, message: impl Into<String>) -> Self {
        Self::Input {
            path: path.to_owned(),
            at: None,
            message: message.into(),
        }
    }

    pub(crate) fn input_line(path: &Path, line: usize, message: impl Into<String>) -> Self {
        Self::Input {
            path: path.to_owned(),
            at: Some(line),
            message: message.into(),
        }
    }

    pub(crate) fn write(path: &Path, reason: impl ToString) -> Self {
        Self::Write {
            path: path.to_owned(),
            reason: reason.to_string(),
            left: NOTHING_LEFT.into(),
        }
    }

    /// Whether nothing is left of what was to be written.
    pub(crate) fn is_all_lost(&self) -> bool {
        matches!(self, Self::Write { left, .. } if left == NOTHING_LEFT)
    }

    /// An [`Error::Write`] that says which files are kept under other names, and which have not got their names back:
    /// the name, and that which the file has instead.
    #[must_use]
    pub(crate) fn with_kept(mut self, kept: &[PathBuf], renamed: &[(PathBuf, PathBuf)]) -> Self {
        if let Self::Write { left, .. } = &mut self
            && !kept.is_empty()
        {
            let names: Vec<String> = kept.iter().map(|path| path.display().to_string()).collect();
            *left = format!("what was complete is kept as {}", names.join(", "));
            if renamed.is_empty() {
                *left += "; files that were there are as they were";
            }
            for (path, now) in renamed {
                *left += &format!("; what was {} is {} now", path.display(), now.display());
            }
        }
        self
    }
}
