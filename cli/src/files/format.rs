//! Particle formats by name.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::Error;
use crate::scene::advice;
use crate::table::Table;

/// A format of particle files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParticleFormat {
    /// Text, one row per particle, a header line.
    Csv,
    /// VTK's unstructured grid; opens in ParaView and pyvista.
    Vtu,
    /// VTK's polygonal data; opens in ParaView and pyvista.
    Vtp,
    /// VTK's legacy format, binary.
    Vtk,
    /// NumPy's archive of arrays.
    Npz,
    /// Points with properties, little-endian binary.
    Ply,
    /// LAMMPS's data file, atom style sph.
    Lammps,
    /// SPHinXsys's `Reload.xml`, all bodies in one file.
    Reload,
    /// SPHinXsys's older `NAME_rld.xml`, the particles of one body.
    ReloadBody,
    /// Houdini's and SPlisHSPlasH's points, BGEO version 5.
    Bgeo,
    /// DualSPHysics's case; what its particles are is in a file beside it ([`ParticleFormat::beside`]).
    Bi4,
}

/// The formats that hold every column to the last bit, and their endings.
pub const PARTICLE_FORMATS: [(ParticleFormat, &str); 6] = [
    (ParticleFormat::Vtu, "vtu"),
    (ParticleFormat::Csv, "csv"),
    (ParticleFormat::Npz, "npz"),
    (ParticleFormat::Vtp, "vtp"),
    (ParticleFormat::Vtk, "vtk"),
    (ParticleFormat::Ply, "ply"),
];

/// The formats that a solver reads, which hold what it asks for, and their endings. A name that ends with `_rld.xml` is
/// [`ParticleFormat::ReloadBody`].
pub const SOLVER_FORMATS: [(ParticleFormat, &str); 4] = [
    (ParticleFormat::Lammps, "data"),
    (ParticleFormat::Reload, "xml"),
    (ParticleFormat::Bgeo, "bgeo"),
    (ParticleFormat::Bi4, "bi4"),
];

/// Every format and its ending.
fn all() -> impl Iterator<Item = (ParticleFormat, &'static str)> {
    PARTICLE_FORMATS.into_iter().chain(SOLVER_FORMATS)
}

/// A path's ending in small letters, empty where it has none.
pub(super) fn ending(path: &Path) -> String {
    path.extension()
        .map_or_else(String::new, |e| e.to_string_lossy().to_lowercase())
}

/// The body whose particles a file is for, by its name: `NAME_rld.xml`.
pub(super) fn body_of(path: &Path) -> Option<String> {
    let stem = path.file_stem()?.to_string_lossy();
    let body = stem.strip_suffix("_rld")?;
    (ending(path) == "xml").then(|| body.to_owned())
}

impl ParticleFormat {
    /// Whether it is read column by column, a piece at a time, so that nobody need hold all of it.
    pub(crate) fn is_read_by_column(self) -> bool {
        matches!(self, Self::Vtu | Self::Vtp)
    }

    /// The format that a path's ending names.
    ///
    /// # Errors
    /// [`Error::Input`] with the known endings.
    pub fn of(path: &Path) -> Result<Self, Error> {
        let ending = ending(path);
        if ending.is_empty() {
            let known: Vec<&str> = all().map(|(_, name)| name).collect();
            let known = known.join(", ");
            return Err(Error::input(
                path,
                format!(
                    "the name has no ending that says which format; add one: there are {known}"
                ),
            ));
        }
        if matches!(ending.as_str(), "npy" | "txt" | "dat") {
            let instead = if ending == "npy" { "npz" } else { "csv" };
            return Err(Error::input(
                path,
                format!(
                    "particles are read from .{ending} files, not written to them; name it .{instead}"
                ),
            ));
        }
        if body_of(path).is_some() {
            return Ok(Self::ReloadBody);
        }
        all()
            .find(|(_, name)| *name == ending)
            .map(|(format, _)| format)
            .ok_or_else(|| {
                let known: Vec<&str> = all().map(|(_, name)| name).collect();
                Error::input(
                    path,
                    format!(
                        "particles cannot be written or read as \"{ending}\"; {}",
                        advice(&ending, &known)
                    ),
                )
            })
    }

    /// The second file of a format that has two, by the name of the first: of `case.bi4`, `case.xml`.
    #[must_use]
    pub fn beside(self, path: &Path) -> Option<PathBuf> {
        (self == Self::Bi4).then(|| path.with_extension("xml"))
    }

    /// Writes particles; of a format that has two files, the first.
    ///
    /// # Errors
    /// Those of `to`; before anything is written, where a number is not finite, or the format cannot hold the particles.
    pub fn write(self, table: &Table, to: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Csv => super::write_csv(table, to),
            Self::Vtu => super::write_vtu(table, to),
            Self::Vtp => super::write_vtp(table, to),
            Self::Vtk => super::write_vtk(table, to),
            Self::Npz => super::write_npz(table, to),
            Self::Ply => super::write_ply(table, to),
            Self::Lammps => super::write_lammps(table, to),
            Self::Reload => super::write_reload(table, to),
            Self::ReloadBody => super::write_reload_body(table, to),
            Self::Bgeo => super::write_bgeo(table, to),
            Self::Bi4 => super::write_bi4(table, to),
        }
    }
}
