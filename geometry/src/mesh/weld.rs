//! Loose triangles into shared vertices.

use std::collections::HashMap;

use sphpack_neighbors::point;

/// Vertices nearer than this, in parts of the mesh's size, may be one where the exact weld leaves holes: some ten
/// times the resolution of the 32-bit numbers in STL files.
pub(crate) const TOLERANCE: f64 = 1e-6;

/// Shared vertices, and triangles by their numbers.
type Indexed = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Vertices in the order of their first use, equal ones (−0 = 0) shared.
pub(crate) fn exact(corners: &[[[f64; 3]; 3]]) -> Indexed {
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::with_capacity(corners.len());
    let mut vertices = Vec::new();
    let triangles = corners
        .iter()
        .map(|t| {
            t.map(|p| {
                let p = p.map(|x| x + 0.0);
                *numbers.entry(p.map(f64::to_bits)).or_insert_with(|| {
                    vertices.push(p);
                    vertices.len() as u32 - 1
                })
            })
        })
        .collect();
    (vertices, triangles)
}

/// Every vertex takes the place of the first one within `tolerance`, if there is one. O(n).
pub(crate) fn within(vertices: &[[f64; 3]], triangles: &[[u32; 3]], tolerance: f64) -> Indexed {
    let cell = |p: [f64; 3]| p.map(|x| (x / tolerance).floor() as i64);
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::with_capacity(vertices.len());
    let mut kept: Vec<[f64; 3]> = Vec::new();
    let mut number = Vec::with_capacity(vertices.len());
    for &p in vertices {
        let home = cell(p);
        let mut found: Option<u32> = None;
        for step in 0..27 {
            let offset = [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1];
            let there: [i64; 3] = std::array::from_fn(|k| home[k].saturating_add(offset[k]));
            for &v in cells.get(&there).into_iter().flatten() {
                if point::distance(kept[v as usize], p) <= tolerance {
                    found = Some(found.map_or(v, |f| f.min(v)));
                }
            }
        }
        number.push(found.unwrap_or_else(|| {
            kept.push(p);
            let v = kept.len() as u32 - 1;
            cells.entry(home).or_default().push(v);
            v
        }));
    }
    let triangles = triangles
        .iter()
        .map(|t| t.map(|v| number[v as usize]))
        .collect();
    (kept, triangles)
}
