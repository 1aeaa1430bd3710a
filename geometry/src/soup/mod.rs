//! Triangles before they are a body: whatever a file holds, what is wrong with it, and what can be mended.

mod body;
mod check;
mod cracks;
mod crossings;
mod doubles;
mod facing;
mod flush;
mod holes;
mod join;
mod pinches;
mod repair;
mod report;
mod shells;
#[cfg(test)]
pub(crate) mod tests;
mod triangulate;
mod wrap;
mod write;

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, point};

use crate::mesh::{topology, weld};
use crate::{GeometryError, MeshError, Similarity};

pub use body::Mended;
pub use repair::{HoleLimit, Repair, Repaired};
pub use report::{Defect, DefectKind, Hole, MeshReport, Shell, ShellRole};
pub(crate) use report::{four_digits, seven_digits};
pub(crate) use shells::Joined;
pub(crate) use triangulate::{MOST_POINTS, least_area};

/// Triangles over shared vertices, with any defect a file can have: holes, flipped or doubled triangles, shells that
/// overlap. [`Soup::check`] says what is wrong, [`Soup::repaired`] mends what can safely be mended, and
/// [`Soup::body`] makes a [`Mesh`](crate::Mesh) of it or says why not.
///
/// ```
/// use sphpack_geometry::{DefectKind, Soup};
/// let corner = |k: usize| [(k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2 & 1) as f64];
/// let mut cube = [
///     [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
///     [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
/// ]
/// .map(|t| t.map(corner));
/// cube[4].swap(0, 1);
/// let soup = Soup::from_loose(&cube)?;
/// assert_eq!(soup.check().defect(DefectKind::Inconsistent).map(|d| d.count), Some(3));
/// let mended = soup.body()?;
/// assert_eq!(mended.done.len(), 1); // one triangle faced the wrong way
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Soup {
    pub(crate) vertices: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Vertices that were taken together although they are not equal.
    pub(crate) welded: usize,
}

impl Soup {
    /// `triangles`, three places in `vertices` each (scene units).
    ///
    /// # Errors
    /// [`MeshError::NotFinite`], [`MeshError::BadIndex`].
    pub fn new(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, GeometryError> {
        topology::check_places(&vertices, &triangles)?;
        Ok(Self {
            vertices,
            triangles,
            welded: 0,
        })
    }

    /// Loose triangles, each its three corners: equal corners are welded, and where edges stay open, corners within
    /// 10⁻⁶ of the mesh's size are welded too, if that closes any.
    ///
    /// # Errors
    /// [`MeshError::NotFinite`].
    pub fn from_loose(corners: &[[[f64; 3]; 3]]) -> Result<Self, GeometryError> {
        let is_bad = |t: &[[f64; 3]; 3]| t.iter().any(|&v| !point::norm_squared(v).is_finite());
        if let Some(index) = corners.par_iter().position_first(is_bad) {
            return Err(MeshError::NotFinite {
                what: "triangle",
                index,
            }
            .into());
        }
        let (vertices, triangles) = weld::exact(corners);
        let open = open_edges(&triangles);
        if open > 0 {
            let tolerance = weld::TOLERANCE * Bounds::of(&vertices).diagonal();
            if tolerance > 0.0 {
                let (fewer, rewired) = weld::within(&vertices, &triangles, tolerance);
                if fewer.len() < vertices.len() && open_edges(&rewired) < open {
                    return Ok(Self {
                        welded: vertices.len() - fewer.len(),
                        vertices: fewer,
                        triangles: rewired,
                    });
                }
            }
        }
        Ok(Self {
            vertices,
            triangles,
            welded: 0,
        })
    }

    /// The triangles scaled, rotated and moved.
    ///
    /// # Errors
    /// [`MeshError::NotFinite`] where numbers overflow.
    pub fn transformed(&self, by: &Similarity<3>) -> Result<Self, GeometryError> {
        let vertices = self.vertices.iter().map(|&v| by.point(v)).collect();
        Ok(Self {
            welded: self.welded,
            ..Self::new(vertices, self.triangles.clone())?
        })
    }

    /// Vertices, scene units.
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Triangles, three places in [`Soup::vertices`] each.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The triangles, each its three corners.
    pub fn loose(&self) -> Vec<[[f64; 3]; 3]> {
        (0..self.triangles.len()).map(|t| self.corners(t)).collect()
    }

    /// The corners of triangle `t`.
    pub(crate) fn corners(&self, t: usize) -> [[f64; 3]; 3] {
        self.triangles[t].map(|v| self.vertices[v as usize])
    }

    /// The middle of triangle `t`.
    pub(crate) fn middle(&self, t: usize) -> [f64; 3] {
        crate::mesh::triangle::place(&self.corners(t), [1.0 / 3.0; 3])
    }
}

/// Whether a triangle uses a vertex twice.
pub(crate) fn is_degenerate(&[a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}

/// Edges with one triangle, leaving out those of degenerate ones.
fn open_edges(triangles: &[[u32; 3]]) -> usize {
    let proper: Vec<[u32; 3]> = triangles
        .iter()
        .copied()
        .filter(|t| !is_degenerate(t))
        .collect();
    topology::edges(&topology::sorted_sides(&proper))
        .filter(|edge| edge.len() == 1)
        .count()
}
