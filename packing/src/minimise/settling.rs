//! From any start to rest: the schedule that methods share.

use std::io::{self, Write};

use super::{Landscape, Minimiser, MinimiserKind, Step};
use crate::course::{Begin, Course};
use crate::forces::Levelling;
use crate::packed::StopReason;
use crate::problem::PackingError;
use crate::state::{Damaged, State};
use sphpack_pairs::Repulsion;

/// How particles are left.
///
/// The pressure alone would pull some pairs together wherever the lattice has a defect, so evenness and consistency
/// cannot both be had: a repulsion that holds pairs apart is itself a residual.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Finish {
    /// A weak repulsion stays on, which keeps pairs 0.9 ∆s apart, and the density is levelled. Some 10⁻³ of residual
    /// are the price.
    #[default]
    Even,
    /// Free particles end where the background pressure's own forces vanish (zero-order consistency). Pairs may come
    /// as near as 0.7 ∆s.
    Consistent,
}

impl Finish {
    /// The tolerance of the largest force times h that is worth waiting for.
    pub fn default_tolerance(self) -> f64 {
        match self {
            Self::Even => 1e-3,
            Self::Consistent => 1e-5,
        }
    }
}

/// Brings particles to rest: under a strong repulsion first, which sorts out the worst and spreads surface particles
/// along their surface, then as the finish asks, with surface particles held where they are.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// C of k_r = C ∆s p_b: at first (001's), and at the end of an even finish.
    pub repulsion: [f64; 2],
    /// κ of the [`Levelling`] at the end of an even finish; 0 is none. A consistent finish has none: a pressure that
    /// differs from place to place is a residual.
    pub levelling: f64,
    /// Its [leeway](Levelling::leeway).
    pub leeway: f64,
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
            levelling: Self::levelling_at(1.2),
            leeway: 0.0,
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
    /// The levelling that pays at an h/∆s: 10 from 1.2 on, less below, as the fourth power. With a shorter kernel every
    /// neighbour counts for more, and evenness costs more evaluations and larger forces left over.
    pub fn levelling_at(h_over_spacing: f64) -> f64 {
        10.0 * (h_over_spacing / 1.2).min(1.0).powi(4)
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
            Finish::Even => {
                Repulsion::with_reach(spacing, self.repulsion[1], Repulsion::REACH_OVER_SPACING)
            }
            Finish::Consistent => {
                Repulsion::with_reach(spacing, self.repulsion[0], CONSISTENT_REACH)
            }
        }
    }

    /// The levelling at the end, towards Γ₀ = `perfect_gamma`.
    pub(crate) fn last_levelling(&self, perfect_gamma: f64) -> Option<Levelling> {
        match self.finish {
            Finish::Even => Levelling::new(self.levelling, perfect_gamma).map(|level| Levelling {
                leeway: self.leeway,
                ..level
            }),
            Finish::Consistent => None,
        }
    }

    fn begin_end<const D: usize>(&self, landscape: &mut Landscape<'_, D>, perfect_gamma: f64) {
        landscape.hold_surface();
        landscape.set_levelling(self.last_levelling(perfect_gamma));
        landscape.set_repulsion(self.last_repulsion(landscape.spacing()));
    }

    /// Settles the landscape's particles; its repulsion should be [`Settling::early_repulsion`]. With `is_again` they
    /// have been through the strong repulsion before. `perfect_gamma` is Γ of the undisturbed lattice. Fails only where
    /// it is to go on from a damaged state.
    pub(crate) fn run<const D: usize>(
        &self,
        landscape: &mut Landscape<'_, D>,
        course: &mut Course<'_>,
        perfect_gamma: f64,
        is_again: bool,
    ) -> Result<StopReason, PackingError> {
        let minimiser = self.minimiser.build::<D>();
        let mut begin = landscape.evaluations();
        // Iterations with other evaluators.
        let mut earlier = course.progress.evaluation.saturating_sub(begin);
        let tolerance = self.tolerance();
        let mut early = !is_again;
        let mut noted = 0;
        let (mut lowest, mut energy_then, mut lowest_at) = (f64::INFINITY, f64::INFINITY, begin);
        let (mut halved, mut halved_at) = (f64::INFINITY, begin);
        let mut descent = Descent {
            landscape,
            minimiser,
        };
        let found = course.go_on(&mut [
            &mut descent,
            &mut begin,
            &mut earlier,
            &mut early,
            &mut noted,
            &mut lowest,
            &mut energy_then,
            &mut lowest_at,
            &mut halved,
            &mut halved_at,
        ])?;
        if found == Begin::Anew && is_again {
            self.begin_end(descent.landscape, perfect_gamma);
        }
        let reason = loop {
            if course.is_to_stop(&[
                &descent,
                &begin,
                &earlier,
                &early,
                &noted,
                &lowest,
                &energy_then,
                &lowest_at,
                &halved,
                &halved_at,
            ]) {
                break StopReason::Interrupted;
            }
            let Descent {
                landscape,
                minimiser,
            } = &mut descent;
            if landscape.evaluations().saturating_sub(begin) >= self.max_evaluations {
                break StopReason::IterationLimit;
            }
            let step = minimiser.step(landscape);
            let evaluations = landscape.evaluations();
            let residual = landscape.residual();
            course.progress.evaluation = earlier + evaluations;
            course.progress.criterion = residual;
            course.tell();
            if evaluations >= noted + NOTE_EVERY {
                noted = evaluations;
                course.note(landscape.forces(), landscape.particles());
            }
            if early {
                let over = evaluations - begin >= self.early_evaluations * self.minimiser.pace();
                let settled = residual < EARLY_END * tolerance;
                if over || settled || step == Step::Stuck {
                    early = false;
                    self.begin_end(landscape, perfect_gamma);
                    minimiser.reset();
                    (lowest, lowest_at) = (f64::INFINITY, evaluations);
                    energy_then = landscape.energy();
                    (halved, halved_at) = (f64::INFINITY, evaluations);
                }
                continue;
            }
            if residual < tolerance {
                break StopReason::Converged;
            }
            if step == Step::Stuck {
                break StopReason::Stagnated;
            }
            if residual < 0.5 * halved {
                (halved, halved_at) = (residual, evaluations);
            } else if evaluations > halved_at + LONG_PATIENCE {
                break StopReason::Stagnated;
            }
            if residual < lowest {
                (lowest, lowest_at, energy_then) = (residual, evaluations, landscape.energy());
            } else if evaluations > lowest_at + PATIENCE {
                let little = STANDSTILL * lowest.max(SMALL_FORCE) * landscape.len() as f64;
                if energy_then - landscape.energy() < little {
                    break StopReason::Stagnated;
                }
                (lowest_at, energy_then) = (evaluations, landscape.energy());
            }
        };
        let landscape = descent.landscape;
        course.note(landscape.forces(), landscape.particles());
        course.seconds.projection += landscape.projection_seconds();
        Ok(reason)
    }
}

/// A minimiser on its landscape.
struct Descent<'s, 'l, const D: usize> {
    landscape: &'s mut Landscape<'l, D>,
    minimiser: Box<dyn Minimiser<D>>,
}

impl<const D: usize> State for Descent<'_, '_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.landscape.save(out)?;
        self.minimiser.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.landscape.load(from)?;
        self.minimiser.load(from, self.landscape.len())
    }
}
