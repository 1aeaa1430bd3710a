//! Levenberg and Marquardt's steps, by conjugate gradients.

use super::objective::Objective;
use crate::minimise::vectors::{add_scaled, dot, longest};

/// Steps down an [`Objective`] (Levenberg 1944, Marquardt 1963): (JᵀWJ + λ) p = −∇F, solved by a few conjugate gradients
/// without a preconditioner. A diagonal one changed nothing (cylinder, ∆s = 0.1: 280 products, L∞ 0.0476 % with,
/// 0.0474 % without): all particles have about as many neighbours.
#[derive(Debug)]
pub(super) struct Marquardt<const D: usize> {
    /// λ over the largest eigenvalue, about; `None` before the first step.
    pub(super) damping: Option<f64>,
    places: Vec<[f64; D]>,
    rest: Vec<[f64; D]>,
    direction: Vec<[f64; D]>,
    product: Vec<[f64; D]>,
    step: Vec<[f64; D]>,
}

/// λ at first, over the largest eigenvalue.
const FIRST: f64 = 1e-3;
/// What it is multiplied by after a full step, and after one that went up.
const LESS: f64 = 0.3;
const MORE: f64 = 3.0;
/// The part of the first square of the residual at which a step is solved.
const SOLVED: f64 = 1e-6;
/// No particle moves farther in a step, in ∆s.
const FARTHEST: f64 = 0.04;
/// Trials of a step, each 0.4 times as long.
const TRIALS: usize = 6;
const SHORTER: f64 = 0.4;

/// Pair sums that a step of so many products takes, if it goes down at once.
pub(super) fn sums(products: usize) -> usize {
    2 * products + 2
}

impl<const D: usize> Marquardt<D> {
    pub(super) fn new() -> Self {
        Self {
            damping: None,
            places: Vec::new(),
            rest: Vec::new(),
            direction: Vec::new(),
            product: Vec::new(),
            step: Vec::new(),
        }
    }

    /// One step of at most so many products from where the particles are, which must be evaluated: whether F went down, and how
    /// many pair sums it took.
    pub(super) fn step(
        &mut self,
        objective: &mut Objective<'_, D>,
        spacing: f64,
        products: usize,
    ) -> (bool, usize) {
        let before = objective.value();
        let held = objective.descent(&mut self.rest);
        let mut sums = 1;
        self.step.clear();
        self.step.resize(self.rest.len(), [0.0; D]);
        self.direction.clone_from(&self.rest);
        let mut square = dot(&self.rest, &self.rest);
        let first = square;
        for _ in 0..products {
            if square.is_nan() || square <= SOLVED * first {
                break;
            }
            objective.product(&self.direction, &held, &mut self.product);
            sums += 2;
            let own = dot(&self.direction, &self.direction);
            let curvature = dot(&self.direction, &self.product);
            let damping = *(self.damping).get_or_insert(FIRST * curvature / own);
            let along = square / (curvature + damping * own);
            if !along.is_finite() {
                break;
            }
            add_scaled(&mut self.product, damping, &self.direction);
            add_scaled(&mut self.step, along, &self.direction);
            add_scaled(&mut self.rest, -along, &self.product);
            let next = dot(&self.rest, &self.rest);
            let (rest, part) = (&self.rest, next / square);
            for (direction, rest) in self.direction.iter_mut().zip(rest) {
                *direction = std::array::from_fn(|k| rest[k] + part * direction[k]);
            }
            square = next;
        }
        let far = longest(&self.step) / (FARTHEST * spacing);
        let mut part = if far > 1.0 { 1.0 / far } else { 1.0 };
        objective.movable.places(&mut self.places);
        for trial in 0..TRIALS {
            objective.movable.move_to(&self.places, part, &self.step);
            objective.evaluate();
            sums += 1;
            if objective.value() < before {
                if trial == 0 {
                    self.change(LESS);
                }
                return (true, sums);
            }
            part *= SHORTER;
            self.change(MORE);
        }
        objective.movable.move_to(&self.places, 0.0, &self.step);
        objective.evaluate();
        (false, sums + 1)
    }

    fn change(&mut self, factor: f64) {
        self.damping = self.damping.map(|damping| damping * factor);
    }
}
