//! The log of a packing, the same for every method: clock, progress, history, and the result at its end.

use std::fmt;
use std::io::{self, Write};
use std::time::Instant;

use sphpack_neighbors::point;

use crate::forces::{Forces, largest};
use crate::lattice::Filling;
use crate::methods::MethodInfo;
use crate::observer::{HistoryPoint, Keeper, Observer, Progress, Stage};
use crate::packed::{Packed, ParticleSurface, Seconds, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::state::{Damaged, State, Value, values};

/// What a method keeps beside its particles: clock, progress and history, whom to tell, and where an earlier run was. Good
/// for one packing.
///
/// ```
/// use sphpack_packing::{RunLog, Silent};
///
/// let mut nobody = Silent;
/// let log = RunLog::new(&mut nobody);
/// // Balanced::default().pack(&problem, &mut log)
/// # drop(log);
/// ```
pub struct RunLog<'a> {
    began: Instant,
    method: Option<&'static MethodInfo>,
    observer: &'a mut dyn Observer,
    history: Vec<HistoryPoint>,
    /// Where the time went so far; a method fills in what only it knows.
    pub(crate) seconds: Seconds,
    /// What the observer is told next.
    pub(crate) progress: Progress,
    /// Evaluations that were counted.
    pub(crate) earlier_evaluations: usize,
    /// Whether the observer wants an end.
    pub(crate) interrupted: bool,
    /// Seconds of the runs that this one goes on from.
    seconds_before: f64,
    /// The state to go on from, and how much of it was taken.
    earlier: Vec<u8>,
    read: usize,
    /// The states of loops that are done, and of loops around the one that runs, in the order in which they began.
    frames: Vec<Vec<u8>>,
    /// Whether a state was asked for after the end was wanted. What comes then is not on the way of a run that goes on.
    is_last_kept: bool,
}

/// Where a loop begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Begin {
    /// At its beginning.
    Anew,
    /// Where an earlier run was in it.
    Within,
    /// At its end: an earlier run was in a later loop, or in one inside.
    Beyond,
}

impl fmt::Debug for RunLog<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RunLog")
            .field("progress", &self.progress)
            .field("seconds", &self.seconds)
            .finish_non_exhaustive()
    }
}

impl<'a> RunLog<'a> {
    /// Starts the clock.
    pub fn new(observer: &'a mut dyn Observer) -> Self {
        let earlier = observer.keeper().and_then(Keeper::earlier);
        Self {
            began: Instant::now(),
            method: None,
            observer,
            history: Vec::new(),
            seconds: Seconds::default(),
            progress: Progress {
                stage: Stage::Geometry,
                evaluation: 0,
                max_evaluations: 0,
                criterion: f64::INFINITY,
                tolerance: 0.0,
                on_surface: 0,
                target: 0,
                seconds: 0.0,
            },
            earlier_evaluations: 0,
            interrupted: false,
            seconds_before: 0.0,
            earlier: earlier.unwrap_or_default(),
            read: 0,
            frames: Vec::new(),
            is_last_kept: false,
        }
    }

    /// A method begins, which will stop at `tolerance` or after `max_evaluations`.
    pub(crate) fn begin(
        &mut self,
        method: &'static MethodInfo,
        tolerance: f64,
        max_evaluations: usize,
    ) {
        self.method = Some(method);
        self.progress.tolerance = tolerance;
        self.progress.max_evaluations = max_evaluations;
    }

    fn seconds_so_far(&self) -> f64 {
        self.seconds_before + self.began.elapsed().as_secs_f64()
    }

    /// At the beginning of a loop: where an earlier run has been in it or beyond, `parts` become as they were there. Of
    /// what this log keeps the rest comes back with the innermost loop.
    pub(crate) fn go_on(&mut self, parts: &mut [&mut dyn State]) -> Result<Begin, PackingError> {
        if self.earlier.is_empty() {
            return Ok(Begin::Anew);
        }
        let mut from = &self.earlier[self.read..];
        let is_innermost = bool::take(&mut from)?;
        for part in parts {
            part.load(&mut from)?;
        }
        if !is_innermost {
            self.read = self.earlier.len() - from.len();
            return Ok(Begin::Beyond);
        }
        self.history.load(&mut from)?;
        self.seconds.load(&mut from)?;
        self.progress.load(&mut from)?;
        self.earlier_evaluations.load(&mut from)?;
        self.seconds_before = self.progress.seconds;
        if !from.is_empty() {
            return Err(Damaged.into());
        }
        self.earlier = Vec::new();
        Ok(Begin::Within)
    }

    /// Before a step, `parts` being all that the loop has come to: whether it is to end, once a state is kept where one
    /// is wanted.
    pub(crate) fn is_to_stop(&mut self, parts: &[&dyn State]) -> bool {
        if !self.is_last_kept && self.observer.keeper().is_some_and(Keeper::is_due) {
            self.keep(parts);
        }
        self.is_last_kept = self.interrupted;
        self.interrupted
    }

    fn keep(&mut self, parts: &[&dyn State]) {
        self.progress.seconds = self.seconds_so_far();
        let frames = &self.frames;
        let own: [&dyn State; 4] = [
            &self.history,
            &self.seconds,
            &self.progress,
            &self.earlier_evaluations,
        ];
        let write = |out: &mut dyn Write| -> io::Result<()> {
            for frame in frames {
                false.put(out)?;
                out.write_all(frame)?;
            }
            true.put(out)?;
            (parts.iter().chain(&own)).try_for_each(|part| part.save(out))
        };
        if let Some(keeper) = self.observer.keeper() {
            keeper.keep(&write);
        }
    }

    /// The first `place` loops stay as they are, the one after them has come to `parts`: it is done, or will be gone on
    /// with from there when what comes now is done.
    pub(crate) fn set_aside(&mut self, place: usize, parts: &[&dyn State]) {
        self.frames.truncate(place);
        if self.observer.keeper().is_some() {
            let mut frame = Vec::new();
            // Memory takes everything.
            let _ = parts.iter().try_for_each(|part| part.save(&mut frame));
            self.frames.push(frame);
        }
    }

    /// Tells the observer that a stage begins.
    pub(crate) fn enter(&mut self, stage: Stage) {
        self.progress.stage = stage;
        self.tell();
    }

    /// Tells the observer where `progress` stands.
    pub(crate) fn tell(&mut self) {
        self.progress.seconds = self.seconds_so_far();
        self.interrupted |= self.observer.progress(&self.progress).is_break();
    }

    /// Notes the figures of the last evaluation.
    pub(crate) fn note<const D: usize>(&mut self, forces: &Forces<D>, particles: &Particles<D>) {
        let kind = &particles.kind;
        let of = |wanted: bool, value: f64| if wanted { value } else { 0.0 };
        let energy = forces.energy() / forces.list().targets().max(1) as f64;
        let residual = forces.smoothing_length()
            * largest(kind.len(), |i| {
                of(kind[i] == Kind::Free, point::norm(forces.gradient(i)))
            });
        let linf = largest(kind.len(), |i| {
            of(kind[i] != Kind::Frozen, (forces.gamma(i) - 1.0).abs())
        });
        self.note_figures(energy, residual, linf);
    }

    /// Notes the energy per particle, the largest h|∇Γ| and the largest |Γ − 1|.
    pub(crate) fn note_figures(&mut self, energy: f64, residual: f64, linf: f64) {
        self.progress.seconds = self.seconds_so_far();
        self.history.push(HistoryPoint {
            evaluation: self.progress.evaluation,
            energy,
            residual,
            linf,
            seconds: self.progress.seconds,
        });
    }

    /// Counts what an evaluator has done, when it is needed no more.
    pub(crate) fn count<const D: usize>(&mut self, forces: &Forces<D>) {
        let (neighbors, pairs) = forces.seconds();
        self.seconds.neighbors += neighbors;
        self.seconds.forces += pairs;
        self.earlier_evaluations += forces.evaluations();
    }

    /// The result, of particles that `forces` settled: the clock stops.
    pub(crate) fn end<const D: usize>(
        &mut self,
        problem: &Problem<D>,
        particles: Particles<D>,
        frozen_lattice: Filling<D>,
        surfaces: Vec<ParticleSurface<D>>,
        forces: &Forces<D>,
        stop_reason: StopReason,
    ) -> Packed<D> {
        self.count(forces);
        self.end_counted(problem, particles, frozen_lattice, surfaces, stop_reason)
    }

    /// The result where all evaluations are counted: the clock stops.
    pub(crate) fn end_counted<const D: usize>(
        &mut self,
        problem: &Problem<D>,
        mut particles: Particles<D>,
        frozen_lattice: Filling<D>,
        surfaces: Vec<ParticleSurface<D>>,
        stop_reason: StopReason,
    ) -> Packed<D> {
        if problem.domain.is_periodic() {
            for (x, kind) in particles.position.iter_mut().zip(&particles.kind) {
                if *kind != Kind::Frozen {
                    *x = problem.domain.wrap(*x);
                }
            }
        }
        let projecting = Instant::now();
        let on_surface = ParticleSurface::seats(&surfaces, &particles);
        self.seconds.projection += projecting.elapsed().as_secs_f64();
        self.seconds.total = self.seconds_so_far();
        let Seconds {
            geometry,
            seeding,
            neighbors,
            forces,
            projection,
            minimiser: _,
            total,
        } = self.seconds;
        let booked = geometry + seeding + neighbors + forces + projection;
        self.seconds.minimiser = (total - booked).max(0.0);
        Packed {
            particles,
            problem: problem.clone(),
            method: self.method.unwrap_or(&MethodInfo::USUAL),
            domain: problem.domain,
            spacing: problem.spacing(),
            lattice: problem.chosen_lattice(),
            frozen_lattice,
            kernel: problem.kernel,
            h_over_spacing: problem.h_over_spacing,
            bodies: problem
                .bodies
                .iter()
                .map(|body| body.name.clone())
                .collect(),
            surfaces,
            on_surface,
            knows_sides: false,
            omitted: Vec::new(),
            excess: Vec::new(),
            stop_reason: if self.interrupted {
                StopReason::Interrupted
            } else {
                stop_reason
            },
            iterations: self.progress.evaluation,
            force_evaluations: self.earlier_evaluations,
            history: std::mem::take(&mut self.history),
            seconds: self.seconds,
        }
    }
}

values!(HistoryPoint {
    evaluation: usize,
    energy: f64,
    residual: f64,
    linf: f64,
    seconds: f64
});

values!(Seconds {
    geometry: f64,
    seeding: f64,
    neighbors: f64,
    forces: f64,
    projection: f64,
    minimiser: f64,
    total: f64,
});

values!(Progress {
    stage: Stage,
    evaluation: usize,
    max_evaluations: usize,
    criterion: f64,
    tolerance: f64,
    on_surface: usize,
    target: usize,
    seconds: f64,
});

impl Value for Stage {
    const LEAST: usize = 1;

    fn put(&self, out: &mut dyn Write) -> io::Result<()> {
        (*self as u8).put(out)
    }

    fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
        let all = [Self::Geometry, Self::Seeding, Self::Capture, Self::Settling];
        let place = usize::from(u8::take(from)?);
        all.get(place).copied().ok_or(Damaged)
    }
}
