//! All files of a format, written as a part of one set.

use std::path::Path;

use super::{AtomicFiles, ParticleFormat, compare};
use crate::Error;
use crate::table::Table;

/// Writes particles under temporary names and has what is written read again and compared with the table; `false` where there was no memory
/// for that.
///
/// # Errors
/// [`Error::Write`] where they cannot be written, the format cannot hold them, or what is read again differs.
pub(crate) fn put(
    files: &mut AtomicFiles,
    format: ParticleFormat,
    table: &Table,
    path: &Path,
) -> Result<bool, Error> {
    let mut is_compared = true;
    files.write_and_check(
        path,
        |to| format.write(table, to),
        |written| compare(table, format, written).map(|done| is_compared = done),
    )?;
    Ok(is_compared)
}
