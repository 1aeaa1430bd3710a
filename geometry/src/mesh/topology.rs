//! Which triangles share which edges.

use rayon::prelude::*;
use sphpack_neighbors::point;

use crate::MeshError;

/// One side of one triangle, in two numbers so that millions of them sort fast.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// Its vertices, the lower one first.
    edge: u64,
    /// Triangle, side, and whether it runs from the lower vertex to the higher.
    at: u64,
}

impl Side {
    fn new(triangle: usize, k: usize, from: u32, to: u32) -> Self {
        Self {
            edge: u64::from(from.min(to)) << 32 | u64::from(from.max(to)),
            at: (triangle as u64) << 3 | (k as u64) << 1 | u64::from(from < to),
        }
    }

    /// Its two vertices, the lower one first.
    pub(crate) fn ends(self) -> [usize; 2] {
        [
            (self.edge >> 32) as usize,
            (self.edge & u64::from(u32::MAX)) as usize,
        ]
    }

    /// Its triangle.
    pub(crate) fn triangle(self) -> usize {
        (self.at >> 3) as usize
    }

    /// Which side of the triangle it is: from that corner to the next.
    pub(crate) fn side(self) -> usize {
        (self.at >> 1 & 3) as usize
    }

    /// Whether it runs from the lower vertex to the higher.
    pub(crate) fn runs_up(self) -> bool {
        self.at & 1 == 1
    }

    /// The middle of its edge.
    pub(crate) fn middle(self, vertices: &[[f64; 3]]) -> [f64; 3] {
        let [a, b] = self.ends();
        point::scale(point::add(vertices[a], vertices[b]), 0.5)
    }
}

/// Refuses vertices that are no finite numbers, and corners that are no places in `vertices`.
pub(crate) fn check_places(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    // Squares must stay finite too, or every distance is infinite.
    let is_bad = |&v: &[f64; 3]| !point::norm_squared(v).is_finite();
    if let Some(index) = vertices.iter().position(is_bad) {
        return Err(MeshError::NotFinite {
            what: "vertex",
            index,
        });
    }
    let count = vertices.len();
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= count) {
            return Err(MeshError::BadIndex {
                triangle,
                vertex: vertex as usize,
                vertices: count,
            });
        }
    }
    Ok(())
}

/// All sides, those of one edge together.
pub(crate) fn sorted_sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (t, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            sides.push(Side::new(t, k, corners[k], corners[(k + 1) % 3]));
        }
    }
    sides.par_sort_unstable();
    sides
}

/// The sides of each edge, edge after edge.
pub(crate) fn edges(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| a.edge == b.edge)
}

/// Whether every edge has exactly two triangles that run along it in opposite directions.
pub(super) fn check_closed(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let (mut open_edges, mut non_manifold, mut wrong_way) = (0, 0, 0);
    let (mut first_hole, mut first_wrong) = (None, None);
    for edge in edges(&sorted_sides(triangles)) {
        match edge {
            [a, b] if a.runs_up() != b.runs_up() => {}
            [a, _] => {
                wrong_way += 1;
                first_wrong.get_or_insert_with(|| a.middle(vertices));
            }
            _ => {
                if edge.len() == 1 {
                    open_edges += 1;
                } else {
                    non_manifold += 1;
                }
                first_hole.get_or_insert_with(|| edge[0].middle(vertices));
            }
        }
    }
    if let Some(place) = first_hole {
        return Err(MeshError::Open {
            open_edges,
            non_manifold,
            place,
        });
    }
    match first_wrong {
        Some(place) => Err(MeshError::InconsistentFacing {
            edges: wrong_way,
            place,
        }),
        None => Ok(()),
    }
}

/// For every triangle and side of a closed mesh, the triangle on the other side and its side's number.
pub(super) fn neighbors(triangles: &[[u32; 3]]) -> Vec<[(u32, u8); 3]> {
    let mut across = vec![[(0, 0); 3]; triangles.len()];
    for edge in edges(&sorted_sides(triangles)) {
        if let [a, b] = edge {
            across[a.triangle()][a.side()] = (b.triangle() as u32, b.side() as u8);
            across[b.triangle()][b.side()] = (a.triangle() as u32, a.side() as u8);
        }
    }
    across
}
