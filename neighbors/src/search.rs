//! The search for the candidates of blocks, eight distances at a time.

use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};

use crate::block::{Found, SHELLS};
use crate::octaves::Octaves;
use crate::{Bounds, LANES};

/// Sorted sources, and how far to look.
pub(crate) struct Search<'a, const D: usize> {
    pub(crate) sorted: &'a Octaves<D>,
    /// Slots below this are targets and their periodic images.
    pub(crate) targets: usize,
    /// Of all, skin included.
    pub(crate) reach: f64,
    /// Where the shells after the first begin, skin included; where reaches differ, in parts of the greater one of a pair.
    pub(crate) begins: [f64; SHELLS - 1],
    pub(crate) level: Level,
}

/// Targets of consecutive slots.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Members<'a, const D: usize> {
    pub(crate) positions: &'a [[f64; D]],
    /// Reach of each, skin included; empty where all have one.
    pub(crate) reaches: &'a [f64],
}

impl<'a, const D: usize> Members<'a, D> {
    /// Block by block.
    pub(crate) fn blocks(self) -> impl Iterator<Item = Self> {
        (0..self.positions.len()).step_by(LANES).map(move |first| {
            let end = (first + LANES).min(self.positions.len());
            Members {
                positions: &self.positions[first..end],
                reaches: self.reaches.get(first..end).unwrap_or(&[]),
            }
        })
    }

    /// The greatest reach, or that of all.
    fn reach(self, of_all: f64) -> f64 {
        if self.reaches.is_empty() {
            of_all
        } else {
            self.reaches.iter().copied().fold(0.0, f64::max)
        }
    }
}

/// What a search keeps from block to block.
#[derive(Debug, Clone)]
pub(crate) struct Scratch<const D: usize> {
    /// Slots and coordinates of what is within reach of a few blocks.
    slots: Vec<u32>,
    at: [Vec<f64>; D],
    /// Reaches, where these differ.
    reaches: Vec<f64>,
    /// The candidates of one block.
    pub(crate) found: Found,
}

impl<const D: usize> Default for Scratch<D> {
    fn default() -> Self {
        Self {
            slots: Vec::new(),
            at: std::array::from_fn(|_| Vec::new()),
            reaches: Vec::new(),
            found: Found::default(),
        }
    }
}

/// Squared distances may be this much too long, relatively, so that rounding loses no pair.
const ROUNDING: f64 = 1e-12;

impl<const D: usize> Search<'_, D> {
    /// Collects what is within reach of the targets of a few blocks, for [`Search::block`].
    pub(crate) fn surround(&self, members: Members<'_, D>, scratch: &mut Scratch<D>) {
        scratch.slots.clear();
        scratch.reaches.clear();
        for at in &mut scratch.at {
            at.clear();
        }
        let bounds = Bounds::of(members.positions);
        let reach = members.reach(self.reach);
        for octave in &self.sorted.octaves {
            let sorted = self.sorted;
            octave
                .cells
                .for_each_run(&bounds, reach.max(octave.reach), |range| {
                    let range = octave.first + range.start..octave.first + range.end;
                    scratch
                        .slots
                        .extend_from_slice(&sorted.slots[range.clone()]);
                    for (k, at) in scratch.at.iter_mut().enumerate() {
                        at.extend_from_slice(&sorted.at[k][range.clone()]);
                    }
                    if let Some(reaches) = sorted.reaches.get(range) {
                        scratch.reaches.extend_from_slice(reaches);
                    }
                });
        }
        // Whole vectors: what is added is out of reach.
        let padded = scratch.slots.len().next_multiple_of(LANES);
        for at in &mut scratch.at {
            at.resize(padded, f64::INFINITY);
        }
        if !scratch.reaches.is_empty() {
            scratch.reaches.resize(padded, 0.0);
        }
    }

    /// Finds the candidates of a block, which has 1 … [`LANES`] targets.
    pub(crate) fn block(&self, members: Members<'_, D>, scratch: &mut Scratch<D>) {
        dispatch!(self.level, simd => {
            if members.reaches.is_empty() {
                self.near::<_, false>(simd, members, scratch);
            } else {
                self.near::<_, true>(simd, members, scratch);
            }
        });
    }

    /// What is within reach of some target, eight sources at a time: where one of these is within reach of the targets' box,
    /// the nearest target of either half tells whether a source is a candidate, and in which shell.
    #[inline(always)]
    fn near<S: Simd, const MANY: bool>(
        &self,
        simd: S,
        members: Members<'_, D>,
        scratch: &mut Scratch<D>,
    ) {
        let bounds = Bounds::of(members.positions);
        let last = members.positions.len() - 1;
        let zero = f64x8::splat(simd, 0.0);
        let (mut min, mut max) = ([zero; D], [zero; D]);
        for k in 0..D {
            min[k] = f64x8::splat(simd, bounds.min[k]);
            max[k] = f64x8::splat(simd, bounds.max[k]);
        }
        // Lanes beyond a short block repeat its last target.
        let mut targets = [[0.0; D]; LANES];
        let mut target_reaches = [self.reach; LANES];
        for lane in 0..LANES {
            targets[lane] = members.positions[lane.min(last)];
            if MANY {
                target_reaches[lane] = members.reaches[lane.min(last)];
            }
        }
        let greatest = f64x8::splat(simd, members.reach(self.reach));
        let rounding = f64x8::splat(simd, 1.0 + ROUNDING);
        let mut within = f64x8::splat(simd, self.reach * self.reach * (1.0 + ROUNDING));
        let mut begins = [within; SHELLS - 1];
        for s in 0..SHELLS - 1 {
            begins[s] = f64x8::splat(simd, self.begins[s] * self.begins[s] * (1.0 + ROUNDING));
        }
        // Slices of their own: the compiler then knows that they stay where they are.
        let at: [&[[f64; LANES]]; D] = scratch.at.each_ref().map(|at| at.as_chunks().0);
        let reaches: &[[f64; LANES]] = scratch.reaches.as_chunks().0;
        let (slots, found) = (&scratch.slots[..], &mut scratch.found);
        for vector in 0..at[0].len() {
            let mut x = [zero; D];
            let mut square = zero;
            for k in 0..D {
                x[k] = at[k][vector].simd_into(simd);
                let gap = (min[k] - x[k]).max(x[k] - max[k]).max(zero);
                square = gap.mul_add(gap, square);
            }
            let mut theirs = greatest;
            if MANY {
                theirs = reaches[vector].simd_into(simd);
                let reach = theirs.max(greatest);
                within = reach * reach * rounding;
            }
            let in_box = square.simd_le(within).to_bitmask();
            if in_box == 0 {
                continue;
            }
            // Squared distances from the nearest target of either half; where reaches differ, over the square of the greater one.
            let mut nearest = [f64x8::splat(simd, f64::INFINITY); 2];
            let inverse = if MANY {
                f64x8::splat(simd, 1.0) / (theirs * theirs)
            } else {
                zero
            };
            for half in 0..2 {
                for lane in half * LANES / 2..(half + 1) * LANES / 2 {
                    let mut square = zero;
                    for k in 0..D {
                        let d = f64x8::splat(simd, targets[lane][k]) - x[k];
                        square = d.mul_add(d, square);
                    }
                    if MANY {
                        let own = target_reaches[lane];
                        square *= inverse.min(f64x8::splat(simd, 1.0 / (own * own)));
                    }
                    nearest[half] = nearest[half].min(square);
                }
            }
            let near = if MANY { rounding } else { within };
            let one = nearest[0].simd_le(near).to_bitmask() & in_box;
            let two = nearest[1].simd_le(near).to_bitmask() & in_box;
            let all = nearest[0].min(nearest[1]);
            let mut inner = [0; SHELLS - 1];
            for s in 0..SHELLS - 1 {
                inner[s] = all.simd_lt(begins[s]).to_bitmask();
            }
            let mut left = one | two;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                let bit = |mask: u64| (mask >> lane & 1) as usize;
                let mut shell = SHELLS - 1;
                for s in 0..SHELLS - 1 {
                    shell -= bit(inner[s]);
                }
                let slot = slots[vector * LANES + lane];
                let is_target = (slot as usize) < self.targets;
                found.add(slot, is_target, shell, bit(one) + 2 * bit(two));
            }
        }
    }
}
