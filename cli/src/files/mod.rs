//! Reading and writing files: particles in several formats, everything whole or not at all.

mod any_read;
mod arrays;
mod atomic;
#[cfg(test)]
mod atomic_tests;
mod bgeo;
mod bgeo_read;
#[cfg(test)]
mod bgeo_tests;
mod bi4;
mod bi4_case;
mod bi4_items;
mod bi4_read;
#[cfg(test)]
mod bi4_tests;
mod bi4_xml;
mod by_body;
mod carried;
mod columns;
mod csv;
mod csv_header;
#[cfg(test)]
mod foreign_tests;
mod format;
mod lammps;
mod lammps_read;
#[cfg(test)]
mod lammps_tests;
mod npy_read;
#[cfg(test)]
mod npy_tests;
mod npz;
mod npz_read;
mod number_type;
mod part;
mod ply;
mod ply_read;
mod put;
mod read_back;
mod reload;
mod reload_read;
#[cfg(test)]
mod reload_tests;
mod shortest;
mod size_limit;
#[cfg(test)]
mod solver_tests;
mod suits;
mod taken;
mod temporary;
#[cfg(test)]
mod tests;
mod validate;
mod vtk;
mod vtk_read;
mod vtk_xml;
mod vtp;
mod vtu;
mod vtu_read;
mod xml_tag;
mod zip;

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::Error;
use crate::table::Table;

pub(crate) use atomic::{AtomicFiles, replace};
pub use bgeo::write_bgeo;
pub use bgeo_read::read_bgeo;
pub use bi4::write_bi4;
pub use bi4_read::read_bi4;
pub use bi4_xml::write_bi4_xml;
pub use columns::Columns;
pub use csv::{read_csv, write_csv};
pub use format::{PARTICLE_FORMATS, ParticleFormat, SOLVER_FORMATS};
pub use lammps::write_lammps;
pub use lammps_read::read_lammps;
pub use npy_read::read_npy;
pub use npz::write_npz;
pub use npz_read::read_npz;
pub(crate) use part::{Owners, Part};
pub use ply::write_ply;
pub use ply_read::read_ply;
pub(crate) use put::put;
use read_back::compare;
pub use reload::{write_reload, write_reload_body};
pub use reload_read::read_reload;
pub(crate) use taken::refuse_taken;
pub(crate) use temporary::forget_unfinished;
pub use vtk::write_vtk;
pub use vtk_read::read_vtk;
pub use vtp::write_vtp;
pub use vtu::write_vtu;
pub use vtu_read::read_vtu;

/// Writes particles into a file whose ending says the format: whole or not at all, and read again to see that it holds what it
/// should. With `{body}` in its name there is a file for each body and for the fluid, with `{side}` one for each side; all of them or none.
/// `may_replace`: whether a file that exists may be replaced.
///
/// # Errors
/// [`Error::Input`] for an ending that is none of [`PARTICLE_FORMATS`] and [`SOLVER_FORMATS`], where the name is taken by what may not be replaced, and where
/// a body's name can be that of no file; [`Error::Write`].
pub fn save(table: &Table, path: &Path, may_replace: bool) -> Result<(), Error> {
    let format = ParticleFormat::of(path)?;
    let parts = Owners::of_table(table).files(path)?;
    let both = |path: &Path| [Some(path.to_owned()), format.beside(path)];
    for path in (parts.iter()).flat_map(|(path, _)| both(path)).flatten() {
        refuse_taken(&path, may_replace, "let it be replaced")?;
    }
    let mut files = AtomicFiles::new(may_replace);
    for (path, part) in &parts {
        put(&mut files, format, part, table, path)?;
    }
    files.finish()
}

/// The largest input that is read into memory, bytes.
pub(crate) const MAX_INPUT: u64 = 8 << 30;

/// Opens a file for reading.
pub(crate) fn open(path: &Path) -> Result<File, Error> {
    let unusable = |e: io::Error| {
        Error::input(
            path,
            match e.kind() {
                io::ErrorKind::NotFound => {
                    "there is no such file; check the name and the folder".to_owned()
                }
                _ => format!("cannot be opened ({e}); check its permissions"),
            },
        )
    };
    // Before it is opened: a pipe that nobody writes to would be waited for.
    let meta = fs::metadata(path).map_err(unusable)?;
    if !meta.is_file() {
        return Err(Error::input(
            path,
            if meta.is_dir() {
                "this is not a file, but a folder; give the path of a file in it"
            } else {
                "this is not a file, but a pipe or a device; save what it gives to a file first"
            },
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
    File::open(path).map_err(unusable)
}

/// Everything a file holds that must not be longer than `most` bytes; `what` is that which it would be too long for.
pub(crate) fn read_up_to(path: &Path, most: u64, what: &str) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    (open(path)?.take(most + 1).read_to_end(&mut bytes))
        .map_err(|e| Error::input(path, format!("cannot be read ({e})")))?;
    if bytes.len() as u64 > most {
        return Err(Error::input(
            path,
            format!("the file has more than {most} bytes, too many for {what}"),
        ));
    }
    Ok(bytes)
}

/// Everything a file holds.
pub(crate) fn read_whole(path: &Path) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    // No more than was asked about, should it go on growing.
    open(path)?
        .take(MAX_INPUT)
        .read_to_end(&mut bytes)
        .map_err(|e| Error::input(path, format!("cannot be read ({e})")))?;
    Ok(bytes)
}
