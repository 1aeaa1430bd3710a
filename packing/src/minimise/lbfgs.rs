//! L-BFGS with a backtracking line search.

use std::io::{self, Write};

use super::history::{History, Taken};
use super::{Minimiser, Potential, Step, vectors};
use crate::Damaged;

/// Limited-memory BFGS (Nocedal & Wright, Numerical Optimization, algorithm 7.4). Steps are capped, their directions
/// tangential to the surfaces, and none is accepted that raises the energy beyond its rounding.
#[derive(Debug, Clone)]
pub struct Lbfgs<const D: usize> {
    /// Pairs of steps and gradient changes that are remembered, 16 at most.
    pub memory: usize,
    /// No particle moves farther than this in one step, in ∆s.
    pub step_over_spacing: f64,
    history: History<D>,
    place: Vec<[f64; D]>,
    next: Vec<[f64; D]>,
    force: Vec<[f64; D]>,
    direction: Vec<[f64; D]>,
}

/// The Armijo condition: this part of the decrease that the slope promises must come true.
const SUFFICIENT: f64 = 1e-4;

/// Line search trials until the memory is dropped, and then until the step is given up.
const TRIALS: usize = 8;

/// The first step, before anything is known: the force times this, over h². A tenth of what the stiffest mode allows.
const FIRST_OVER_H2: f64 = 0.25;

/// Energies that differ by less than this part are equal: their sums are rounded.
const ROUNDING: f64 = 1e-14;

impl<const D: usize> Default for Lbfgs<D> {
    fn default() -> Self {
        Self {
            memory: 10,
            step_over_spacing: 0.2,
            history: History::default(),
            place: Vec::new(),
            next: Vec::new(),
            force: Vec::new(),
            direction: Vec::new(),
        }
    }
}

impl<const D: usize> Lbfgs<D> {
    fn find_direction(&mut self, energy: &dyn Potential<D>) {
        let first = FIRST_OVER_H2 * energy.smoothing_length().powi(2);
        self.history
            .direction(&self.force, first, &mut self.direction);
        energy.make_tangential(&mut self.direction);
    }

    fn remember(&mut self, energy: &mut dyn Potential<D>) {
        energy.places(&mut self.next);
        let taken = Taken {
            from: &self.place,
            to: &self.next,
            force_before: &self.force,
            force: energy.force(),
        };
        self.history.remember(taken, self.memory);
    }
}

impl<const D: usize> Minimiser<D> for Lbfgs<D> {
    fn step(&mut self, energy: &mut dyn Potential<D>) -> Step {
        energy.places(&mut self.place);
        self.force.clear();
        self.force.extend_from_slice(energy.force());
        let before = energy.value();
        loop {
            self.find_direction(energy);
            let mut slope = vectors::dot(&self.direction, &self.force);
            let mut longest = energy.longest(&self.direction);
            if slope.is_nan() || slope <= 0.0 || longest.is_nan() {
                if self.history.is_empty() {
                    return Step::Stuck;
                }
                self.history.clear();
                continue;
            }
            let limit = self.step_over_spacing * energy.spacing();
            if longest > limit {
                vectors::scale(&mut self.direction, limit / longest);
                slope *= limit / longest;
                longest = limit;
            }
            let mut part = 1.0;
            for _ in 0..TRIALS {
                energy.move_to(&self.place, part, &self.direction);
                let rise = energy.value() - before;
                let rounding = ROUNDING * before.abs();
                let is_rounding = part * slope <= 10.0 * rounding && rise <= rounding;
                if rise <= -SUFFICIENT * part * slope || is_rounding {
                    self.remember(energy);
                    return Step::Taken;
                }
                // The lowest point of the parabola through what is known.
                let lowest = 0.5 * slope * part * part / (rise + slope * part);
                part = lowest.clamp(0.1 * part, 0.5 * part);
            }
            if self.history.is_empty() || longest <= 0.0 {
                energy.move_to(&self.place, 0.0, &self.direction);
                return Step::Stuck;
            }
            self.history.clear();
        }
    }

    fn reset(&mut self) {
        self.history.clear();
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.history.save(out)
    }

    fn load(&mut self, from: &mut &[u8], count: usize) -> Result<(), Damaged> {
        self.history.load(from, count)
    }
}
