//! Particle files of any format.

use std::path::Path;

use super::{
    Columns, ParticleFormat, format, read_bgeo, read_bi4, read_csv, read_lammps, read_npy,
    read_npz, read_ply, read_reload, read_vtk, read_vtu, read_whole,
};
use crate::Error;

impl Columns {
    /// Reads a particle file; its ending says which format. What is never written is read too: an array of NumPy's (.npy), and
    /// rows of text by other names (.txt, .dat).
    ///
    /// # Errors
    /// [`Error::Input`] where it cannot be read, or has no coordinates.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let ending = format::ending(path);
        let format = match ending.as_str() {
            "npy" => {
                let mut columns = read_npy(&read_whole(path)?, path)?;
                columns.lower_case();
                return Ok(columns);
            }
            "txt" | "dat" => ParticleFormat::Csv,
            _ => ParticleFormat::of(path)?,
        };
        Self::parse(format, &read_whole(path)?, path)
    }

    /// The columns in the content of a particle file; `path` is for messages. Holds no more than the columns beside the
    /// bytes, but for one array of a compressed file.
    ///
    /// # Errors
    /// [`Error::Input`] where the content is damaged, or has no coordinates.
    pub fn parse(format: ParticleFormat, bytes: &[u8], path: &Path) -> Result<Self, Error> {
        let mut columns = match format {
            ParticleFormat::Csv => read_csv(bytes, path),
            ParticleFormat::Vtu | ParticleFormat::Vtp => read_vtu(bytes, path),
            ParticleFormat::Npz => read_npz(bytes, path),
            ParticleFormat::Ply => read_ply(bytes, path),
            ParticleFormat::Vtk => read_vtk(bytes, path),
            ParticleFormat::Lammps => read_lammps(bytes, path),
            ParticleFormat::Reload | ParticleFormat::ReloadBody => read_reload(bytes, path),
            ParticleFormat::Bgeo => read_bgeo(bytes, path),
            ParticleFormat::Bi4 => read_bi4(bytes, path),
        }?;
        columns.lower_case();
        Ok(columns)
    }
}
