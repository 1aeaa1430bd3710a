//! The coupled method of Negi & Ramachandran (2021), §3.3: inside and outside packed apart, then together.

use std::time::Instant;

use sphpack_geometry::Closest;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::point;

use super::fluid_side::around_body;
use super::motion::Motion;
use super::watch::Watch;
use crate::estimate::Work;
use crate::forces::Forces;
use crate::lattice::Lattice;
use crate::methods::info::MethodInfo;
use crate::observer::Stage;
use crate::on_surface::OnSurface;
use crate::packed::{Packed, ParticleSurface, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::run_log::RunLog;
use crate::seeding::{Seeds, seed};
use sphpack_pairs::Repulsion;

/// The coupled method (Negi & Ramachandran 2021, §3.3, algorithms 4 and 5, after Jiang et al. 2015), in the plane and
/// in space.
///
/// Inside and outside are packed apart first, each held by its own surface ∆s/2 from the body's, under the symmetric
/// pressure of eq. 27 and the cohesion of eq. 28, which keeps too many particles from being pushed onto the surface;
/// then together, under the pressure alone, the inner surface's particles sliding along it. How many of them there are
/// nobody controls, which is what the paper shows.
///
/// The paper's equations are dimensionally loose and its constants heuristic (γ = 20, p_b = 10, h = ∆s = 0.1). Here
/// p_b = 1 and γ = [`Coupled::cohesion`] · p_b/h, for every scene; the cohesion's R is the kernel's support radius, as
/// in Akinci et al. (2013).
///
/// It depends on the start: from the paper's rectangular lattice more particles end on the surface than from the
/// hexagonal one, and the density varies about twice as much.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coupled {
    /// ε: stop when u_max ∆t/h is below this (Negi & Ramachandran 2021, eq. 23).
    pub velocity_tolerance: f64,
    /// Give up after this many iterations, those of both sides apart included.
    pub max_iterations: usize,
    /// Iterations of the first pass on either side, at most: neither side has more than a third of all.
    pub apart_iterations: usize,
    /// A particle this near to its domain's surface becomes a boundary particle, in ∆s.
    pub capture_over_spacing: f64,
    /// γ h/p_b.
    pub cohesion: f64,
    /// C_ζ of the damping ζ = C_ζ √p_b/∆s.
    pub damping: f64,
}

impl Default for Coupled {
    fn default() -> Self {
        Self {
            velocity_tolerance: 1e-4,
            max_iterations: 30_000,
            apart_iterations: 5000,
            capture_over_spacing: 0.05,
            cohesion: 0.2,
            damping: 0.2,
        }
    }
}

/// Eq. 27 with constant volumes is a background pressure of twice p_b.
const SYMMETRIC: f64 = 2.0;

/// Iterations between two looks at progress and convergence.
const LOOK_EVERY: usize = 50;

impl Coupled {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "coupled",
        summary: "inside and outside packed apart, then together (Negi & Ramachandran 2021)",
        kernel: KernelKind::Cubic,
        h_over_spacing: 1.0,
        lattices: Some([Lattice::Square, Lattice::SimpleCubic]),
        // Twice 5,000 iterations of one side with two sums each, then 2,750 … 20,000 of all with one.
        work: Work {
            evaluations: 20_000.0,
            lists: 2.0,
            ..Work::PLAIN
        },
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

        // CreateParticles, DivideDomain
        log.enter(Stage::Seeding);
        let seeding = Instant::now();
        let Seeds {
            particles: lattice,
            frozen_lattice,
        } = seed(problem)?;
        let [mut inner, mut outer] = divide(problem, &surfaces, &lattice);
        log.seconds.seeding = seeding.elapsed().as_secs_f64();

        log.enter(Stage::Capture);
        if !problem.bodies.is_empty() {
            self.pack_apart(problem, &mut inner, log, 0, &|p, body| {
                surfaces[usize::from(body)].surface.closest(p)
            })?;
            self.pack_apart(problem, &mut outer, log, 1, &|p, _| {
                outer_surface(problem, p)
            })?;
        }

        // Both domains: only the inner surface's particles keep to it.
        for i in 0..outer.len() {
            if outer.kind[i] == Kind::Boundary {
                outer.kind[i] = Kind::Free;
            }
            let kind = outer.kind[i];
            inner.push(outer.position[i], kind, outer.volume[i], None);
        }
        let mut particles = inner;
        log.enter(Stage::Settling);
        let (stop_reason, forces) = self.pack_together(problem, &mut particles, &surfaces, log)?;
        Ok(log
            .end(
                problem,
                particles,
                frozen_lattice,
                surfaces,
                &forces,
                stop_reason,
            )
            .with_known_sides())
    }

    /// Algorithm 4 on one domain, as loop `place` of the log. `nearest` tells the nearest place on its surface, seen from a place of a body's, and
    /// how far beyond it that is (negative within).
    fn pack_apart<const D: usize>(
        &self,
        problem: &Problem<D>,
        particles: &mut Particles<D>,
        log: &mut RunLog<'_>,
        place: usize,
        nearest: &(dyn Fn([f64; D], u16) -> Closest<D> + Sync),
    ) -> Result<(), PackingError> {
        let (h, spacing) = (problem.smoothing_length(), problem.spacing());
        let zeta = self.damping * SYMMETRIC.sqrt() / spacing;
        let cohesion = self.cohesion * problem.support() / h;
        let mut forces = Forces::of(problem, Repulsion::none());
        let mut pull = Forces::of_cohesion(&problem.domain, problem.support(), problem.skin());
        let mut motion = Motion::at_rest(&problem.domain, particles.len());
        let mut on_surface = OnSurface::default();
        on_surface.refresh(particles);
        let mut watch = Watch::new(particles.len());
        let (mut begin, mut first) = (log.progress.evaluation, 1);
        log.go_on(&mut [
            &mut begin,
            &mut first,
            particles,
            &mut on_surface,
            &mut watch,
            &mut motion,
            &mut forces,
            &mut pull,
        ])?;
        let last = self.apart_iterations.min(self.max_iterations / 3);
        for iteration in first..=last {
            if log.is_to_stop(&[
                &begin,
                &iteration,
                particles,
                &on_surface,
                &watch,
                &motion,
                &forces,
                &pull,
            ]) {
                break;
            }
            // UpdateNeighbors, ComputeAccelerations (eqs. 27 and 28)
            forces.evaluate(particles);
            pull.evaluate(particles);
            let dt = motion.time_step(h, zeta, SYMMETRIC);
            // IntegrateParticles
            motion.advance(particles, &on_surface, dt, zeta, |i| {
                let (push, pull) = (forces.gradient(i), pull.gradient(i));
                std::array::from_fn(|k| -SYMMETRIC * push[k] - cohesion * pull[k])
            });
            // ProjectParticles, every iteration
            let projecting = Instant::now();
            let captured = watch.near(particles, self.capture_over_spacing * spacing, nearest);
            if !captured.is_empty() {
                for (i, _) in captured {
                    particles.kind[i] = Kind::Boundary;
                }
                on_surface.refresh(particles);
            }
            on_surface.project_by(particles, |p, body| Some(nearest(p, body)));
            log.seconds.projection += projecting.elapsed().as_secs_f64();
            if iteration % LOOK_EVERY == 0 || iteration == last {
                log.look(
                    begin + iteration,
                    motion.fastest * dt / h,
                    &forces,
                    particles,
                );
            }
        }
        log.set_aside(
            place,
            &[
                &begin,
                &(last + 1),
                particles,
                &on_surface,
                &watch,
                &motion,
                &forces,
                &pull,
            ],
        );
        log.count(&forces);
        log.count(&pull);
        Ok(())
    }

    /// The second pass of algorithm 5.
    fn pack_together<const D: usize>(
        &self,
        problem: &Problem<D>,
        particles: &mut Particles<D>,
        surfaces: &[ParticleSurface<D>],
        log: &mut RunLog<'_>,
    ) -> Result<(StopReason, Forces<D>), PackingError> {
        let h = problem.smoothing_length();
        let zeta = self.damping * SYMMETRIC.sqrt() / problem.spacing();
        let mut forces = Forces::of(problem, Repulsion::none());
        let mut motion = Motion::at_rest(&problem.domain, particles.len());
        let mut on_surface = OnSurface::default();
        on_surface.refresh(particles);
        log.progress.on_surface = on_surface.index.len();
        let (mut begin, mut first) = (log.progress.evaluation, 1);
        log.go_on(&mut [
            &mut begin,
            &mut first,
            particles,
            &mut on_surface,
            &mut motion,
            &mut forces,
        ])?;
        let last = self.max_iterations.saturating_sub(begin);
        for iteration in first..=last {
            if log.is_to_stop(&[&begin, &iteration, particles, &on_surface, &motion, &forces]) {
                break;
            }
            forces.evaluate(particles);
            let dt = motion.time_step(h, zeta, SYMMETRIC);
            motion.advance(particles, &on_surface, dt, zeta, |i| {
                point::scale(forces.gradient(i), -SYMMETRIC)
            });
            on_surface.project(particles, surfaces, problem.support());
            if iteration % LOOK_EVERY == 0 || iteration == last {
                // CheckConvergence (eq. 23)
                let criterion = motion.fastest * dt / h;
                if log.look(begin + iteration, criterion, &forces, particles) {
                    return Ok((StopReason::Converged, forces));
                }
            }
        }
        forces.evaluate(particles);
        Ok((StopReason::IterationLimit, forces))
    }
}

/// The nearest place on the outside's surface, ∆s/2 outside the nearest body; its normal points to the body, out of
/// the outside, and its distance is negative outside.
fn outer_surface<const D: usize>(problem: &Problem<D>, p: [f64; D]) -> Closest<D> {
    let half = 0.5 * problem.spacing();
    let hit = (problem.bodies.iter())
        .map(|body| body.surface.closest(p))
        .min_by(|a, b| a.distance.total_cmp(&b.distance))
        .expect("there is a body");
    around_body(p, hit, half)
}

/// The particles of the inside and of the outside. What lies between a body's two surfaces is moved along the normal by
/// ∆s, inward or outward as it is inside or outside of the body's own surface (Negi & Ramachandran 2021, §3.3).
fn divide<const D: usize>(
    problem: &Problem<D>,
    surfaces: &[ParticleSurface<D>],
    lattice: &Particles<D>,
) -> [Particles<D>; 2] {
    let (mut inner, mut outer) = (
        Particles::new(problem.sizes()),
        Particles::new(problem.sizes()),
    );
    let across = |p: [f64; D], beyond: f64, normal: [f64; D]| {
        let moved = point::add_scaled(p, -problem.spacing(), normal);
        problem.domain.clamp(if beyond > 0.0 { moved } else { p })
    };
    for i in 0..lattice.len() {
        let (p, kind, volume) = (lattice.position[i], lattice.kind[i], lattice.volume[i]);
        let holder = (problem.bodies.iter().zip(0_u16..))
            .find(|(body, _)| kind == Kind::Free && body.surface.inside(p));
        if let Some((body, number)) = holder {
            let held = surfaces[usize::from(number)].surface.closest(p);
            let p = across(p, held.distance, body.surface.closest(p).normal);
            inner.push(p, Kind::Free, volume, Some(number));
        } else if kind == Kind::Free && !problem.bodies.is_empty() {
            let hit = outer_surface(problem, p);
            let p = across(p, hit.distance, hit.normal);
            outer.push(p, Kind::Free, volume, None);
        } else {
            outer.push(p, kind, volume, None);
        }
    }
    [inner, outer]
}

#[cfg(test)]
mod tests {
    use sphpack_geometry::Ball;
    use sphpack_neighbors::Domain;

    use super::*;
    use crate::observer::Silent;

    #[test]
    fn no_more_iterations_than_asked_for_in_all_passes_together() {
        let disc = Ball::new([0.0; 2], 0.5).expect("a disc");
        let problem = Problem::new(Domain::new([-1.0; 2], [1.0; 2]), 0.15).body("disc", disc);
        for most in [1, 7, 160, 1000] {
            let coupled = Coupled {
                velocity_tolerance: 0.0,
                max_iterations: most,
                ..Coupled::default()
            };
            let packed = coupled.pack_in(&problem, &mut RunLog::new(&mut Silent));
            let packed = packed.expect("a sound problem");
            assert_eq!(packed.stop_reason, StopReason::IterationLimit);
            assert_eq!(packed.iterations, most);
            // Two sums in every iteration apart, one of those together, and one at the end.
            let apart = 2 * (most / 3);
            assert_eq!(packed.force_evaluations, most + apart + 1);
        }
    }
}
