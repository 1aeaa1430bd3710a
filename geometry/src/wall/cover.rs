//! Holes between the points of a wall, and what fills them.

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, point};

use super::CROWDED;
use super::crowd::Crowd;
use crate::level_inset::{gradient, halves};
use crate::surface::Surface;

/// Every place of the layers is within this of one of their points, in ∆s: a square lattice leaves 0.71, a cubic one 0.87, and rounding
/// edges to whole intervals a little more.
pub(super) const HOLE_IN_PLANE: f64 = 0.9;
pub(super) const HOLE_IN_SPACE: f64 = 1.0;

/// The smallest cells in which holes are looked for, in ∆s, pass by pass: what is large is filled before what is small is looked at.
const PASSES: [f64; 3] = [0.25, 0.0625, 0.015_625];

/// The largest cells, in ∆s.
const LARGEST: f64 = 0.5;

/// What is to be covered.
pub(super) struct Room<'a, const D: usize> {
    pub(super) wall: &'a dyn Surface<D>,
    pub(super) spacing: f64,
    pub(super) layers: usize,
}

/// A place that is far from every point of the wall.
struct Hole<const D: usize> {
    at: [f64; D],
    far: f64,
}

impl<const D: usize> Room<'_, D> {
    fn hole(&self) -> f64 {
        let over_spacing = if D == 2 { HOLE_IN_PLANE } else { HOLE_IN_SPACE };
        over_spacing * self.spacing
    }

    /// Points for the holes between those of `wall`, where they keep clear of `others`; `wall` has them then.
    pub(super) fn fill(&self, wall: &mut Crowd<D>, others: &Crowd<D>) -> Vec<[f64; D]> {
        let bounds = self.wall.bounds();
        let largest = bounds.size().iter().copied().fold(0.0, f64::max);
        let halvings = (largest / (LARGEST * self.spacing)).log2().ceil().max(0.0);
        let cell = LARGEST * self.spacing;
        let root = Bounds::new(bounds.center(), bounds.center())
            .grown(0.5 * cell * 2.0_f64.powf(halvings));
        let mut cells = Vec::new();
        self.cells(root, &mut cells);
        let mut more = Vec::new();
        for pass in PASSES {
            let smallest = pass * self.spacing * (1.0 + 1e-9);
            let found: Vec<Vec<Hole<D>>> = (cells.par_iter().with_min_len(16))
                .map(|&cell| {
                    let mut holes = Vec::new();
                    self.look(cell, smallest, wall, &mut holes);
                    holes
                })
                .collect();
            let mut holes: Vec<Hole<D>> = found.into_iter().flatten().collect();
            // The deepest first; the sort is stable, so that equal ones stay in the order of the cells.
            holes.sort_by(|a, b| b.far.total_cmp(&a.far));
            for hole in holes {
                // As far as it was, less what others of this pass have covered.
                if wall.nearest(hole.at) < hole.far.min(self.hole()) {
                    continue;
                }
                let clear = |p: &[f64; D]| {
                    let least = CROWDED * self.spacing;
                    wall.nearest(*p) >= least && others.nearest(*p) >= least
                };
                if let Some(p) = [self.centred(hole.at), hole.at].into_iter().find(clear) {
                    wall.add(p);
                    more.push(p);
                }
            }
        }
        more
    }

    /// Cells which the layers pass.
    fn cells(&self, cell: Bounds<D>, to: &mut Vec<Bounds<D>>) {
        if !self.is_passed(&cell) {
            return;
        }
        if cell.size()[0] <= LARGEST * self.spacing * (1.0 + 1e-9) {
            to.push(cell);
            return;
        }
        for part in halves(&cell) {
            self.cells(part, to);
        }
    }

    fn is_passed(&self, cell: &Bounds<D>) -> bool {
        let reach = 0.5 * cell.diagonal();
        let depth = -self.wall.closest(cell.center()).distance;
        depth > -reach && depth < self.spacing * self.layers as f64 + reach
    }

    fn look(&self, cell: Bounds<D>, smallest: f64, wall: &Crowd<D>, to: &mut Vec<Hole<D>>) {
        let reach = 0.5 * cell.diagonal();
        let center = cell.center();
        let far = wall.nearest(center);
        if far + reach <= self.hole() || !self.is_passed(&cell) {
            return;
        }
        if cell.size()[0] > smallest {
            for part in halves(&cell) {
                self.look(part, smallest, wall, to);
            }
            return;
        }
        let depth = -self.wall.closest(center).distance;
        let is_last = smallest <= 1.5 * PASSES[PASSES.len() - 1] * self.spacing;
        let least = self.hole() - if is_last { reach } else { 0.0 };
        if depth > 0.0 && depth < self.spacing * self.layers as f64 && far > least {
            to.push(Hole { at: center, far });
        }
    }

    /// The place straight below or above where a point is neither nearer to the surface than ∆s/2 nor to the far side of the layers,
    /// as far as the body allows.
    fn centred(&self, p: [f64; D]) -> [f64; D] {
        let hit = self.wall.closest(p);
        let depth = -hit.distance;
        let half = 0.5 * self.spacing;
        let wanted = depth.clamp(half, self.spacing * self.layers as f64 - half);
        let outward = gradient(p, &hit);
        let mut down = wanted - depth;
        // Where the body is thin the way down leads up again beyond its middle.
        for _ in 0..8 {
            let there = point::add_scaled(p, -down, outward);
            let reached = -self.wall.closest(there).distance;
            if (reached - depth - down).abs() <= 0.05 * self.spacing {
                return there;
            }
            down *= 0.7;
        }
        p
    }
}
