//! Reading and writing files: particles in several formats, everything whole or not at all.

mod arrays;
mod columns;
mod csv;
mod format;
#[cfg(test)]
mod legacy;
mod npz;
mod npz_read;
mod number_type;
mod ply;
mod ply_read;
mod sound;
#[cfg(test)]
mod tests;
mod vtk;
mod vtk_xml;
mod vtp;
mod vtu;
mod vtu_read;
mod whole;
mod zip;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::Error;

pub use columns::Columns;
pub use csv::{read_csv, write_csv};
pub use format::{PARTICLE_FORMATS, ParticleFormat};
pub use npz::write_npz;
pub use npz_read::read_npz;
pub use ply::write_ply;
pub use ply_read::read_ply;
pub use vtk::write_vtk;
pub use vtp::write_vtp;
pub use vtu::write_vtu;
pub use vtu_read::read_vtu;
pub(crate) use whole::{WholeFiles, forget_unfinished};

/// The largest input that is read into memory, bytes.
const MAX_INPUT: u64 = 8 << 30;

/// Opens a file for reading.
pub(crate) fn open(path: &Path) -> Result<File, Error> {
    let file = File::open(path).map_err(|e| {
        Error::input(
            path,
            match e.kind() {
                std::io::ErrorKind::NotFound => {
                    "there is no such file; check the name and the folder".to_owned()
                }
                _ => format!("cannot be opened ({e}); check its permissions"),
            },
        )
    })?;
    let meta = file
        .metadata()
        .map_err(|e| Error::input(path, format!("cannot be read ({e})")))?;
    if !meta.is_file() {
        return Err(Error::input(
            path,
            "this is not a file; give the path of one",
        ));
    }
    if meta.len() > MAX_INPUT {
        return Err(Error::input(
            path,
            format!(
                "the file has {} bytes, more than the {MAX_INPUT} that are read; use a smaller one",
                meta.len()
            ),
        ));
    }
    Ok(file)
}

/// Everything a file holds.
pub(crate) fn read_whole(path: &Path) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    open(path)?
        .read_to_end(&mut bytes)
        .map_err(|e| Error::input(path, format!("cannot be read ({e})")))?;
    Ok(bytes)
}
