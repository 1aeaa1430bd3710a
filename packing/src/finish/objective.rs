//! The sum of squares that a finish minimises.

use rayon::prelude::*;
use sphpack_neighbors::point;
use sphpack_pairs::Repulsion;

use super::close_pairs::{Approaching, ClosePairs};
use crate::forces::{Forces, largest};
use crate::minimise::Movable;
use crate::particles::Kind;
use crate::problem::Problem;

/// F = ½ Σ_i V_i [α e_i (Γ_i − Γ₀)² + β e'_i |h ∇Γ_i|²] / ∆s^D + that of [close pairs](ClosePairs), over the positions of
/// what moves, surface particles along their surfaces. Γ counts for all that is judged, ∇Γ for free particles and those
/// just beyond the band, on whose lattice nothing else would keep it small. e and e' are [emphases](Objective::emphasise).
///
/// Products with its Gauss–Newton matrix take two pair sums each ([`sphpack_pairs::Variation`]); no matrix is kept.
#[derive(Debug)]
pub(super) struct Objective<'a, const D: usize> {
    pub(super) movable: Movable<'a, D>,
    pub(super) forces: Forces<D>,
    perfect_gamma: f64,
    /// α and β.
    pub(super) weights: [f64; 2],
    /// Who has a density, and a kernel gradient sum, that counts.
    is_level: Vec<bool>,
    is_calm: Vec<bool>,
    /// e and e', per particle.
    pub(super) emphasis: Vec<[f64; 2]>,
    /// The number of each particle among the mobile ones.
    place: Vec<Option<u32>>,
    close: ClosePairs<D>,
    /// ∆s^D.
    unit: f64,
    /// The fields of a pair sum, a column each.
    columns: Vec<Vec<f64>>,
}

/// Where the objective stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Figures {
    /// The largest |Γ − Γ₀|.
    pub(super) level: f64,
    /// The largest h|∇Γ|.
    pub(super) calm: f64,
}

impl<'a, const D: usize> Objective<'a, D> {
    /// Around where the particles are. `rim` are frozen ones whose kernel gradient sum counts; pairs are close below `least`
    /// (scene units).
    pub(super) fn new(
        problem: &Problem<D>,
        movable: Movable<'a, D>,
        rim: &[usize],
        weights: [f64; 2],
        (least, stiffness): (f64, f64),
    ) -> Self {
        let kind = &movable.particles.kind;
        let mut is_level: Vec<bool> = kind.iter().map(|&kind| kind != Kind::Frozen).collect();
        let mut is_calm: Vec<bool> = kind.iter().map(|&kind| kind == Kind::Free).collect();
        for &i in rim {
            (is_level[i], is_calm[i]) = (true, true);
        }
        let mut place = vec![None; kind.len()];
        for (number, &i) in (0_u32..).zip(&movable.mobile) {
            place[i as usize] = Some(number);
        }
        Self {
            forces: Forces::of(problem, Repulsion::none()),
            perfect_gamma: problem.perfect_gamma(),
            weights,
            emphasis: vec![[1.0; 2]; kind.len()],
            place,
            close: ClosePairs::new(&problem.domain, least, stiffness),
            unit: problem.spacing().powi(D as i32),
            columns: vec![Vec::new(); D + 1],
            is_level,
            is_calm,
            movable,
        }
    }

    /// Sums up where the particles are: needed after they have moved.
    pub(super) fn evaluate(&mut self) {
        let particles = &*self.movable.particles;
        let (position, volume) = (&particles.position, &particles.volume);
        self.forces
            .evaluate_plain(position, volume, |i| self.is_level[i]);
        self.close.find(position, &self.movable.mobile, &self.place);
    }

    /// [`Objective::evaluate`] where an earlier run has evaluated and counted.
    pub(super) fn evaluate_again(&mut self) {
        let (evaluations, spent) = (self.forces.evaluations(), self.forces.seconds());
        self.evaluate();
        self.forces.set_spent(evaluations, spent);
    }

    /// Γ − Γ₀ and h ∇Γ of a particle, zero where they do not count.
    fn residual(&self, i: usize) -> (f64, [f64; D]) {
        let level = if self.is_level[i] {
            self.excess(i)
        } else {
            0.0
        };
        let calm = if self.is_calm[i] {
            point::scale(self.forces.gradient(i), self.forces.smoothing_length())
        } else {
            [0.0; D]
        };
        (level, calm)
    }

    /// The particles whose density counts.
    pub(super) fn judged(&self) -> impl Iterator<Item = usize> {
        (0..self.is_level.len()).filter(|&i| self.is_level[i])
    }

    /// Γ − Γ₀ of a particle.
    pub(super) fn excess(&self, i: usize) -> f64 {
        self.forces.gamma(i) - self.perfect_gamma
    }

    /// The number of each particle among the mobile ones.
    pub(super) fn places(&self) -> &[Option<u32>] {
        &self.place
    }

    /// The distance of the closest pair, or below which length pairs are close, if none is.
    pub(super) fn closest(&self) -> f64 {
        self.close.closest()
    }

    /// Pairs that are close, or come to be with the step `p`; and below which length they are.
    pub(super) fn approaching(&self, p: &[[f64; D]]) -> (Vec<Approaching<D>>, f64) {
        let (position, mobile) = (&self.movable.particles.position, &self.movable.mobile);
        let found = self.close.approaching(position, mobile, &self.place, p);
        (found, self.close.least())
    }

    /// F.
    pub(super) fn value(&self) -> f64 {
        let volume = &self.movable.particles.volume;
        let of_one = |i: usize| {
            let (level, calm) = self.residual(i);
            let [own, others] = self.emphasis[i];
            let [alpha, beta] = self.weights;
            let squares = alpha * own * level * level + beta * others * point::dot(calm, calm);
            0.5 * volume[i] / self.unit * squares
        };
        let each: Vec<f64> = (0..volume.len())
            .into_par_iter()
            .with_min_len(4096)
            .map(of_one)
            .collect();
        each.iter().sum::<f64>() + self.close.energy()
    }

    pub(super) fn figures(&self) -> Figures {
        let count = self.is_level.len();
        Figures {
            level: largest(count, |i| self.residual(i).0.abs()),
            calm: largest(count, |i| point::norm(self.residual(i).1)),
        }
    }

    /// Makes what is large count more: e ← ½ e + ½ (1 + `most` (r/max r)²), so that the largest residuals go down and not
    /// only their mean square.
    pub(super) fn emphasise(&mut self, most: f64) {
        let Figures { level, calm } = self.figures();
        let part = |r: f64, greatest: f64| {
            if greatest > 0.0 {
                (r / greatest).powi(2)
            } else {
                0.0
            }
        };
        let mut emphasis = std::mem::take(&mut self.emphasis);
        for (i, [own, others]) in emphasis.iter_mut().enumerate() {
            let (r, g) = self.residual(i);
            *own = 0.5 * *own + 0.5 * (1.0 + most * part(r, level));
            *others = 0.5 * *others + 0.5 * (1.0 + most * part(point::norm(g), calm));
        }
        self.emphasis = emphasis;
    }

    /// −∇F of what moves, as far as it can go there, and the directions of what is held against that.
    pub(super) fn descent(&mut self, out: &mut Vec<[f64; D]>) -> Vec<(usize, [f64; D])> {
        let h = self.forces.smoothing_length();
        let of_one = |i: usize| {
            let (level, calm) = self.residual(i);
            (level, point::scale(calm, 1.0 / h))
        };
        let residuals: Vec<_> = (0..self.is_level.len()).map(of_one).collect();
        self.transpose(&residuals, -1.0, out);
        self.close.add_descent(out);
        self.movable.make_tangential(out);
        let mut held = Vec::new();
        for (place, away) in self.movable.held() {
            if point::dot(out[place], away) < 0.0 {
                out[place] = point::reject(out[place], away);
                held.push((place, away));
            }
        }
        held
    }

    /// The Gauss–Newton matrix of F times `p`, along what `held` leaves.
    pub(super) fn product(
        &mut self,
        p: &[[f64; D]],
        held: &[(usize, [f64; D])],
        out: &mut Vec<[f64; D]>,
    ) {
        for (k, column) in self.columns.iter_mut().enumerate() {
            column.clear();
            let of = |place: &Option<u32>| match (k, place) {
                (1.., Some(place)) => p[*place as usize][k - 1],
                _ => 0.0,
            };
            column.extend(self.place.iter().map(of));
        }
        self.forces.vary(&self.columns);
        let changes: Vec<_> = (0..self.is_level.len())
            .map(|i| self.forces.variation(i))
            .collect();
        self.transpose(&changes, 1.0, out);
        self.close.add_product(p, out);
        self.restrict(out, held);
    }

    /// Leaves of `v` what goes along the surfaces, and against nothing that is held.
    pub(super) fn restrict(&self, v: &mut [[f64; D]], held: &[(usize, [f64; D])]) {
        self.movable.make_tangential(v);
        for &(place, away) in held {
            v[place] = point::reject(v[place], away);
        }
    }

    /// `sign` times the derivative of ½ Σ weights · (Γ, ∇Γ)² where these are `values`, by the positions of what moves.
    fn transpose(&mut self, values: &[(f64, [f64; D])], sign: f64, out: &mut Vec<[f64; D]>) {
        let h = self.forces.smoothing_length();
        let [alpha, beta] = self.weights.map(|weight| weight / self.unit);
        let beta = beta * h * h;
        for (k, column) in self.columns.iter_mut().enumerate() {
            column.clear();
            let emphasis = &self.emphasis;
            let counted = (self.is_level.iter()).zip(&self.is_calm);
            column.extend(values.iter().zip(emphasis).zip(counted).map(
                |((&(level, calm), [own, others]), (&is_level, &is_calm))| match k {
                    0 if is_level => alpha * own * level,
                    1.. if is_calm => beta * others * calm[k - 1],
                    _ => 0.0,
                },
            ));
        }
        self.forces.vary(&self.columns);
        let volume = &self.movable.particles.volume;
        let of_one = |&i: &u32| {
            let (_, by_position) = self.forces.variation(i as usize);
            point::scale(by_position, sign * volume[i as usize])
        };
        (self
            .movable
            .mobile
            .par_iter()
            .with_min_len(1024)
            .map(of_one))
        .collect_into_vec(out);
    }
}
