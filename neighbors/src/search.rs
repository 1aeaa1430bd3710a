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
            reaches: Vec::new(),
            near: Vec::new(),
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
                        at.extend(sorted.positions[range.clone()].iter().map(|p| p[k]));
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
                self.near_box::<_, false>(simd, members, scratch);
                self.near_targets::<_, false>(simd, members, scratch);
            } else {
                self.near_box::<_, true>(simd, members, scratch);
                self.near_targets::<_, true>(simd, members, scratch);
            }
        });
    }

    /// What is within reach of the box, eight sources at a time.
    #[inline(always)]
    fn near_box<S: Simd, const MANY: bool>(
        &self,
        simd: S,
        members: Members<'_, D>,
        scratch: &mut Scratch<D>,
    ) {
        let bounds = Bounds::of(members.positions);
        let reach = members.reach(self.reach);
        let zero = f64x8::splat(simd, 0.0);
        let own = f64x8::splat(simd, reach);
        let mut within = f64x8::splat(simd, reach * reach * (1.0 + ROUNDING));
        let rounding = f64x8::splat(simd, 1.0 + ROUNDING);
        let (mut min, mut max) = ([zero; D], [zero; D]);
        for k in 0..D {
            min[k] = f64x8::splat(simd, bounds.min[k]);
            max[k] = f64x8::splat(simd, bounds.max[k]);
        }
        // Slices of their own: the compiler then knows that they stay where they are.
        let at: [&[[f64; LANES]]; D] = scratch.at.each_ref().map(|at| at.as_chunks().0);
        let reaches: &[[f64; LANES]] = scratch.reaches.as_chunks().0;
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
            if MANY {
                let theirs: f64x8<S> = reaches[vector].simd_into(simd);
                let reach = theirs.max(own);
                within = reach * reach * rounding;
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
    fn near_targets<S: Simd, const MANY: bool>(
        &self,
        simd: S,
        members: Members<'_, D>,
        scratch: &mut Scratch<D>,
    ) {
        let last = members.positions.len() - 1;
        let mut x = [f64x8::splat(simd, 0.0); D];
        for k in 0..D {
            let mut lanes = [0.0; LANES];
            for lane in 0..LANES {
                lanes[lane] = members.positions[lane.min(last)][k];
            }
            x[k] = lanes.simd_into(simd);
        }
        let mut own = f64x8::splat(simd, self.reach);
        if MANY {
            let mut lanes = [0.0; LANES];
            for lane in 0..LANES {
                lanes[lane] = members.reaches[lane.min(last)];
            }
            own = lanes.simd_into(simd);
        }
        let rounding = f64x8::splat(simd, 1.0 + ROUNDING);
        let mut within = f64x8::splat(simd, self.reach * self.reach * (1.0 + ROUNDING));
        let mut begins = [within; SHELLS - 1];
        for s in 0..SHELLS - 1 {
            begins[s] = f64x8::splat(simd, self.begins[s] * self.begins[s] * (1.0 + ROUNDING));
        }
        let at: [&[f64]; D] = scratch.at.each_ref().map(Vec::as_slice);
        let reaches = &scratch.reaches[..];
        let (slots, found) = (&scratch.slots[..], &mut scratch.found);
        for &place in &scratch.near {
            let place = place as usize;
            let mut square = f64x8::splat(simd, 0.0);
            for k in 0..D {
                let d = x[k] - f64x8::splat(simd, at[k][place]);
                square = d.mul_add(d, square);
            }
            let mut unit = rounding;
            if MANY {
                let reach = own.max(f64x8::splat(simd, reaches[place]));
                unit = reach * reach;
                within = unit * rounding;
            }
            let near = square.simd_le(within).to_bitmask();
            let halves = usize::from(near & 0xf != 0) + 2 * usize::from(near & 0xf0 != 0);
            // A shell is as far away as its nearest target.
            let mut shell = SHELLS - 1;
            for s in 0..SHELLS - 1 {
                let begin = if MANY { begins[s] * unit } else { begins[s] };
                shell -= usize::from(square.simd_lt(begin).any_true());
            }
            let slot = slots[place];
            found.add(slot, (slot as usize) < self.targets, shell, halves);
        }
    }
}
