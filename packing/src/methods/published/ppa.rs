//! The particle packing algorithm of Bouscasse et al., §III: fluid at rest between walls that never move.

use std::time::Instant;

use rayon::prelude::*;
use sphpack_geometry::{Closest, GeometryError, InsetError, Surface};
use sphpack_neighbors::{KdTree, point};

use super::fluid_side::{around_body, tightest, within_body};
use super::motion::Motion;
use super::put_back::put_back;
use super::watch::Watch;
use crate::estimate::Work;
use crate::forces::Forces;
use crate::methods::info::{CHOOSING, MethodInfo};
use crate::observer::Stage;
use crate::off_bound::off_bound;
use crate::on_surface::OnSurface;
use crate::packed::{Packed, ParticleSurface, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::run_log::RunLog;
use crate::seeding::{Seeds, seed};
use sphpack_pairs::Repulsion;

/// The particle packing algorithm (Bouscasse et al., §III).
///
/// The fluid is the lattice's sites between the walls, with the volume V₀ = V/N each, and follows
/// du/dt = −β ∇Γ − ν u (eq. III.7) with ν = α √β/V₀^(1/d) (III.6) and ∆t = CFL V₀^(1/d)/√β (III.8), β = 1. Walls are
/// fixed particles in layers ∆s/2, 3∆s/2, … behind the true surfaces, as deep as the kernel reaches (the fixed ghost
/// particles of Marrone et al. 2011); what gaps layers leave at corners is filled with lattice sites. They are frozen:
/// part of no figure.
///
/// Not in the paper: particles nearer than 0.7 ∆s repel each other, or those that an acute corner presses together would
/// end at one place.
///
/// A body named in [`Ppa::containers`] holds the fluid inside, any other one keeps it out. The paper states neither
/// kernel nor h/∆s.
#[derive(Debug, Clone, PartialEq)]
pub struct Ppa {
    /// Stop where the mean of ½ u²/β falls below this; Bouscasse et al., §IV reach 10⁻⁸.
    pub energy_tolerance: f64,
    /// Give up after this many iterations; Bouscasse et al. need 2000 to 2500.
    pub max_iterations: usize,
    /// α of III.6; Bouscasse et al. give 10⁻³ … 5·10⁻³. The energy falls as exp(−2 α CFL n) at best, so the upper
    /// end.
    pub damping: f64,
    /// CFL of III.8.
    pub cfl: f64,
    /// For every body, whether the fluid is inside it.
    pub containers: Vec<bool>,
}

impl Default for Ppa {
    fn default() -> Self {
        Self {
            energy_tolerance: 1e-8,
            max_iterations: 20_000,
            damping: 5e-3,
            cfl: 1.0,
            containers: Vec::new(),
        }
    }
}

/// Iterations between two looks at convergence.
const LOOK_EVERY: usize = 50;

/// No fluid particle comes nearer to a wall's surface than this, in ∆s: wall particles alone are no barrier.
const FLOOR: f64 = 0.4;

/// Sites that are put back nearer than this to another one, in ∆s, are left out.
const CROWDED: f64 = 0.5;

/// Particles nearer than this, in ∆s, repel each other. The kernel's own force vanishes at no distance, and pairs that an
/// acute corner presses together would become one; elsewhere nobody comes so near. No stronger than ∆t can follow.
const PAIRED: f64 = 0.7;
const APART: f64 = 0.5 * Repulsion::STRENGTH;

/// How often a particle in a corner is put back from one wall and the other.
const CORNER_ROUNDS: usize = 20;

/// A wall's lattice site this near to a wall particle, in ∆s, is none.
const CLEARANCE: f64 = 0.8;

impl Ppa {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "ppa",
        summary: "fluid at rest between walls that never move, for containers (Bouscasse et al.)",
        fills_bodies: false,
        fills_box: false,
        // 1,800 … 2,550 iterations; fast particles need new lists more often.
        work: Work {
            evaluations: 2200.0,
            times_plain: 1.25,
            bytes: [80.0, 180.0],
            placing: CHOOSING,
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
        log.begin(&Self::INFO, self.energy_tolerance, self.max_iterations);
        log.enter(Stage::Geometry);
        let geometry = Instant::now();
        problem.check_uniform()?;
        // No particle is on a wall: the fluid goes to the true surfaces.
        let surfaces = (problem.bodies.iter())
            .map(|body| ParticleSurface {
                surface: body.surface.clone(),
                target_count: 0,
            })
            .collect();
        log.seconds.geometry = geometry.elapsed().as_secs_f64();
        log.enter(Stage::Seeding);
        let seeding = Instant::now();
        let Seeds {
            particles: lattice,
            frozen_lattice,
        } = seed(problem)?;
        let mut particles = self.fluid_and_walls(problem, &lattice)?;
        log.seconds.seeding = seeding.elapsed().as_secs_f64();

        log.enter(Stage::Settling);
        let size = problem.spacing();
        let viscosity = self.damping / size;
        let dt = self.cfl * size;
        let apart = Repulsion::with_reach(size, APART, PAIRED);
        let mut forces = Forces::of(problem, apart);
        let mut motion = Motion::at_rest(&problem.domain, particles.len());
        let mut on_surface = OnSurface::default();
        on_surface.refresh(&particles);
        let floor = FLOOR * size;
        let mut watch = Watch::new(particles.len());
        let nearest = |p: [f64; D], _| self.wall(problem, p);
        let mut stop_reason = StopReason::IterationLimit;
        let mut first = 1;
        log.go_on(&mut [
            &mut first,
            &mut particles,
            &mut motion,
            &mut watch,
            &mut forces,
        ])?;
        for iteration in first..=self.max_iterations {
            if log.is_to_stop(&[&iteration, &particles, &motion, &watch, &forces]) {
                break;
            }
            forces.evaluate(&particles);
            // III.7, velocities first.
            motion.advance(&mut particles, &on_surface, dt, viscosity, |i| {
                forces.acceleration(i)
            });
            // "Particles are not allowed to escape from the boundaries."
            for (i, _) in watch.near(&particles, floor, &nearest) {
                particles.position[i] = self.off_walls(problem, particles.position[i]);
                motion.stop(i);
            }
            if iteration % LOOK_EVERY == 0 || iteration == self.max_iterations {
                let criterion = motion.mean_kinetic_energy(&particles.kind);
                if log.look(iteration, criterion, &forces, &particles) {
                    stop_reason = StopReason::Converged;
                    break;
                }
            }
        }
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

    /// The nearest place of any wall, its normal out of the fluid, its distance negative within the fluid.
    fn wall<const D: usize>(&self, problem: &Problem<D>, p: [f64; D]) -> Closest<D> {
        let walls = (problem.bodies.iter().enumerate()).map(|(number, body)| {
            let hit = body.surface.closest(p);
            if self.holds_fluid(number) {
                within_body(p, hit)
            } else {
                around_body(p, hit, 0.0)
            }
        });
        tightest(p, walls)
    }

    /// The place as far off the walls as the floor asks, in a corner first from one wall, then from the other.
    fn off_walls<const D: usize>(&self, problem: &Problem<D>, p: [f64; D]) -> [f64; D] {
        let floor = FLOOR * problem.spacing();
        let step = |p| off_bound(p, &self.wall(problem, p), floor);
        problem.domain.clamp(put_back(p, CORNER_ROUNDS, step))
    }

    /// The sites, those too near to the walls put back. Of those that meet then, in an acute corner, the first is kept:
    /// nothing would drive the others apart.
    fn apart_from_walls<const D: usize>(
        &self,
        problem: &Problem<D>,
        sites: &[[f64; D]],
    ) -> Vec<[f64; D]> {
        let at: Vec<[f64; D]> = (sites.par_iter())
            .with_min_len(256)
            .map(|&p| self.off_walls(problem, p))
            .collect();
        let Ok(tree) = KdTree::new(&at) else {
            return at;
        };
        let crowded = CROWDED * problem.spacing();
        let mut is_kept: Vec<bool> = at.iter().zip(sites).map(|(p, site)| p == site).collect();
        for i in 0..at.len() {
            let is_alone = || (tree.within(at[i], crowded).iter()).all(|near| !is_kept[near.index]);
            if !is_kept[i] && is_alone() {
                is_kept[i] = true;
            }
        }
        let kept = at.into_iter().zip(is_kept).filter(|(_, is_kept)| *is_kept);
        kept.map(|(p, _)| p).collect()
    }

    fn holds_fluid(&self, body: usize) -> bool {
        self.containers.get(body).copied().unwrap_or(false)
    }

    /// The lattice's sites in the fluid, each with its share of the fluid's volume, and the walls around it.
    fn fluid_and_walls<const D: usize>(
        &self,
        problem: &Problem<D>,
        lattice: &Particles<D>,
    ) -> Result<Particles<D>, PackingError> {
        let is_fluid = |p: [f64; D]| {
            (problem.bodies.iter().enumerate())
                .all(|(b, body)| body.surface.inside(p) == self.holds_fluid(b))
        };
        let mut particles = Particles::new(problem.sizes());
        let sites = |kind: Kind| {
            (0..lattice.len())
                .filter(move |&i| lattice.kind[i] == kind)
                .map(|i| lattice.position[i])
        };
        let fluid: Vec<[f64; D]> = sites(Kind::Free).filter(|&p| is_fluid(p)).collect();
        for p in self.apart_from_walls(problem, &fluid) {
            particles.push(p, Kind::Free, 0.0, None);
        }
        let volume = self.fluid_volume(problem) / particles.len().max(1) as f64;
        particles.volume.fill(volume);
        let mut walls = self.walls(problem)?;
        walls.retain(|&p| !is_fluid(p));
        let gaps: Vec<[f64; D]> = match KdTree::new(&walls) {
            Ok(tree) if !walls.is_empty() => {
                let clearance = CLEARANCE * problem.spacing();
                let far = |p: [f64; D]| {
                    tree.nearest(p)
                        .is_none_or(|found| found.distance > clearance)
                };
                let is_near = |p: [f64; D]| {
                    let reach = problem.frozen_depth();
                    let within = |body: &crate::Body<D>| body.surface.closest_within(p, reach);
                    problem.bodies.iter().any(|body| within(body).is_some())
                };
                sites(Kind::Free)
                    .filter(|&p| !is_fluid(p) && far(p) && is_near(p))
                    .collect()
            }
            _ => Vec::new(),
        };
        for p in walls.into_iter().chain(gaps) {
            particles.push(p, Kind::Frozen, volume, None);
        }
        if !(0..problem.bodies.len()).any(|body| self.holds_fluid(body)) {
            for p in sites(Kind::Frozen) {
                particles.push(p, Kind::Frozen, volume, None);
            }
        }
        Ok(particles)
    }

    /// The volume of the containers, or of the box, without that of what is in it.
    fn fluid_volume<const D: usize>(&self, problem: &Problem<D>) -> f64 {
        let of = |holds: bool| -> f64 {
            (problem.bodies.iter().enumerate())
                .filter(|(b, _)| self.holds_fluid(*b) == holds)
                .map(|(_, body)| body.surface.volume())
                .sum()
        };
        let around = of(true);
        let all = if around > 0.0 {
            around
        } else {
            problem.domain.bounds.volume()
        };
        all - of(false)
    }

    /// Layers of points behind every surface, seen from the fluid.
    fn walls<const D: usize>(&self, problem: &Problem<D>) -> Result<Vec<[f64; D]>, PackingError> {
        let layers = (problem.frozen_depth() / problem.spacing()).ceil() as usize;
        let mut points = Vec::new();
        for (number, body) in problem.bodies.iter().enumerate() {
            let fail = |source| PackingError::Surface {
                body: body.name.clone(),
                error: source,
            };
            for layer in 0..layers {
                let depth = (layer as f64 + 0.5) * problem.spacing();
                let found = if self.holds_fluid(number) {
                    outside(body.surface.as_ref(), depth, problem.spacing())
                } else {
                    inside(body.surface.as_ref(), depth, problem.spacing())
                };
                match found {
                    Ok(found) => points.extend(found),
                    Err(GeometryError::Inset(InsetError::Vanished { .. })) => break,
                    Err(error) => return Err(fail(error)),
                }
            }
        }
        Ok(points)
    }
}

fn count_on<const D: usize>(measure: f64, spacing: f64) -> usize {
    (measure / spacing.powi(D as i32 - 1)).round().max(1.0) as usize
}

/// A layer within a body.
fn inside<const D: usize>(
    body: &dyn Surface<D>,
    depth: f64,
    spacing: f64,
) -> Result<Vec<[f64; D]>, GeometryError> {
    let layer = body.inset(depth)?;
    let points = layer.sample(count_on::<D>(layer.measure(), spacing))?;
    Ok(points.into_iter().map(|hit| hit.point).collect())
}

/// A layer around a body: even points of its surface moved out along their normals, those that come too near to
/// another part of the surface left out. Corners stay open.
fn outside<const D: usize>(
    body: &dyn Surface<D>,
    depth: f64,
    spacing: f64,
) -> Result<Vec<[f64; D]>, GeometryError> {
    let points = body.sample(count_on::<D>(body.measure(), spacing))?;
    let moved = |hit: Closest<D>| point::add_scaled(hit.point, depth, hit.normal);
    Ok(points
        .into_iter()
        .map(moved)
        .filter(|&p| body.closest(p).distance > 0.99 * depth)
        .collect())
}
