//! Bodies from files: what a file holds is told from its content, and read into loose triangles or closed loops.
//!
//! Every reader goes from bytes to a result. Nothing that a file says about its own size is trusted: memory grows with
//! the bytes that are there, and no bytes make a reader panic or run on.

mod airfoil;
mod faces;
mod format;
mod lines;
#[cfg(test)]
mod mangle;
mod mesh;
mod obj;
mod outline;
mod ply;
mod rows;
mod stl;
mod stl_text;
mod svg;
#[cfg(test)]
mod tests;

use crate::GeometryError;
use faces::Faces;

pub use format::BodyFormat;
pub use svg::FLATTENING_OVER_SIZE;

/// A named part of a mesh file: a solid of an STL file, an object or group of an OBJ file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solid {
    /// Its name in the file; empty where the file gives none.
    pub name: String,
    /// The corners of its triangles, scene units, in the order of the file. All are finite; nothing is welded.
    pub triangles: Vec<[[f64; 3]; 3]>,
}

impl BodyFormat {
    /// The loose triangles of a mesh file's content, part by part; polygons are cut into fans about their
    /// first corner, or, where that would fold, into the triangles of least area. O(n) in memory for n bytes, and in time
    /// but for polygons that bend inward, O(m³) for m ≤ 300 corners of one.
    ///
    /// # Errors
    /// A [`ReadError`](crate::ReadError) with the line or byte, what is wrong and the cure;
    /// [`MeshError::NotFinite`](crate::MeshError::NotFinite); a file without triangles, of a 2-D format, or
    /// with a polygon of more corners that bends inward, is an error.
    pub fn solids(self, bytes: &[u8]) -> Result<Vec<Solid>, GeometryError> {
        let solids = match self {
            Self::Stl => stl::read(bytes)?,
            Self::Obj => obj::read(bytes)?,
            Self::Ply => ply::read(bytes)?,
            Self::Csv | Self::Airfoil | Self::Svg => {
                return Err(lines::whole(format!(
                    "this is {}, an outline (2-D); a mesh is needed here: STL, OBJ or PLY",
                    self.description()
                )));
            }
        };
        if solids.iter().all(|solid| solid.triangles.is_empty()) {
            return Err(lines::whole(
                "the file holds no triangles; export the body again",
            ));
        }
        Ok(solids)
    }

    /// The loops of an outline file's content, in the order and direction of the file; a loop's last point may repeat
    /// its first. Of an SVG drawing, the boundary of what it paints, curves as straight sides within
    /// [`FLATTENING_OVER_SIZE`] of its size. O(n) in time and memory for n bytes, of a drawing whose paths meet
    /// O(n log n).
    ///
    /// # Errors
    /// A [`ReadError`](crate::ReadError) with the line, what is wrong and the cure; a file of a
    /// 3-D format is an error.
    pub fn loops(self, bytes: &[u8]) -> Result<Vec<Vec<[f64; 2]>>, GeometryError> {
        match self {
            Self::Csv => rows::read(bytes),
            Self::Airfoil => airfoil::read(bytes),
            Self::Svg => svg::read(bytes).map(|(loops, _)| loops),
            Self::Stl | Self::Obj | Self::Ply => Err(lines::whole(format!(
                "this is {}, a mesh (3-D); an outline is needed here: rows of x,y, an airfoil or SVG",
                self.description()
            ))),
        }
    }
}

/// The parts of a file whose faces are given by their corners' numbers.
fn loosened(
    vertices: &[[f64; 3]],
    parts: Vec<(String, Faces)>,
) -> Result<Vec<Solid>, GeometryError> {
    let solid = |(name, faces): (String, Faces)| {
        Ok(Solid {
            name,
            triangles: faces.loose(vertices)?,
        })
    };
    parts.into_iter().map(solid).collect()
}
