//! Density and forces of a particle set, evaluated again and again while it moves.

mod variation;

use std::io::{self, Write};
use std::time::Instant;

use fearless_simd::Level;
use rayon::prelude::*;
use sphpack_kernels::{KernelKind, WithKernel};
use sphpack_neighbors::{CellList, Domain};
use sphpack_pairs::{
    Gathered, PackingSum, PackingSums, Repulsion, RepulsionSum, Shape, VariationSum,
};

pub use crate::levelling::Levelling;
use crate::particles::Particles;
use crate::problem::Problem;
use crate::state::{Damaged, State, Value, all_finite, put_list};

/// Particles per block of a reduction. Fixed, so that sums have the same bits for any number of threads.
const REDUCTION_BLOCK: usize = 4096;

/// Evaluates Γ, ∇Γ, repulsion and energy; keeps the neighbour list between calls.
///
/// Where particles differ in size, its lengths (smoothing length, skin, repulsion) are those of the finest, and scale with each
/// particle, with the mean of both in a pair's repulsion. Γ_i and ∇Γ_i are then gathered with the particle's own h.
#[derive(Debug)]
pub struct Forces<const D: usize> {
    shape: Shape,
    smoothing_length: f64,
    /// The kernel's support and the list's skin, scene units.
    support: f64,
    skin: f64,
    /// Supports, and smoothing lengths, where particles differ in size.
    each: [Vec<f64>; 2],
    /// The repulsion, which may be changed between evaluations.
    pub repulsion: Repulsion,
    /// The levelling, which may be changed between evaluations.
    pub levelling: Option<Levelling>,
    /// Which particles have their density levelled, by their number; all where it is empty.
    pub levelled: Vec<bool>,
    list: CellList<D>,
    /// Where the list of an earlier run was built: built there again, it has the same slots, and sums the same bits.
    built_at: Option<Vec<[f64; D]>>,
    /// The farthest that the repulsion has reached so far; what is farther in the list is not asked for it.
    reach: f64,
    level: Level,
    gathered: Gathered,
    sums: Vec<PackingSum>,
    /// V (Γ − Γ₀) of every particle, 0 for those that are no targets or are not levelled.
    excess: Vec<f64>,
    /// Σ_j V_j (Γ_j − Γ₀) ∇_iW_ij of every target slot.
    excess_gradient: Vec<[f64; 3]>,
    /// Of every target slot, by [`Forces::vary`].
    variation: Vec<VariationSum>,
    evaluations: usize,
    neighbor_seconds: f64,
    force_seconds: f64,
}

impl<const D: usize> Forces<D> {
    /// An evaluator for a kernel of the given smoothing length; lists have a skin of `skin` (scene units).
    pub fn new(
        domain: &Domain<D>,
        kernel: KernelKind,
        smoothing_length: f64,
        skin: f64,
        repulsion: Repulsion,
    ) -> Self {
        let support = kernel.support_over_h() * smoothing_length;
        Self::between(
            domain,
            Shape::Smoothing(kernel),
            smoothing_length,
            support,
            skin,
            repulsion,
        )
    }

    /// An evaluator whose "∇Γ" is the sum Σ_j V_j C_ij n̂_ij over R, with the [cohesion profile](sphpack_kernels::Cohesion)
    /// of support radius R and n̂ from j to i.
    pub fn of_cohesion(domain: &Domain<D>, support: f64, skin: f64) -> Self {
        Self::between(
            domain,
            Shape::Cohesion,
            support,
            support,
            skin,
            Repulsion::none(),
        )
    }

    fn between(
        domain: &Domain<D>,
        shape: Shape,
        smoothing_length: f64,
        support: f64,
        skin: f64,
        repulsion: Repulsion,
    ) -> Self {
        Self {
            shape,
            smoothing_length,
            support,
            skin,
            each: [Vec::new(), Vec::new()],
            repulsion,
            levelling: None,
            levelled: Vec::new(),
            list: CellList::new(domain, support.max(repulsion.reach())).with_skin(skin),
            built_at: None,
            reach: 0.0,
            level: Level::new(),
            gathered: Gathered::default(),
            sums: Vec::new(),
            excess: Vec::new(),
            excess_gradient: Vec::new(),
            variation: Vec::new(),
            evaluations: 0,
            neighbor_seconds: 0.0,
            force_seconds: 0.0,
        }
    }

    /// The evaluator that a problem asks for.
    pub fn of(problem: &Problem<D>, repulsion: Repulsion) -> Self {
        Self::new(
            &problem.domain,
            problem.kernel,
            problem.smoothing_length(),
            problem.skin(),
            repulsion,
        )
    }

    /// Evaluates everything at the present positions. Frozen particles are sources only. O(n), parallel; allocates
    /// only when the neighbour list is built anew.
    pub fn evaluate(&mut self, particles: &Particles<D>) {
        let is_target = |i: usize| particles.kind[i] != crate::Kind::Frozen;
        let relative = particles.sizes.relative();
        self.evaluate_each(&particles.position, &particles.volume, relative, is_target);
    }

    /// [`Forces::evaluate`] on plain slices, of particles of one size.
    pub fn evaluate_plain(
        &mut self,
        positions: &[[f64; D]],
        volumes: &[f64],
        is_target: impl Fn(usize) -> bool + Sync,
    ) {
        self.evaluate_each(positions, volumes, None, is_target);
    }

    /// [`Forces::evaluate_plain`] with every particle's size over the finest, where they differ.
    pub fn evaluate_each(
        &mut self,
        positions: &[[f64; D]],
        volumes: &[f64],
        relative: Option<&[f64]>,
        is_target: impl Fn(usize) -> bool + Sync,
    ) {
        let start = Instant::now();
        self.take_sizes(relative);
        if let Some(places) = self
            .built_at
            .take_if(|places| places.len() == positions.len())
        {
            self.set_shells();
            self.update_list(&places, &is_target);
            self.sums.resize(self.list.targets(), PackingSum::default());
        }
        if self.list.builds() == 0 || self.repulsion.reach() > self.reach {
            self.reach = self.repulsion.reach().max(self.reach);
            self.set_shells();
        }
        if self.update_list(positions, is_target) {
            self.sums.resize(self.list.targets(), PackingSum::default());
        }
        let listed = Instant::now();
        let h = self.smoothing_length;
        if relative.is_none() {
            self.gathered.gather(&self.list, positions, volumes, h);
        } else {
            let each = &self.each[1];
            (self.gathered).gather_each(&self.list, positions, volumes, each);
        }
        let pairs = sums_of(self.shape, h, &self.list, &self.gathered, self.level);
        let repulsion = self.repulsion.at_size(h);
        pairs.sum::<D>(repulsion, &mut self.sums);
        if let Some(levelling) = self.levelling {
            self.level_out(levelling, volumes);
        }
        self.evaluations += 1;
        self.neighbor_seconds += (listed - start).as_secs_f64();
        self.force_seconds += listed.elapsed().as_secs_f64();
    }

    /// Supports and smoothing lengths of all, of as many as the finest has.
    fn take_sizes(&mut self, relative: Option<&[f64]>) {
        let was_each = !self.each[1].is_empty();
        for each in &mut self.each {
            each.clear();
        }
        let (seen, h) = (self.seen(), self.smoothing_length);
        if let Some(relative) = relative {
            let [supports, lengths] = &mut self.each;
            supports.extend(relative.iter().map(|over| over * seen));
            lengths.extend(relative.iter().map(|over| over * h));
        }
        let is_each = relative.is_some();
        if was_each != is_each {
            // A skin is a length, or a part of each support.
            let skin = if is_each { self.skin / seen } else { self.skin };
            self.list = CellList::new(self.list.domain(), seen).with_skin(skin);
            self.set_shells();
        }
    }

    /// How far the finest particle sees, scene units.
    fn seen(&self) -> f64 {
        self.support.max(self.repulsion.reach())
    }

    fn update_list(
        &mut self,
        positions: &[[f64; D]],
        is_target: impl Fn(usize) -> bool + Sync,
    ) -> bool {
        match &self.each[0][..] {
            [] => self.list.update_some(positions, is_target),
            supports => self.list.update_each(positions, supports, is_target),
        }
    }

    fn set_shells(&mut self) {
        // In parts of the greater support of a pair where supports differ. A pair's repulsion reaches no farther there than
        // that of two of the greater size.
        let unit = if self.each[0].is_empty() {
            1.0
        } else {
            1.0 / self.seen()
        };
        let [length, reach] = [self.smoothing_length, self.reach].map(|length| length * unit);
        self.list.set_shells(self.shape.shells::<D>(length, reach));
    }

    /// The second pass, which needs every Γ.
    fn level_out(&mut self, levelling: Levelling, volumes: &[f64]) {
        self.excess.clear();
        self.excess.resize(volumes.len(), 0.0);
        for (sums, &i) in self.sums.iter().zip(self.list.target_particles()) {
            let i = i as usize;
            if is_levelled(&self.levelled, i) {
                self.excess[i] = volumes[i] * levelling.excess(sums.0.whole)[1];
            }
        }
        self.gathered.weigh(&self.list, &self.excess);
        self.excess_gradient.resize(self.list.targets(), [0.0; 3]);
        let h = self.smoothing_length;
        let pairs = sums_of(self.shape, h, &self.list, &self.gathered, self.level);
        pairs.gradient::<D>(&mut self.excess_gradient);
    }

    /// Must be called when a particle starts or stops being frozen.
    pub fn targets_changed(&mut self) {
        self.list.invalidate();
        self.built_at = None;
    }

    #[inline]
    fn sums(&self, i: usize) -> PackingSum {
        (self.list.slot_of(i)).map_or(PackingSum::default(), |slot| self.sums[slot])
    }

    /// Γ of particle `i` at the last evaluation; 0 for frozen ones.
    #[inline]
    pub fn gamma(&self, i: usize) -> f64 {
        self.sums(i).0.whole
    }

    /// ∇Γ of particle `i` at the last evaluation, per scene unit; zero for frozen ones.
    #[inline]
    pub fn gradient(&self, i: usize) -> [f64; D] {
        first(self.sums(i).1)
    }

    /// −∇Γ plus repulsion: the acceleration of particle `i` for p_b = 1 (Negi & Ramachandran 2021, eqs. 13 and 16),
    /// per scene unit.
    #[inline]
    pub fn acceleration(&self, i: usize) -> [f64; D] {
        let (_, gradient, repulsion) = self.sums(i);
        std::array::from_fn(|k| repulsion.acceleration[k] - gradient[k])
    }

    /// The energy whose negative gradient the accelerations are (for equal volumes), per particle volume:
    /// ½ Σ_ij V W_ij + Σ_pairs φ_R, every pair with a frozen particle counted once.
    pub fn energy(&self) -> f64 {
        blocked_sum(&self.sums, |(density, _, repulsion)| {
            0.5 * (density.whole + density.of_others) + repulsion.energy
        })
    }

    /// Smoothing length of the kernel, scene units.
    pub fn smoothing_length(&self) -> f64 {
        self.smoothing_length
    }

    /// [`Forces::energy`] with every particle's pressure part times its own weight, that of the levelling too: with
    /// volumes over a common volume as weights, the energy whose negative gradient is
    /// [`Forces::weighted_acceleration`].
    pub fn weighted_energy(&self, weight: impl Fn(usize) -> f64 + Sync) -> f64 {
        let particle = self.list.target_particles();
        let blocks = self
            .sums
            .chunks(REDUCTION_BLOCK)
            .zip(particle.chunks(REDUCTION_BLOCK));
        let partial: Vec<f64> = blocks
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|(sums, particle)| {
                let mut sum = 0.0;
                for ((density, _, repulsion), &i) in sums.iter().zip(particle) {
                    let i = i as usize;
                    let (stiffness, [excess, held]) = self.excess_of(i, density.whole);
                    let levelling = stiffness * held * (2.0 * excess - held);
                    let pressure = 0.5 * (density.whole + density.of_others + levelling);
                    sum += weight(i) * pressure + repulsion.energy;
                }
                sum
            })
            .collect();
        partial.iter().sum()
    }

    /// [`Forces::acceleration`] with the pressure part times `weight`, that of the levelling too.
    #[inline]
    pub fn weighted_acceleration(&self, i: usize, weight: f64) -> [f64; D] {
        let Some(slot) = self.list.slot_of(i) else {
            return [0.0; D];
        };
        let (density, gradient, RepulsionSum { acceleration, .. }) = &self.sums[slot];
        let Some(level) = self.levelling else {
            return std::array::from_fn(|k| acceleration[k] - weight * gradient[k]);
        };
        let (stiffness, [_, held]) = self.excess_of(i, density.whole);
        let own = 1.0 + stiffness * held;
        let others = self.excess_gradient[slot];
        std::array::from_fn(|k| {
            acceleration[k] - weight * (own * gradient[k] + level.stiffness * others[k])
        })
    }

    /// κ of particle `i` and its [`Levelling::excess`]; zeros where it is not levelled.
    #[inline]
    fn excess_of(&self, i: usize, gamma: f64) -> (f64, [f64; 2]) {
        match self.levelling {
            Some(level) if is_levelled(&self.levelled, i) => (level.stiffness, level.excess(gamma)),
            _ => (0.0, [0.0; 2]),
        }
    }

    /// Evaluations so far.
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }

    /// Evaluates once more what an earlier run has evaluated and counted.
    pub(crate) fn evaluate_again(&mut self, particles: &Particles<D>) {
        let spent = (self.neighbor_seconds, self.force_seconds);
        self.evaluate(particles);
        self.evaluations -= 1;
        (self.neighbor_seconds, self.force_seconds) = spent;
    }

    /// Counts as many evaluations, and seconds, as an earlier run.
    pub(crate) fn set_spent(&mut self, evaluations: usize, seconds: (f64, f64)) {
        self.evaluations = evaluations;
        (self.neighbor_seconds, self.force_seconds) = seconds;
    }

    /// Seconds spent on keeping neighbour lists, and on the pair loop.
    pub fn seconds(&self) -> (f64, f64) {
        (self.neighbor_seconds, self.force_seconds)
    }

    /// Work with its kernel, in scene units.
    pub(crate) fn with_kernel<W: WithKernel<D>>(&self, work: W) -> W::Output {
        self.shape.with(self.smoothing_length, work)
    }

    /// The neighbour list of the last evaluation.
    pub fn list(&self) -> &CellList<D> {
        &self.list
    }
}

/// To be evaluated before it is asked anything.
impl<const D: usize> State for Forces<D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.repulsion.save(out)?;
        self.levelling.save(out)?;
        self.reach.save(out)?;
        let built_at = self.built_at.as_deref();
        put_list(built_at.unwrap_or(self.list.reference()), out)?;
        self.evaluations.save(out)?;
        self.neighbor_seconds.save(out)?;
        self.force_seconds.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.repulsion.load(from)?;
        self.levelling.load(from)?;
        self.reach.load(from)?;
        let places = Vec::take(from)?;
        if !all_finite(&places) {
            return Err(Damaged);
        }
        self.targets_changed();
        self.built_at = (!places.is_empty()).then_some(places);
        self.evaluations.load(from)?;
        self.neighbor_seconds.load(from)?;
        self.force_seconds.load(from)
    }
}

/// The pair sums of a list. Not of [`Forces`], which may lend out its sums besides.
fn sums_of<'a, const D: usize>(
    shape: Shape,
    length: f64,
    list: &'a CellList<D>,
    gathered: &'a Gathered,
    level: Level,
) -> PackingSums<'a> {
    PackingSums {
        shape,
        length,
        blocks: list.blocks(),
        gathered,
        level,
    }
}

/// The first D coordinates.
#[inline]
fn first<const D: usize>(of: [f64; 3]) -> [f64; D] {
    std::array::from_fn(|k| of[k])
}

impl Value for Repulsion {
    const LEAST: usize = <[f64; 4]>::LEAST;

    fn put(&self, out: &mut dyn Write) -> io::Result<()> {
        self.parameters().put(out)
    }

    fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
        <[f64; 4]>::take(from).map(Self::of)
    }
}

#[inline]
fn is_levelled(levelled: &[bool], i: usize) -> bool {
    levelled.is_empty() || levelled[i]
}

/// Σ f over the values in blocks of fixed size: the same bits for any number of threads.
pub(crate) fn blocked_sum<T: Sync>(values: &[T], f: impl Fn(&T) -> f64 + Sync) -> f64 {
    let partial: Vec<f64> = values
        .par_chunks(REDUCTION_BLOCK)
        .map(|block| block.iter().map(&f).sum())
        .collect();
    partial.iter().sum()
}

/// The largest f(i) for `i` in `0..n`, in parallel; 0 for none. NaN is passed on, so that nothing hides it.
pub(crate) fn largest(n: usize, f: impl Fn(usize) -> f64 + Sync + Send) -> f64 {
    (0..n)
        .into_par_iter()
        .with_min_len(REDUCTION_BLOCK)
        .map(f)
        .reduce(|| 0.0, |a, b| if b > a || b.is_nan() { b } else { a })
}
