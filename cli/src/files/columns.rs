//! Anybody's particles, as columns by name.

use std::collections::BTreeMap;
use std::path::Path;

use super::ParticleFormat;
use crate::Error;

/// A particle file's columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Columns {
    /// Columns of numbers, all of one length.
    pub numbers: BTreeMap<String, Vec<f64>>,
    /// Columns of words, all of that same length.
    pub words: BTreeMap<String, Vec<String>>,
}

impl Columns {
    /// Reads a particle file; its ending says which format.
    ///
    /// # Errors
    /// [`Error::Input`] where it cannot be read, or has no coordinates.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let format = ParticleFormat::of(path)?;
        let bytes = super::read_whole(path)?;
        match format {
            ParticleFormat::Csv => super::read_csv(&bytes, path),
            ParticleFormat::Vtu => super::read_vtu(&bytes, path),
        }
    }
}
