//! Meshes from files of any format.

use std::path::Path;

use super::{BodyFormat, outline};
use crate::{GeometryError, Mesh, Soup};

impl Mesh {
    /// Reads a mesh without defects: STL, OBJ or PLY, by its content. All parts of the file are taken together and
    /// welded as by [`Mesh::from_loose`]. [`Soup::read`] takes meshes with defects too.
    ///
    /// # Errors
    /// [`GeometryError::InFile`] with the file's name around [`ReadError::Unreadable`](crate::ReadError::Unreadable), what
    /// [`BodyFormat::detect`] or [`BodyFormat::solids`] finds, or what [`Mesh::new`] finds.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        outline::in_file(path.as_ref(), |bytes, extension| {
            Self::from_bytes(BodyFormat::detect(bytes, extension)?, bytes)
        })
    }

    /// [`Mesh::read`] for a file's content that is already in memory, in a format that is known.
    ///
    /// # Errors
    /// As [`Mesh::read`], without a file's name.
    pub fn from_bytes(format: BodyFormat, bytes: &[u8]) -> Result<Self, GeometryError> {
        Self::from_loose(&loose(format, bytes)?)
    }

    /// Reads an STL file, binary or text (several solids are taken together), by its content.
    ///
    /// # Errors
    /// As [`Mesh::read`].
    pub fn read_stl(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        outline::in_file(path.as_ref(), |bytes, _| Self::from_stl_bytes(bytes))
    }

    /// [`Mesh::read_stl`] for a file's content that is already in memory.
    ///
    /// # Errors
    /// As [`Mesh::read_stl`], without a file's name.
    pub fn from_stl_bytes(bytes: impl AsRef<[u8]>) -> Result<Self, GeometryError> {
        Self::from_bytes(BodyFormat::Stl, bytes.as_ref())
    }
}

impl Soup {
    /// Reads a mesh with whatever defects it has: STL, OBJ or PLY, by its content. The triangles of all parts of the
    /// file are taken together, as by [`Soup::from_loose`].
    ///
    /// # Errors
    /// [`GeometryError::InFile`] with the file's name around [`ReadError::Unreadable`](crate::ReadError::Unreadable), what
    /// [`BodyFormat::detect`] or [`BodyFormat::solids`] finds, or [`MeshError::NotFinite`](crate::MeshError::NotFinite).
    pub fn read(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        outline::in_file(path.as_ref(), |bytes, extension| {
            Self::from_bytes(BodyFormat::detect(bytes, extension)?, bytes)
        })
    }

    /// [`Soup::read`] for a file's content that is already in memory, in a format that is known.
    ///
    /// # Errors
    /// As [`Soup::read`], without a file's name.
    pub fn from_bytes(format: BodyFormat, bytes: &[u8]) -> Result<Self, GeometryError> {
        Self::from_loose(&loose(format, bytes)?)
    }
}

/// The triangles of all parts of a mesh file, each its three corners.
fn loose(format: BodyFormat, bytes: &[u8]) -> Result<Vec<[[f64; 3]; 3]>, GeometryError> {
    let mut solids = format.solids(bytes)?.into_iter();
    let mut triangles = solids.next().unwrap_or_default().triangles;
    for mut solid in solids {
        triangles.append(&mut solid.triangles);
    }
    Ok(triangles)
}
