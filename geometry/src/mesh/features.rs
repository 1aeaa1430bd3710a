//! Sharp edges, chained from corner to corner.

use super::Mesh;
use crate::surface::Features;

impl Mesh {
    /// Corners and sharp edges; closed chains repeat their first point.
    pub(super) fn find_features(&self) -> Features<3> {
        let mut at: Vec<Vec<u32>> = vec![Vec::new(); self.vertices.len()];
        for (t, indices) in self.triangles.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (indices[k], indices[(k + 1) % 3]);
                if self.normals.sharp[t] >> k & 1 == 1 && a < b {
                    at[a as usize].push(b);
                    at[b as usize].push(a);
                }
            }
        }
        for list in &mut at {
            list.sort_unstable();
        }
        let mut edges = Vec::new();
        // Chains between corners first, then those that close on themselves.
        for from_corners in [true, false] {
            for start in 0..at.len() {
                if from_corners && !self.normals.is_corner[start] {
                    continue;
                }
                while let Some(&second) = at[start].first() {
                    let chain = self.follow(start as u32, second, &mut at);
                    edges.push(
                        chain
                            .into_iter()
                            .map(|v| self.vertices[v as usize])
                            .collect(),
                    );
                }
            }
        }
        Features {
            corners: (0..self.vertices.len())
                .filter(|&v| self.normals.is_corner[v])
                .map(|v| self.vertices[v])
                .collect(),
            edges,
        }
    }

    /// The chain from `start` over `second` to the next corner or back to `start`; its edges are taken out of `at`.
    fn follow(&self, start: u32, second: u32, at: &mut [Vec<u32>]) -> Vec<u32> {
        let mut chain = vec![start];
        let (mut from, mut to) = (start, second);
        loop {
            at[from as usize].retain(|&v| v != to);
            at[to as usize].retain(|&v| v != from);
            chain.push(to);
            if to == start || self.normals.is_corner[to as usize] {
                return chain;
            }
            let Some(&next) = at[to as usize].first() else {
                return chain;
            };
            (from, to) = (to, next);
        }
    }
}
