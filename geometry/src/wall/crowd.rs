//! Points that are asked for the nearest of them, and become more.

use std::collections::HashMap;

use sphpack_neighbors::{Odometer, point};

/// Points by the cells that they are in.
#[derive(Debug, Clone)]
pub(super) struct Crowd<const D: usize> {
    cell: f64,
    cells: HashMap<[i64; D], Vec<[f64; D]>>,
}

impl<const D: usize> Crowd<D> {
    /// None yet; nothing farther than `reach` is ever asked for.
    pub(super) fn new(reach: f64) -> Self {
        Self {
            cell: reach,
            cells: HashMap::new(),
        }
    }

    fn cell_of(&self, p: [f64; D]) -> [i64; D] {
        p.map(|x| (x / self.cell).floor() as i64)
    }

    pub(super) fn add(&mut self, p: [f64; D]) {
        self.cells.entry(self.cell_of(p)).or_default().push(p);
    }

    /// How far the nearest is; the reach where none is nearer than that.
    pub(super) fn nearest(&self, p: [f64; D]) -> f64 {
        let here = self.cell_of(p);
        let [low, high] = [-1, 2].map(|way| here.map(|x| x.saturating_add(way)));
        let mut least = self.cell * self.cell;
        for place in Odometer::new(low, high) {
            for &q in self.cells.get(&place).into_iter().flatten() {
                least = least.min(point::distance_squared(p, q));
            }
        }
        least.sqrt()
    }
}
