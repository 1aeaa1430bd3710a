//! The search for the candidates of blocks, eight distances at a time.

use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};

use crate::block::{Found, SHELLS};
use crate::cells::Cells;
use crate::{Bounds, LANES};

/// Sources in the order of their cells, and how far to look.
pub(crate) struct Search<'a, const D: usize> {
    pub(crate) cells: &'a Cells<D>,
    /// Positions in the order of the cells.
    pub(crate) sources: &'a [[f64; D]],
    /// Slots below this are targets and their periodic images.
    pub(crate) targets: usize,
    pub(crate) reach: f64,
    /// Where the shells after the first begin, skin included.
    pub(crate) begins: [f64; SHELLS - 1],
    pub(crate) level: Level,
}

/// What a search keeps from block to block.
#[derive(Debug, Clone)]
pub(crate) struct Scratch<const D: usize> {
    /// Slots and coordinates of what is within reach of a few blocks.
    slots: Vec<u32>,
    at: [Vec<f64>; D],
    /// Places in these of what is within reach of one block's box.
    near: Vec<u32>,
    /// The candidates of one block.
    pub(crate) found: Found,
}

impl<const D: usize> Default for Scratch<D> {
    fn default() -> Self {
        Self {
            slots: Vec::new(),
            at: std::array::from_fn(|_| Vec::new()),
            near: Vec::new(),
            found: Found::default(),
        }
    }
}

/// Squared distances may be this much too long, relatively, so that rounding loses no pair.
const ROUNDING: f64 = 1e-12;

impl<const D: usize> Search<'_, D> {
    /// Collects what is within reach of the targets of a few blocks, for [`Search::block`].
    pub(crate) fn surround(&self, members: &[[f64; D]], scratch: &mut Scratch<D>) {
        scratch.slots.clear();
        for at in &mut scratch.at {
            at.clear();
        }
        let bounds = Bounds::of(members);
        self.cells.for_each_run(&bounds, self.reach, |range| {
            scratch
                .slots
                .extend_from_slice(&self.cells.items()[range.clone()]);
            for (k, at) in scratch.at.iter_mut().enumerate() {
                at.extend(self.sources[range.clone()].iter().map(|p| p[k]));
            }
        });
        // Whole vectors: what is added is out of reach.
        let padded = scratch.slots.len().next_multiple_of(LANES);
        for at in &mut scratch.at {
            at.resize(padded, f64::INFINITY);
        }
    }

    /// Finds the candidates of a block whose targets, 1 … [`LANES`], are at `members`.
    pub(crate) fn block(&self, members: &[[f64; D]], scratch: &mut Scratch<D>) {
        dispatch!(self.level, simd => {
            self.near_box(simd, &Bounds::of(members), scratch);
            self.near_targets(simd, members, scratch);
        });
    }

    /// What is within reach of the box, eight sources at a time.
    #[inline(always)]
    fn near_box<S: Simd>(&self, simd: S, bounds: &Bounds<D>, scratch: &mut Scratch<D>) {
        let zero = f64x8::splat(simd, 0.0);
        let within = f64x8::splat(simd, self.reach * self.reach * (1.0 + ROUNDING));
        let (mut min, mut max) = ([zero; D], [zero; D]);
        for k in 0..D {
            min[k] = f64x8::splat(simd, bounds.min[k]);
            max[k] = f64x8::splat(simd, bounds.max[k]);
        }
        // Slices of their own: the compiler then knows that they stay where they are.
        let at: [&[[f64; LANES]]; D] = scratch.at.each_ref().map(|at| at.as_chunks().0);
        scratch.near.resize(at[0].len() * LANES + 1, 0);
        let near = &mut scratch.near[..];
        let mut count = 0;
        for vector in 0..at[0].len() {
            let mut square = zero;
            for k in 0..D {
                let x: f64x8<S> = at[k][vector].simd_into(simd);
                let gap = (min[k] - x).max(x - max[k]).max(zero);
                square = gap.mul_add(gap, square);
            }
            let bits = square.simd_le(within).to_bitmask() as usize;
            // Written always, kept where the bit is set: a branch would be guessed wrong every other time.
            for lane in 0..LANES {
                near[count] = (vector * LANES + lane) as u32;
                count += bits >> lane & 1;
            }
        }
        scratch.near.truncate(count);
    }

    /// What is within reach of some target, eight targets at a time.
    #[inline(always)]
    fn near_targets<S: Simd>(&self, simd: S, members: &[[f64; D]], scratch: &mut Scratch<D>) {
        let last = members.len() - 1;
        let mut x = [f64x8::splat(simd, 0.0); D];
        for k in 0..D {
            let mut lanes = [0.0; LANES];
            for lane in 0..LANES {
                lanes[lane] = members[lane.min(last)][k];
            }
            x[k] = lanes.simd_into(simd);
        }
        let within = f64x8::splat(simd, self.reach * self.reach * (1.0 + ROUNDING));
        let mut begins = [within; SHELLS - 1];
        for s in 0..SHELLS - 1 {
            begins[s] = f64x8::splat(simd, self.begins[s] * self.begins[s] * (1.0 + ROUNDING));
        }
        let at: [&[f64]; D] = scratch.at.each_ref().map(Vec::as_slice);
        let (slots, found) = (&scratch.slots[..], &mut scratch.found);
        for &place in &scratch.near {
            let place = place as usize;
            let mut square = f64x8::splat(simd, 0.0);
            for k in 0..D {
                let d = x[k] - f64x8::splat(simd, at[k][place]);
                square = d.mul_add(d, square);
            }
            let near = square.simd_le(within).to_bitmask();
            let halves = usize::from(near & 0xf != 0) + 2 * usize::from(near & 0xf0 != 0);
            // A shell is as far away as its nearest target.
            let mut shell = SHELLS - 1;
            for s in 0..SHELLS - 1 {
                shell -= usize::from(square.simd_lt(begins[s]).any_true());
            }
            let slot = slots[place];
            found.add(slot, (slot as usize) < self.targets, shell, halves);
        }
    }
}
