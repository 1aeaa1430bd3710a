//! The hybrid method of Negi & Ramachandran (2021), §3.1: capture the surface, then settle by damped dynamics.

use std::time::Instant;

use super::accelerations::{hold, predict};
use super::captured::Captured;
use super::motion::Motion;
use crate::forces::Forces;
use crate::methods::info::MethodInfo;
use crate::minimise::{Energy, Settling};
use crate::observer::Stage;
use crate::on_surface::{OnSurface, capture};
use crate::packed::{Packed, StopReason};
use crate::particles::Kind;
use crate::problem::{PackingError, Problem};
use crate::run_log::{Begin, RunLog};
use crate::seeding::{Seeds, fix_corners, seed};
use sphpack_pairs::Repulsion;

/// The hybrid method (Negi & Ramachandran 2021, §3.1, algorithms 1 and 2), with its constants.
///
/// Free particles near the surface become boundary particles, pass after pass, until none is left near it; all move
/// under background pressure, repulsion and damping until the fastest is slow enough. The surface itself takes the
/// place of boundary nodes: projections and distances are exact, and boundary particles stay on the surface at every
/// step (Negi & Ramachandran (2021) project them only every 50th).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hybrid {
    /// ε: stop when u_max ∆t/h is below this (Negi & Ramachandran 2021, eq. 23).
    pub velocity_tolerance: f64,
    /// Give up after this many iterations.
    pub max_iterations: usize,
    /// Iterations between captures.
    pub projection_frequency: usize,
    /// Capture distances in ∆s: at first, and after [`Hybrid::empty_passes`] passes that found none.
    pub capture_over_spacing: [f64; 2],
    /// Passes without a capture until the second distance holds; one more empty pass ends the capture phase.
    pub empty_passes: usize,
    /// C_ζ of the damping ζ = C_ζ √p_b/∆s; Negi & Ramachandran (2021) give 0.2 … 0.5.
    pub damping: f64,
    /// C of the repulsion k_r = C ∆s p_b; Negi & Ramachandran (2021) give 0.004 … 0.006.
    pub repulsion: f64,
    /// The time step, as a multiple of theirs (eq. 25). `docs/stability.md` has what lattices bear: some ten times as much. Close
    /// pairs, which repulsion holds apart, bear less.
    pub time_step: f64,
    /// What takes over where the capture phase ends; `None` goes on damping, as Negi & Ramachandran (2021) do.
    pub settling: Option<Settling>,
    /// The first of Negi & Ramachandran (2021), §3.1.9: the part of N_s that becomes boundary particles at the start,
    /// those nearest to the surface; the first capture follows one interval later. Negi & Ramachandran (2021) have
    /// 0.9; 0 leaves it out.
    pub predicted: f64,
    /// The second: free particles farther than this from every surface, in ∆s, stay on their lattice and are not
    /// evaluated. Infinite leaves it out.
    pub moving_over_spacing: f64,
    /// The third: after the capture phase, each capture follows the last by this factor more iterations; 1 leaves it
    /// out. (The fourth is a larger [`Hybrid::velocity_tolerance`].)
    pub projection_growth: f64,
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
            repulsion: Repulsion::STRENGTH,
            time_step: 1.0,
            settling: None,
            predicted: 0.0,
            moving_over_spacing: f64::INFINITY,
            projection_growth: 1.0,
        }
    }
}

impl Hybrid {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "hybrid",
        summary: "captures the surface, then settles by damped dynamics (Negi & Ramachandran 2021)",
        ..MethodInfo::USUAL
    };

    /// Packs the problem.
    ///
    /// # Errors
    /// Those of [`Problem::check`], and [`PackingError::Surface`].
    pub(crate) fn pack_in<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
    ) -> Result<Packed<D>, PackingError> {
        log.begin(&Self::INFO, self.velocity_tolerance, self.max_iterations);
        // ReadInput
        let surfaces = log.surfaces(problem)?;

        // CreateParticles
        log.enter(Stage::Seeding);
        let seeding = Instant::now();
        let Seeds {
            mut particles,
            frozen_lattice,
        } = seed(problem)?;
        fix_corners(&mut particles, &surfaces, problem.spacing());
        if self.predicted > 0.0 {
            predict(&mut particles, &surfaces, self.predicted, problem.spacing());
        }
        let reach = self.moving_over_spacing * problem.spacing();
        let unmoved = hold(&mut particles, &surfaces, reach);
        log.seconds.seeding = seeding.elapsed().as_secs_f64();

        // SetConstantAndTimeStep, for p_b = 1
        let (h, spacing) = (problem.smoothing_length(), problem.spacing());
        let zeta = self.damping / spacing;
        let mut forces = Forces::of(problem, Repulsion::new(spacing, self.repulsion));
        let mut motion = Motion::at_rest(&problem.domain, particles.len());
        let mut on_surface = OnSurface::default();
        on_surface.refresh(&particles);
        on_surface.project(&mut particles, &surfaces, problem.support());
        let interval = self.projection_frequency as f64;
        let next_capture = if self.predicted > 0.0 {
            self.projection_frequency
        } else {
            0
        };
        let mut at = (0, 0, interval, next_capture);
        let mut stop_reason = StopReason::IterationLimit;
        log.progress.stage = Stage::Capture;
        let bodies = surfaces.len();
        let begin = log.go_on(&mut [
            &mut at,
            &mut Captured {
                particles: &mut particles,
                bodies,
            },
            &mut on_surface,
            &mut motion,
            &mut forces,
        ])?;
        let (mut iteration, mut empty_count, mut interval, mut next_capture) = at;
        let mut is_captured = begin == Begin::Beyond;

        while !is_captured && iteration < self.max_iterations {
            if log.is_to_stop(&[
                &(iteration, empty_count, interval, next_capture),
                &Captured {
                    particles: &mut particles,
                    bodies,
                },
                &on_surface,
                &motion,
                &forces,
            ]) {
                break;
            }
            // UpdateNeighbors, ComputeAccelerations
            forces.evaluate(&particles);
            let dt = self.time_step * motion.time_step(h, zeta, 1.0);
            // IntegrateParticles
            motion.advance(&mut particles, &on_surface, dt, zeta, |i| {
                forces.acceleration(i)
            });

            // ProjectParticles (algorithm 1); empty passes count in both branches.
            let projecting = Instant::now();
            let is_pass = iteration % self.projection_frequency == 0;
            if is_pass && iteration >= next_capture {
                let late = usize::from(empty_count >= self.empty_passes);
                let distance = self.capture_over_spacing[late] * spacing;
                let captured = capture(&mut particles, &surfaces, distance);
                if captured == 0 {
                    empty_count += 1;
                } else {
                    empty_count = if late == 1 { self.empty_passes } else { 0 };
                    on_surface.refresh(&particles);
                }
                if empty_count > self.empty_passes {
                    interval *= self.projection_growth;
                }
                next_capture = iteration + interval as usize;
            }
            on_surface.project(&mut particles, &surfaces, problem.support());
            log.seconds.projection += projecting.elapsed().as_secs_f64();
            iteration += 1;

            if is_pass {
                // CheckConvergence (eq. 23)
                let settled = empty_count > self.empty_passes;
                log.progress.stage = if settled {
                    Stage::Settling
                } else {
                    Stage::Capture
                };
                log.progress.evaluation = iteration;
                log.progress.criterion = motion.fastest * dt / h;
                log.progress.on_surface = on_surface.index.len() + particles.count(Kind::Fixed);
                log.tell();
                log.note(&forces, &particles);
                is_captured = settled && self.settling.is_some();
                if is_captured {
                    break;
                }
                if settled && log.progress.criterion < self.velocity_tolerance {
                    stop_reason = StopReason::Converged;
                    break;
                }
            }
        }
        log.progress.evaluation = iteration;
        if let Some(settling) = &self.settling
            && is_captured
            && iteration < self.max_iterations
        {
            log.set_aside(
                0,
                &[
                    &(iteration, empty_count, interval, next_capture),
                    &Captured {
                        particles: &mut particles,
                        bodies,
                    },
                    &on_surface,
                    &motion,
                    &forces,
                ],
            );
            log.progress.tolerance = settling.tolerance();
            let stages = settling.schedule(spacing, problem.perfect_gamma());
            let reach = problem.support();
            let mut energy = Energy::new(&mut particles, &surfaces, forces, reach);
            stop_reason = settling.run(&mut energy, log, &stages)?;
            forces = energy.into_forces();
        }
        for i in unmoved {
            particles.kind[i] = Kind::Free;
        }
        Ok(log.end(
            problem,
            particles,
            frozen_lattice,
            surfaces,
            &forces,
            stop_reason,
        ))
    }
}
