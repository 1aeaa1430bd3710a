//! A uniform grid over points, filled by counting sort.

use std::ops::Range;

use rayon::prelude::*;

use crate::{Bounds, Odometer};

/// Points sorted into the cells of a uniform grid. The cells of a row along the last axis lie one after the other, so
/// a box query reads a few long runs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Cells<const D: usize> {
    origin: Vec<f64>,
    size: f64,
    inverse_size: f64,
    shape: Vec<usize>,
    /// First entry of each cell in `items`; one more than there are cells.
    start: Vec<u32>,
    /// Point indices, cell by cell, ascending within a cell.
    items: Vec<u32>,
    keys: Vec<u32>,
}

/// More cells than this many per point waste memory on emptiness; the cells grow instead.
const CELLS_PER_POINT: f64 = 2.0;

impl<const D: usize> Cells<D> {
    /// Sorts `points` into cells of about `size`; fewer and larger ones where the points are sparse. All points must
    /// be finite.
    pub(crate) fn build(&mut self, points: &[[f64; D]], size: f64) {
        let bounds = Bounds::of(points);
        self.items.clear();
        self.start.clear();
        self.shape.clear();
        self.origin.clear();
        if points.is_empty() {
            self.shape.resize(D, 0);
            self.start.push(0);
            return;
        }
        let extent = bounds.size();
        let most = (CELLS_PER_POINT * points.len() as f64).max(64.0);
        let mut size = size;
        let count = |size: f64| {
            extent
                .iter()
                .map(|e| (e / size).floor() + 1.0)
                .product::<f64>()
        };
        while count(size) > most {
            size *= 1.25;
        }
        self.origin.extend(bounds.min);
        self.size = size;
        self.inverse_size = 1.0 / size;
        self.shape
            .extend(extent.iter().map(|e| (e / size).floor() as usize + 1));
        let cells: usize = self.shape.iter().product();

        let mut keys = std::mem::take(&mut self.keys);
        points
            .par_iter()
            .map(|&p| self.key(p))
            .collect_into_vec(&mut keys);
        self.start.resize(cells + 1, 0);
        for &key in &keys {
            self.start[key as usize + 1] += 1;
        }
        for cell in 0..cells {
            self.start[cell + 1] += self.start[cell];
        }
        self.items.resize(points.len(), 0);
        for (index, &key) in keys.iter().enumerate() {
            let place = &mut self.start[key as usize];
            self.items[*place as usize] = index as u32;
            *place += 1;
        }
        // Each start has moved to its cell's end, which is the next one's start.
        for cell in (1..=cells).rev() {
            self.start[cell] = self.start[cell - 1];
        }
        self.start[0] = 0;
        self.keys = keys;
    }

    /// Point indices in the order of the cells.
    pub(crate) fn items(&self) -> &[u32] {
        &self.items
    }

    #[inline(always)]
    fn coordinate(&self, axis: usize, x: f64) -> usize {
        let c = (x - self.origin[axis]) * self.inverse_size;
        // The cast saturates: left of the grid is its first cell, right of it its last.
        (c as usize).min(self.shape[axis] - 1)
    }

    fn key(&self, p: [f64; D]) -> u32 {
        let mut key = 0;
        for k in 0..D {
            key = key * self.shape[k] + self.coordinate(k, p[k]);
        }
        key as u32
    }

    /// Calls `f` with ranges of [`Cells::items`] that together hold every point within `reach` of the box (and others
    /// near it).
    #[inline(always)]
    pub(crate) fn for_each_run(
        &self,
        bounds: &Bounds<D>,
        reach: f64,
        mut f: impl FnMut(Range<usize>),
    ) {
        if self.items.is_empty() {
            return;
        }
        // A little more, for what rounding does to the cells' faces.
        let reach = reach * (1.0 + 1e-9);
        let near = bounds.grown(reach);
        let last = D - 1;
        let low: [i64; D] = std::array::from_fn(|k| self.coordinate(k, near.min[k]) as i64);
        // Along the last axis runs go on: one place of it stands for the row.
        let end = std::array::from_fn(|k| {
            if k == last {
                low[k] + 1
            } else {
                self.coordinate(k, near.max[k]) as i64 + 1
            }
        });
        for index in Odometer::new(low, end) {
            // The row's distance from the box, across the last axis.
            let (mut row, mut gap_squared) = (0, 0.0);
            for k in 0..last {
                row = row * self.shape[k] + index[k] as usize;
                let face = self.origin[k] + index[k] as f64 * self.size;
                let gap = (face - bounds.max[k])
                    .max(bounds.min[k] - (face + self.size))
                    .max(0.0);
                gap_squared += gap * gap;
            }
            let rest = reach * reach - gap_squared;
            if rest >= 0.0 {
                let along = rest.sqrt();
                row *= self.shape[last];
                let from = row + self.coordinate(last, bounds.min[last] - along);
                let to = row + self.coordinate(last, bounds.max[last] + along);
                f(self.start[from] as usize..self.start[to + 1] as usize);
            }
        }
    }
}
