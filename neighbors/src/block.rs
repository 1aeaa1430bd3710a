//! Blocks of targets and the runs of their candidates.

use rayon::prelude::*;

use crate::LANES;

/// Blocks that one task handles.
pub(crate) const BLOCKS_PER_CHUNK: usize = 16;

/// Shells that candidates are sorted into, by their distance from the block.
pub const SHELLS: usize = 4;

/// Candidates come in groups of this many vectors.
pub const GROUP: usize = 2;

/// Runs of candidates that are targets: one for each shell, and the split one.
const RUNS: usize = SHELLS + 1;

/// The run of candidates that only half of the block is near to.
const SPLIT: usize = SHELLS;

/// Up to [`LANES`] targets and the slots of everything that may be within their support.
///
/// Most candidates may be near to any target of the block. Of those of the last shell, many are near to its first four
/// targets only, or to the others only: these are *split*, and make pairs of one for the first half and one for the
/// second. All is padded to groups of [`GROUP`] vectors by the padding slot, which has no weight.
#[derive(Debug, Clone, Copy)]
pub struct Block<'a> {
    /// The targets are the slots `first_slot .. first_slot + len`.
    pub first_slot: usize,
    /// How many targets there are, 1 … [`LANES`].
    pub len: usize,
    /// Slots of the candidates, each once, the targets themselves among them; and here and there the padding slot, which
    /// has no weight and is out of reach of all.
    pub candidates: &'a [u32],
    ends: &'a [u32; 2 * RUNS],
    padding: u32,
}

impl<'a> Block<'a> {
    /// The slots of all candidates, without the padding slot.
    #[inline]
    pub fn sources(&self) -> impl Iterator<Item = usize> + use<'a> {
        let padding = self.padding;
        self.candidates
            .iter()
            .filter(move |&&slot| slot != padding)
            .map(|&slot| slot as usize)
    }

    /// The candidates of a shell that are targets or periodic images of targets, or those that are not, without the split ones.
    #[inline(always)]
    pub fn full(&self, shell: usize, are_targets: bool) -> &'a [[u32; GROUP]] {
        self.run(shell, are_targets).as_chunks().0
    }

    /// The split candidates that are targets or images of targets, or those that are not; all are in the last shell. Even places are near to
    /// the first half of the block, odd ones to the second.
    #[inline(always)]
    pub fn split(&self, are_targets: bool) -> &'a [[u32; 2 * GROUP]] {
        self.run(SPLIT, are_targets).as_chunks().0
    }

    #[inline(always)]
    fn run(&self, run: usize, are_targets: bool) -> &'a [u32] {
        let run = if are_targets { run } else { RUNS + run };
        let start = if run == 0 { 0 } else { self.ends[run - 1] };
        &self.candidates[start as usize..self.ends[run] as usize]
    }
}

/// All blocks of a list. They know slots and no positions, so that what runs over them is compiled once for the plane
/// and space.
#[derive(Debug, Clone, Default)]
pub struct Blocks {
    targets: usize,
    chunks: Vec<Chunk>,
}

impl Blocks {
    /// Number of targets: their slots are the first.
    pub fn targets(&self) -> usize {
        self.targets
    }

    /// Empty chunks for so many targets.
    pub(crate) fn chunks_for(&mut self, targets: usize) -> &mut [Chunk] {
        self.targets = targets;
        let blocks = targets.div_ceil(LANES);
        self.chunks
            .resize_with(blocks.div_ceil(BLOCKS_PER_CHUNK), Chunk::default);
        &mut self.chunks
    }

    /// Runs `f` over all blocks in parallel. `out` has one entry per target slot; a block gets those of its targets.
    /// No allocation.
    ///
    /// # Panics
    /// Where `out` is not as long as there are targets.
    pub fn for_each<R: Send>(&self, out: &mut [R], f: impl Fn(Block<'_>, &mut [R]) + Sync) {
        self.for_each_dyn(out, &f);
    }

    /// Compiled once for every kind of output, not for every loop: a loop takes microseconds for a block, a call some
    /// nanoseconds.
    fn for_each_dyn<R: Send>(&self, out: &mut [R], f: &(dyn Fn(Block<'_>, &mut [R]) + Sync)) {
        assert_eq!(out.len(), self.targets, "one output per target");
        out.par_chunks_mut(BLOCKS_PER_CHUNK * LANES)
            .zip(&self.chunks)
            .enumerate()
            .for_each(|(number, (out, chunk))| {
                let first = number * BLOCKS_PER_CHUNK * LANES;
                for (block, out) in out.chunks_mut(LANES).enumerate() {
                    f(chunk.block(block, first + block * LANES, out.len()), out);
                }
            });
    }

    /// The block of a target slot.
    pub(crate) fn of_slot(&self, slot: usize) -> Block<'_> {
        let block = slot / LANES;
        self.chunks[block / BLOCKS_PER_CHUNK].block(block % BLOCKS_PER_CHUNK, slot, 1)
    }

    /// Candidates over all blocks and lanes: what a pair loop evaluates, pairs beyond the support included.
    pub fn lane_pairs(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.lanes).sum()
    }
}

/// The candidates of consecutive blocks.
#[derive(Debug, Clone, Default)]
pub(crate) struct Chunk {
    /// First candidate of each block, and the end of the last.
    start: Vec<u32>,
    /// Ends of the runs of each block, from its first candidate.
    ends: Vec<[u32; 2 * RUNS]>,
    candidates: Vec<u32>,
    /// Slots × lanes, padding included.
    lanes: usize,
    padding: u32,
}

impl Chunk {
    pub(crate) fn clear(&mut self) {
        self.start.clear();
        self.ends.clear();
        self.candidates.clear();
        self.start.push(0);
        self.lanes = 0;
    }

    /// A block of this chunk.
    #[inline(always)]
    pub(crate) fn block(&self, place: usize, first_slot: usize, len: usize) -> Block<'_> {
        Block {
            first_slot,
            len,
            candidates: &self.candidates
                [self.start[place] as usize..self.start[place + 1] as usize],
            ends: &self.ends[place],
            padding: self.padding,
        }
    }

    /// Takes the candidates of the next block out of `found`.
    pub(crate) fn add_block(&mut self, found: &mut Found, padding: u32) {
        self.padding = padding;
        let first = self.candidates.len();
        let mut ends = [0; 2 * RUNS];
        for (runs, ends) in found.runs.iter_mut().zip(ends.as_chunks_mut::<RUNS>().0) {
            let [shells @ .., left, right, nowhere] = runs;
            nowhere.clear();
            // What has no partner takes a whole vector.
            let pairs = left.len().min(right.len()) / GROUP * GROUP;
            shells[SHELLS - 1].extend(left.drain(pairs..));
            shells[SHELLS - 1].extend(right.drain(pairs..));
            for shell in (0..SHELLS).rev() {
                while !shells[shell].len().is_multiple_of(GROUP) {
                    if shell == 0 {
                        shells[shell].push(padding);
                    } else if let Some(slot) = shells[shell].pop() {
                        // An inner shell takes any candidate.
                        shells[shell - 1].push(slot);
                    }
                }
            }
            for (shell, end) in shells.iter_mut().zip(ends.iter_mut()) {
                self.lanes += LANES * shell.len();
                self.candidates.append(shell);
                *end = (self.candidates.len() - first) as u32;
            }
            self.lanes += LANES * pairs;
            for (left, right) in left.drain(..).zip(right.drain(..)) {
                self.candidates.extend([left, right]);
            }
            ends[SPLIT] = (self.candidates.len() - first) as u32;
        }
        self.ends.push(ends);
        self.start.push(self.candidates.len() as u32);
    }
}

/// Places for a candidate: the shells, the last shell near to one half or the other, nowhere.
const PLACES: usize = SHELLS + 3;

/// The candidates of a block while it is searched: targets, then others, by place.
#[derive(Debug, Clone, Default)]
pub(crate) struct Found {
    runs: [[Vec<u32>; PLACES]; 2],
}

impl Found {
    /// Puts a candidate where it belongs. `halves` says to which halves it may be near: bit 0 the first, bit 1 the
    /// second. Without branches: one list takes what is near to none.
    #[inline(always)]
    pub(crate) fn add(&mut self, slot: u32, is_target: bool, shell: usize, halves: usize) {
        let place = PLACE[shell][halves];
        self.runs[usize::from(!is_target)][place as usize].push(slot);
    }
}

/// The place of a candidate by its shell and its halves.
const PLACE: [[u8; 4]; SHELLS] = {
    const NOWHERE: u8 = PLACES as u8 - 1;
    let mut table = [[NOWHERE; 4]; SHELLS];
    let mut shell = 0;
    while shell < SHELLS {
        let full = shell as u8;
        table[shell] = [NOWHERE, full, full, full];
        shell += 1;
    }
    table[SHELLS - 1] = [NOWHERE, SHELLS as u8, SHELLS as u8 + 1, SHELLS as u8 - 1];
    table
};
