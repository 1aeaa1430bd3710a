//! Where a packing is not even.

use rayon::prelude::*;
use sphpack_neighbors::{CellList, point};

use super::{UNEVEN_PRODUCTS, marquardt};
use crate::forces::Forces;
use crate::particles::{Kind, Particles};
use crate::problem::Problem;
use crate::state::values;

/// Where an energy left particles uneven, and by how much.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Uneven<const D: usize> {
    /// Their places; none where a finish is not worth it.
    pub(crate) places: Vec<[f64; D]>,
    /// How much worse than even the worst of them is.
    pub(crate) worst: f64,
    /// Of how many particles that move.
    moving: usize,
}

values!(Uneven[const D: usize] {
    places: Vec<[f64; D]>,
    worst: f64,
    moving: usize,
});

/// A packing is even where |Γ − Γ₀| is nowhere larger than the first, and no pair of which one moves nearer than the second, in ∆s.
const EVEN: (f64, f64) = (0.005, 0.8);

/// From so much of it on a place counts, and a finish is worth it. Counted from 0.75 on it is nearly all of the band, for a pair is
/// that near everywhere; of 120 packings of blocks, windows and targets 108 are even then, 110 so.
const COUNTED: f64 = 0.95;

/// Its steps may take as much as settling did, and this much anyway: sums over the pairs of a particle. It is a second.
const AS_MUCH: f64 = 1.0;
const FREE: f64 = 1e6;

/// How much worse than even these are: the larger of both over what is asked.
pub(crate) fn unevenness(level: f64, apart_over_spacing: f64) -> f64 {
    (level / EVEN.0).max(EVEN.1 / apart_over_spacing)
}

impl<const D: usize> Uneven<D> {
    /// Of particles that `forces` was evaluated for last.
    pub(crate) fn of(problem: &Problem<D>, particles: &Particles<D>, forces: &Forces<D>) -> Self {
        let spacing = problem.spacing();
        let perfect = problem.perfect_gamma();
        let (position, kind) = (&particles.position, &particles.kind);
        let mut list = CellList::new(&problem.domain, EVEN.1 / COUNTED * spacing);
        list.update(position);
        let of_one = |i: usize| {
            if kind[i] == Kind::Frozen {
                return 0.0;
            }
            let apart = (list.around(i, position))
                .filter(|&(j, _)| kind[i].is_mobile() || kind[j].is_mobile())
                .map(|(_, apart)| point::norm(apart) / spacing)
                .fold(f64::INFINITY, f64::min);
            unevenness((forces.gamma(i) - perfect).abs(), apart)
        };
        let found: Vec<f64> = (0..particles.len())
            .into_par_iter()
            .with_min_len(256)
            .map(of_one)
            .collect();
        Self {
            places: (found.iter().zip(position))
                .filter(|(found, _)| **found > COUNTED)
                .map(|(_, &place)| place)
                .collect(),
            worst: found.iter().copied().fold(0.0, f64::max),
            moving: moving(particles),
        }
    }

    /// How many of so many steps `part` of the particles may take, after as many evaluations of all.
    pub(crate) fn affordable(
        &self,
        steps: usize,
        part: &Particles<D>,
        evaluations: usize,
    ) -> usize {
        let settling = evaluations as f64 * self.moving as f64;
        let step = marquardt::sums(UNEVEN_PRODUCTS) as f64 * moving(part) as f64;
        steps.min(((FREE + AS_MUCH * settling) / step) as usize)
    }
}

fn moving<const D: usize>(particles: &Particles<D>) -> usize {
    (particles.kind.iter())
        .filter(|kind| kind.is_mobile())
        .count()
}
