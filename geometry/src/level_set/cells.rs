//! The cells that the surface passes, and its points in them.

use std::collections::HashMap;

use rayon::prelude::*;
use sphpack_neighbors::point;

use super::LevelSet;
use super::crossings::{Crossing, MARGIN};
use super::fit::Fit;
use super::patches::Case;

/// No crossing.
pub(super) const NONE: u32 = u32::MAX;

/// How far beyond its cell a point may be, in cells: a sharp edge that reaches through a face without a node inside it has
/// no other cell.
const BEYOND: f64 = 0.75;

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
                (0..cell.case.count).map(move |patch| cell.point(set, crossings, patch, BEYOND))
            })
            .collect();
        Self {
            cells,
            around,
            points,
        }
    }
}

impl Cells {
    /// The points; those of cells all of whose crossings are careful are within them, and where there are several
    /// patches in the middles of the crossings, so that the patches keep apart.
    pub(super) fn careful_points(
        &self,
        set: &LevelSet<3>,
        crossings: &[Crossing],
        careful: &[bool],
    ) -> Vec<[f64; 3]> {
        let mut points = self.points.clone();
        for cell in &self.cells {
            let mut own = cell.crossings.iter().filter(|&&n| n != NONE);
            if own.all(|&n| careful[n as usize]) {
                for patch in 0..cell.case.count {
                    points[cell.first as usize + usize::from(patch)] = if cell.case.count > 1 {
                        cell.around(crossings, patch).1
                    } else {
                        cell.point(set, crossings, patch, -MARGIN)
                    };
                }
            }
        }
        points
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
    /// The crossings of a patch, and their middle.
    fn around<'a>(&self, crossings: &'a [Crossing], patch: u8) -> (Vec<&'a Crossing>, [f64; 3]) {
        let own: Vec<&Crossing> = (0..12)
            .filter(|&e| self.case.patch[e] == patch)
            .map(|e| &crossings[self.crossings[e] as usize])
            .collect();
        let sum = own.iter().fold([0.0; 3], |s, c| point::add(s, c.point));
        let middle = point::scale(sum, 1.0 / own.len() as f64);
        (own, middle)
    }

    /// The point of a patch: where the planes of its crossings meet best, at most so far `beyond` the cell.
    fn point(&self, set: &LevelSet<3>, crossings: &[Crossing], patch: u8, beyond: f64) -> [f64; 3] {
        let (own, middle) = self.around(crossings, patch);
        let lower = set.blocks.place(self.node);
        let clamp = |x: [f64; 3]| {
            std::array::from_fn(|k| {
                let part = (x[k] - lower[k]) / set.cell();
                lower[k] + part.clamp(-beyond, 1.0 + beyond) * set.cell()
            })
        };
        let planes: Vec<([f64; 3], f64)> = own.iter().map(|c| (c.normal, c.offset)).collect();
        Fit::new(&planes, middle).within(clamp, MARGIN * set.cell())
    }
}
