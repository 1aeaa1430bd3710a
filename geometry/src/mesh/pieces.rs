//! The connected parts of a mesh.

use std::collections::BTreeMap;

use sphpack_neighbors::{Bounds, point};

use super::{Mesh, topology};
use crate::soup::Joined;
use crate::winding::FastWinding;

/// Triangles that hang together by edges.
struct Shell {
    triangles: Vec<u32>,
    bounds: Bounds<3>,
    /// Negative where it faces inward: a cavity.
    volume: f64,
}

impl Mesh {
    /// The parts, each an outer shell with the cavities in it; none where there is but one.
    pub(crate) fn pieces(&self) -> Vec<Self> {
        let shells = self.shells();
        if shells.iter().filter(|shell| shell.volume > 0.0).count() < 2 {
            return Vec::new();
        }
        let mut windings: Vec<Option<FastWinding>> = shells.iter().map(|_| None).collect();
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (k, shell) in shells.iter().enumerate() {
            // A cavity without a shell around it does not bound a body; it goes with itself.
            let outer = if shell.volume > 0.0 {
                k
            } else {
                self.around(shell, &shells, &mut windings).unwrap_or(k)
            };
            members.entry(outer).or_default().push(k);
        }
        let parts: Option<Vec<Self>> = (members.into_values())
            .map(|numbers| {
                let triangles = numbers.iter().flat_map(|&k| &shells[k].triangles);
                self.of(triangles)
            })
            .collect();
        // What is no body by itself is left in one.
        parts.unwrap_or_default()
    }

    fn shells(&self) -> Vec<Shell> {
        let mut joined = Joined::new(self.triangles.len());
        for (t, sides) in topology::neighbors(&self.triangles).iter().enumerate() {
            for &(other, _) in sides {
                joined.join(t as u32, other);
            }
        }
        let mut shells: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for t in 0..self.triangles.len() as u32 {
            shells.entry(joined.find(t)).or_default().push(t);
        }
        (shells.into_values())
            .map(|triangles| {
                let corners = || triangles.iter().map(|&t| &self.corners[t as usize]);
                let bounds = corners().fold(Bounds::EMPTY, |all, t| all.union(Bounds::of(t)));
                // About the middle, so that a far origin costs no digits.
                let middle = bounds.center();
                let six: f64 = corners()
                    .map(|t| {
                        let [a, b, c] = t.map(|p| point::sub(p, middle));
                        point::dot(a, point::cross(b, c))
                    })
                    .sum();
                Shell {
                    bounds,
                    volume: six / 6.0,
                    triangles,
                }
            })
            .collect()
    }

    /// The smallest outer shell around a cavity. `windings` are those of the shells that were asked so far.
    fn around(
        &self,
        cavity: &Shell,
        shells: &[Shell],
        windings: &mut [Option<FastWinding>],
    ) -> Option<usize> {
        let first = *cavity.triangles.first()?;
        let p = self.corners[first as usize][0];
        let mut best: Option<usize> = None;
        for (k, shell) in shells.iter().enumerate() {
            let is_larger = best.is_some_and(|least| shell.volume >= shells[least].volume);
            if shell.volume <= 0.0 || is_larger || !shell.bounds.contains_box(&cavity.bounds) {
                continue;
            }
            let winding = windings[k].get_or_insert_with(|| {
                let corners = shell.triangles.iter().map(|&t| self.corners[t as usize]);
                FastWinding::new(corners.collect())
            });
            if winding.at(p).abs() > 0.5 {
                best = Some(k);
            }
        }
        best
    }

    /// The mesh of some of the triangles, without the vertices of others.
    fn of<'a>(&self, triangles: impl Iterator<Item = &'a u32>) -> Option<Self> {
        let mut number: BTreeMap<u32, u32> = BTreeMap::new();
        let mut vertices = Vec::new();
        let triangles = triangles
            .map(|&t| {
                self.triangles[t as usize].map(|v| {
                    *number.entry(v).or_insert_with(|| {
                        vertices.push(self.vertices[v as usize]);
                        vertices.len() as u32 - 1
                    })
                })
            })
            .collect();
        Self::new(vertices, triangles).ok()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::surface::Surface;

    /// Corners and triangles.
    type Block = (Vec<[f64; 3]>, Vec<[u32; 3]>);

    /// A box, turned inside out for a cavity.
    fn block(min: [f64; 3], size: f64, is_cavity: bool) -> Block {
        let vertices = (0..8)
            .map(|k| std::array::from_fn(|a| min[a] + size * f64::from(k >> a & 1)))
            .collect();
        let quads = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles = (quads.iter())
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .map(|[a, b, c]: [u32; 3]| if is_cavity { [a, c, b] } else { [a, b, c] })
            .collect();
        (vertices, triangles)
    }

    fn mesh(blocks: Vec<Block>) -> Mesh {
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        for (own, sides) in blocks {
            let first = vertices.len() as u32;
            vertices.extend(own);
            triangles.extend(sides.into_iter().map(|side| side.map(|v| v + first)));
        }
        Mesh::new(vertices, triangles).unwrap()
    }

    #[test]
    fn one_piece_has_no_parts() {
        let holed = mesh(vec![
            block([0.0; 3], 1.0, false),
            block([0.2; 3], 0.5, true),
        ]);
        assert!(holed.parts().is_empty());
    }

    proptest! {
        /// Boxes beside each other, each with boxes in boxes in it.
        #[test]
        fn boxes_in_boxes(depths in prop::collection::vec(1_usize..6, 2..4)) {
            let mut blocks = Vec::new();
            let mut volumes = Vec::new();
            for (k, &depth) in depths.iter().enumerate() {
                let edge = |n: usize| 1.0 - 0.2 * n as f64;
                for n in 0..depth {
                    let min = [2.0 * k as f64, 0.0, 0.0].map(|x| x + 0.1 * n as f64);
                    blocks.push(block(min, edge(n), n % 2 == 1));
                    if n % 2 == 0 {
                        volumes.push(edge(n).powi(3));
                    } else if let Some(around) = volumes.last_mut() {
                        *around -= edge(n).powi(3);
                    }
                }
            }
            let body = mesh(blocks);
            let parts = body.parts();
            if volumes.len() == 1 {
                prop_assert!(parts.is_empty());
                return Ok(());
            }
            prop_assert_eq!(parts.len(), volumes.len());
            let mut found: Vec<f64> = parts.iter().map(|part| part.volume()).collect();
            found.sort_by(f64::total_cmp);
            volumes.sort_by(f64::total_cmp);
            for (found, volume) in found.iter().zip(&volumes) {
                prop_assert!((found - volume).abs() < 1e-12);
            }
        }
    }
}
