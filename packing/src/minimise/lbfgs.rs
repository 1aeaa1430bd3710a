//! L-BFGS with a backtracking line search.

use std::collections::VecDeque;

use super::{Landscape, Minimiser, Step, vectors};
use sphpack_neighbors::point;

/// Limited-memory BFGS (Nocedal & Wright, Numerical Optimization, algorithm 7.4). Steps are capped, their directions
/// tangential to the surfaces, and none is accepted that raises the energy beyond its rounding.
#[derive(Debug, Clone)]
pub struct Lbfgs<const D: usize> {
    /// Pairs of steps and gradient changes that are remembered.
    pub memory: usize,
    /// No particle moves farther than this in one step, in ∆s.
    pub step_over_spacing: f64,
    pairs: VecDeque<Pair<D>>,
    place: Vec<[f64; D]>,
    force: Vec<[f64; D]>,
    direction: Vec<[f64; D]>,
}

/// How one step changed the gradient.
#[derive(Debug, Clone)]
struct Pair<const D: usize> {
    step: Vec<[f64; D]>,
    change: Vec<[f64; D]>,
    /// step · change, positive.
    curvature: f64,
}

/// The Armijo condition: this part of the decrease that the slope promises must come true.
const SUFFICIENT: f64 = 1e-4;

/// Line search trials until the memory is dropped, and then until the step is given up.
const TRIALS: usize = 8;

/// A pair teaches nothing where step · change is below this part of |step| |change|.
const FLAT: f64 = 1e-8;

/// The first step, before anything is known: the force times this, over h². A tenth of what the stiffest mode allows.
const FIRST_OVER_H2: f64 = 0.25;

/// Energies that differ by less than this part are equal: their sums are rounded.
const ROUNDING: f64 = 1e-14;

impl<const D: usize> Default for Lbfgs<D> {
    fn default() -> Self {
        Self {
            memory: 8,
            step_over_spacing: 0.2,
            pairs: VecDeque::new(),
            place: Vec::new(),
            force: Vec::new(),
            direction: Vec::new(),
        }
    }
}

impl<const D: usize> Lbfgs<D> {
    /// Algorithm 7.4: the inverse Hessian as remembered, times the force.
    fn find_direction(&mut self, landscape: &Landscape<'_, D>) {
        self.direction.clear();
        self.direction.extend_from_slice(&self.force);
        let mut weights = [0.0; 64];
        for (k, pair) in self.pairs.iter().enumerate().rev() {
            weights[k] = vectors::dot(&pair.step, &self.direction) / pair.curvature;
            vectors::add_scaled(&mut self.direction, -weights[k], &pair.change);
        }
        let scale = match self.pairs.back() {
            Some(last) => last.curvature / vectors::dot(&last.change, &last.change),
            None => FIRST_OVER_H2 * landscape.smoothing_length() * landscape.smoothing_length(),
        };
        vectors::scale(&mut self.direction, scale);
        for (k, pair) in self.pairs.iter().enumerate() {
            let back = vectors::dot(&pair.change, &self.direction) / pair.curvature;
            vectors::add_scaled(&mut self.direction, weights[k] - back, &pair.step);
        }
        landscape.make_tangential(&mut self.direction);
    }

    fn remember(&mut self, landscape: &Landscape<'_, D>) {
        // The oldest pair's memory serves the newest.
        let mut pair = if self.pairs.len() >= self.memory.clamp(1, 64) {
            self.pairs.pop_front()
        } else {
            None
        }
        .unwrap_or_else(|| Pair {
            step: Vec::new(),
            change: Vec::new(),
            curvature: 0.0,
        });
        landscape.places(&mut pair.step);
        vectors::add_scaled(&mut pair.step, -1.0, &self.place);
        pair.change.clear();
        pair.change.extend(
            self.force
                .iter()
                .zip(landscape.force())
                .map(|(&before, &now)| point::sub(before, now)),
        );
        pair.curvature = vectors::dot(&pair.step, &pair.change);
        let size = vectors::dot(&pair.step, &pair.step) * vectors::dot(&pair.change, &pair.change);
        if pair.curvature > FLAT * size.sqrt() {
            self.pairs.push_back(pair);
        }
    }
}

impl<const D: usize> Minimiser<D> for Lbfgs<D> {
    fn step(&mut self, landscape: &mut Landscape<'_, D>) -> Step {
        landscape.places(&mut self.place);
        self.force.clear();
        self.force.extend_from_slice(landscape.force());
        let before = landscape.energy();
        loop {
            self.find_direction(landscape);
            let mut slope = vectors::dot(&self.direction, &self.force);
            let mut longest = vectors::longest(&self.direction);
            if slope.is_nan() || slope <= 0.0 || longest.is_nan() {
                if self.pairs.is_empty() {
                    return Step::Stuck;
                }
                self.pairs.clear();
                continue;
            }
            let limit = self.step_over_spacing * landscape.spacing();
            if longest > limit {
                vectors::scale(&mut self.direction, limit / longest);
                slope *= limit / longest;
                longest = limit;
            }
            let mut part = 1.0;
            for _ in 0..TRIALS {
                landscape.move_to(&self.place, part, &self.direction);
                let rise = landscape.energy() - before;
                let rounding = ROUNDING * before.abs();
                let is_rounding = part * slope <= 10.0 * rounding && rise <= rounding;
                if rise <= -SUFFICIENT * part * slope || is_rounding {
                    self.remember(landscape);
                    return Step::Taken;
                }
                // The lowest point of the parabola through what is known.
                let lowest = 0.5 * slope * part * part / (rise + slope * part);
                part = lowest.clamp(0.1 * part, 0.5 * part);
            }
            if self.pairs.is_empty() || longest <= 0.0 {
                landscape.move_to(&self.place, 0.0, &self.direction);
                return Step::Stuck;
            }
            self.pairs.clear();
        }
    }

    fn reset(&mut self) {
        self.pairs.clear();
    }
}
