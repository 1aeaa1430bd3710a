//! The zero set as a closed mesh: dual contouring, free of self-intersections.
//!
//! One point per patch of the surface in each cell, where the planes that touch it meet, and around every crossed edge of
//! the grid a polygon of the points of its four cells (Ju, Losasso, Schaefer, Warren, "Dual contouring of Hermite data",
//! ACM TOG 21, 2002). Where a side of that polygon would not pass through the face that its two cells share, a point
//! on that face is put in, and where no diagonal keeps within reach of the edge the polygon becomes a fan around the
//! crossing (after Ju and Udeshi, "Intersection-free contouring on an octree grid", Pacific Graphics 2006): then every
//! triangle keeps to the cells and edges it belongs to. Faces that the surface crosses twice always have their own
//! points, so that every edge of the mesh has two triangles.

use std::collections::HashMap;

use sphpack_neighbors::point;

use super::LevelSet;
use super::cells::{Cells, PLACES};
use super::crossings::{Crossing, MARGIN};
use crate::{GeometryError, Mesh};

impl LevelSet<3> {
    /// The zero set as a closed mesh, `None` where nothing is inside. Sharp edges stay sharp where the surface or the
    /// Boolean has them, by planes that touch the surface as it is, not as the grid sees it; elsewhere the mesh is
    /// within some cell² / 8R of a surface that bends by radius R, and its volume within some cell² / 2R² of that of a
    /// ball. No two triangles cross. A little over two triangles per cell² of the surface; a query or two of the
    /// surface per triangle, in parallel.
    ///
    /// # Errors
    /// What [`Mesh::new`] finds: [`GeometryError::NoVolume`] where next to nothing is inside.
    pub fn mesh(&self) -> Result<Option<Mesh>, GeometryError> {
        if self.is_empty() {
            return Ok(None);
        }
        let crossings = self.crossings();
        let cells = Cells::new(self, &crossings);
        let mut contour = Contour {
            set: self,
            crossings: &crossings,
            vertices: cells.points.clone(),
            cells: &cells,
            on_faces: HashMap::new(),
            triangles: Vec::with_capacity(2 * crossings.len()),
        };
        for n in 0..crossings.len() {
            contour.surround(n);
        }
        Mesh::new(contour.vertices, contour.triangles).map(Some)
    }
}

struct Contour<'a> {
    set: &'a LevelSet<3>,
    crossings: &'a [Crossing],
    cells: &'a Cells,
    vertices: Vec<[f64; 3]>,
    /// Points on faces, by the two crossings that they lie between.
    on_faces: HashMap<[u32; 2], u32>,
    triangles: Vec<[u32; 3]>,
}

impl Contour<'_> {
    /// The polygon around crossing `n`.
    fn surround(&mut self, n: usize) {
        let crossing = self.crossings[n];
        let k = crossing.axis;
        let corners: [u32; 4] = std::array::from_fn(|i| {
            let cell = &self.cells.cells[self.cells.around[n][i] as usize];
            let [u, v] = PLACES[i];
            cell.first + u32::from(cell.case.patch[4 * k + u + 2 * v])
        });
        // As seen from the edge's lower end, in cells: along the two other axes, then along the edge.
        let start = self.set.blocks.place(crossing.node);
        let seen = corners.map(|v| {
            let away = point::sub(self.vertices[v as usize], start);
            [(k + 1) % 3, (k + 2) % 3, k].map(|a| away[a] / self.set.cell())
        });
        let mut ring = Vec::with_capacity(8);
        for i in 0..4 {
            ring.push(corners[i]);
            ring.extend(self.on_face(n, i, &corners));
        }
        let diagonal = if ring.len() == 4 {
            diagonal(&seen, crossing.part)
        } else {
            None
        };
        let own = self.triangles.len();
        if let Some(first) = diagonal {
            let at = |i: usize| corners[(first + i) % 4];
            self.triangles.push([at(0), at(1), at(2)]);
            self.triangles.push([at(0), at(2), at(3)]);
        } else {
            let hub = self.vertices.len() as u32;
            self.vertices.push(crossing.point);
            for (i, &v) in ring.iter().enumerate() {
                self.triangles.push([v, ring[(i + 1) % ring.len()], hub]);
            }
        }
        if !crossing.leaves {
            for t in &mut self.triangles[own..] {
                t.swap(1, 2);
            }
        }
    }

    /// The point on the face between corners `i` and `i + 1` of the polygon around crossing `n`, if one is needed. What
    /// is decided for the partner of `n` on that face is decided from the same numbers.
    fn on_face(&mut self, n: usize, i: usize, corners: &[u32; 4]) -> Option<u32> {
        let (axis, next) = (self.crossings[n].axis, (i + 1) % 4);
        let [a, b] = [i, next].map(|i| &self.cells.cells[self.cells.around[n][i] as usize]);
        // The face is at a right angle to the first other axis, then the second; the polygon goes once round the edge.
        let other = i % 2;
        let across = (axis + 1 + other) % 3;
        let [u, v] = PLACES[i];
        let face = 2 * across + PLACES[i][other];
        let partner = a.crossings[usize::from(a.case.partner[face][4 * axis + u + 2 * v])];
        let key = [(n as u32).min(partner), (n as u32).max(partner)];
        if a.case.is_twofold[face] || a.case.count > 1 || b.case.count > 1 {
            let [p, q] = key.map(|n| self.crossings[n as usize].point);
            return Some(self.face_point(key, point::scale(point::add(p, q), 0.5)));
        }
        // From the lower cell to the upper, whose lowest node is the face's too.
        let is_up = PLACES[i][other] == 1;
        let (from, to, upper) = if is_up {
            (corners[i], corners[next], b)
        } else {
            (corners[next], corners[i], a)
        };
        let [p, q] = [from, to].map(|v| self.vertices[v as usize]);
        let (start, cell) = (self.set.blocks.place(upper.node), self.set.cell());
        let share = (start[across] - p[across]) / (q[across] - p[across]);
        let mut is_on_face = true;
        let place = std::array::from_fn(|k| {
            if k == across {
                return start[k];
            }
            let passed = (p[k] + share * (q[k] - p[k]) - start[k]) / cell;
            let kept = passed.clamp(MARGIN, 1.0 - MARGIN);
            is_on_face &= kept == passed;
            start[k] + kept * cell
        });
        (!is_on_face).then(|| self.face_point(key, place))
    }

    fn face_point(&mut self, key: [u32; 2], place: [f64; 3]) -> u32 {
        let vertices = &mut self.vertices;
        *self.on_faces.entry(key).or_insert_with(|| {
            vertices.push(place);
            vertices.len() as u32 - 1
        })
    }
}

/// The corner from which a diagonal cuts the polygon around an edge into two triangles whose planes meet the edge; of
/// two such the one that passes it nearer to `part`. Corners as seen from the edge's lower end, in cells.
fn diagonal(seen: &[[f64; 3]; 4], part: f64) -> Option<usize> {
    let cross = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
    // Where the plane of three corners meets the edge; nowhere if they turn the wrong way, because the diagonal passes
    // outside the polygon.
    let height = |[p, q, r]: [[f64; 3]; 3]| {
        let (a, b, c) = (cross(q, r), cross(r, p), cross(p, q));
        let double_area = a + b + c;
        if double_area > 0.0 {
            (a * p[2] + b * q[2] + c * r[2]) / double_area
        } else {
            f64::NAN
        }
    };
    let off = |first: usize| {
        let at = |i: usize| seen[(first + i) % 4];
        let heights = [height([at(0), at(1), at(2)]), height([at(0), at(2), at(3)])];
        let is_within = heights.iter().all(|&h| h > 0.0 && h < 1.0);
        // The edge passes the first triangle where it is on that side of the diagonal.
        let passed = usize::from(cross(at(2), at(0)) < 0.0);
        is_within.then(|| (heights[passed] - part).abs())
    };
    match (off(0), off(1)) {
        (Some(a), Some(b)) => Some(usize::from(b < a)),
        (a, b) => a.map(|_| 0).or(b.map(|_| 1)),
    }
}
