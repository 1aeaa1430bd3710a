//! How much room there is between the level sets of a surface.

use rayon::prelude::*;
use sphpack_neighbors::Bounds;

use crate::level_inset::{cut, gradient, halves};
use crate::surface::Surface;

/// The smallest cells, per ∆s. With 4 in space the shells of a cube of 12.6 ∆s are right to 2 in 10,000.
const CELLS_IN_PLANE: f64 = 16.0;
const CELLS_IN_SPACE: f64 = 4.0;

/// Cells of a thread's piece of work, along an axis.
const PIECE: f64 = 16.0;

/// Of every layer, by its depth δ.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shells {
    /// Measure of the set δ = (k + 1/2) ∆s, k from 0.
    pub(super) measure: Vec<f64>,
    /// Volume of k ∆s < δ < (k + 1) ∆s.
    pub(super) volume: Vec<f64>,
}

/// What a cell holds: of every level j ∆s/2 its measure, and the volume of what is less deep.
#[derive(Debug, Clone)]
struct Sums {
    measure: Vec<f64>,
    shallower: Vec<f64>,
}

impl Sums {
    fn none(levels: usize) -> Self {
        Self {
            measure: vec![0.0; levels],
            shallower: vec![0.0; levels],
        }
    }
}

/// A level set by cells that are halved where it may pass, and cut there by its tangent plane.
struct Grid<'a, const D: usize> {
    wall: &'a dyn Surface<D>,
    spacing: f64,
    levels: usize,
    smallest: f64,
}

impl<const D: usize> Grid<'_, D> {
    fn depth(&self, level: usize) -> f64 {
        0.5 * self.spacing * level as f64
    }

    /// Cells of about `PIECE` of the smallest which anything of the layers may be in.
    fn pieces(&self, cell: Bounds<D>, to: &mut Vec<Bounds<D>>) {
        let reach = 0.5 * cell.diagonal();
        let depth = -self.wall.closest(cell.center()).distance;
        if depth < -reach {
            return;
        }
        if cell.size()[0] <= PIECE * self.smallest || depth - reach > self.depth(self.levels) {
            to.push(cell);
            return;
        }
        for part in halves(&cell) {
            self.pieces(part, to);
        }
    }

    fn add(&self, cell: Bounds<D>, sums: &mut Sums) {
        let reach = 0.5 * cell.diagonal();
        let center = cell.center();
        let hit = self.wall.closest(center);
        let depth = -hit.distance;
        let is_passed = |level: usize| (depth - self.depth(level)).abs() <= reach;
        let size = cell.size()[0];
        if size > self.smallest && (0..self.levels).any(is_passed) {
            for part in halves(&cell) {
                self.add(part, sums);
            }
            return;
        }
        let volume = cell.volume();
        let outward = gradient(center, &hit);
        for level in 0..self.levels {
            if !is_passed(level) {
                if depth < self.depth(level) {
                    sums.shallower[level] += volume;
                }
                continue;
            }
            let (area, deeper) = cut(outward, (self.depth(level) - depth) / size);
            sums.measure[level] += area * size.powi(D as i32 - 1);
            sums.shallower[level] += (1.0 - deeper) * volume;
        }
    }
}

/// Of `layers` layers of `spacing` on the side of `wall` that it calls its inside.
pub(super) fn shells<const D: usize>(wall: &dyn Surface<D>, spacing: f64, layers: usize) -> Shells {
    let per_spacing = if D == 2 {
        CELLS_IN_PLANE
    } else {
        CELLS_IN_SPACE
    };
    let bounds = wall.bounds();
    let largest = bounds.size().iter().copied().fold(0.0, f64::max) * 1.02;
    let halvings = (largest * per_spacing / spacing).log2().ceil().max(0.0);
    let levels = 2 * layers + 1;
    let grid = Grid {
        wall,
        spacing,
        levels,
        smallest: largest * 0.5_f64.powf(halvings) * (1.0 + 1e-9),
    };
    // Off the middle, so that flat sides do not run between two cells, and half of them is lost.
    let center = bounds.center().map(|x| x + 0.003_7 * largest);
    let root = Bounds::new(center, center).grown(0.5 * largest);
    let mut pieces = Vec::new();
    grid.pieces(root, &mut pieces);
    let parts: Vec<Sums> = (pieces.into_par_iter())
        .map(|cell| {
            let mut sums = Sums::none(levels);
            grid.add(cell, &mut sums);
            sums
        })
        .collect();
    let mut all = Sums::none(levels);
    for part in parts {
        for level in 0..levels {
            all.measure[level] += part.measure[level];
            all.shallower[level] += part.shallower[level];
        }
    }
    Shells {
        measure: (0..layers).map(|k| all.measure[2 * k + 1]).collect(),
        volume: (0..layers)
            .map(|k| (all.shallower[2 * k + 2] - all.shallower[2 * k]).max(0.0))
            .collect(),
    }
}
