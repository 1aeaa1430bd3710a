//! Holes, closed by triangles over their rims.

use std::collections::{BTreeMap, BTreeSet};

use sphpack_neighbors::point;

use super::Soup;
use super::check::across as size_of;
use super::shells::NONE;
use super::triangulate::{MOST_POINTS, least_area};
use crate::mesh::topology::{self, Side};

/// A rim, and the triangles over it.
#[derive(Debug)]
pub(super) struct Filling {
    /// Vertices of the triangles; one beyond the last of the soup is `middle`.
    pub(super) triangles: Vec<[u32; 3]>,
    /// A new vertex, where there is one.
    pub(super) middle: Option<[f64; 3]>,
    /// The middle of the hole.
    pub(super) place: [f64; 3],
    /// How large the hole is across.
    pub(super) size: f64,
}

/// The rims of `soup`, whose triangles must agree: loops of vertices, in the direction in which new triangles run
/// along them.
fn rims(soup: &Soup, sides: &[Side]) -> Vec<Vec<u32>> {
    // Per side the neighbour across; NONE for rims and edges of more than two triangles.
    let mut across = vec![[(NONE, 0_u8); 3]; soup.triangles.len()];
    // Open sides by the vertex they end in.
    let mut into: BTreeMap<u32, Vec<(usize, usize)>> = BTreeMap::new();
    let mut open: Vec<(usize, usize)> = Vec::new();
    for edge in topology::edges(sides) {
        match edge {
            [a] => {
                let (t, k) = (a.triangle(), a.side());
                open.push((t, k));
                let end = soup.triangles[t][(k + 1) % 3];
                into.entry(end).or_default().push((t, k));
            }
            [a, b] => {
                across[a.triangle()][a.side()] = (b.triangle() as u32, b.side() as u8);
                across[b.triangle()][b.side()] = (a.triangle() as u32, a.side() as u8);
            }
            _ => {}
        }
    }
    // The open side that ends where side (t, k) begins, at the other end of the fan of triangles around that vertex.
    let before = |t: usize, k: usize| {
        let (mut t, mut k) = (t, (k + 2) % 3);
        for _ in 0..soup.triangles.len() {
            let (next, back) = across[t][k];
            if next == NONE {
                break;
            }
            (t, k) = (next as usize, (usize::from(back) + 2) % 3);
        }
        (t, k)
    };
    // The unit vector from corner `i` of a triangle to corner `j`.
    let direction = |t: usize, i: usize, j: usize| {
        let corners = soup.corners(t);
        point::unit(point::sub(corners[j], corners[i])).unwrap_or([0.0; 3])
    };
    let mut seen: BTreeSet<(usize, usize)> = BTreeSet::new();
    let mut rims = Vec::new();
    for start in open {
        if seen.contains(&start) {
            continue;
        }
        let mut rim = Vec::new();
        let mut at = start;
        loop {
            seen.insert(at);
            let (t, k) = at;
            // New triangles run the other way: from the side's end to its start.
            rim.push(soup.triangles[t][(k + 1) % 3]);
            let start_vertex = soup.triangles[t][k];
            let choices = into.get(&start_vertex).map_or(&[][..], Vec::as_slice);
            let free = || choices.iter().copied().filter(|c| !seen.contains(c));
            // Where holes meet in a vertex, the triangles between two of them bound both: a hole goes on along
            // other triangles, the nearest by direction.
            let next = if choices.len() > 1 {
                let fan = before(t, k);
                let here = direction(t, k, (k + 1) % 3);
                free()
                    .filter(|&c| c != fan)
                    .max_by(|&(s, i), &(u, j)| {
                        let along =
                            |t: usize, k: usize| point::dot(here, direction(t, (k + 1) % 3, k));
                        along(s, i).total_cmp(&along(u, j))
                    })
                    .or_else(|| free().next())
            } else {
                free().next()
            };
            match next {
                Some(next) if start_vertex != rim[0] => at = next,
                _ => {
                    if start_vertex == rim[0] && rim.len() >= 3 {
                        rims.push(rim);
                    }
                    break;
                }
            }
        }
    }
    rims
}

/// Triangles over every rim that can be closed, the smallest first.
pub(super) fn fillings(soup: &Soup, sides: &[Side]) -> Vec<Filling> {
    let mut edges: BTreeSet<[u32; 2]> = {
        let on_rim: BTreeSet<u32> = topology::edges(sides)
            .filter(|edge| edge.len() == 1)
            .flat_map(|edge| edge[0].ends().map(|v| v as u32))
            .collect();
        topology::edges(sides)
            .map(|edge| edge[0].ends().map(|v| v as u32))
            .filter(|ends| ends.iter().all(|v| on_rim.contains(v)))
            .collect()
    };
    let mut fillings: Vec<Filling> = rims(soup, sides)
        .into_iter()
        .map(|rim| {
            let points: Vec<[f64; 3]> = rim.iter().map(|&v| soup.vertices[v as usize]).collect();
            let is_taken = |i: usize, j: usize| {
                let (a, b) = (rim[i], rim[j]);
                a == b || edges.contains(&[a.min(b), a.max(b)])
            };
            let (place, size) = size_of(&points);
            if points.len() <= MOST_POINTS
                && let Some(triangles) = least_area(&points, is_taken)
            {
                let triangles: Vec<[u32; 3]> =
                    triangles.iter().map(|t| t.map(|i| rim[i])).collect();
                for [a, b, c] in &triangles {
                    edges.extend([(a, b), (b, c), (c, a)].map(|(v, w)| [*v.min(w), *v.max(w)]));
                }
                return Filling {
                    triangles,
                    middle: None,
                    place,
                    size,
                };
            }
            let sum = points.iter().fold([0.0; 3], |s, &p| point::add(s, p));
            let middle = soup.vertices.len() as u32;
            Filling {
                triangles: (0..rim.len())
                    .map(|i| [rim[i], rim[(i + 1) % rim.len()], middle])
                    .collect(),
                middle: Some(point::scale(sum, 1.0 / points.len() as f64)),
                place,
                size,
            }
        })
        .collect();
    fillings.sort_by(|a, b| a.size.total_cmp(&b.size));
    fillings
}
