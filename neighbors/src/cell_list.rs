//! The neighbour list of a set that moves.

use fearless_simd::Level;
use rayon::prelude::*;

use crate::block::{Block, Chunk, SHELLS};
use crate::cells::Cells;
use crate::clusters::cluster;
use crate::search::{Scratch, Search};
use crate::{Bounds, Domain, LANES, point};

/// A source as the pair loop reads it: coordinates (zero beyond D) and its weight, usually the volume, last.
pub type Slot = [f64; 4];

/// Blocks that one task handles.
const BLOCKS_PER_CHUNK: usize = 16;

/// Blocks whose surroundings are collected at once.
const SEARCHED_TOGETHER: usize = 4;

/// Small cells follow a sphere closely, large ones are few.
const CELL_OVER_REACH: f64 = 0.5;

/// Neighbours of moving particles: blocks of [`LANES`] particles that share one list of candidates.
///
/// Some particles are *targets* (their neighbours are wanted), all are *sources*. A list made for a support radius
/// plus a skin serves until some particle has moved half the skin; [`CellList::update`] sees to that.
///
/// Memory: 4 bytes per candidate and block (1.3 bytes per pair of SPH particles) and about 60 bytes per particle. Cost of
/// a build: O(n log n), parallel; three to four evaluations of density and force. The same bits for any number of
/// threads.
///
/// ```
/// use sphpack_neighbors::{CellList, Domain};
///
/// let points = vec![[0.0, 0.0], [0.3, 0.0], [0.9, 0.9]];
/// let mut near = CellList::new(&Domain::new([0.0, 0.0], [1.0, 1.0]), 0.5);
/// near.update(&points, |_| true);
/// assert_eq!(near.of(0, &points), vec![1]);
/// ```
#[derive(Debug, Clone)]
pub struct CellList<const D: usize> {
    domain: Domain<D>,
    support: f64,
    skin: f64,
    /// Where the shells after the first begin.
    shells: [f64; SHELLS - 1],
    /// Positions at the last build.
    reference: Vec<[f64; D]>,
    targets: usize,
    /// The particle in each slot. Slots `0..targets` are the targets, block by block; the other sources follow.
    particle: Vec<u32>,
    /// What to add to a particle's position to get its slot's; empty without periodic axes.
    shift: Vec<[f64; D]>,
    slot_of: Vec<u32>,
    chunks: Vec<Chunk>,
    cells: Cells<D>,
    /// The instructions that the search uses.
    level: Level,
    /// Where the slot of nobody is: out of reach of all.
    nobody: [f64; D],
    builds: usize,
}

impl<const D: usize> CellList<D> {
    /// An empty list for the given support radius (scene units), without skin.
    pub fn new(domain: &Domain<D>, support: f64) -> Self {
        Self {
            domain: *domain,
            support,
            skin: 0.0,
            shells: [f64::INFINITY; SHELLS - 1],
            level: Level::new(),
            nobody: [0.0; D],
            reference: Vec::new(),
            targets: 0,
            particle: Vec::new(),
            shift: Vec::new(),
            slot_of: Vec::new(),
            chunks: Vec::new(),
            cells: Cells::default(),
            builds: 0,
        }
    }

    /// Makes lists that hold until some particle has moved half of `skin` (scene units).
    #[must_use]
    pub fn with_skin(self, skin: f64) -> Self {
        Self { skin, ..self }
    }

    /// [`CellList::set_shells`] from the start.
    #[must_use]
    pub fn with_shells(mut self, radii: [f64; SHELLS - 1]) -> Self {
        self.set_shells(radii);
        self
    }

    /// Sorts the candidates of every block into shells: as long as a list holds, those of shell `s` are at least
    /// `radii[s − 1]` away from every target of the block. Radii (scene units) ascend; without them all is shell 0.
    /// Other radii than before make the next [`CellList::update`] build anew.
    pub fn set_shells(&mut self, radii: [f64; SHELLS - 1]) {
        if radii != self.shells {
            self.shells = radii;
            self.invalidate();
        }
    }

    /// The box.
    pub fn domain(&self) -> &Domain<D> {
        &self.domain
    }

    /// The support radius.
    pub fn support(&self) -> f64 {
        self.support
    }

    /// How many times a list was built.
    pub fn builds(&self) -> usize {
        self.builds
    }

    /// The positions at the last build: a list built from these again, with the same shells and targets, has the same
    /// slots. Empty where the next [`CellList::update`] builds anew.
    pub fn reference(&self) -> &[[f64; D]] {
        &self.reference
    }

    /// Number of targets.
    pub fn targets(&self) -> usize {
        self.targets
    }

    /// The slot of a target; `None` for a particle that is none.
    #[inline]
    pub fn slot_of(&self, particle: usize) -> Option<usize> {
        let slot = self.slot_of[particle];
        (slot != u32::MAX).then_some(slot as usize)
    }

    /// Particle indices of the targets' slots, block by block.
    pub fn target_particles(&self) -> &[u32] {
        &self.particle[..self.targets]
    }

    /// Slot by slot the particle in it, and what to add to that one's position to get the slot's, which is not zero for periodic
    /// images and, on periodic axes, for particles that are not in the box. The targets' slots come first.
    pub fn sources(&self) -> impl ExactSizeIterator<Item = (usize, [f64; D])> {
        let shift = |slot: usize| self.shift.get(slot).copied().unwrap_or([0.0; D]);
        (self.particle.iter().enumerate()).map(move |(slot, &i)| (i as usize, shift(slot)))
    }

    /// Brings the list up to date; true where it had to be built anew: the number of points changed, or one moved
    /// more than half the skin. Positions must be finite. Changing which particles are targets needs
    /// [`CellList::invalidate`].
    pub fn update(
        &mut self,
        positions: &[[f64; D]],
        is_target: impl Fn(usize) -> bool + Sync,
    ) -> bool {
        if positions.len() == self.reference.len() && self.builds > 0 {
            let limit = 0.25 * self.skin * self.skin;
            let moved = positions
                .par_iter()
                .zip(&self.reference)
                .with_min_len(4096)
                .any(|(&p, &q)| point::distance_squared(p, q) > limit);
            if !moved {
                return false;
            }
        }
        self.build(positions, is_target);
        true
    }

    /// Makes the next [`CellList::update`] build anew.
    pub fn invalidate(&mut self) {
        self.reference.clear();
        self.builds = 0;
    }

    fn build(&mut self, positions: &[[f64; D]], is_target: impl Fn(usize) -> bool + Sync) {
        let reach = self.support + self.skin;
        self.reference.clear();
        self.reference.extend_from_slice(positions);
        self.builds += 1;

        // Targets first, in compact blocks of their wrapped positions.
        let wrapped: Vec<[f64; D]> = if self.domain.is_periodic() {
            positions.iter().map(|&p| self.domain.wrap(p)).collect()
        } else {
            Vec::new()
        };
        let at: &[[f64; D]] = if wrapped.is_empty() {
            positions
        } else {
            &wrapped
        };
        self.particle.clear();
        self.particle.extend(
            (0..positions.len())
                .filter(|&i| is_target(i))
                .map(|i| i as u32),
        );
        self.targets = self.particle.len();
        cluster(at, &mut self.particle);
        self.slot_of.clear();
        self.slot_of.resize(positions.len(), u32::MAX);
        for (slot, &i) in self.particle.iter().enumerate() {
            self.slot_of[i as usize] = slot as u32;
        }
        self.particle.extend(
            (0..positions.len())
                .filter(|&i| self.slot_of[i] == u32::MAX)
                .map(|i| i as u32),
        );
        self.shift.clear();
        if !wrapped.is_empty() {
            self.add_images(positions, &wrapped, reach);
        }

        // Sources that are no targets, in the order of the grid: what is near in space is near in memory.
        let mut sources = self.source_positions(positions);
        let others = &sources[self.targets..];
        self.cells.build(others, reach);
        let mut order: Vec<usize> = self
            .cells
            .items()
            .iter()
            .map(|&k| self.targets + k as usize)
            .collect();
        // A pair with a target's image is a pair of targets: images come before sources that are no targets.
        let is_image = |k: &usize| self.slot_of[self.particle[*k] as usize] != u32::MAX;
        let images = order.iter().filter(|k| is_image(k)).count();
        if images > 0 {
            order.sort_by_key(|k| !is_image(k));
        }
        reorder_tail(&mut self.particle, self.targets, &order);
        if !self.shift.is_empty() {
            reorder_tail(&mut self.shift, self.targets, &order);
        }
        reorder_tail(&mut sources, self.targets, &order);

        self.cells.build(&sources, CELL_OVER_REACH * reach);
        let by_cell: Vec<[f64; D]> = self
            .cells
            .items()
            .par_iter()
            .with_min_len(4096)
            .map(|&slot| sources[slot as usize])
            .collect();
        let search = Search {
            cells: &self.cells,
            sources: &by_cell,
            targets: self.targets + images,
            reach,
            // Both ends of a pair may come half a skin nearer.
            begins: self.shells.map(|r| r + self.skin),
            level: self.level,
        };
        let targets = &sources[..self.targets];
        let nobody = sources.len() as u32;
        let blocks = self.targets.div_ceil(LANES);
        self.chunks
            .resize_with(blocks.div_ceil(BLOCKS_PER_CHUNK), Chunk::default);
        self.chunks
            .par_iter_mut()
            .zip(targets.par_chunks(BLOCKS_PER_CHUNK * LANES))
            .for_each_init(Scratch::default, |scratch, (chunk, targets)| {
                chunk.clear();
                for few in targets.chunks(SEARCHED_TOGETHER * LANES) {
                    search.surround(few, scratch);
                    for members in few.chunks(LANES) {
                        search.block(members, scratch);
                        chunk.add_block(&mut scratch.found, nobody);
                    }
                }
            });
        self.nobody = point::add(Bounds::of(&sources).max, [2.0 * reach; D]);
    }

    /// Appends a slot for every periodic image within `reach` of the box; fills `shift`.
    fn add_images(&mut self, positions: &[[f64; D]], wrapped: &[[f64; D]], reach: f64) {
        self.shift.extend(
            self.particle
                .iter()
                .map(|&i| point::sub(wrapped[i as usize], positions[i as usize])),
        );
        for own in 0..positions.len() {
            let i = self.particle[own] as usize;
            for image in self.domain.images(wrapped[i], reach).skip(1) {
                self.particle.push(i as u32);
                self.shift.push(point::sub(image, positions[i]));
            }
        }
    }

    fn source_positions(&self, positions: &[[f64; D]]) -> Vec<[f64; D]> {
        let mut sources: Vec<[f64; D]> = self
            .particle
            .iter()
            .map(|&i| positions[i as usize])
            .collect();
        for (p, &shift) in sources.iter_mut().zip(&self.shift) {
            *p = point::add(*p, shift);
        }
        sources
    }

    /// Writes every source's present position times `unit` and weight into its slot, and the slot of nobody behind
    /// them; `weights` has one entry per particle. O(n), parallel, no allocation once `slots` has its size.
    pub fn gather(
        &self,
        positions: &[[f64; D]],
        weights: &[f64],
        unit: f64,
        slots: &mut Vec<Slot>,
    ) {
        let slot = |number: usize| {
            let Some(&i) = self.particle.get(number) else {
                let mut slot = [0.0; 4];
                slot[..D].copy_from_slice(&point::scale(self.nobody, unit));
                return slot;
            };
            let i = i as usize;
            let mut p = positions[i];
            if !self.shift.is_empty() {
                p = point::add(p, self.shift[number]);
            }
            let mut slot = [0.0, 0.0, 0.0, weights[i]];
            slot[..D].copy_from_slice(&point::scale(p, unit));
            slot
        };
        (0..self.particle.len() + 1)
            .into_par_iter()
            .with_min_len(4096)
            .map(slot)
            .collect_into_vec(slots);
    }

    /// Writes other weights into gathered `slots`; `weights` has one entry per particle. O(n), parallel.
    pub fn weigh(&self, weights: &[f64], slots: &mut [Slot]) {
        slots
            .par_iter_mut()
            .zip(&self.particle)
            .with_min_len(4096)
            .for_each(|(slot, &i)| slot[3] = weights[i as usize]);
    }

    /// Runs `f` over all blocks in parallel. `out` has one entry per target slot; a block gets those of its targets.
    /// No allocation.
    ///
    /// # Panics
    /// Where `out` is not as long as there are targets.
    pub fn for_each_block<R: Send>(&self, out: &mut [R], f: impl Fn(Block<'_>, &mut [R]) + Sync) {
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

    /// Candidates over all blocks and lanes: what the pair loop evaluates, pairs beyond the support included.
    pub fn lane_pairs(&self) -> usize {
        self.chunks.iter().map(Chunk::lanes).sum()
    }

    /// The particles within the support of target `i`, itself left out, with x_i − x_j; an image counts as its particle,
    /// and appears once for each image in reach. Nothing where `i` is no target. One target at a time: for a few of
    /// many, [`CellList::for_each_block`] goes over all.
    pub fn around<'a>(
        &'a self,
        i: usize,
        positions: &'a [[f64; D]],
    ) -> impl Iterator<Item = (usize, [f64; D])> + 'a {
        let position = |slot: usize| {
            let p = positions[self.particle[slot] as usize];
            self.shift
                .get(slot)
                .map_or(p, |&shift| point::add(p, shift))
        };
        let near = move |slot: usize| {
            let (block, here) = (slot / LANES, position(slot));
            self.chunks[block / BLOCKS_PER_CHUNK]
                .block(block % BLOCKS_PER_CHUNK, slot, 1)
                .candidates
                .iter()
                .map(|&other| other as usize)
                .filter(move |&other| other != slot && other < self.particle.len())
                .map(move |other| {
                    let apart = point::sub(here, position(other));
                    (self.particle[other] as usize, apart)
                })
                .filter(|(_, apart)| point::norm_squared(*apart) <= self.support * self.support)
        };
        self.slot_of(i).into_iter().flat_map(near)
    }

    /// The particles of [`CellList::around`], ascending. For tests and tools, not for loops.
    pub fn of(&self, i: usize, positions: &[[f64; D]]) -> Vec<usize> {
        let mut found: Vec<usize> = self.around(i, positions).map(|(j, _)| j).collect();
        found.sort_unstable();
        found
    }
}

fn reorder_tail<T: Copy>(values: &mut [T], first: usize, order: &[usize]) {
    let tail: Vec<T> = order.iter().map(|&k| values[k]).collect();
    values[first..].copy_from_slice(&tail);
}
