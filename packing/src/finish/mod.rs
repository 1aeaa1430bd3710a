//! The last stage of a packing: density and kernel gradient sum themselves, not an energy of which they are the forces.
//!
//! An energy's places of rest are where background pressure pulls pairs together until it finds none left to pull; those of
//! the sum of squares [`Objective`] keep them apart, and density and consistency come down together (docs/balanced.md has
//! the figures).

mod close_pairs;
mod linearised;
mod marquardt;
mod objective;
mod resting;
#[cfg(test)]
mod tests;

use std::io::{self, Write};

use crate::minimise::Movable;
use crate::packed::{ParticleSurface, StopReason};
use crate::particles::Particles;
use crate::problem::{PackingError, Problem};
use crate::run_log::{Begin, RunLog};
use crate::state::{Damaged, State, Value};
use marquardt::Marquardt;
use objective::{Figures, Objective};
use resting::{Rested, Resting};

/// What a finish is to come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Goal {
    /// α and β of the [`Objective`].
    pub(crate) weights: [f64; 2],
    /// It has come there where the largest |Γ − Γ₀| and the largest h|∇Γ| are below these.
    pub(crate) level: f64,
    pub(crate) calm: f64,
    /// Steps at most.
    pub(crate) steps: usize,
    /// Whether by [`Resting`], else by [`Marquardt`].
    pub(crate) rests: bool,
}

/// Pairs are close below this, in ∆s, and how strongly they are kept apart. A stiffer wall stops the steps at it (1 instead
/// of 0.01, cylinder, ∆s = 0.1: no step goes down any more after eight), a softer one lets pairs come to 0.86.
/// Where a place of rest is looked for it is less, as a wall that many pairs lie at makes that way long (cylinder, ∆s = 0.05: 45
/// steps at 0.88, 22 at 0.86).
const LEAST_OVER_SPACING: f64 = 0.88;
const LEAST_AT_REST: f64 = 0.86;
const STIFFNESS: f64 = 0.01;

/// How much more the largest residual counts than the smallest.
const EMPHASIS: f64 = 30.0;

/// By how much evenness may count more, or less, from one step to the next, so that both goals are met together.
const SHIFT: f64 = 1.5;

/// Nothing goes on where a step takes off less than this part of F.
const LITTLE: f64 = 0.02;

/// Nor at rest where a step leaves more than this part of the largest |Γ − Γ₀|.
const EVENER: f64 = 0.98;

/// The particles of a finish.
pub(crate) struct Set<'a, const D: usize> {
    /// What is not to move is frozen.
    pub(crate) particles: &'a mut Particles<D>,
    /// Frozen ones whose kernel gradient sum counts.
    pub(crate) rim: &'a [usize],
    pub(crate) surfaces: &'a [ParticleSurface<D>],
}

/// Takes the particles of an even packing to a goal, or as near as steps take them. `max_evaluations` is that of the
/// whole packing, pair sums counted as evaluations.
pub(crate) fn run<const D: usize>(
    problem: &Problem<D>,
    set: Set<'_, D>,
    goal: Goal,
    max_evaluations: usize,
    log: &mut RunLog<'_>,
) -> Result<StopReason, PackingError> {
    let mut movable = Movable::new(
        set.particles,
        set.surfaces,
        problem.domain,
        problem.support(),
    );
    movable.keep_sides(&problem.bodies, &problem.domain);
    let least = if goal.rests {
        LEAST_AT_REST
    } else {
        LEAST_OVER_SPACING
    } * problem.spacing();
    let objective = Objective::new(problem, movable, set.rim, goal.weights, (least, STIFFNESS));
    let mut course = Course {
        resting: Resting::of(&objective),
        objective,
        marquardt: Marquardt::new(),
        steps: 0,
        level: f64::INFINITY,
        begin: log.progress.evaluation,
        sums: 0,
    };
    if log.go_on(&mut [&mut course])? == Begin::Anew {
        course.objective.evaluate();
        course.sums = 1;
    }
    let reason = loop {
        if log.is_to_stop(&[&course]) {
            break StopReason::Interrupted;
        }
        let Figures { level, calm } = course.objective.figures();
        log.progress.evaluation = course.begin + course.sums;
        log.progress.criterion = calm;
        log.progress.tolerance = goal.calm;
        log.tell();
        log.note(&course.objective.forces, course.objective.movable.particles);
        // At rest nothing gets much evener any more.
        let is_level = level <= goal.level || (goal.rests && level > EVENER * course.level);
        if is_level && calm <= goal.calm {
            break StopReason::Converged;
        }
        course.level = level;
        if course.steps >= goal.steps {
            // What makes both small comes as far as it comes.
            break if goal.rests {
                StopReason::Stagnated
            } else {
                StopReason::Converged
            };
        }
        if log.progress.evaluation >= max_evaluations {
            break StopReason::IterationLimit;
        }
        if goal.rests {
            let (rested, sums) = (course.resting).step(&mut course.objective, problem.spacing());
            course.sums += sums;
            course.steps += 1;
            if rested == Rested::Stuck {
                course.steps = goal.steps;
            }
            continue;
        }
        course.objective.emphasise(EMPHASIS);
        let behind = (level / goal.level) / (calm / goal.calm);
        course.objective.weights[0] *= behind.clamp(1.0 / SHIFT, SHIFT);
        let before = course.objective.value();
        let (went_down, sums) = (course.marquardt).step(&mut course.objective, problem.spacing());
        course.steps += 1;
        course.sums += sums;
        if !went_down || before - course.objective.value() < LITTLE * before {
            course.steps = goal.steps;
        }
    };
    log.seconds.projection += course.objective.movable.seconds;
    let forces = &course.objective.forces;
    log.count(forces);
    // A sum over the pairs is an evaluation, whatever it sums.
    log.earlier_evaluations += course.sums.saturating_sub(forces.evaluations());
    Ok(reason)
}

/// A finish on its way.
struct Course<'a, const D: usize> {
    objective: Objective<'a, D>,
    marquardt: Marquardt<D>,
    resting: Resting,
    steps: usize,
    /// The largest |Γ − Γ₀| before the last step.
    level: f64,
    /// Evaluations before it began.
    begin: usize,
    /// Pair sums since.
    sums: usize,
}

impl<const D: usize> State for Course<'_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.objective.movable.save(out)?;
        self.objective.forces.save(out)?;
        self.objective.emphasis.save(out)?;
        self.objective.weights.save(out)?;
        self.marquardt.damping.save(out)?;
        self.resting.farthest.save(out)?;
        (self.steps, self.level, self.begin, self.sums).save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        let count = self.objective.emphasis.len();
        let mobile = self.objective.movable.mobile.clone();
        self.objective.movable.load(from)?;
        self.objective.forces.load(from)?;
        self.objective.emphasis.load(from)?;
        self.objective.weights.load(from)?;
        self.marquardt.damping.load(from)?;
        self.resting.farthest.load(from)?;
        (self.steps, self.level, self.begin, self.sums) = Value::take(from)?;
        let movable = &self.objective.movable;
        let is_same = movable.particles.len() == count && movable.mobile == mobile;
        if self.objective.emphasis.len() != count || !is_same {
            return Err(Damaged);
        }
        self.objective.evaluate_again();
        Ok(())
    }
}
