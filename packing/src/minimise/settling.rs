//! From any start to rest: the schedule that methods share.

use std::io::{self, Write};

use super::{Energy, Minimiser, MinimiserKind, Potential, Step};
use crate::forces::Levelling;
use crate::packed::StopReason;
use crate::problem::PackingError;
use crate::run_log::{Begin, RunLog};
use crate::state::{Damaged, State, Value, values};
use sphpack_kernels::KernelKind;
use sphpack_pairs::Repulsion;

/// How particles are left.
///
/// The pressure alone would pull some pairs together wherever the lattice has a defect, and a repulsion that holds them
/// apart is itself a residual: by its energy evenness and consistency cannot both be had. So the method balanced makes
/// the sums of squares of both small themselves, from an even packing on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Finish {
    /// A weak repulsion stays on, which keeps pairs 0.9 ∆s apart, and the density is levelled. Some 10⁻³ of residual
    /// are the price.
    #[default]
    Even,
    /// Free particles end where the background pressure's own forces vanish (zero-order consistency), down its energy. Pairs
    /// may come as near as 0.7 ∆s.
    Consistent,
    /// So do they here, but by Newton's way from an even packing, with pairs 0.86 ∆s apart: for small sets, by the method
    /// balanced. Others take this for [`Finish::Consistent`].
    Calm,
    /// Density and kernel gradient sum are both made small, as [`Settling::balance`] weighs them, by the method balanced.
    /// Others take this for [`Finish::Even`].
    Both,
}

impl Finish {
    /// The tolerance of the largest force times h that is worth waiting for.
    pub fn default_tolerance(self) -> f64 {
        match self {
            Self::Even => 1e-3,
            Self::Consistent => 1e-5,
            Self::Calm => 1e-6,
            Self::Both => 6e-4,
        }
    }
}

/// Brings particles to rest: under a strong repulsion first, which sorts out the worst and spreads surface particles
/// along their surface, then as the finish asks, with surface particles held where they are.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Settling {
    /// The minimiser.
    pub minimiser: MinimiserKind,
    /// How particles are left.
    pub finish: Finish,
    /// Stop when the largest force that is being minimised, times h, is below this; `None` is the finish's default.
    pub residual_tolerance: Option<f64>,
    /// Give up after this many evaluations, counted from where settling begins.
    pub max_evaluations: usize,
    /// Evaluations under the strong repulsion, at most, times the minimiser's [`MinimiserKind::pace`].
    pub early_evaluations: usize,
    /// C of k_r = C ∆s p_b: at first (Negi & Ramachandran's), and at the end of an even finish.
    pub repulsion: [f64; 2],
    /// κ of the [`Levelling`] at the end of an even finish; 0 is none. A consistent finish has none: a pressure that
    /// differs from place to place is a residual.
    pub levelling: f64,
    /// Its [leeway](Levelling::leeway).
    pub leeway: f64,
    /// What the finish [`Finish::Both`] weighs more: 0 is the kernel gradient sum alone, 1 the density alone.
    pub balance: f64,
}

impl Default for Settling {
    fn default() -> Self {
        Self {
            minimiser: MinimiserKind::default(),
            finish: Finish::default(),
            residual_tolerance: None,
            max_evaluations: 20_000,
            early_evaluations: 60,
            repulsion: [Repulsion::STRENGTH, 0.001],
            levelling: Self::LEVELLING,
            leeway: 0.0,
            balance: 0.5,
        }
    }
}

/// Where repulsion begins at a consistent end, in ∆s: it keeps pairs from falling into one another, which they do in
/// 3-D without, and touches hardly any pair in 2-D.
const CONSISTENT_REACH: f64 = 0.7;

/// The strong repulsion has done its work where the largest force is below this part of the tolerance.
const EARLY_END: f64 = 0.3;

/// Evaluations between two lines of the history.
const NOTE_EVERY: usize = 10;

/// Nothing goes on any more where within [`PATIENCE`] evaluations the largest force has found no new low and the
/// energy per particle has fallen by less than [`STANDSTILL`] times that force (or 10⁻³, if it is smaller). Where room is short
/// a few particles with large forces creep for ever, while the energy falls by less and less.
const PATIENCE: usize = 200;
const STANDSTILL: f64 = 1e-5;
const SMALL_FORCE: f64 = 1e-3;

/// Nor where the largest force has not halved within so many evaluations: what comes to rest at all does within some
/// hundred by L-BFGS, and within five times as many by the slowest minimiser.
const LONG_PATIENCE: usize = 1500;

impl Settling {
    /// The levelling that pays with the quintic spline.
    const LEVELLING: f64 = 10.0;

    /// The levelling that pays with a kernel at an h/∆s, in so many dimensions: 10 from 1.2 on, less below, as the fourth power. With a
    /// shorter kernel every neighbour counts for more, and evenness costs more evaluations and larger forces left over.
    ///
    /// In space more with Wendland's kernels, which are pointed: docs/steady.md has what that leaves and takes beside what ten does. Where they
    /// are too short for the lattice, more makes it worse, so it falls off steeply.
    pub fn levelling_at(dimension: usize, kernel: KernelKind, h_over_spacing: f64) -> f64 {
        let at_least = Self::LEVELLING * (h_over_spacing / 1.2).min(1.0).powi(4);
        let (most, from) = match (dimension, kernel) {
            (3, KernelKind::WendlandC2) => (60.0, 1.2),
            (3, KernelKind::WendlandC4) => (200.0, 1.4),
            (3, KernelKind::WendlandC6) => (200.0, 1.6),
            _ => return at_least,
        };
        at_least.max(most * (h_over_spacing / from).min(1.0).powi(12))
    }

    /// The tolerance, the finish's default filled in.
    pub fn tolerance(&self) -> f64 {
        self.residual_tolerance
            .unwrap_or_else(|| self.finish.default_tolerance())
    }

    /// The repulsion to begin with.
    pub fn early_repulsion(&self, spacing: f64) -> Repulsion {
        Repulsion::new(spacing, self.repulsion[0])
    }

    fn last_repulsion(&self, spacing: f64) -> Repulsion {
        match self.finish {
            Finish::Even | Finish::Both => {
                Repulsion::with_reach(spacing, self.repulsion[1], Repulsion::REACH_OVER_SPACING)
            }
            Finish::Consistent | Finish::Calm => {
                Repulsion::with_reach(spacing, self.repulsion[0], CONSISTENT_REACH)
            }
        }
    }

    /// The levelling at the end, towards Γ₀ = `perfect_gamma`.
    pub(crate) fn last_levelling(&self, perfect_gamma: f64) -> Option<Levelling> {
        match self.finish {
            Finish::Even | Finish::Both => {
                Levelling::new(self.levelling, perfect_gamma).map(|level| Levelling {
                    leeway: self.leeway,
                    ..level
                })
            }
            Finish::Consistent | Finish::Calm => None,
        }
    }

    /// How particles of this spacing come to rest on a lattice whose undisturbed Γ is `perfect_gamma`: the stages, in
    /// order.
    pub(crate) fn schedule(&self, spacing: f64, perfect_gamma: f64) -> [SettlingStage; 2] {
        [
            SettlingStage {
                repulsion: self.early_repulsion(spacing),
                levelling: None,
                is_surface_held: false,
                most: self.early_evaluations * self.minimiser.pace(),
            },
            SettlingStage {
                repulsion: self.last_repulsion(spacing),
                levelling: self.last_levelling(perfect_gamma),
                is_surface_held: true,
                most: self.max_evaluations,
            },
        ]
    }

    /// Settles the energy's particles, stage by stage; what has been through some of them before leaves them out. Fails
    /// only where it is to go on from a damaged state.
    pub(crate) fn run<const D: usize>(
        &self,
        energy: &mut Energy<'_, D>,
        log: &mut RunLog<'_>,
        stages: &[SettlingStage],
    ) -> Result<StopReason, PackingError> {
        let mut descent = Descent {
            energy,
            minimiser: self.minimiser.build::<D>(),
            stage: 0,
            noted: 0,
            progress: Standstill::from(0),
        };
        let mut begin = descent.energy.evaluations();
        // Iterations with other evaluators.
        let mut earlier = log.progress.evaluation.saturating_sub(begin);
        let tolerance = self.tolerance();
        if log.go_on(&mut [&mut descent, &mut begin, &mut earlier])? == Begin::Anew {
            stages[0].enter(descent.energy);
            descent.energy.value();
            if !stages[0].is_surface_held {
                // Where surface particles slide they have been put onto it first: that evaluation is not settling's.
                begin = descent.energy.evaluations();
            }
            descent.progress = Standstill::from(begin);
        }
        let reason = loop {
            if log.is_to_stop(&[&descent, &begin, &earlier]) {
                break StopReason::Interrupted;
            }
            let Descent {
                energy,
                minimiser,
                stage,
                noted,
                progress,
            } = &mut descent;
            if energy.evaluations().saturating_sub(begin) >= self.max_evaluations {
                break StopReason::IterationLimit;
            }
            if energy.take_changed() {
                minimiser.reset();
            }
            let step = minimiser.step(*energy);
            let residual = energy.residual();
            let evaluations = energy.evaluations();
            log.progress.evaluation = earlier + evaluations;
            log.progress.criterion = residual;
            log.tell();
            if evaluations >= *noted + NOTE_EVERY {
                *noted = evaluations;
                let (forces, particles) = energy.evaluated();
                log.note(forces, particles);
            }
            if let Some(next) = stages.get(*stage + 1) {
                let over = evaluations - begin >= stages[*stage].most;
                let settled = residual < EARLY_END * tolerance;
                if over || settled || step == Step::Stuck {
                    *stage += 1;
                    next.enter(energy);
                    *progress = Standstill::from(evaluations);
                    progress.energy_then = energy.value();
                }
                continue;
            }
            if residual < tolerance {
                break StopReason::Converged;
            }
            if step == Step::Stuck || progress.has_come(energy) {
                break StopReason::Stagnated;
            }
        };
        let energy = descent.energy;
        let (forces, particles) = energy.evaluated();
        log.note(forces, particles);
        log.seconds.projection += energy.projection_seconds();
        Ok(reason)
    }
}

/// One energy on the way to rest.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SettlingStage {
    repulsion: Repulsion,
    levelling: Option<Levelling>,
    /// Whether boundary particles stay where they are, else they slide along their surface.
    is_surface_held: bool,
    /// Evaluations until the next stage, at most.
    most: usize,
}

impl SettlingStage {
    fn enter<const D: usize>(&self, energy: &mut Energy<'_, D>) {
        if self.is_surface_held {
            energy.hold_surface();
        }
        energy.set_levelling(self.levelling);
        energy.set_repulsion(self.repulsion);
    }
}

/// Since when nothing goes on any more.
#[derive(Debug, Clone, Copy)]
struct Standstill {
    /// The largest force's lowest, the energy then, and at which evaluation.
    lowest: f64,
    energy_then: f64,
    lowest_at: usize,
    /// Where the largest force was half of what it was before.
    halved: f64,
    halved_at: usize,
}

values!(Standstill {
    lowest: f64,
    energy_then: f64,
    lowest_at: usize,
    halved: f64,
    halved_at: usize,
});

impl Standstill {
    fn from(evaluation: usize) -> Self {
        Self {
            lowest: f64::INFINITY,
            energy_then: f64::INFINITY,
            lowest_at: evaluation,
            halved: f64::INFINITY,
            halved_at: evaluation,
        }
    }

    /// Takes a step in: whether nothing goes on any more.
    fn has_come<const D: usize>(&mut self, energy: &mut Energy<'_, D>) -> bool {
        let (residual, value) = (energy.residual(), energy.value());
        let (count, evaluations) = (energy.len() as f64, energy.evaluations());
        if residual < 0.5 * self.halved {
            (self.halved, self.halved_at) = (residual, evaluations);
        } else if evaluations > self.halved_at + LONG_PATIENCE {
            return true;
        }
        if residual < self.lowest {
            (self.lowest, self.lowest_at, self.energy_then) = (residual, evaluations, value);
        } else if evaluations > self.lowest_at + PATIENCE {
            let little = STANDSTILL * self.lowest.max(SMALL_FORCE) * count;
            if self.energy_then - value < little {
                return true;
            }
            (self.lowest_at, self.energy_then) = (evaluations, value);
        }
        false
    }
}

/// A minimiser on its way down an energy.
struct Descent<'s, 'l, const D: usize> {
    energy: &'s mut Energy<'l, D>,
    minimiser: Box<dyn Minimiser<D>>,
    /// The stage that it is in.
    stage: usize,
    /// The evaluation at which the history got its last line.
    noted: usize,
    progress: Standstill,
}

impl<const D: usize> State for Descent<'_, '_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.energy.save(out)?;
        self.minimiser.save(out)?;
        (self.stage, self.noted, self.progress).save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.energy.load(from)?;
        self.minimiser.load(from, self.energy.len())?;
        (self.stage, self.noted, self.progress) = Value::take(from)?;
        Ok(())
    }
}
