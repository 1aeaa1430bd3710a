//! Pairs that are too close to one another.

use rayon::prelude::*;
use sphpack_neighbors::{CellList, Domain, point};

/// An energy of pairs that are closer than a length d: ½ K (1 − r/d)² each. Where none is, it is nothing: density and
/// kernel gradient sum alone would let some come as near as 0.8 ∆s.
#[derive(Debug)]
pub(super) struct ClosePairs<const D: usize> {
    list: CellList<D>,
    /// d, scene units.
    least: f64,
    stiffness: f64,
    /// The pairs of each mobile particle, from `start` on.
    start: Vec<usize>,
    pairs: Vec<Pair<D>>,
}

/// One side of a close pair.
#[derive(Debug, Clone, Copy)]
struct Pair<const D: usize> {
    /// The other's number among the mobile particles, if it is one.
    other: Option<u32>,
    /// From it to this one, of length one.
    direction: [f64; D],
    /// 1 − r/d.
    lack: f64,
}

/// Pairs up to this are listed, in d, and the skin of the list.
const LISTED: f64 = 1.12;
const SKIN: f64 = 0.1;

/// A pair that a step brings, or leaves, too close: each once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Approaching<const D: usize> {
    /// The numbers of both among the mobile particles; the first is one.
    pub(super) both: [Option<u32>; 2],
    /// From the second to the first, of length one.
    pub(super) direction: [f64; D],
    /// r/d before the step.
    pub(super) distance: f64,
}

impl<const D: usize> ClosePairs<D> {
    pub(super) fn new(domain: &Domain<D>, least: f64, stiffness: f64) -> Self {
        Self {
            list: CellList::new(domain, LISTED * least).with_skin(SKIN * least),
            least,
            stiffness,
            start: Vec::new(),
            pairs: Vec::new(),
        }
    }

    /// Finds the close pairs of particles at `position`, of which `mobile` are mobile; `place` is the number of each among
    /// these.
    pub(super) fn find(&mut self, position: &[[f64; D]], mobile: &[u32], place: &[Option<u32>]) {
        self.list.update_some(position, |i| place[i].is_some());
        let (list, least) = (&self.list, self.least);
        let of_one = |&i: &u32| -> Vec<Pair<D>> {
            (sorted(list, i as usize, position).into_iter())
                // Two in one place have no direction apart.
                .filter(|&(_, r, _)| r < least && r > 0.0)
                .map(|(j, r, apart)| Pair {
                    other: place[j],
                    direction: point::scale(apart, 1.0 / r),
                    lack: 1.0 - r / least,
                })
                .collect()
        };
        let found: Vec<Vec<Pair<D>>> = mobile.par_iter().with_min_len(256).map(of_one).collect();
        self.start.clear();
        self.pairs.clear();
        for of_one in found {
            self.start.push(self.pairs.len());
            self.pairs.extend(of_one);
        }
        self.start.push(self.pairs.len());
    }

    /// The pairs that are closer than d where [`ClosePairs::find`] was called, or come to be with the step `p`.
    pub(super) fn approaching(
        &self,
        position: &[[f64; D]],
        mobile: &[u32],
        place: &[Option<u32>],
        p: &[[f64; D]],
    ) -> Vec<Approaching<D>> {
        let mut found = Vec::new();
        for (own, &i) in (0_u32..).zip(mobile) {
            for (j, r, apart) in sorted(&self.list, i as usize, position) {
                if place[j].is_some_and(|other| other < own) || r == 0.0 {
                    continue;
                }
                let direction = point::scale(apart, 1.0 / r);
                let theirs = place[j].map_or([0.0; D], |other| p[other as usize]);
                let after = r + point::dot(direction, point::sub(p[own as usize], theirs));
                if r.min(after) < self.least {
                    found.push(Approaching {
                        both: [Some(own), place[j]],
                        direction,
                        distance: r / self.least,
                    });
                }
            }
        }
        found
    }

    /// The closest pair's distance, or d.
    pub(super) fn closest(&self) -> f64 {
        let lack = self.pairs.iter().map(|pair| pair.lack).fold(0.0, f64::max);
        (1.0 - lack) * self.least
    }

    /// d, scene units.
    pub(super) fn least(&self) -> f64 {
        self.least
    }

    fn of(&self, place: usize) -> &[Pair<D>] {
        &self.pairs[self.start[place]..self.start[place + 1]]
    }

    pub(super) fn energy(&self) -> f64 {
        let of_one = |pair: &Pair<D>| {
            let share = if pair.other.is_some() { 0.5 } else { 1.0 };
            0.5 * share * self.stiffness * pair.lack * pair.lack
        };
        self.pairs.iter().map(of_one).sum()
    }

    /// Adds −∇ of the energy.
    pub(super) fn add_descent(&self, out: &mut [[f64; D]]) {
        for (place, out) in out.iter_mut().enumerate() {
            for pair in self.of(place) {
                let push = self.stiffness / self.least * pair.lack;
                *out = point::add_scaled(*out, push, pair.direction);
            }
        }
    }

    /// Adds the energy's second derivative, but for what turns pairs, times `p`.
    pub(super) fn add_product(&self, p: &[[f64; D]], out: &mut [[f64; D]]) {
        let stiffness = self.stiffness / (self.least * self.least);
        for (place, out) in out.iter_mut().enumerate() {
            for pair in self.of(place) {
                let theirs = pair.other.map_or([0.0; D], |other| p[other as usize]);
                let nearer = point::dot(pair.direction, point::sub(p[place], theirs));
                *out = point::add_scaled(*out, stiffness * nearer, pair.direction);
            }
        }
    }
}

/// Who is listed around a particle, with distance and separation, in an order that does not depend on when the list was
/// built: sums have the same bits where a run goes on from a state.
fn sorted<const D: usize>(
    list: &CellList<D>,
    i: usize,
    position: &[[f64; D]],
) -> Vec<(usize, f64, [f64; D])> {
    let mut around: Vec<_> = (list.around(i, position))
        .map(|(j, apart)| (j, point::norm(apart), apart))
        .collect();
    around.sort_by(|(i, r, _), (j, s, _)| i.cmp(j).then(r.total_cmp(s)));
    around
}
