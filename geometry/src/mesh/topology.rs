//! Which triangles share which edges.

use sphpack_neighbors::point;

use crate::GeometryError;

/// One side of one triangle: its vertices, lower first, then triangle, side, and whether it runs from lower to higher.
type Side = (u32, u32, u32, u8, bool);

/// All sides, those of one edge together.
fn sorted_sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (t, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            sides.push((a.min(b), a.max(b), t as u32, k as u8, a < b));
        }
    }
    sides.sort_unstable();
    sides
}

/// Whether every edge has exactly two triangles that run along it in opposite directions.
pub(super) fn check_closed(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
) -> Result<(), GeometryError> {
    let middle = |side: &Side| {
        point::scale(
            point::add(vertices[side.0 as usize], vertices[side.1 as usize]),
            0.5,
        )
    };
    let (mut open_edges, mut non_manifold, mut wrong_way) = (0, 0, 0);
    let (mut first_hole, mut first_wrong) = (None, None);
    for edge in sorted_sides(triangles).chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        match edge {
            [a, b] if a.4 != b.4 => {}
            [a, _] => {
                wrong_way += 1;
                first_wrong.get_or_insert_with(|| middle(a));
            }
            _ => {
                if edge.len() == 1 {
                    open_edges += 1;
                } else {
                    non_manifold += 1;
                }
                first_hole.get_or_insert_with(|| middle(&edge[0]));
            }
        }
    }
    if let Some(place) = first_hole {
        return Err(GeometryError::OpenMesh {
            open_edges,
            non_manifold,
            place,
        });
    }
    match first_wrong {
        Some(place) => Err(GeometryError::InconsistentFacing {
            edges: wrong_way,
            place,
        }),
        None => Ok(()),
    }
}

/// For every triangle and side of a closed mesh, the triangle on the other side and its side's number.
pub(super) fn neighbors(triangles: &[[u32; 3]]) -> Vec<[(u32, u8); 3]> {
    let mut across = vec![[(0, 0); 3]; triangles.len()];
    for edge in sorted_sides(triangles).chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let [a, b] = edge {
            across[a.2 as usize][a.3 as usize] = (b.2, b.3);
            across[b.2 as usize][b.3 as usize] = (a.2, a.3);
        }
    }
    across
}
