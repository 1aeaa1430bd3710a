//! All files of a format, written as a part of one set.

use std::fs;
use std::path::Path;

use sphpack_packing::Kind;

use super::{AtomicFiles, Part, ParticleFormat, compare, write_bi4_xml};
use crate::Error;
use crate::table::Table;

/// What was put into a set of files.
pub(crate) struct Written {
    /// How many particles.
    pub(crate) particles: usize,
    /// How many of them are frozen.
    pub(crate) frozen: usize,
    /// Whether they were read again and compared; not where there was no memory for that.
    pub(crate) is_compared: bool,
}

/// Writes a part of the particles under temporary names and has what is written read again and compared with the table.
///
/// # Errors
/// [`Error::Write`] where they cannot be written, the format cannot hold them, or what is read again differs.
pub(crate) fn put(
    files: &mut AtomicFiles,
    format: ParticleFormat,
    part: &Part,
    table: &Table,
    path: &Path,
) -> Result<Written, Error> {
    let table = &*part.rows(table);
    let mut is_compared = true;
    files.write_and_check(
        path,
        |to| format.write(table, to),
        |written| compare(table, format, written).map(|done| is_compared = done),
    )?;
    if let Some(beside) = format.beside(path) {
        let is_same = |written: &Path| {
            let again = fs::read(written).map_err(|e| format!("it cannot be read again ({e})"))?;
            let mut text = Vec::new();
            write_bi4_xml(table, &mut text).map_err(|e| e.to_string())?;
            let differs = "read again, it is not what was written; this is a fault of the disk";
            (again == text)
                .then_some(())
                .ok_or_else(|| differs.to_owned())
        };
        files.write_and_check(&beside, |to| write_bi4_xml(table, to), is_same)?;
    }
    Ok(Written {
        particles: table.len(),
        frozen: (table.kind.iter())
            .filter(|&&kind| kind == Kind::Frozen)
            .count(),
        is_compared,
    })
}
