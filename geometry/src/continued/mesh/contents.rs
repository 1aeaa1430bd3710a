//! Area and volume of a mesh within a box, and of what is left of it where it is moved inward.

use sphpack_neighbors::{Bounds, Domain, point};

use super::super::slack;
use super::super::window::{clipped, holds, part_of_way};
use crate::mesh::{Mesh, inset, triangle};

/// Part of the area by which it may grow or shrink along open sides: a cap of a ball of R = 6 and height 1, moved by 0.5, is 0.41 by this and
/// 7 % off.
const ASLANT: f64 = 0.1;

/// What of a mesh lies in a box, as powers of the depth by which it is moved inward.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Contents {
    area: f64,
    pub(super) volume: f64,
    /// Σ ℓ w over edges and Σ c over vertices within the box, as Steiner's expansion has them.
    edges: f64,
    vertices: f64,
    /// Σ ℓ tan φ over the lines in which the surface passes open sides, φ the angle between its normal and the side: so much
    /// longer it becomes there.
    rim: f64,
    /// The same with every part of a line by its size.
    aslant: f64,
    /// Whether faces lie nearly on each other at an edge.
    is_folded: bool,
}

impl Contents {
    /// Area and volume.
    pub(super) fn as_it_is(&self) -> (f64, f64) {
        (self.area, self.volume.max(0.0))
    }

    /// Area and volume once the surface has moved inward by `depth`; `None` where the expansion does not go so far: along the small folds
    /// of a mesh that was cut on a grid it says anything.
    pub(super) fn moved_in(&self, depth: f64) -> Option<(f64, f64)> {
        let falls = self.edges <= 0.0 || depth * self.vertices < self.edges;
        let is_aslant = depth * self.aslant > ASLANT * self.area;
        if self.area > 0.0 && (self.is_folded || !falls || is_aslant) {
            return None;
        }
        let area = self.area - depth * (2.0 * self.edges - self.rim - depth * self.vertices);
        let half = self.edges - 0.5 * self.rim;
        let volume =
            self.volume - depth * (self.area - depth * (half - depth * self.vertices / 3.0));
        Some((area.max(0.0), volume.clamp(0.0, self.volume.max(0.0))))
    }
}

/// Triangles, of the parts of a mesh's triangles within the box, with the normals of the whole ones.
pub(super) fn pieces_in(mesh: &Mesh, domain: &Domain<3>) -> Vec<([[f64; 3]; 3], [f64; 3])> {
    let mut pieces = Vec::new();
    for t in mesh.triangles() {
        let corners = t.map(|v| mesh.vertices()[v as usize]);
        let polygon = within(&corners, domain);
        let Some(normal) = point::unit(triangle::area_vector(&corners)) else {
            continue;
        };
        for k in 1..polygon.len().saturating_sub(1) {
            let piece = [polygon[0], polygon[k], polygon[k + 1]];
            if triangle::area(&piece) > 0.0 {
                pieces.push((piece, normal));
            }
        }
    }
    pieces
}

/// The part of a triangle within the box; none of one that lies on an open side or on an upper periodic one.
fn within(corners: &[[f64; 3]; 3], domain: &Domain<3>) -> Vec<[f64; 3]> {
    let Bounds { min, max } = domain.bounds;
    let mut polygon = corners.to_vec();
    for k in 0..3 {
        let lies_on = |side: f64| corners.iter().all(|c| c[k] == side);
        if lies_on(max[k]) || lies_on(min[k]) && !domain.periodic[k] {
            return Vec::new();
        }
        if corners.iter().any(|c| c[k] > max[k]) {
            polygon = clipped(&polygon, k, max[k], 1.0);
        }
        if corners.iter().any(|c| c[k] < min[k]) {
            polygon = clipped(&polygon, k, min[k], -1.0);
        }
        if polygon.len() < 3 {
            return Vec::new();
        }
    }
    polygon
}

pub(super) fn of(mesh: &Mesh, domain: &Domain<3>) -> Contents {
    let mut found = Contents::default();
    let at_side = slack(domain);
    for (t, triangle) in mesh.triangles().iter().enumerate() {
        let corners = triangle.map(|v| mesh.vertices()[v as usize]);
        found.volume += below(&corners, domain);
        let polygon = within(&corners, domain);
        for k in 1..polygon.len().saturating_sub(1) {
            found.area += triangle::area(&[polygon[0], polygon[k], polygon[k + 1]]);
        }
        if !polygon.is_empty() {
            let rim = rim(&corners, &polygon, domain);
            found.rim += rim;
            found.aslant += rim.abs();
        }
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            if let Some([from, to]) = part_of_way(a, b, domain) {
                // Every edge is met twice.
                found.edges += 0.5 * (to - from) * point::distance(a, b) * inset::width(mesh, t, k);
                found.is_folded |= inset::is_fold(mesh, t, k);
            }
        }
    }
    for (v, &c) in inset::of_vertices(mesh).iter().enumerate() {
        if holds(mesh.vertices()[v], domain, at_side) {
            found.vertices += c;
        }
    }
    found
}

/// What a triangle adds to ∮ x n_x dA with all coordinates kept within the box: over all triangles the volume in it.
fn below(corners: &[[f64; 3]; 3], domain: &Domain<3>) -> f64 {
    let Bounds { min, max } = domain.bounds;
    let mut polygon = corners.to_vec();
    for k in 1..3 {
        polygon = clipped(&polygon, k, max[k], 1.0);
        polygon = clipped(&polygon, k, min[k], -1.0);
        if polygon.len() < 3 {
            return 0.0;
        }
    }
    let moment = |polygon: &[[f64; 3]], height: &dyn Fn([f64; 3]) -> f64| -> f64 {
        (1..polygon.len().saturating_sub(1))
            .map(|k| {
                let piece = [polygon[0], polygon[k], polygon[k + 1]];
                let mean = piece.iter().map(|&p| height(p)).sum::<f64>() / 3.0;
                0.5 * mean * triangle::area_vector(&piece)[0]
            })
            .sum()
    };
    let lower = clipped(&polygon, 0, max[0], 1.0);
    let middle = clipped(&lower, 0, min[0], -1.0);
    let above = clipped(&polygon, 0, max[0], -1.0);
    let width = max[0] - min[0];
    moment(&middle, &|p| p[0] - min[0]) + moment(&above, &|_| width)
}

/// The lengths of a clipped triangle's sides on open sides of the box, times how much longer the surface becomes there.
fn rim(corners: &[[f64; 3]; 3], polygon: &[[f64; 3]], domain: &Domain<3>) -> f64 {
    let Some(normal) = point::unit(triangle::area_vector(corners)) else {
        return 0.0;
    };
    let mut sum = 0.0;
    for k in (0..3).filter(|&k| !domain.periodic[k]) {
        for (side, out) in [(domain.bounds.min[k], -1.0), (domain.bounds.max[k], 1.0)] {
            for (i, a) in polygon.iter().enumerate() {
                let b = &polygon[(i + 1) % polygon.len()];
                if a[k] == side && b[k] == side {
                    let slope = normal[k] * out;
                    let along = (1.0 - slope * slope).max(1e-12).sqrt();
                    sum += point::distance(*a, *b) * slope / along;
                }
            }
        }
    }
    sum
}
