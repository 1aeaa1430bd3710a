//! The course of a packing, the same for every method: clock, progress, history, and the result at its end.

use std::time::Instant;

use sphpack_neighbors::point;

use crate::forces::{Forces, largest};
use crate::lattice::Filling;
use crate::observer::{Observer, Phase, Progress, Sample};
use crate::packed::{Packed, ParticleSurface, Seconds, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::Problem;
use crate::repulsion::Repulsion;

/// What a method keeps beside its particles.
pub(crate) struct Course<'a> {
    begin: Instant,
    observer: &'a mut dyn Observer,
    history: Vec<Sample>,
    /// Where the time went so far; a method fills in what only it knows.
    pub(crate) seconds: Seconds,
    /// What the observer is told next.
    pub(crate) progress: Progress,
    /// Evaluations that were counted.
    pub(crate) earlier_evaluations: usize,
    /// Whether the observer wants an end.
    pub(crate) interrupted: bool,
}

impl<'a> Course<'a> {
    /// Starts the clock of a method that stops at `tolerance` or after `max_evaluations`.
    pub(crate) fn new(
        observer: &'a mut dyn Observer,
        tolerance: f64,
        max_evaluations: usize,
    ) -> Self {
        Self {
            begin: Instant::now(),
            observer,
            history: Vec::new(),
            seconds: Seconds::default(),
            progress: Progress {
                phase: Phase::Geometry,
                evaluation: 0,
                max_evaluations,
                criterion: f64::INFINITY,
                tolerance,
                on_surface: 0,
                target: 0,
                seconds: 0.0,
            },
            earlier_evaluations: 0,
            interrupted: false,
        }
    }

    /// Tells the observer that a phase begins.
    pub(crate) fn enter(&mut self, phase: Phase) {
        self.progress.phase = phase;
        self.tell();
    }

    /// Tells the observer where `progress` stands.
    pub(crate) fn tell(&mut self) {
        self.progress.seconds = self.begin.elapsed().as_secs_f64();
        self.interrupted |= self.observer.progress(&self.progress).is_break();
    }

    /// Notes the figures of the last evaluation.
    pub(crate) fn note<const D: usize>(&mut self, forces: &Forces<D>, particles: &Particles<D>) {
        self.progress.seconds = self.begin.elapsed().as_secs_f64();
        let kind = &particles.kind;
        let of = |wanted: bool, value: f64| if wanted { value } else { 0.0 };
        self.history.push(Sample {
            evaluation: self.progress.evaluation,
            energy: forces.energy() / forces.list().targets().max(1) as f64,
            residual: forces.smoothing_length()
                * largest(kind.len(), |i| {
                    of(kind[i] == Kind::Free, point::norm(forces.gradient(i)))
                }),
            linf: largest(kind.len(), |i| {
                of(kind[i] != Kind::Frozen, (forces.gamma(i) - 1.0).abs())
            }),
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

    /// The result of a method whose particles stay where they were put, measured once.
    pub(crate) fn end_unmoved<const D: usize>(
        mut self,
        problem: &Problem<D>,
        particles: Particles<D>,
        frozen_lattice: Filling<D>,
        surfaces: Vec<ParticleSurface<D>>,
    ) -> Packed<D> {
        let mut forces = Forces::of(problem, Repulsion::none());
        forces.evaluate(&particles);
        self.progress.evaluation = 1;
        self.note(&forces, &particles);
        self.end(
            problem,
            particles,
            frozen_lattice,
            surfaces,
            &forces,
            StopReason::Converged,
        )
        .with_known_sides()
    }

    /// The result: the clock stops.
    pub(crate) fn end<const D: usize>(
        mut self,
        problem: &Problem<D>,
        mut particles: Particles<D>,
        frozen_lattice: Filling<D>,
        surfaces: Vec<ParticleSurface<D>>,
        forces: &Forces<D>,
        stop_reason: StopReason,
    ) -> Packed<D> {
        if problem.domain.is_periodic() {
            for (x, kind) in particles.position.iter_mut().zip(&particles.kind) {
                if *kind != Kind::Frozen {
                    *x = problem.domain.wrap(*x);
                }
            }
        }
        self.count(forces);
        self.seconds.total = self.begin.elapsed().as_secs_f64();
        Packed {
            particles,
            domain: problem.domain,
            spacing: problem.spacing,
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
            knows_sides: false,
            omitted: Vec::new(),
            stop_reason: if self.interrupted {
                StopReason::Interrupted
            } else {
                stop_reason
            },
            iterations: self.progress.evaluation,
            force_evaluations: self.earlier_evaluations,
            history: self.history,
            seconds: self.seconds,
        }
    }
}
