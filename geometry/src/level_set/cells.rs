//! The cells that the surface passes, and its points in them.

use std::collections::HashMap;

use rayon::prelude::*;
use sphpack_neighbors::point;

use super::LevelSet;
use super::crossings::{Crossing, MARGIN};
use super::fit;
use super::patches::Case;

/// No crossing.
pub(super) const NONE: u32 = u32::MAX;

/// A cell that the surface passes.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    /// Its lowest node.
    pub(super) node: [i32; 3],
    /// Per edge, the number of the crossing.
    pub(super) crossings: [u32; 12],
    /// The number of its first point.
    pub(super) first: u32,
    pub(super) case: &'static Case,
}

/// All such cells.
#[derive(Debug)]
pub(super) struct Cells {
    pub(super) cells: Vec<Cell>,
    /// Per crossing its four cells, counter-clockwise seen from above: at the upper side of the edge along both other
    /// axes, then at the lower side along the first of them, along both, along the second.
    pub(super) around: Vec<[u32; 4]>,
    /// The surface's points, one per patch, cell after cell.
    pub(super) points: Vec<[f64; 3]>,
}

/// Where the edge is in its four cells, as in [`Cells::around`]: its places along the two other axes.
pub(super) const PLACES: [[usize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

impl Cells {
    pub(super) fn new(set: &LevelSet<3>, crossings: &[Crossing]) -> Self {
        let mut number: HashMap<[i32; 3], u32> = HashMap::with_capacity(crossings.len());
        let mut cells: Vec<Cell> = Vec::new();
        let mut around = Vec::with_capacity(crossings.len());
        for (n, crossing) in (0_u32..).zip(crossings) {
            let k = crossing.axis;
            around.push(PLACES.map(|[u, v]| {
                let mut node = crossing.node;
                node[(k + 1) % 3] -= u as i32;
                node[(k + 2) % 3] -= v as i32;
                let cell = *number.entry(node).or_insert_with(|| {
                    cells.push(Cell {
                        node,
                        crossings: [NONE; 12],
                        first: 0,
                        case: Case::of(0),
                    });
                    cells.len() as u32 - 1
                });
                cells[cell as usize].crossings[4 * k + u + 2 * v] = n;
                cell
            }));
        }
        cells
            .par_iter_mut()
            .for_each(|cell| cell.case = Case::of(code(set, cell.node)));
        let mut first = 0;
        for cell in &mut cells {
            cell.first = first;
            first += u32::from(cell.case.count);
        }
        let points = cells
            .par_iter()
            .flat_map_iter(|cell| {
                (0..cell.case.count).map(move |patch| cell.point(set, crossings, patch))
            })
            .collect();
        Self {
            cells,
            around,
            points,
        }
    }
}

/// Bit c: whether corner c of the cell is inside.
fn code(set: &LevelSet<3>, node: [i32; 3]) -> u8 {
    (0..8).fold(0, |code, c| {
        let corner = std::array::from_fn(|k| node[k] + (c >> k & 1));
        code | u8::from(set.blocks.at(corner) < 0.0) << c
    })
}

impl Cell {
    /// The point of a patch: where the planes of its crossings meet best, in the cell; the middle of the crossings
    /// where the cell has several patches, so that these keep apart.
    fn point(&self, set: &LevelSet<3>, crossings: &[Crossing], patch: u8) -> [f64; 3] {
        let own: Vec<&Crossing> = (0..12)
            .filter(|&e| self.case.patch[e] == patch)
            .map(|e| &crossings[self.crossings[e] as usize])
            .collect();
        let sum = own.iter().fold([0.0; 3], |s, c| point::add(s, c.point));
        let middle = point::scale(sum, 1.0 / own.len() as f64);
        if self.case.count > 1 {
            return middle;
        }
        let lower = set.blocks.place(self.node);
        let near = MARGIN * set.cell();
        let far = (1.0 - MARGIN) * set.cell();
        let is_within = |x: &[f64; 3]| (0..3).all(|k| (near..=far).contains(&(x[k] - lower[k])));
        let planes: Vec<([f64; 3], f64)> = own.iter().map(|c| (c.normal, c.offset)).collect();
        let mut found = middle;
        for candidate in fit::candidates(&planes, middle) {
            found = candidate;
            if is_within(&found) {
                return found;
            }
        }
        std::array::from_fn(|k| found[k].clamp(lower[k] + near, lower[k] + far))
    }
}
