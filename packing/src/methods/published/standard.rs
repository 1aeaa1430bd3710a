//! The standard method of Negi & Ramachandran (2021), §3.2: a solid of offset layers, and fluid packed around it.

use std::sync::Arc;
use std::time::Instant;

use sphpack_geometry::{Feature, GeometryError, InsetError, LevelInset, Surface};
use sphpack_neighbors::{KdTree, point};

use super::motion::Motion;
use crate::estimate::Work;
use crate::forces::Forces;
use crate::methods::info::MethodInfo;
use crate::observer::Stage;
use crate::on_surface::OnSurface;
use crate::packed::{Packed, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::run_log::RunLog;
use crate::seeding::seed;
use sphpack_pairs::Repulsion;

/// The standard method (Negi & Ramachandran 2021, §3.2, algorithm 3), in the plane only.
///
/// The solid is layers of particles ∆s apart (Marrone et al. 2011): the particle surface, moved inward by ∆s again and
/// again until nothing is left, corners on their bisectors. Its particles never move. The fluid is the lattice's sites
/// outside the true bodies, and settles under background pressure and damping alone (Colagrossi et al. 2012), eq. 26:
/// without repulsion particles may pair. On a curved surface layers ∆s apart hold too few particles, which is what the
/// paper shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standard {
    /// ε: stop when u_max ∆t/h is below this (Negi & Ramachandran 2021, eq. 23).
    pub velocity_tolerance: f64,
    /// Give up after this many iterations.
    pub max_iterations: usize,
    /// C_ζ of the damping ζ = C_ζ √p_b/∆s.
    pub damping: f64,
}

impl Default for Standard {
    fn default() -> Self {
        Self {
            velocity_tolerance: 1e-4,
            max_iterations: 20_000,
            damping: 0.2,
        }
    }
}

/// Where layers of opposite sides meet, a particle this near to an earlier one, in ∆s, is left out.
const CROWDED: f64 = 0.6;

/// Iterations between two looks at convergence.
const LOOK_EVERY: usize = 50;

impl Standard {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "standard",
        summary: "a solid of offset layers, fluid packed around it; 2-D (Negi & Ramachandran 2021)",
        dimensions: &[2],
        fills_box: false,
        // 650 … 1,700 evaluations.
        work: Work {
            evaluations: 1200.0,
            ..Work::PLAIN
        },
        ..MethodInfo::USUAL
    };

    /// Packs the problem.
    ///
    /// # Errors
    /// Those of [`Problem::check`], [`PackingError::Surface`], and [`PackingError::OnlyPlane`] in space.
    pub(crate) fn pack_in<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
    ) -> Result<Packed<D>, PackingError> {
        Self::INFO.check_dimension(D)?;
        log.begin(&Self::INFO, self.velocity_tolerance, self.max_iterations);
        // ReadInput
        let surfaces = log.surfaces(problem)?;

        // CreateParticles
        log.enter(Stage::Seeding);
        let seeding = Instant::now();
        let seeds = seed(problem)?;
        let volume = seeds.frozen_lattice.volume_per_site();
        let (mut particles, kinds) = layers(problem, volume)?;
        seeds.surround(problem, &mut particles);
        log.progress.on_surface = kinds.iter().filter(|kind| kind.is_on_surface()).count();
        log.seconds.seeding = seeding.elapsed().as_secs_f64();

        // SetConstantAndTimeStep, for p_b = 1
        let h = problem.smoothing_length();
        let zeta = self.damping / problem.spacing();
        let mut forces = Forces::of(problem, Repulsion::none());
        let mut motion = Motion::at_rest(&problem.domain, particles.len());
        let mut on_surface = OnSurface::default();
        on_surface.refresh(&particles);
        let mut stop_reason = StopReason::IterationLimit;
        log.enter(Stage::Settling);
        let mut first = 1;
        log.go_on(&mut [&mut first, &mut particles, &mut motion, &mut forces])?;
        for iteration in first..=self.max_iterations {
            if log.is_to_stop(&[&iteration, &particles, &motion, &forces]) {
                break;
            }
            // UpdateNeighbors, ComputeAccelerations (eq. 26), IntegrateParticles (eqs. 17, 19)
            forces.evaluate(&particles);
            let dt = motion.time_step(h, zeta, 1.0);
            motion.advance(&mut particles, &on_surface, dt, zeta, |i| {
                forces.acceleration(i)
            });
            if iteration % LOOK_EVERY == 0 || iteration == self.max_iterations {
                // CheckConvergence (eq. 23)
                let criterion = motion.fastest * dt / h;
                if log.look(iteration, criterion, &forces, &particles) {
                    stop_reason = StopReason::Converged;
                    break;
                }
            }
        }
        particles.kind[..kinds.len()].copy_from_slice(&kinds);
        Ok(log
            .end(
                problem,
                particles,
                seeds.frozen_lattice,
                surfaces,
                &forces,
                stop_reason,
            )
            .with_known_sides())
    }
}

/// The solids' layers, all fixed, and the kinds that they are to have in the end: the first layer is on the particle
/// surface, the others count as free although they never moved.
fn layers<const D: usize>(
    problem: &Problem<D>,
    volume: f64,
) -> Result<(Particles<D>, Vec<Kind>), PackingError> {
    let mut particles = Particles::new(problem.sizes());
    let mut kinds = Vec::new();
    for (body, number) in problem.bodies.iter().zip(0_u16..) {
        let fail = |source| PackingError::Surface {
            body: body.name.clone(),
            error: source,
        };
        let is_taken = |p: [f64; D]| {
            let earlier = &problem.bodies[..usize::from(number)];
            earlier.iter().any(|other| other.surface.inside(p))
        };
        for layer in 0.. {
            let depth = (body.inset_over_spacing + f64::from(layer)) * problem.spacing();
            // By distance: deep polygon offsets of a curve of many points cross themselves everywhere, and take minutes.
            let inset = match layer {
                0 => body.surface.inset(depth),
                _ => LevelInset::new(body.surface.clone(), depth)
                    .map(|inset| Arc::new(inset) as Arc<dyn Surface<D>>),
            };
            let surface = match inset {
                Ok(surface) => surface,
                Err(GeometryError::Inset(InsetError::Vanished { .. })) => break,
                Err(error) => return Err(fail(error)),
            };
            // As many as fit at a distance of ∆s.
            let earlier = KdTree::new(&particles.position).ok();
            let mut own: Vec<[f64; D]> = Vec::new();
            let count = (surface.measure() / problem.spacing()).floor().max(1.0) as usize;
            for hit in surface.sample(count).map_err(fail)? {
                let is_close = |other: [f64; D]| {
                    point::distance(other, hit.point) < CROWDED * problem.spacing()
                };
                let nearest = earlier.as_ref().and_then(|tree| tree.nearest(hit.point));
                let is_crowded = nearest
                    .is_some_and(|found| found.distance < CROWDED * problem.spacing())
                    || own.iter().any(|&other| is_close(other));
                if is_crowded || is_taken(hit.point) {
                    continue;
                }
                own.push(hit.point);
                particles.push(hit.point, Kind::Fixed, volume, Some(number));
                kinds.push(match (layer, hit.feature) {
                    (0, Feature::Smooth) => Kind::Boundary,
                    (0, _) => Kind::Fixed,
                    _ => Kind::Free,
                });
            }
        }
    }
    Ok((particles, kinds))
}
