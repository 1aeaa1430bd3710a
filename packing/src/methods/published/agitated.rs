//! The agitated method of Negi & Ramachandran (preprint), §2: particles on circles keep the others moving until the
//! surface has its share.

use std::f64::consts::TAU;
use std::time::Instant;

use rayon::prelude::*;
use sphpack_neighbors::{KdTree, place_of, point};

use super::captured::Captured;
use super::motion::Motion;
use crate::estimate::Work;
use crate::forces::{Forces, largest};
use crate::methods::info::MethodInfo;
use crate::observer::Stage;
use crate::on_surface::OnSurface;
use crate::packed::{Packed, ParticleSurface, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::run_log::{Begin, RunLog};
use crate::seeding::{Seeds, seed};
use sphpack_pairs::Repulsion;

mod near;
#[cfg(test)]
mod tests;

use near::{Near, REACH};

/// The agitated method (Negi & Ramachandran preprint, §2).
///
/// Some free particles, on a coarse grid and at least 2 ∆s from every surface, run on circles (2-D, eq. 12) or closed
/// curves on spheres (3-D, eq. 13) of radius ∆s/2 and stir the rest. The free particles nearest to a surface are its
/// boundary particles at the start (§2.2), slow ones within ∆s/10 of it become so, boundary particles farther than ∆s/4
/// become free again (§2.5); when their number has not changed for a revolution, agitators become free particles, and
/// the method ends when the largest error of the density has changed by less than 10⁻³ within one more (eq. 17).
///
/// In the paper p_b = 2000 (d−1) k with k = 1 (eq. 18); here p_b = 1 and times are in units of ∆s/√p_b. Where the paper
/// leaves room:
///
/// - Its revolution of 0.2 s at ∆s = 0.05 is one of 179 units. The curve of eq. 13 takes two of them.
/// - Its largest step, h²/ζ "≈ 10⁻⁴ s" (eq. 16), is no time, and 10⁻⁴ s is another part of the unit for every ∆s: 0.09 at
///   ∆s = 0.05, 0.36 at 0.0125. Here 0.36: the damping of eq. 19 takes 400 units to bring a motion down to 1/e, which is
///   what most of the iterations are for, and eq. 20 keeps steps small for as long as anything moves fast.
/// - "Nearest to the body" at the start has no distance: here ∆s/2 to either side, a layer that holds N_s particles.
/// - Eq. 4 is cut at its zero, r = c, beyond which it would attract; agitators start on their curve (eqs. 12 and 13 begin
///   ∆s/2 off the site).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agitated {
    /// The end: how little the largest error of the density changes within a revolution (eq. 17).
    pub density_tolerance: f64,
    /// Give up after this many iterations.
    pub max_iterations: usize,
    /// The damping ζ in √p_b/∆s (eq. 19).
    pub damping: f64,
    /// k in p_b, times d − 1 (eq. 18).
    pub repulsion: f64,
    /// The time of a revolution, in ∆s/√p_b.
    pub revolution: f64,
    /// The largest time step, in ∆s/√p_b.
    pub largest_step: f64,
    /// What agitators do.
    pub agitators: Agitators,
    /// Revolutions without a change of the number of boundary particles until agitators become free.
    pub steady_revolutions: f64,
    /// The side of the grid's cells, each of which gets an agitator, in ∆s.
    pub grid_over_spacing: f64,
    /// Free particles within this of a surface, in ∆s, are boundary particles at the start.
    pub start_over_spacing: f64,
    /// Distances in ∆s at which free particles become boundary particles later, and these free ones.
    pub conversion_over_spacing: [f64; 2],
}

/// What agitators do until the surface has its share.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Agitators {
    /// They run on their curves.
    #[default]
    Turning,
    /// They stay on their sites: what the curves are for.
    Resting,
    /// There are none.
    None,
}

impl Default for Agitated {
    fn default() -> Self {
        Self {
            density_tolerance: 1e-3,
            max_iterations: 20_000,
            damping: 5e-3,
            repulsion: 1.0 / 2000.0,
            revolution: 179.0,
            largest_step: 0.36,
            agitators: Agitators::Turning,
            steady_revolutions: 1.0,
            grid_over_spacing: 4.0,
            start_over_spacing: 0.5,
            conversion_over_spacing: [0.1, 0.25],
        }
    }
}

/// No particle moves farther than this in a step, in ∆s (eq. 20).
const FARTHEST: f64 = 0.01;

/// Agitators are at least this far from every surface, in ∆s.
const AWAY: f64 = 2.0;

/// The skin of the repulsion's neighbour lists, in ∆s.
const SKIN: f64 = 0.3;

/// Steps between two lines of the history.
const NOTE_EVERY: usize = 50;

impl Agitated {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "agitated",
        summary: "stirred by particles on circles until the surface has its share (Negi & Ramachandran, preprint)",
        // 3,200 … 7,850 iterations, a third of their time the repulsion, whose lists, one for each particle, took 350
        // … 720 bytes in space.
        work: Work {
            evaluations: 4000.0,
            times_plain: 1.5,
            bytes: [220.0, 500.0],
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
        log.begin(&Self::INFO, self.density_tolerance, self.max_iterations);
        let surfaces = log.surfaces(problem)?;
        log.enter(Stage::Seeding);
        let seeding = Instant::now();
        let Seeds {
            mut particles,
            frozen_lattice,
        } = seed(problem)?;
        let mut agitators = match self.agitators {
            Agitators::None => Vec::new(),
            _ => self.chosen(problem, &surfaces, &mut particles),
        };
        log.seconds.seeding = seeding.elapsed().as_secs_f64();

        // All in units of ∆s/√p_b (eqs. 16, 18, 19).
        let size = problem.spacing();
        let period = self.revolution * size;
        let round = self.steady_revolutions * if D == 2 { period } else { 2.0 * period };
        let slow = 0.5 * size * TAU / period;
        let convert_every = (0.1 / (slow * self.largest_step)).ceil().max(1.0) as usize;
        let zeta = self.damping / size;
        let strength = self.repulsion / (D as f64 - 1.0);
        let mut forces = Forces::of(problem, Repulsion::none());
        let mut near = Near::default();
        let mut acceleration = Vec::new();
        let mut motion = Motion::at_rest(&problem.domain, particles.len());
        let mut on_surface = OnSurface::default();
        on_surface.refresh(&particles);
        let mut times = [0.0; 3];
        let (mut is_stirred, mut error_then) = (true, f64::INFINITY);
        let (mut first, bodies) = (0, surfaces.len());
        let mut stop_reason = StopReason::IterationLimit;
        log.enter(Stage::Capture);
        let begin = log.go_on(&mut [
            &mut first,
            &mut times,
            &mut is_stirred,
            &mut error_then,
            &mut Captured {
                particles: &mut particles,
                bodies,
            },
            &mut on_surface,
            &mut motion,
            &mut forces,
            &mut near,
        ])?;
        if begin != Begin::Anew {
            near.find(&particles, &problem.domain, (REACH[1] + SKIN) * size);
            agitators.retain(|_| is_stirred);
        }
        let [mut time, mut changed_at, mut looked_at] = times;
        for iteration in first..self.max_iterations {
            if log.is_to_stop(&[
                &iteration,
                &[time, changed_at, looked_at],
                &is_stirred,
                &error_then,
                &Captured {
                    particles: &mut particles,
                    bodies,
                },
                &on_surface,
                &motion,
                &forces,
                &near,
            ]) {
                break;
            }
            if iteration % convert_every == 0 && is_stirred {
                let is_slow = |i: usize| motion.speed(i) < slow;
                let reach = match iteration {
                    0 => self.start_over_spacing,
                    _ => self.conversion_over_spacing[0],
                };
                if self.convert(problem, &mut particles, &surfaces, &is_slow, reach) {
                    changed_at = time;
                }
                on_surface.refresh(&particles);
                on_surface.project(&mut particles, &surfaces, problem.support());
            }
            // Eqs. 2, 5, 6 and 9
            forces.evaluate(&particles);
            near.update(&particles, &problem.domain, REACH[1] * size, SKIN * size);
            near.accelerations(
                &particles,
                &problem.domain,
                strength,
                size,
                &mut acceleration,
            );
            let farthest = FARTHEST * size;
            let dt = (self.largest_step * size).min(farthest / motion.fastest.max(farthest / size));
            motion.advance(&mut particles, &on_surface, dt, zeta, |i| {
                point::sub(acceleration[i], forces.gradient(i))
            });
            on_surface.project(&mut particles, &surfaces, problem.support());
            time += dt;
            let turning: &[(usize, [f64; D])] = match self.agitators {
                Agitators::Turning => &agitators,
                _ => &[],
            };
            for &(i, site) in turning {
                particles.position[i] = orbit(site, 0.5 * size, TAU * time / period);
            }
            if is_stirred && time - changed_at >= round {
                is_stirred = false;
                for (i, _) in agitators.drain(..) {
                    particles.kind[i] = Kind::Free;
                }
                (looked_at, error_then) = (time, f64::INFINITY);
                log.progress.stage = Stage::Settling;
            }
            let is_last = iteration + 1 == self.max_iterations;
            if (iteration + 1) % NOTE_EVERY == 0 || is_last {
                let error = largest(particles.len(), |i| match particles.kind[i] {
                    Kind::Frozen => 0.0,
                    _ => (forces.gamma(i) - 1.0).abs(),
                });
                log.progress.evaluation = iteration + 1;
                log.progress.on_surface = on_surface.index.len();
                log.note(&forces, &particles);
                if !is_stirred && time - looked_at >= period {
                    // Eq. 17
                    log.progress.criterion = (error_then - error).abs();
                    if log.progress.criterion < self.density_tolerance {
                        stop_reason = StopReason::Converged;
                        break;
                    }
                    (looked_at, error_then) = (time, error);
                }
                log.tell();
            }
        }
        for (i, _) in agitators {
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

    /// The free particles nearest to the points of a coarse grid, far enough from every surface; held as fixed while
    /// they run. With the sites that they run about.
    fn chosen<const D: usize>(
        &self,
        problem: &Problem<D>,
        surfaces: &[ParticleSurface<D>],
        particles: &mut Particles<D>,
    ) -> Vec<(usize, [f64; D])> {
        let Ok(tree) = KdTree::new(&particles.position) else {
            return Vec::new();
        };
        let step = self.grid_over_spacing * problem.spacing();
        let bounds = problem.domain.bounds;
        let cells: [usize; D] =
            std::array::from_fn(|k| ((bounds.size()[k] / step).floor() as usize).max(1));
        let mut chosen = Vec::new();
        for number in 0..cells.iter().product::<usize>() {
            let cell = place_of(number, cells);
            let middle: [f64; D] = std::array::from_fn(|k| {
                bounds.min[k] + (cell[k] as f64 + 0.5) * bounds.size()[k] / cells[k] as f64
            });
            let Some(found) = tree.nearest(middle) else {
                continue;
            };
            let (i, away) = (found.index, AWAY * problem.spacing());
            let p = particles.position[i];
            let is_near = |s: &ParticleSurface<D>| s.surface.closest_within(p, away).is_some();
            if particles.kind[i] == Kind::Free && !surfaces.iter().any(is_near) {
                particles.kind[i] = Kind::Fixed;
                chosen.push((i, p));
            }
        }
        chosen
    }

    /// §2.5; whether the number of boundary particles changed.
    fn convert<const D: usize>(
        &self,
        problem: &Problem<D>,
        particles: &mut Particles<D>,
        surfaces: &[ParticleSurface<D>],
        is_slow: &(dyn Fn(usize) -> bool + Sync),
        reach: f64,
    ) -> bool {
        let before = particles.count(Kind::Boundary);
        let [to_boundary, to_free] =
            [reach, self.conversion_over_spacing[1]].map(|d| d * problem.spacing());
        let kinds: Vec<(Kind, Option<u16>)> = (0..particles.len())
            .into_par_iter()
            .with_min_len(256)
            .map(|i| {
                let (kind, body) = (particles.kind[i], particles.body[i]);
                let p = particles.position[i];
                let within = |s: &ParticleSurface<D>, reach| s.surface.closest_within(p, reach);
                match kind {
                    Kind::Free if is_slow(i) => (surfaces.iter().zip(0_u16..))
                        .find(|(s, _)| within(s, to_boundary).is_some())
                        .map_or((kind, body), |(_, b)| (Kind::Boundary, Some(b))),
                    Kind::Boundary => {
                        let own = &surfaces[usize::from(body.unwrap_or(0))];
                        match within(own, to_free) {
                            Some(_) => (kind, body),
                            None => (Kind::Free, None),
                        }
                    }
                    _ => (kind, body),
                }
            })
            .collect();
        for (i, (kind, body)) in kinds.into_iter().enumerate() {
            (particles.kind[i], particles.body[i]) = (kind, body);
        }
        particles.count(Kind::Boundary) != before
    }
}

/// Eqs. 12 and 13, begun at the site.
fn orbit<const D: usize>(site: [f64; D], radius: f64, angle: f64) -> [f64; D] {
    let at = |angle: f64| -> [f64; 3] {
        if D == 2 {
            [angle.cos(), angle.sin(), 0.0]
        } else {
            let (half, whole) = ((0.5 * angle).sin_cos(), angle.sin_cos());
            [half.1 * whole.0, half.0 * whole.0, whole.1]
        }
    };
    let (now, first) = (at(angle), at(0.0));
    std::array::from_fn(|k| site[k] + radius * (now[k] - first[k]))
}
