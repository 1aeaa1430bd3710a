//! Where the particles of a file are.

use std::path::Path;

use sphpack_neighbors::point;

use crate::Error;
use crate::files::Columns;
use crate::memory::available_bytes;

/// What a byte of a particle file comes to, with its columns and what is made of them.
const BYTES_PER_BYTE: f64 = 4.0;

/// The dimension, 2 where there is no z but 0, and every particle's place; z is 0 in 2-D.
///
/// # Errors
/// [`Error::Input`] where there are no coordinates, no particles, or a coordinate that is no usual number.
pub(crate) fn places(columns: &Columns, path: &Path) -> Result<(usize, Vec<[f64; 3]>), Error> {
    let missing = |name: &str| {
        Error::input(
            path,
            format!("there is no column \"{name}\"; it needs x and y at least"),
        )
    };
    let column = |name: &str| columns.numbers.get(name);
    let x = column("x").ok_or_else(|| missing("x"))?;
    let y = column("y").ok_or_else(|| missing("y"))?;
    let z = column("z").filter(|z| z.iter().any(|&z| z != 0.0));
    let dimension = if z.is_some() { 3 } else { 2 };
    let position: Vec<[f64; 3]> = (0..x.len())
        .map(|i| [x[i], y[i], z.map_or(0.0, |z| z[i])])
        .collect();
    if position.is_empty() {
        return Err(Error::input(
            path,
            "there are no particles in it; give a file with some",
        ));
    }
    if let Some(bad) = position
        .iter()
        .position(|&p| !point::norm_squared(p).is_finite())
    {
        return Err(Error::input(
            path,
            format!(
                "particle {bad} has a coordinate that is not a finite number of usual size; correct or remove it"
            ),
        ));
    }
    Ok((dimension, position))
}

/// Refuses a file that would not fit into memory with all that is made of it: nothing could be said once it runs out. `what` is
/// being done with it.
pub(crate) fn check_memory(path: &Path, what: &str) -> Result<(), Error> {
    // What is no file, or too long for any memory, is told by who reads it.
    let meta = std::fs::metadata(path).ok();
    let file = meta.filter(|meta| meta.is_file() && meta.len() <= crate::files::MAX_INPUT);
    let size = file.map_or(0, |meta| meta.len());
    let (needed, free) = (BYTES_PER_BYTE * size as f64, available_bytes());
    if needed <= free {
        return Ok(());
    }
    let mebibytes = |bytes: f64| bytes / 1_048_576.0;
    Err(Error::input(
        path,
        format!(
            "{what} it takes about {:.0} MiB of memory, more than the {:.0} MiB allowed; where limits of the process leave so little (ulimit -v), fewer threads leave more (RAYON_NUM_THREADS=1 in the environment)",
            mebibytes(needed),
            mebibytes(free)
        ),
    ))
}
