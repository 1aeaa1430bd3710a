//! The neighbour list of a set that moves.

use fearless_simd::Level;
use rayon::prelude::*;

use crate::arranged::Arranged;
use crate::block::{BLOCKS_PER_CHUNK, Blocks, SHELLS};
use crate::cells::Cells;
use crate::clusters::cluster;
use crate::octaves::Octaves;
use crate::reaches::Reaches;
use crate::search::{Members, Scratch, Search};
use crate::{Bounds, Domain, LANES, point};

/// A source as the pair loop reads it: coordinates (zero beyond D) and its weight, usually the volume, last.
pub type Slot = [f64; 4];

/// Blocks whose surroundings are collected at once.
const SEARCHED_TOGETHER: usize = 4;

/// Neighbours of moving particles: blocks of [`LANES`] particles that share one list of candidates.
///
/// Some particles are *targets* (their neighbours are wanted), all are *sources*. A list made for a support radius
/// plus a skin serves until some particle has moved half the skin; [`CellList::update`] sees to that.
///
/// All look equally far ([`CellList::update`]), or each as far as it says ([`CellList::update_each`]): then two are neighbours
/// of each other where either sees the other, so that sums over W(h_i), over W(h_j) and over a mean find all they need.
///
/// Memory: 4 bytes per candidate and block (1.3 bytes per pair of SPH particles) and about 60 bytes per particle. Cost of
/// a build: O(n log n), parallel; three to four evaluations of density and force. The same bits for any number of
/// threads.
///
/// ```
/// use sphpack_neighbors::{CellList, Domain};
///
/// let points = vec![[0.0, 0.0], [0.3, 0.0], [0.9, 0.9]];
/// let mut list = CellList::new(&Domain::new([0.0, 0.0], [1.0, 1.0]), 0.5);
/// list.update(&points);
/// assert_eq!(list.of(0, &points), vec![1]);
/// // All within reach are among the candidates, by particle and shift (zero without periodic sides).
/// let way = |j: usize, shift: [f64; 2]| [0, 1].map(|k| points[0][k] - points[j][k] - shift[k]);
/// let near = list.neighbors(0).filter(|&(j, shift)| {
///     let [x, y] = way(j, shift);
///     x * x + y * y <= 0.25
/// });
/// assert_eq!(near.count(), 1);
/// ```
#[derive(Debug, Clone)]
pub struct CellList<const D: usize> {
    domain: Domain<D>,
    reaches: Reaches,
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
    blocks: Blocks,
    arranged: Arranged,
    sorted: Octaves<D>,
    /// The instructions that the search uses.
    level: Level,
    /// Where the padding slot is: out of reach of all.
    padding: [f64; D],
    builds: usize,
}

impl<const D: usize> CellList<D> {
    /// An empty list for the given support radius (scene units), without skin.
    #[must_use]
    pub fn new(domain: &Domain<D>, support: f64) -> Self {
        Self {
            domain: *domain,
            reaches: Reaches::one(support, 0.0),
            shells: [f64::INFINITY; SHELLS - 1],
            level: Level::new(),
            padding: [0.0; D],
            reference: Vec::new(),
            targets: 0,
            particle: Vec::new(),
            shift: Vec::new(),
            slot_of: Vec::new(),
            blocks: Blocks::default(),
            arranged: Arranged::default(),
            sorted: Octaves::default(),
            builds: 0,
        }
    }

    /// Makes lists that hold until some particle has moved half of `skin`: scene units, or parts of each particle's own
    /// support where these differ.
    #[must_use]
    pub fn with_skin(mut self, skin: f64) -> Self {
        self.set_skin(skin);
        self
    }

    /// Another skin than before makes the next update build anew.
    pub fn set_skin(&mut self, skin: f64) {
        if self.reaches.set_skin(skin) {
            self.invalidate();
        }
    }

    /// [`CellList::set_shells`] from the start.
    #[must_use]
    pub fn with_shells(mut self, radii: [f64; SHELLS - 1]) -> Self {
        self.set_shells(radii);
        self
    }

    /// Sorts the candidates of every block into shells: as long as a list holds, those of shell `s` are at least
    /// `radii[s − 1]` away from every target of the block. Radii (scene units; where supports differ, parts of the greater one
    /// of a pair) ascend; without them all is shell 0. Other radii than before make the next update build anew.
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

    /// The support radius; where supports differ, the greatest of the last build.
    pub fn support(&self) -> f64 {
        self.reaches.support
    }

    /// How many times a list was built.
    pub fn builds(&self) -> usize {
        self.builds
    }

    /// The positions at the last build: a list built from these again, with the same shells and targets, has the same
    /// slots; where supports differ, one that was [arranged](CellList::arrange) the same way before. Empty where the next update
    /// builds anew.
    pub fn reference(&self) -> &[[f64; D]] {
        &self.reference
    }

    /// How the targets are arranged.
    pub fn arranged(&self) -> &Arranged {
        &self.arranged
    }

    /// Takes over an arrangement of the targets of the next build, of which the supports differ.
    ///
    /// # Panics
    /// In the next update, where a target is missing or twice in it.
    pub fn arrange(&mut self, arranged: Arranged) {
        self.invalidate();
        self.arranged = arranged;
    }

    /// Number of targets.
    pub fn targets(&self) -> usize {
        self.targets
    }

    /// The slot of a target; `None` for a particle that is none.
    ///
    /// # Panics
    /// Where the last update had no particle of this number.
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

    /// Brings a list of which all particles are targets up to date; true where it had to be built anew: the number of points
    /// changed, or one moved more than half the skin. Positions must be finite.
    pub fn update(&mut self, positions: &[[f64; D]]) -> bool {
        self.update_some(positions, |_| true)
    }

    /// [`CellList::update`] where only some particles are targets. Changing which needs [`CellList::invalidate`].
    pub fn update_some(
        &mut self,
        positions: &[[f64; D]],
        is_target: impl Fn(usize) -> bool + Sync,
    ) -> bool {
        self.update_with(positions, None, is_target)
    }

    /// [`CellList::update_some`] where every particle has a support radius of its own (scene units, positive, finite),
    /// which may change while it moves.
    ///
    /// # Panics
    /// Where there is not one support for every position.
    pub fn update_each(
        &mut self,
        positions: &[[f64; D]],
        supports: &[f64],
        is_target: impl Fn(usize) -> bool + Sync,
    ) -> bool {
        assert_eq!(positions.len(), supports.len(), "one support per particle");
        self.update_with(positions, Some(supports), is_target)
    }

    fn update_with(
        &mut self,
        positions: &[[f64; D]],
        supports: Option<&[f64]>,
        is_target: impl Fn(usize) -> bool + Sync,
    ) -> bool {
        let holds =
            self.builds > 0 && (self.reaches).still_hold(&self.reference, positions, supports);
        if !holds {
            self.reaches.set(supports);
            self.build(positions, is_target);
        }
        !holds
    }

    /// Makes the next update build anew.
    pub fn invalidate(&mut self) {
        self.reference.clear();
        self.builds = 0;
        self.arranged = Arranged::default();
    }

    fn build(&mut self, positions: &[[f64; D]], is_target: impl Fn(usize) -> bool + Sync) {
        let reach = self.reaches.greatest();
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
        let is_kept = self.reaches.are_many() && self.arranged.still_serves(positions.len());
        if is_kept {
            self.particle.extend_from_slice(&self.arranged.order);
        } else {
            self.particle.extend(
                (0..positions.len())
                    .filter(|&i| is_target(i))
                    .map(|i| i as u32),
            );
            cluster(at, &mut self.particle);
        }
        self.targets = self.particle.len();
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
        let mut cells = Cells::default();
        cells.build(&sources[self.targets..], reach);
        let mut order: Vec<usize> = (cells.items().iter())
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

        let mut reaches = Vec::new();
        if self.reaches.are_many() {
            let reach = |&i: &u32| self.reaches.listed(i as usize);
            reaches.extend(self.particle.iter().map(reach));
            self.sorted.build_many(&sources, &reaches);
        } else {
            self.sorted.build_one(&sources, reach);
        }
        let search = Search {
            sorted: &self.sorted,
            targets: self.targets + images,
            reach,
            begins: self.shells.map(|begin| self.reaches.shell(begin)),
            level: self.level,
        };
        let targets = &sources[..self.targets];
        let padding = sources.len() as u32;
        let chunks = self.blocks.chunks_for(self.targets);
        chunks
            .par_iter_mut()
            .zip(targets.par_chunks(BLOCKS_PER_CHUNK * LANES))
            .enumerate()
            .for_each_init(Scratch::default, |scratch, (number, (chunk, targets))| {
                chunk.clear();
                let mut first = number * BLOCKS_PER_CHUNK * LANES;
                for few in targets.chunks(SEARCHED_TOGETHER * LANES) {
                    // Empty where all have one reach.
                    let their = reaches.get(first..first + few.len()).unwrap_or(&[]);
                    first += few.len();
                    let few = Members {
                        positions: few,
                        reaches: their,
                    };
                    search.surround(few, scratch);
                    for members in few.blocks() {
                        search.block(members, scratch);
                        chunk.add_block(&mut scratch.found, padding);
                    }
                }
            });
        self.padding = point::add(Bounds::of(&sources).max, [2.0 * reach; D]);
        if self.reaches.are_many() {
            let lane_pairs = self.blocks.lane_pairs();
            if is_kept {
                self.arranged.wear(lane_pairs);
            } else {
                let order = self.particle[..self.targets].to_vec();
                self.arranged = Arranged::new(order, positions.len(), lane_pairs);
            }
        }
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

    /// Slot by slot, what `value` says of the slot's particle and its shift ([`CellList::sources`]), and `padding` for the padding
    /// slot behind them: any field, images included. O(n), parallel, no allocation once `out` has its size.
    pub fn gather_with<T: Copy + Send + Sync>(
        &self,
        value: impl Fn(usize, [f64; D]) -> T + Sync,
        padding: T,
        out: &mut Vec<T>,
    ) {
        let slot = |number: usize| {
            let Some(&i) = self.particle.get(number) else {
                return padding;
            };
            let shift = self.shift.get(number).copied().unwrap_or([0.0; D]);
            value(i as usize, shift)
        };
        (0..self.particle.len() + 1)
            .into_par_iter()
            .with_min_len(4096)
            .map(slot)
            .collect_into_vec(out);
    }

    /// Writes every source's present position times `unit` and weight into its slot, and the padding slot behind
    /// them; `weights` has one entry per particle. O(n), parallel, no allocation once `slots` has its size.
    ///
    /// # Panics
    /// Where positions or weights are fewer than at the last update.
    pub fn gather(
        &self,
        positions: &[[f64; D]],
        weights: &[f64],
        unit: f64,
        slots: &mut Vec<Slot>,
    ) {
        let slot = |p: [f64; D], weight: f64| {
            let mut slot = [0.0, 0.0, 0.0, weight];
            slot[..D].copy_from_slice(&point::scale(p, unit));
            slot
        };
        let padding = slot(self.padding, 0.0);
        if self.shift.is_empty() {
            self.gather_with(|i, _| slot(positions[i], weights[i]), padding, slots);
        } else {
            let shifted = |i: usize, shift| slot(point::add(positions[i], shift), weights[i]);
            self.gather_with(shifted, padding, slots);
        }
    }

    /// Writes other weights into gathered `slots`; `weights` has one entry per particle. O(n), parallel.
    ///
    /// # Panics
    /// Where weights are fewer than particles at the last update.
    pub fn weigh(&self, weights: &[f64], slots: &mut [Slot]) {
        slots
            .par_iter_mut()
            .zip(&self.particle)
            .with_min_len(4096)
            .for_each(|(slot, &i)| slot[3] = weights[i as usize]);
    }

    /// The blocks that pair loops run over.
    pub fn blocks(&self) -> &Blocks {
        &self.blocks
    }

    /// Candidates of target `i`, itself left out, by particle and shift: x_i − (x_j + shift) is the way from `j`, or from an
    /// image of it, to `i`. All within either's support are among them, and others as far as the skin and the block go.
    /// Nothing where `i` is no target. One target at a time: for all of them [`CellList::blocks`] is many times faster.
    ///
    /// # Panics
    /// Where the last update had no particle `i`.
    pub fn neighbors(&self, i: usize) -> impl Iterator<Item = (usize, [f64; D])> + '_ {
        let shift = |slot: usize| self.shift.get(slot).copied().unwrap_or([0.0; D]);
        let near = move |slot: usize| {
            (self.blocks.of_slot(slot).sources())
                .filter(move |&other| other != slot)
                .map(move |other| {
                    let shift = point::sub(shift(other), shift(slot));
                    (self.particle[other] as usize, shift)
                })
        };
        self.slot_of(i).into_iter().flat_map(near)
    }

    /// The particles within the support of target `i`, or of which it is within theirs, itself left out, with x_i − x_j; an
    /// image counts as its particle, and appears once for each image in reach. Nothing where `i` is no target. Supports are
    /// those of the last build.
    ///
    /// # Panics
    /// Where the last update had no particle `i`, or other positions than these.
    pub fn around<'a>(
        &'a self,
        i: usize,
        positions: &'a [[f64; D]],
    ) -> impl Iterator<Item = (usize, [f64; D])> + 'a {
        self.neighbors(i)
            .map(move |(j, shift)| (j, point::sub(positions[i], point::add(positions[j], shift))))
            .filter(move |&(j, apart)| {
                let support = self.reaches.of_pair(i, j);
                point::norm_squared(apart) <= support * support
            })
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
