//! A neighbour list with what its pair sums read.

use fearless_simd::Level;
use sphpack_kernels::{Kernel, Quintic};
use sphpack_neighbors::{Blocks, CellList, Domain};
use sphpack_pairs::{Gathered, Term, shells};

use crate::parallel::each_row;

/// The skin of the lists over the smoothing length. Fluid moves by some hundredths of it in a step; a thicker skin has fewer
/// new lists and longer ones.
const SKIN: f64 = 0.35;

/// Some particles as targets, all as sources.
#[derive(Debug)]
pub(crate) struct Neighborhood<const D: usize> {
    list: CellList<D>,
    smoothing_length: f64,
    gathered: Gathered,
    /// The particle of every slot.
    particle: Vec<u32>,
    builds: usize,
    level: Level,
}

impl<const D: usize> Neighborhood<D> {
    pub(crate) fn new(domain: &Domain<D>, smoothing_length: f64) -> Self {
        Self::with_skin(domain, smoothing_length, SKIN)
    }

    /// Of particles that stay where they are.
    pub(crate) fn fixed(domain: &Domain<D>, smoothing_length: f64) -> Self {
        Self::with_skin(domain, smoothing_length, 0.0)
    }

    fn with_skin(domain: &Domain<D>, smoothing_length: f64, skin: f64) -> Self {
        const { assert!(D == 2 || D == 3, "particles are in the plane or in space") };
        let (support, shells) = if D == 2 {
            let kernel = Quintic::<2>::new(smoothing_length);
            (kernel.support(), shells(kernel, 0.0))
        } else {
            let kernel = Quintic::<3>::new(smoothing_length);
            (kernel.support(), shells(kernel, 0.0))
        };
        Self {
            list: CellList::new(domain, support)
                .with_skin(skin * smoothing_length)
                .with_shells(shells),
            smoothing_length,
            gathered: Gathered::default(),
            particle: Vec::new(),
            builds: 0,
            level: Level::new(),
        }
    }

    /// How many lists there were, those before an [`Neighborhood::invalidate`] too.
    pub(crate) fn builds(&self) -> usize {
        self.builds
    }

    pub(crate) fn list(&self) -> &CellList<D> {
        &self.list
    }

    /// Makes the next update build anew: particles have changed their numbers.
    pub(crate) fn invalidate(&mut self) {
        self.list.invalidate();
    }

    /// Brings the list up to date, and takes positions and weights. The same particles must be targets every time.
    pub(crate) fn update(
        &mut self,
        positions: &[[f64; D]],
        weights: &[f64],
        is_target: impl Fn(usize) -> bool + Sync,
    ) {
        if self.list.update_some(positions, is_target) {
            self.builds += 1;
            self.particle.clear();
            (self.particle).extend(self.list.sources().map(|(i, _)| i as u32));
        }
        (self.gathered).gather(&self.list, positions, weights, self.smoothing_length);
    }

    /// Takes other weights.
    pub(crate) fn weigh(&mut self, weights: &[f64]) {
        self.gathered.weigh(&self.list, weights);
    }

    /// Takes fields, `stride` numbers each: `fill` writes those of a particle.
    pub(crate) fn fill(&mut self, stride: usize, fill: impl Fn(usize, &mut [f64]) + Sync) {
        let particle = &self.particle;
        each_row(self.gathered.fields_mut(stride), stride, |slot, row| {
            match particle.get(slot) {
                Some(&i) => fill(i as usize, row),
                // Padding.
                None => row.fill(0.0),
            }
        });
    }

    /// Sums over the pairs of every target, slot by slot.
    pub(crate) fn sum<T: Compiled>(&self, term: &T, out: &mut Vec<T::Sum>) {
        out.resize(self.list.targets(), T::Sum::default());
        let sum = if D == 2 { T::in_plane } else { T::in_space };
        sum(
            term,
            self.smoothing_length,
            self.level,
            self.list.blocks(),
            &self.gathered,
            out,
        );
    }

    /// Of what [`Neighborhood::sum`] found, that of a particle; the default for one that is no target.
    pub(crate) fn of<R: Copy + Default>(&self, sums: &[R], particle: usize) -> R {
        let slot = self.list.slot_of(particle);
        slot.map_or_else(R::default, |slot| sums[slot])
    }
}

/// A term whose loops are compiled with this crate: they are long code, and nothing in them depends on who calls.
pub(crate) trait Compiled: Term {
    fn in_plane(
        &self,
        h: f64,
        level: Level,
        blocks: &Blocks,
        gathered: &Gathered,
        out: &mut [Self::Sum],
    );
    fn in_space(
        &self,
        h: f64,
        level: Level,
        blocks: &Blocks,
        gathered: &Gathered,
        out: &mut [Self::Sum],
    );
}

/// Compiles a term's loops.
macro_rules! compiled {
    ($term:ty) => {
        impl $crate::neighborhood::Compiled for $term {
            fn in_plane(
                &self,
                h: f64,
                level: fearless_simd::Level,
                blocks: &sphpack_neighbors::Blocks,
                gathered: &sphpack_pairs::Gathered,
                out: &mut [Self::Sum],
            ) {
                let kernel = sphpack_kernels::Quintic::<2>::new(h);
                sphpack_pairs::walk(level, kernel, self, blocks, gathered, out);
            }

            fn in_space(
                &self,
                h: f64,
                level: fearless_simd::Level,
                blocks: &sphpack_neighbors::Blocks,
                gathered: &sphpack_pairs::Gathered,
                out: &mut [Self::Sum],
            ) {
                let kernel = sphpack_kernels::Quintic::<3>::new(h);
                sphpack_pairs::walk(level, kernel, self, blocks, gathered, out);
            }
        }
    };
}
pub(crate) use compiled;
