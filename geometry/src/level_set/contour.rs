//! The zero set as a closed mesh: dual contouring, free of self-intersections.
//!
//! One point per patch of the surface in each cell, where the planes that touch it meet, and around every crossed edge of
//! the grid a polygon of the points of its four cells, cut along the diagonal that is nearer to the surface (Ju, Losasso,
//! Schaefer, Warren, "Dual contouring of Hermite data", ACM TOG 21, 2002). Faces that the surface crosses twice have
//! points of their own, so that every edge of the mesh has two triangles.
//!
//! Where triangles cross, which happens where points were held back by the sides of their cells, the polygons around
//! are made anew with care (after Ju and Udeshi, "Intersection-free contouring on an octree grid", Pacific Graphics 2006):
//! where a side of a polygon would not pass through the face that its two cells share, a point on that face is put in, and
//! where no diagonal keeps within reach of the edge the polygon becomes a fan around the crossing. Then every triangle
//! keeps to the cells and edges it belongs to, and none can cross another.

use std::collections::HashMap;

use sphpack_neighbors::point;

use super::LevelSet;
use super::cells::{Cells, NONE, PLACES};
use super::crossings::{Crossing, MARGIN};
use super::fit::Fit;
use crate::{GeometryError, Mesh, Soup};

/// Rounds in which polygons around crossing triangles are made anew, before all are.
const ROUNDS: usize = 8;

/// Of two diagonals that pass each other nearer than this, in cells, either will do.
const FLAT: f64 = 0.01;

impl LevelSet<3> {
    /// The zero set as a closed mesh, `None` where nothing is inside. Sharp edges are kept where the surface or the
    /// Boolean has them, by planes that touch the surface as it is, not as the grid sees it: exactly where faces are
    /// flat, with small folds here and there along curved ones; elsewhere the mesh is
    /// within some 0.4 cell² / R of a surface that bends by radius R, and a ball's volume within 0.25 cell² / R². No two
    /// triangles cross. A little over two triangles per cell² of the surface; a query or two of the surface per
    /// triangle, in parallel.
    ///
    /// # Errors
    /// What [`Mesh::new`] finds: [`MeshError::NoVolume`](crate::MeshError::NoVolume) where next to nothing is inside.
    pub fn mesh(&self) -> Result<Option<Mesh>, GeometryError> {
        if self.is_empty() {
            return Ok(None);
        }
        let crossings = self.crossings();
        let cells = Cells::new(self, &crossings);
        let mut careful = vec![false; crossings.len()];
        for round in 0.. {
            let mut contour = Contour {
                set: self,
                crossings: &crossings,
                cells: &cells,
                careful: &careful,
                vertices: cells.careful_points(self, &crossings, &careful),
                on_faces: HashMap::new(),
                triangles: Vec::with_capacity(2 * crossings.len()),
                around: Vec::with_capacity(2 * crossings.len()),
            };
            for n in 0..crossings.len() {
                contour.surround(n);
            }
            let Contour {
                vertices,
                triangles,
                around,
                ..
            } = contour;
            let soup = Soup::new(vertices, triangles)?;
            let bad = soup.crossing_triangles();
            if bad.is_empty() || careful.iter().all(|&c| c) {
                return Mesh::new(soup.vertices, soup.triangles).map(Some);
            }
            if round >= ROUNDS {
                careful.fill(true);
            }
            for t in bad {
                for cell in cells.around[around[t as usize] as usize] {
                    for &n in &cells.cells[cell as usize].crossings {
                        if n != NONE {
                            careful[n as usize] = true;
                        }
                    }
                }
            }
        }
        Ok(None)
    }
}

struct Contour<'a> {
    set: &'a LevelSet<3>,
    crossings: &'a [Crossing],
    cells: &'a Cells,
    /// Per crossing, whether its polygon must keep within reach of it.
    careful: &'a [bool],
    vertices: Vec<[f64; 3]>,
    /// Points on faces, by the two crossings that they lie between.
    on_faces: HashMap<[u32; 2], u32>,
    triangles: Vec<[u32; 3]>,
    /// Per triangle, the crossing it belongs to.
    around: Vec<u32>,
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
        let mut ring = Vec::with_capacity(8);
        for i in 0..4 {
            ring.push(corners[i]);
            ring.extend(self.on_face(n, i, &corners));
        }
        let diagonal = match (ring.len(), self.careful[n]) {
            (4, true) => {
                // As seen from the edge's lower end, in cells: along the two other axes, then along the edge.
                let start = self.set.blocks.place(crossing.node);
                let seen = corners.map(|v| {
                    let away = point::sub(self.vertices[v as usize], start);
                    [(k + 1) % 3, (k + 2) % 3, k].map(|a| away[a] / self.set.cell())
                });
                careful_diagonal(&seen, crossing.part)
            }
            (4, false) => Some(self.diagonal(&corners)),
            _ => None,
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
        self.around.resize(self.triangles.len(), n as u32);
    }

    /// The corner from which the diagonal begins whose middle is nearer to the surface; of a flat polygon the shorter
    /// one.
    fn diagonal(&self, corners: &[u32; 4]) -> usize {
        let at = corners.map(|v| self.vertices[v as usize]);
        let both = [0, 1].map(|i| (at[i], at[i + 2]));
        let middles = both.map(|(p, q)| point::scale(point::add(p, q), 0.5));
        let [a, b] = both.map(|(p, q)| point::sub(q, p));
        let height = point::unit(point::cross(a, b))
            .map_or(0.0, |up| point::dot(up, point::sub(middles[1], middles[0])));
        let [first, second] = if height.abs() > FLAT * self.set.cell() {
            middles.map(|p| self.set.field.at(p).0.abs())
        } else {
            [a, b].map(point::norm_squared)
        };
        usize::from(second < first)
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
        let [own, mate] = key.map(|n| &self.crossings[n as usize]);
        let middle = point::scale(point::add(own.point, mate.point), 0.5);
        let is_twofold = a.case.is_twofold[face];
        let is_careful = self.careful[n] || self.careful[partner as usize];
        if is_careful && (is_twofold || a.case.count > 1 || b.case.count > 1) {
            return Some(self.face_point(key, || middle));
        }
        if !is_careful && !is_twofold {
            return None;
        }
        // From the lower cell to the upper, whose lowest node is the face's too.
        let is_up = PLACES[i][other] == 1;
        let (from, to, upper) = if is_up {
            (corners[i], corners[next], b)
        } else {
            (corners[next], corners[i], a)
        };
        let [p, q] = [from, to].map(|v| self.vertices[v as usize]);
        let (set, start) = (self.set, self.set.blocks.place(upper.node));
        let clamp = |x: [f64; 3]| {
            std::array::from_fn(|k| {
                let part = (x[k] - start[k]) / set.cell();
                let kept = part.clamp(MARGIN, 1.0 - MARGIN);
                start[k] + if k == across { 0.0 } else { kept * set.cell() }
            })
        };
        let share = (start[across] - p[across]) / (q[across] - p[across]);
        let passed = point::add_scaled(p, share, point::sub(q, p));
        if !is_twofold && point::distance(clamp(passed), passed) <= 1e-9 * set.cell() {
            return None;
        }
        Some(self.face_point(key, || {
            let planes = [own, mate].map(|c| (c.normal, c.offset));
            Fit::new(&planes, middle).within(clamp, MARGIN * set.cell())
        }))
    }

    fn face_point(&mut self, key: [u32; 2], place: impl FnOnce() -> [f64; 3]) -> u32 {
        let vertices = &mut self.vertices;
        *self.on_faces.entry(key).or_insert_with(|| {
            vertices.push(place());
            vertices.len() as u32 - 1
        })
    }
}

/// The corner from which a diagonal cuts the polygon around an edge into two triangles whose planes meet the edge; of
/// two such the one that passes it nearer to `part`. Corners as seen from the edge's lower end, in cells.
fn careful_diagonal(seen: &[[f64; 3]; 4], part: f64) -> Option<usize> {
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
