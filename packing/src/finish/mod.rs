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
mod uneven;

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
pub(crate) use uneven::{Uneven, unevenness};

/// What a finish is to come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Goal {
    /// α and β of the [`Objective`].
    pub(crate) weights: [f64; 2],
    /// It has come there where the largest |Γ − Γ₀| and the largest h|∇Γ| are below these.
    pub(crate) level: f64,
    pub(crate) calm: f64,
    /// And no pair of which one moves is nearer than this, in ∆s.
    pub(crate) apart: f64,
    /// Steps at most.
    pub(crate) steps: usize,
    /// What moves.
    pub(crate) among: Among,
}

/// What a finish moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Among {
    /// The band, by [`Marquardt`].
    Band,
    /// All there is, by [`Resting`].
    All,
    /// What is around [`Uneven`] places, by [`Marquardt`].
    Uneven,
}

impl Goal {
    fn rests(&self) -> bool {
        self.among == Among::All
    }

    /// Products of a step of [`Marquardt`]'s, and the part of F that it has to take off.
    fn steps_by<const D: usize>(&self) -> (usize, f64) {
        match self.among {
            Among::Uneven => (UNEVEN_PRODUCTS, UNEVEN_LITTLE),
            _ => (PRODUCTS[usize::from(D == 3)], LITTLE),
        }
    }

    /// Below which distance pairs are close, in ∆s, and how strongly they are kept apart.
    fn wall(&self) -> (f64, f64) {
        match self.among {
            Among::Band => (LEAST_OVER_SPACING, STIFFNESS),
            Among::All => (LEAST_AT_REST, STIFFNESS),
            Among::Uneven => UNEVEN_WALL,
        }
    }
}

/// Pairs are close below this, in ∆s, and how strongly they are kept apart. A stiffer wall stops the steps at it (1 instead
/// of 0.01, cylinder, ∆s = 0.1: no step goes down any more after eight), a softer one lets pairs come to 0.86.
/// Where a place of rest is looked for it is less, as a wall that many pairs lie at makes that way long (cylinder, ∆s = 0.05: 45
/// steps at 0.88, 22 at 0.86).
const LEAST_OVER_SPACING: f64 = 0.88;
const LEAST_AT_REST: f64 = 0.86;
const STIFFNESS: f64 = 0.01;

/// Products of a step, at most, in the plane and in space, where longer steps make single particles worse.
const PRODUCTS: [usize; 2] = [40, 20];

/// The same around what is uneven, where a few pairs count for as much as all densities and steps are short; and what a step has
/// to take off there. Of 24 packings of narrow parts and pockets 11 are even after 12 steps of 40 products each with a wall of 0.05,
/// 13 after 24 of 15 with one of 0.2, for half as many sums. With those a gap of 0.4 ∆s between blocks was 9.3 times worse than
/// even before and 4.2 times after, 1.7 times after 48 steps that go on while they take off 0.003.
const UNEVEN_WALL: (f64, f64) = (0.86, 0.2);
const UNEVEN_PRODUCTS: usize = 15;
const UNEVEN_LITTLE: f64 = 0.003;

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
/// whole packing, pair sums counted as evaluations. Comes back with how much worse than even ([`Uneven`]) they are then.
pub(crate) fn run<const D: usize>(
    problem: &Problem<D>,
    set: Set<'_, D>,
    goal: Goal,
    max_evaluations: usize,
    log: &mut RunLog<'_>,
) -> Result<(StopReason, f64), PackingError> {
    let mut movable = Movable::new(
        set.particles,
        set.surfaces,
        problem.domain,
        problem.support(),
    );
    movable.keep_sides(&problem.bodies, &problem.domain);
    let (least, stiffness) = goal.wall();
    let wall = (least * problem.spacing(), stiffness);
    let objective = Objective::new(problem, movable, set.rim, goal.weights, wall);
    let (products, little) = goal.steps_by::<D>();
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
        (log.progress.criterion, log.progress.tolerance) = if goal.calm.is_finite() {
            (calm, goal.calm)
        } else {
            (level, goal.level)
        };
        log.tell();
        log.note(&course.objective.forces, course.objective.movable.particles);
        // At rest nothing gets much evener any more.
        let is_level = level <= goal.level || (goal.rests() && level > EVENER * course.level);
        let is_apart = course.objective.closest() >= goal.apart * problem.spacing();
        if is_level && calm <= goal.calm && is_apart {
            break StopReason::Converged;
        }
        course.level = level;
        if course.steps >= goal.steps {
            // What makes both small comes as far as it comes.
            break if goal.rests() {
                StopReason::Stagnated
            } else {
                StopReason::Converged
            };
        }
        if log.progress.evaluation >= max_evaluations {
            break StopReason::IterationLimit;
        }
        if goal.rests() {
            let (rested, sums) = (course.resting).step(&mut course.objective, problem.spacing());
            course.sums += sums;
            course.steps += 1;
            if rested == Rested::Stuck {
                course.steps = goal.steps;
            }
            continue;
        }
        course.objective.emphasise(EMPHASIS);
        if goal.calm.is_finite() {
            let behind = (level / goal.level) / (calm / goal.calm);
            course.objective.weights[0] *= behind.clamp(1.0 / SHIFT, SHIFT);
        }
        let before = course.objective.value();
        let (went_down, sums) =
            (course.marquardt).step(&mut course.objective, problem.spacing(), products);
        course.steps += 1;
        course.sums += sums;
        if !went_down || before - course.objective.value() < little * before {
            course.steps = goal.steps;
        }
    };
    log.seconds.projection += course.objective.movable.seconds;
    let forces = &course.objective.forces;
    log.count(forces);
    // A sum over the pairs is an evaluation, whatever it sums.
    log.earlier_evaluations += course.sums.saturating_sub(forces.evaluations());
    let apart = course.objective.closest() / problem.spacing();
    Ok((reason, unevenness(course.objective.figures().level, apart)))
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
