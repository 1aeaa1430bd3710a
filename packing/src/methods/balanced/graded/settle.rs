//! From the places of equal mass to rest.

use std::io::{self, Write};

use super::energy::{Aim, GradedEnergy};
use crate::minimise::{Minimiser, Potential, Settling, Step};
use crate::packed::StopReason;
use crate::problem::PackingError;
use crate::run_log::{Begin, RunLog};
use crate::state::{Damaged, State, Value};

/// κ, and the repulsion's C beside it: only their ratio counts.
const STIFFNESS: f64 = 30.0;
const LEVEL_REPULSION: f64 = 4e-4;

/// Evaluations of each stage, at most, times the minimiser's pace: order is won while sizes are frozen. Levelling goes on for as
/// many again as come behind unless the largest |Γ − 1| and its root mean square are below [`EVEN`]: 50 : 1 around a circle asks
/// for them.
const ORDERING: usize = 40;
const LEVELLING: [usize; 2] = [69, 19];
const EVEN: [f64; 2] = [1e-3, 1.5e-4];

/// Evaluations between two lines of the history.
const NOTE_EVERY: usize = 10;

/// The particles are in order, or as level as they get, where the largest force is below this.
const ORDERED: f64 = 3e-4;
const LEVEL: f64 = 1e-5;

/// Orders the particles, and levels their density. Fails only where it is to go on from a damaged state.
pub(super) fn run<const D: usize>(
    energy: &mut GradedEnergy<'_, D>,
    settling: &Settling,
    log: &mut RunLog<'_>,
) -> Result<StopReason, PackingError> {
    let pace = settling.minimiser.pace();
    // What is told of the way: it ends by evaluations.
    log.progress.tolerance = LEVEL;
    log.progress.max_evaluations =
        (settling.max_evaluations).min(pace * (ORDERING + LEVELLING[0] + LEVELLING[1]));
    let mut course = Course {
        energy,
        minimiser: settling.minimiser.build::<D>(),
        is_levelling: false,
        begun: 0,
        noted: 0,
    };
    if log.go_on(&mut [&mut course])? == Begin::Anew {
        course.energy.value();
        course.begun = course.energy.evaluations;
    }
    let reason = loop {
        if log.is_to_stop(&[&course]) {
            break StopReason::Interrupted;
        }
        if course.energy.evaluations >= settling.max_evaluations {
            break StopReason::IterationLimit;
        }
        if course.energy.take_changed() {
            course.minimiser.reset();
        }
        let step = course.minimiser.step(course.energy);
        let residual = course.energy.residual();
        log.progress.evaluation = course.energy.evaluations;
        log.progress.criterion = residual;
        log.tell();
        if course.energy.evaluations >= course.noted + NOTE_EVERY {
            course.note(log);
        }
        let spent = course.energy.evaluations - course.begun;
        if course.is_levelling {
            let [usual, more] = LEVELLING.map(|evaluations| evaluations * pace);
            let is_over = spent >= usual && (spent >= usual + more || course.is_even());
            if is_over || residual < LEVEL || step == Step::Stuck {
                break StopReason::Converged;
            }
        } else if spent >= ORDERING * pace || residual < ORDERED || step == Step::Stuck {
            course.enter_level();
            course.begun = course.energy.evaluations;
        }
    };
    course.note(log);
    Ok(reason)
}

/// Settling on its way.
struct Course<'s, 'e, const D: usize> {
    energy: &'s mut GradedEnergy<'e, D>,
    minimiser: Box<dyn Minimiser<D>>,
    is_levelling: bool,
    /// The evaluation at which the stage began.
    begun: usize,
    /// The evaluation at which the history got its last line.
    noted: usize,
}

impl<const D: usize> Course<'_, '_, D> {
    fn enter_level(&mut self) {
        self.is_levelling = true;
        self.energy.hold_surface();
        let aim = Aim::Level {
            stiffness: STIFFNESS,
        };
        self.energy.pursue(aim, LEVEL_REPULSION);
    }

    fn is_even(&mut self) -> bool {
        let [level, rms, _] = self.energy.figures();
        level < EVEN[0] && rms < EVEN[1]
    }

    fn note(&mut self, log: &mut RunLog<'_>) {
        self.noted = self.energy.evaluations;
        let energy = self.energy.value() / self.energy.len().max(1) as f64;
        let [level, _, calm] = self.energy.figures();
        log.note_figures(energy, calm, level);
    }
}

impl<const D: usize> State for Course<'_, '_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.is_levelling.save(out)?;
        self.energy.save(out)?;
        self.minimiser.save(out)?;
        (self.begun, self.noted).save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        if bool::take(from)? {
            self.enter_level();
        }
        self.energy.load(from)?;
        self.minimiser.load(from, self.energy.len())?;
        (self.begun, self.noted) = Value::take(from)?;
        Ok(())
    }
}
