//! The hybrid method of paper 001 §3.1: capture the surface, then settle by damped dynamics.

use std::time::Instant;

use rayon::prelude::*;
use sphpack_neighbors::point;

use crate::forces::{Forces, largest};
use crate::observer::{Observer, Phase, Progress, Sample};
use crate::on_surface::{OnSurface, capture};
use crate::packed::{Packed, Seconds, StopReason};
use crate::particles::Kind;
use crate::problem::{PackingError, Problem};
use crate::repulsion::{Repulsion, STRENGTH};
use crate::seeding::{Seeds, fix_corners, particle_surfaces, seed};

/// The hybrid method (001 §3.1, algorithms 1 and 2), with its constants.
///
/// Free particles near the surface become boundary particles, pass after pass, until none is left near it; all move
/// under background pressure, repulsion and damping until the fastest is slow enough. The surface itself takes the
/// place of boundary nodes: projections and distances are exact, and boundary particles stay on the surface at every
/// step (001 projects them only every 50th).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hybrid {
    /// ε: stop when u_max ∆t/h is below this (001 eq. 23).
    pub velocity_tolerance: f64,
    /// Give up after this many iterations.
    pub max_iterations: usize,
    /// Iterations between captures.
    pub projection_frequency: usize,
    /// Capture distances in ∆s: at first, and after [`Hybrid::empty_passes`] passes that found none.
    pub capture_over_spacing: [f64; 2],
    /// Passes without a capture until the second distance holds; one more empty pass ends the capture phase.
    pub empty_passes: usize,
    /// C_ζ of the damping ζ = C_ζ √p_b/∆s; 001 gives 0.2 … 0.5.
    pub damping: f64,
    /// C of the repulsion k_r = C ∆s p_b; 001 gives 0.004 … 0.006.
    pub repulsion: f64,
}

impl Default for Hybrid {
    fn default() -> Self {
        Self {
            velocity_tolerance: 1e-4,
            max_iterations: 20_000,
            projection_frequency: 50,
            capture_over_spacing: [0.5, 0.65],
            empty_passes: 4,
            damping: 0.2,
            repulsion: STRENGTH,
        }
    }
}

impl Hybrid {
    /// Packs the problem.
    ///
    /// # Errors
    /// Those of [`Problem::check`], and [`PackingError::Surface`].
    pub fn pack<const D: usize>(
        &self,
        problem: &Problem<D>,
        observer: &mut dyn Observer,
    ) -> Result<Packed<D>, PackingError> {
        let begin = Instant::now();
        let mut seconds = Seconds::default();
        let mut progress = Progress {
            phase: Phase::Geometry,
            evaluation: 0,
            max_evaluations: self.max_iterations,
            criterion: f64::INFINITY,
            tolerance: self.velocity_tolerance,
            on_surface: 0,
            target: 0,
            seconds: 0.0,
        };
        // ReadInput
        problem.check()?;
        let mut stop_reason = StopReason::IterationLimit;
        let mut interrupted = observer.progress(&progress).is_break();
        let surfaces = particle_surfaces(problem)?;
        progress.target = surfaces.iter().map(|surface| surface.target_count).sum();
        seconds.geometry = begin.elapsed().as_secs_f64();

        // CreateParticles
        progress.phase = Phase::Seeding;
        progress.seconds = begin.elapsed().as_secs_f64();
        interrupted |= observer.progress(&progress).is_break();
        let seeding = Instant::now();
        let Seeds {
            mut particles,
            frozen_lattice,
        } = seed(problem)?;
        fix_corners(&mut particles, &surfaces, problem.spacing);
        seconds.seeding = seeding.elapsed().as_secs_f64();

        // SetConstantAndTimeStep, for p_b = 1
        let (h, spacing) = (problem.smoothing_length(), problem.spacing);
        let zeta = self.damping / spacing;
        let mut forces = Forces::of(problem, Repulsion::new(spacing, self.repulsion));
        let mut velocity = vec![[0.0; D]; particles.len()];
        let mut on_surface = OnSurface::default();
        on_surface.refresh(&particles);
        let mut history = Vec::new();
        let (mut iteration, mut empty_count, mut fastest) = (0, 0, 0.0_f64);
        progress.phase = Phase::Capture;

        while iteration < self.max_iterations && !interrupted {
            // UpdateNeighbors, ComputeAccelerations
            forces.evaluate(&particles);
            // Eq. 25, with last step's velocities.
            let dt = (0.1 * h).min((0.1 * h / (zeta * fastest)).sqrt());

            // IntegrateParticles: eqs. 17 and 19; along the surface for boundary particles (eq. 22).
            let kind = &particles.kind;
            velocity
                .par_iter_mut()
                .zip(&mut particles.position)
                .enumerate()
                .with_min_len(1024)
                .filter(|(i, _)| kind[*i].is_mobile())
                .for_each(|(i, (u, x))| {
                    let a = point::add_scaled(forces.acceleration(i), -zeta, *u);
                    *u = on_surface.tangential(i, point::add_scaled(*u, dt, a));
                    *x = point::add_scaled(*x, dt, *u);
                });
            fastest = largest(velocity.len(), |i| point::norm(velocity[i]));

            // ProjectParticles (algorithm 1); empty passes count in both branches.
            let projecting = Instant::now();
            let is_pass = iteration % self.projection_frequency == 0;
            if is_pass {
                let late = usize::from(empty_count >= self.empty_passes);
                let distance = self.capture_over_spacing[late] * spacing;
                let captured = capture(&mut particles, &surfaces, distance);
                if captured == 0 {
                    empty_count += 1;
                } else {
                    empty_count = if late == 1 { self.empty_passes } else { 0 };
                    on_surface.refresh(&particles);
                }
            }
            on_surface.project(&mut particles, &surfaces, problem.support());
            seconds.projection += projecting.elapsed().as_secs_f64();
            iteration += 1;

            if is_pass {
                // CheckConvergence (eq. 23)
                let settled = empty_count > self.empty_passes;
                progress.phase = if settled {
                    Phase::Settling
                } else {
                    Phase::Capture
                };
                progress.evaluation = iteration;
                progress.criterion = fastest * dt / h;
                progress.on_surface = on_surface.index.len() + particles.count(Kind::Fixed);
                progress.seconds = begin.elapsed().as_secs_f64();
                interrupted |= observer.progress(&progress).is_break();
                history.push(sample(
                    &forces,
                    &particles.kind,
                    h,
                    iteration,
                    progress.seconds,
                ));
                if settled && progress.criterion < self.velocity_tolerance {
                    stop_reason = StopReason::Converged;
                    break;
                }
            }
        }
        if interrupted {
            stop_reason = StopReason::Interrupted;
        }
        if problem.domain.is_periodic() {
            for (x, kind) in particles.position.iter_mut().zip(&particles.kind) {
                if *kind == Kind::Free {
                    *x = problem.domain.wrap(*x);
                }
            }
        }
        (seconds.neighbors, seconds.forces) = forces.seconds();
        seconds.total = begin.elapsed().as_secs_f64();
        Ok(Packed {
            particles,
            domain: problem.domain,
            spacing,
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
            stop_reason,
            iterations: iteration,
            force_evaluations: forces.evaluations(),
            history,
            seconds,
        })
    }
}

/// Figures of the last evaluation.
fn sample<const D: usize>(
    forces: &Forces<D>,
    kind: &[Kind],
    h: f64,
    evaluation: usize,
    seconds: f64,
) -> Sample {
    let of_kind = |i: usize, wanted: bool, value: f64| {
        if wanted && kind[i] != Kind::Frozen {
            value
        } else {
            0.0
        }
    };
    let targets = forces.list().targets().max(1) as f64;
    Sample {
        evaluation,
        energy: forces.energy() / targets,
        residual: h * largest(kind.len(), |i| {
            of_kind(i, kind[i] == Kind::Free, point::norm(forces.gradient(i)))
        }),
        linf: largest(kind.len(), |i| {
            of_kind(i, true, (forces.gamma(i) - 1.0).abs())
        }),
        seconds,
    }
}
