//! Sources sorted by reach and place: a grid for every octave of reach, so that few cells are looked into whatever the
//! ratio of the reaches.

use rayon::prelude::*;

use crate::cells::Cells;

/// Small cells follow a sphere closely, large ones are few.
const CELL_OVER_REACH: f64 = 0.5;

/// The sources of a list in the order in which they are searched: octave by octave, cell by cell.
#[derive(Debug, Clone)]
pub(crate) struct Octaves<const D: usize> {
    /// The octaves that have sources, the least reach first.
    pub(crate) octaves: Vec<Octave<D>>,
    /// Slots.
    pub(crate) slots: Vec<u32>,
    /// Coordinate by coordinate.
    pub(crate) at: [Vec<f64>; D],
    /// Reach of each, skin included; empty where all have one.
    pub(crate) reaches: Vec<f64>,
}

/// The sources of one octave of reach.
#[derive(Debug, Clone)]
pub(crate) struct Octave<const D: usize> {
    pub(crate) cells: Cells<D>,
    /// Where they begin.
    pub(crate) first: usize,
    /// The greatest reach among them.
    pub(crate) reach: f64,
}

impl<const D: usize> Default for Octaves<D> {
    fn default() -> Self {
        Self {
            octaves: Vec::new(),
            slots: Vec::new(),
            at: std::array::from_fn(|_| Vec::new()),
            reaches: Vec::new(),
        }
    }
}

impl<const D: usize> Octaves<D> {
    /// Sorts sources that all look as far as `reach`.
    pub(crate) fn build_one(&mut self, sources: &[[f64; D]], reach: f64) {
        self.reaches.clear();
        self.slots.clear();
        self.octaves.resize_with(1, || Octave {
            cells: Cells::default(),
            first: 0,
            reach,
        });
        let octave = &mut self.octaves[0];
        octave.reach = reach;
        octave.cells.build(sources, CELL_OVER_REACH * reach);
        self.slots.extend_from_slice(octave.cells.items());
        for (k, at) in self.at.iter_mut().enumerate() {
            let sorted = self.slots.par_iter().with_min_len(4096);
            sorted
                .map(|&slot| sources[slot as usize][k])
                .collect_into_vec(at);
        }
    }

    /// Sorts sources of which each has its reach: positive and finite.
    pub(crate) fn build_many(&mut self, sources: &[[f64; D]], reaches: &[f64]) {
        self.octaves.clear();
        self.slots.clear();
        for at in &mut self.at {
            at.clear();
        }
        self.reaches.clear();
        let least = reaches.iter().copied().fold(f64::INFINITY, f64::min);
        let octave = |slot: &u32| (reaches[*slot as usize] / least).log2().ceil() as u32;
        let mut order: Vec<u32> = (0..sources.len() as u32).collect();
        // Stable: the order of slots stays within an octave.
        order.sort_by_cached_key(octave);
        for members in order.chunk_by(|a, b| octave(a) == octave(b)) {
            let places: Vec<[f64; D]> = (members.iter()).map(|&s| sources[s as usize]).collect();
            let greatest = members.iter().map(|&slot| reaches[slot as usize]);
            let mut octave = Octave {
                cells: Cells::default(),
                first: self.slots.len(),
                reach: greatest.fold(0.0, f64::max),
            };
            octave.cells.build(&places, CELL_OVER_REACH * octave.reach);
            for &item in octave.cells.items() {
                let slot = members[item as usize];
                self.slots.push(slot);
                for (at, &x) in self.at.iter_mut().zip(&places[item as usize]) {
                    at.push(x);
                }
                self.reaches.push(reaches[slot as usize]);
            }
            self.octaves.push(octave);
        }
    }
}
