//! The area and volume of a mesh moved inward.

use std::sync::Arc;

use super::{Mesh, topology, triangle, vanished};
use crate::level_inset::LevelInset;
use crate::surface::Surface;
use crate::{GeometryError, ParameterError};

/// Where some edge turns by more than this (radians), faces lie nearly on each other, and the expansion says nothing.
const FOLD: f64 = 2.8;

/// Edges that turn by less than this (radians) are taken as flat where the faces around a vertex are told apart.
const FLAT: f64 = 0.05;

/// The level set φ = −`depth` of the mesh, with its area and volume by Steiner's expansion, as for polyhedra and
/// smooth bodies:
///
/// A(d) = A − d Σ 2 ℓ w + d² Σ c, V(d) = V − d A + d² Σ ℓ w − d³ Σ c / 3,
///
/// over edges of length ℓ and vertices. w = tan(α/2) for a convex edge that turns by α (both faces lose a strip),
/// −α/2 for a reflex one (a round strip is added). c is, at a vertex with flat faces that meet in edges, the sum of
/// (2 w₁w₂ + (w₁² + w₂²) cos β) / (2 sin β) over the faces' angles β; elsewhere the angle defect. Exact for convex
/// polyhedra with three edges per corner while no face vanishes, and for smooth bodies as far as the mesh resolves
/// them; depth ≪ size of what is not smooth otherwise. Where whole walls vanish, area and volume are counted
/// ([`vanished::contents`]).
pub(super) fn inset(mesh: &Mesh, depth: f64) -> Result<Arc<dyn Surface<3>>, GeometryError> {
    ParameterError::check_depth(depth)?;
    let body: Arc<dyn Surface<3>> = Arc::new(mesh.clone());
    if depth == 0.0 {
        return Ok(body);
    }
    if (mesh.normals.turn.iter().flatten()).any(|turn| turn.abs() > FOLD) {
        return Ok(Arc::new(LevelInset::new(body, depth)?));
    }
    if let Some((area, volume)) = vanished::contents(mesh, depth) {
        let inset = LevelInset::with_contents(body, depth, area, volume)?;
        return Ok(Arc::new(inset));
    }
    let (edges, vertices) = coefficients(mesh);
    let area = mesh.area - depth * (2.0 * edges - depth * vertices);
    let volume = mesh.volume - depth * (mesh.area - depth * (edges - depth * vertices / 3.0));
    // Beyond its range the expansion is of no use: it must fall with the depth, between nothing and the body.
    let falls = edges <= 0.0 || depth * vertices < edges;
    if falls && area > 0.0 && volume > 0.0 && volume < mesh.volume {
        Ok(Arc::new(LevelInset::with_contents(
            body, depth, area, volume,
        )?))
    } else {
        Ok(Arc::new(LevelInset::new(body, depth)?))
    }
}

/// Σ ℓ w over edges and Σ c over vertices.
fn coefficients(mesh: &Mesh) -> (f64, f64) {
    let mut edges = 0.0;
    for (t, corners) in mesh.corners.iter().enumerate() {
        for k in 0..3 {
            let length = sphpack_neighbors::point::distance(corners[k], corners[(k + 1) % 3]);
            // Every edge is met twice.
            edges += 0.5 * length * width(mesh, t, k);
        }
    }
    let vertices = of_vertices(mesh).iter().fold(0.0, |sum, c| sum + c);
    (edges, vertices)
}

/// c of every vertex; 0 of those that no triangle uses.
pub(crate) fn of_vertices(mesh: &Mesh) -> Vec<f64> {
    let across = topology::neighbors(&mesh.triangles);
    // Per vertex: one of its triangles' corners, and the sum of the angles around it.
    let mut start = vec![(0, 0); mesh.vertices.len()];
    let mut angles = vec![0.0; mesh.vertices.len()];
    for (t, corners) in mesh.corners.iter().enumerate() {
        for k in 0..3 {
            let v = mesh.triangles[t][k] as usize;
            start[v] = (t, k);
            angles[v] += triangle::angle(corners, k);
        }
    }
    (0..mesh.vertices.len())
        .map(|v| {
            if angles[v] == 0.0 {
                return 0.0;
            }
            let defect = std::f64::consts::TAU - angles[v];
            let term = if mesh.normals.is_corner[v] {
                corner_term(mesh, &across, start[v])
            } else {
                None
            };
            term.unwrap_or(defect)
        })
        .collect()
}

/// w of side `k` of a triangle.
pub(crate) fn width(mesh: &Mesh, t: usize, k: usize) -> f64 {
    let turn = mesh.normals.turn[t][k];
    if turn > 0.0 {
        (0.5 * turn).tan().min(1e3)
    } else {
        0.5 * turn
    }
}

/// Whether the faces at side `k` of a triangle lie nearly on each other.
pub(crate) fn is_fold(mesh: &Mesh, t: usize, k: usize) -> bool {
    mesh.normals.turn[t][k].abs() > FOLD
}

/// c of [`inset`] for a vertex with flat faces; `None` where it is not that simple.
fn corner_term(mesh: &Mesh, across: &[[(u32, u8); 3]], (t, k): (usize, usize)) -> Option<f64> {
    // Around the vertex over the sides that leave it: angle of each triangle, and what lies beyond its side.
    let mut ring: Vec<(f64, f64, f64)> = Vec::new();
    let (mut at, mut corner) = (t, k);
    loop {
        ring.push((
            triangle::angle(&mesh.corners[at], corner),
            mesh.normals.turn[at][corner],
            width(mesh, at, corner),
        ));
        let (next, back) = across[at][corner];
        at = next as usize;
        corner = (back as usize + 1) % 3;
        if at == t || ring.len() > 1000 {
            break;
        }
    }
    // Start behind an edge, then join triangles up to the next edge into one face.
    let first = ring.iter().position(|&(_, turn, _)| turn.abs() > FLAT)?;
    ring.rotate_left(first);
    let mut before = ring.first()?.2;
    let (mut beta, mut sum) = (0.0, 0.0);
    for &(angle, turn, w) in ring[1..].iter().chain(&ring[..1]) {
        beta += angle;
        if turn.abs() > FLAT {
            let (sin, cos) = f64::sin_cos(beta);
            if sin < 0.1 {
                return None;
            }
            sum += (2.0 * before * w + (before * before + w * w) * cos) / (2.0 * sin);
            before = w;
            beta = 0.0;
        }
    }
    Some(sum)
}
