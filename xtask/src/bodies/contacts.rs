//! Blocks that touch: along a side, a part of one, an edge, or in a point; each a shell of its own in one file.

use std::path::Path;

use sphpack::Outcome;
use sphpack_packing::Kind;

use super::drawn::{DEEP, Drawn, faults_of, is_deep};
use super::frame::{Frame, outside_block};
use super::space;
use crate::scene_fuzz::random::Random;

/// A particle of the surface has no more of the body than this above it, in ∆s, or it is on an inner wall.
const INNER: f64 = 0.8;

/// Places are inside where they are out by less than this: a side that two blocks share is in both.
const SHARED: f64 = 1e-6;

/// Lower and upper corner, in the frame.
type Block = [[f64; 3]; 2];

#[derive(Debug)]
struct Touching {
    spacing: f64,
    frame: Frame,
    blocks: Vec<Block>,
    /// Which diagonals of its sides a block has: a side that two share is parted otherwise in each.
    mirrored: Vec<bool>,
}

pub(super) fn draw(number: u64) -> Box<dyn Drawn> {
    let mut random = Random::new(3, number);
    let spacing = random.between(0.08, 0.12);
    let blocks = blocks(&mut random);
    let mirrored = blocks.iter().map(|_| random.chance(0.5)).collect();
    let frame = if random.chance(0.5) {
        Frame::upright()
    } else {
        Frame::random(&mut random, 3)
    };
    Box::new(Touching {
        spacing,
        frame,
        blocks,
        mirrored,
    })
}

fn blocks(random: &mut Random) -> Vec<Block> {
    let mut edge = || random.between(0.5, 1.0);
    let (a, b, c, d, e, f) = (edge(), edge(), edge(), edge(), edge(), edge());
    let first = [[0.0; 3], [a, b, c]];
    let second = match random.below(8) {
        // The whole of a side.
        0 => [[0.0, 0.0, c], [a, b, c + d]],
        // In the middle of a side.
        1 => [[0.2 * a, 0.3 * b, c], [0.8 * a, 0.8 * b, c + d]],
        // In the corner of a side.
        2 => [[0.0, 0.0, c], [0.5 * a, 0.6 * b, c + d]],
        // Beside it, over a part of the side only.
        3 => [[0.4 * a, 0.3 * b, c], [0.4 * a + d, 0.3 * b + e, c + f]],
        // Along an edge.
        4 => [[a, 0.0, c], [a + d, b, c + e]],
        // Along a part of an edge.
        5 => [[a, 0.3 * b, c], [a + d, 0.3 * b + e, c + f]],
        // In a point.
        6 => [[a, b, c], [a + d, b + e, c + f]],
        // Four rails, flush at their ends.
        _ => {
            let (long, wide) = (1.0 + d, 0.3 * e + 0.1);
            let across = 1.0 + f;
            return vec![
                [[0.0; 3], [long, wide, wide]],
                [[0.0, across - wide, 0.0], [long, across, wide]],
                [[0.0, wide, 0.0], [wide, across - wide, wide]],
                [[long - wide, wide, 0.0], [long, across - wide, wide]],
            ];
        }
    };
    vec![first, second]
}

impl Touching {
    fn holds(&self, own: [f64; 3]) -> bool {
        (self.blocks.iter()).any(|[low, high]| {
            let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (low[k] + high[k]));
            let half = std::array::from_fn(|k| 0.5 * (high[k] - low[k]));
            let from = std::array::from_fn(|k| own[k] - middle[k]);
            outside_block(half, from, 3) < SHARED
        })
    }
}

impl Drawn for Touching {
    fn text(&self, folder: &Path, number: u64) -> Result<String, String> {
        let mut triangles = Vec::new();
        for ([low, high], is_mirrored) in self.blocks.iter().zip(&self.mirrored) {
            let block = if *is_mirrored {
                // Mirrored, the diagonals are the others.
                let at = |p: [f64; 3]| [low[0] + high[0] - p[0], p[1], p[2]];
                let mut block = space::cuboid(*low, *high);
                for corners in &mut block {
                    *corners = [at(corners[0]), at(corners[2]), at(corners[1])];
                }
                block
            } else {
                space::cuboid(*low, *high)
            };
            triangles.extend(block.iter().map(|t| t.map(|p| self.frame.place(p))));
        }
        let file = format!("contacts-{number}.obj");
        space::write(&triangles, &folder.join(&file))?;
        Ok(format!(
            "spacing = {:?}\n[domain]\nmargin = {:?}\n[[body]]\nname = \"blocks\"\nshape = {{ file = {file:?} }}\n",
            self.spacing,
            5.0 * self.spacing
        ))
    }

    fn faults(&self, outcome: &Outcome) -> Vec<String> {
        let table = &outcome.table;
        let (mut held, mut strayed, mut sunk, mut inner) = (0.0, 0, 0, 0);
        for i in (0..table.len()).filter(|&i| table.kind[i] != Kind::Frozen) {
            let own = self.frame.own(table.position[i]);
            let deep = |far: f64| is_deep(3, far * self.spacing, own, |p| self.holds(p));
            if table.body[i].is_some() {
                held += table.volume[i];
                strayed += usize::from(!self.holds(own));
                inner += usize::from(table.kind[i] != Kind::Free && deep(INNER));
            } else {
                sunk += usize::from(deep(DEEP));
            }
        }
        let exact: f64 = (self.blocks.iter())
            .map(|[low, high]| (0..3).map(|k| high[k] - low[k]).product::<f64>())
            .sum();
        let counts = [
            (strayed, "particles of the body outside it"),
            (sunk, "particles of fluid in the body"),
            (inner, "particles on an inner wall"),
        ];
        faults_of(outcome, &counts, [held, exact])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shared_side_is_inside() {
        let pair = Touching {
            spacing: 0.1,
            frame: Frame::upright(),
            blocks: vec![[[0.0; 3], [1.0; 3]], [[0.0, 0.0, 1.0], [1.0, 1.0, 2.0]]],
            mirrored: vec![false, true],
        };
        let deep = |p| is_deep(3, 0.08, p, |p| pair.holds(p));
        assert!(deep([0.5, 0.5, 1.0]) && !deep([0.5, 0.5, 1.95]) && !deep([0.05, 0.5, 1.0]));
    }
}
