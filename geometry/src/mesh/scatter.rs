//! Points scattered over a mesh by area.

use super::{Mesh, triangle};
use crate::sample::Candidates;

/// Part by which each point's place across its triangle goes on from the last one's: the golden ratio.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl Mesh {
    /// `wanted` points, each standing for the same area. The triangles are in the order of the tree, so that points
    /// taken at equal steps of area are spread in space as well.
    pub(super) fn scattered(&self, wanted: usize) -> Candidates<3> {
        let numbers: Vec<usize> = (0..self.corners.len()).collect();
        let mut across = 0.5;
        Candidates::systematic(
            wanted,
            &numbers,
            |&t| triangle::area(&self.corners[t]),
            |&t, before| {
                across = (across + GOLDEN) % 1.0;
                // The part of a triangle's area that lies nearer to a corner than a parallel to the far side grows
                // with the square of the way.
                let way = before.sqrt();
                let weights = [1.0 - way, way * (1.0 - across), way * across];
                (
                    triangle::place(&self.corners[t], weights),
                    self.normals.face[t],
                )
            },
        )
    }
}
