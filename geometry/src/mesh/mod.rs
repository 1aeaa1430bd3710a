//! Bodies in space: closed triangle meshes.

mod features;
pub(crate) mod inset;
mod normals;
mod pieces;
mod scatter;
mod surface;
#[cfg(test)]
pub(crate) mod tests;
pub(crate) mod topology;
pub(crate) mod triangle;
pub(crate) mod vanished;
pub(crate) mod weld;

use std::sync::{Arc, OnceLock};

use sphpack_neighbors::{Bounds, point};

use crate::surface::Features;
use crate::{Bvh, GeometryError, MeshError, Similarity};
use normals::Normals;

/// An edge at which the two triangles' normals differ by more than this is sharp; at less it is part of a smooth
/// surface. A vertex where a chain of sharp edges turns by more than this is a corner.
pub const EDGE_DEGREES: f64 = 30.0;

/// A closed triangle mesh, its triangles counter-clockwise seen from outside.
///
/// The sign of the distance comes from pseudonormals (Bærentzen and Aanæs, "Signed distance computation using the
/// angle weighted pseudonormal", IEEE TVCG 11, 2005) and is right at edges and vertices too.
///
/// ```
/// use sphpack_geometry::{Mesh, Surface};
/// let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let tetrahedron = Mesh::new(vertices, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
/// assert!((tetrahedron.volume() - 1.0 / 6.0).abs() < 1e-15);
/// assert!((tetrahedron.closest([0.2, 0.2, 0.1]).distance + 0.1).abs() < 1e-15);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mesh {
    vertices: Vec<[f64; 3]>,
    /// In the order of the tree's leaves. Side `k` of a triangle runs from its corner `k` to the next.
    triangles: Vec<[u32; 3]>,
    /// The triangles' corners, as queries read them.
    corners: Vec<[[f64; 3]; 3]>,
    bvh: Bvh<3>,
    normals: Normals,
    features: OnceLock<Features<3>>,
    /// The connected parts, once they were asked for; boxed, so that a mesh is not large by what most have not.
    parts: Box<OnceLock<Vec<Arc<Self>>>>,
    area: f64,
    volume: f64,
}

impl Mesh {
    /// The mesh of `triangles`, three places in `vertices` each (scene units). The order of a triangle's corners must
    /// agree with its neighbours'; the whole is turned inside out where its volume comes out negative. Triangles
    /// that use a vertex twice are dropped. O(n log n).
    ///
    /// # Errors
    /// [`MeshError::NotFinite`], [`MeshError::BadIndex`], [`MeshError::Open`] unless every edge has
    /// exactly two triangles, [`MeshError::InconsistentFacing`] where these face opposite ways,
    /// [`MeshError::NoVolume`].
    pub fn new(
        vertices: Vec<[f64; 3]>,
        mut triangles: Vec<[u32; 3]>,
    ) -> Result<Self, GeometryError> {
        topology::check_places(&vertices, &triangles)?;
        triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
        if triangles.is_empty() {
            return Err(MeshError::NoVolume { triangles: 0 }.into());
        }
        topology::check_closed(&vertices, &triangles)?;
        let mut volume = enclosed(&vertices, &triangles);
        let size = Bounds::of(&vertices).diagonal();
        if volume.abs() <= 1e-15 * size.powi(3) || !volume.is_finite() {
            return Err(MeshError::NoVolume {
                triangles: triangles.len(),
            }
            .into());
        }
        if volume < 0.0 {
            volume = -volume;
            for t in &mut triangles {
                t.swap(1, 2);
            }
        }
        let place = |t: &[u32; 3]| t.map(|v| vertices[v as usize]);
        let boxes: Vec<Bounds<3>> = triangles.iter().map(|t| Bounds::of(&place(t))).collect();
        let mut bvh = Bvh::build(&boxes);
        let triangles: Vec<[u32; 3]> = bvh
            .renumber()
            .into_iter()
            .map(|i| triangles[i as usize])
            .collect();
        let corners: Vec<[[f64; 3]; 3]> = triangles.iter().map(place).collect();
        let neighbors = topology::neighbors(&triangles);
        let normals = Normals::new(vertices.len(), &triangles, &corners, &neighbors);
        Ok(Self {
            area: corners.iter().map(triangle::area).sum(),
            volume,
            normals,
            bvh,
            corners,
            features: OnceLock::new(),
            parts: Box::default(),
            vertices,
            triangles,
        })
    }

    /// The mesh of loose triangles, each its three corners: equal corners are welded, and where edges stay open,
    /// corners within 10⁻⁶ of the mesh's size are welded too.
    ///
    /// # Errors
    /// As [`Mesh::new`].
    pub fn from_loose(corners: &[[[f64; 3]; 3]]) -> Result<Self, GeometryError> {
        if let Some(index) = corners
            .iter()
            .position(|t| t.iter().any(|&v| !point::is_finite(v)))
        {
            return Err(MeshError::NotFinite {
                what: "triangle",
                index,
            }
            .into());
        }
        let (vertices, triangles) = weld::exact(corners);
        let size = Bounds::of(&vertices).diagonal();
        match Self::new(vertices.clone(), triangles.clone()) {
            Err(error @ GeometryError::Mesh(MeshError::Open { .. })) => {
                let (vertices, triangles) =
                    weld::within(&vertices, &triangles, weld::TOLERANCE * size);
                // What the exact weld finds wrong is nearer to the file.
                Self::new(vertices, triangles).map_err(|_| error)
            }
            result => result,
        }
    }

    /// Vertices, scene units.
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Triangles, three places in [`Mesh::vertices`] each, counter-clockwise seen from outside; sorted in space, not
    /// in the order of the input.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The mesh scaled by `factor` about the origin.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless `factor` is positive and finite, or what [`Mesh::new`] finds where
    /// numbers overflow.
    pub fn scaled(&self, factor: f64) -> Result<Self, GeometryError> {
        self.transformed(&Similarity::scaling(factor)?)
    }

    /// The mesh scaled, rotated and moved.
    ///
    /// # Errors
    /// What [`Mesh::new`] finds where numbers overflow.
    pub fn transformed(&self, by: &Similarity<3>) -> Result<Self, GeometryError> {
        Self::new(
            self.vertices.iter().map(|&v| by.point(v)).collect(),
            self.triangles.clone(),
        )
    }
}

/// Signed volume by the divergence theorem, taken about the middle of the mesh so that a far origin costs no digits.
fn enclosed(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    let middle = Bounds::of(vertices).center();
    let mut six = 0.0;
    for t in triangles {
        let [a, b, c] = t.map(|v| point::sub(vertices[v as usize], middle));
        six += point::dot(a, point::cross(b, c));
    }
    six / 6.0
}
