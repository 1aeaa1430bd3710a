//! The balanced method: surface first, exact counts, then a minimiser. No paper has it.

mod shares;
#[cfg(test)]
mod tests;

use std::time::Instant;

use sphpack_geometry::{Closest, Feature};

use crate::course::Course;
use crate::forces::Forces;
use crate::minimise::{Landscape, Settling};
use crate::observer::{Observer, Phase};
use crate::packed::{Packed, ParticleSurface};
use crate::particles::{Kind, Particles};
use crate::problem::{Body, PackingError, Problem};
use crate::quality::Spacing;
use crate::seeding::{Seeds, particle_surfaces, seed_lattice};
use shares::Depths;

/// The balanced method.
///
/// 1. Surface first: N_s particles are spread evenly over every particle surface, corners and edges first.
/// 2. Exact counts: every body, and the fluid, gets as many particles as its volume asks for: those on the surface and
///    the deepest lattice sites. The particles of a region share its volume equally, to the last digit.
/// 3. Minimise the energy of background pressure and repulsion; boundary particles slide along their surface.
///
/// Nothing waits for particles to wander onto the surface, so some sixty evaluations do where 001 takes thousands.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Balanced {
    /// How the particles come to rest.
    pub settling: Settling,
}

impl Balanced {
    /// Packs the problem.
    ///
    /// # Errors
    /// Those of [`Problem::check`], and [`PackingError::Surface`].
    pub fn pack<const D: usize>(
        &self,
        problem: &Problem<D>,
        observer: &mut dyn Observer,
    ) -> Result<Packed<D>, PackingError> {
        let settling = &self.settling;
        let mut course = Course::new(observer, settling.tolerance(), settling.max_evaluations);
        problem.check()?;
        course.enter(Phase::Geometry);
        let geometry = Instant::now();
        let surfaces = particle_surfaces(problem)?;
        let samples = sample(problem, &surfaces)?;
        course.progress.target = surfaces.iter().map(|surface| surface.target_count).sum();
        course.progress.on_surface = samples.iter().map(Vec::len).sum();
        course.seconds.geometry = geometry.elapsed().as_secs_f64();

        course.enter(Phase::Seeding);
        let seeding = Instant::now();
        let Seeds {
            mut particles,
            frozen_lattice,
        } = place(problem, &surfaces, &samples);
        course.seconds.seeding = seeding.elapsed().as_secs_f64();

        course.enter(Phase::Settling);
        let forces = Forces::of(problem, settling.early_repulsion(problem.spacing));
        let reach = problem.support();
        let mut landscape =
            Landscape::new(&mut particles, &surfaces, forces, problem.spacing, reach);
        let stop_reason = settling.run(&mut landscape, &mut course);
        let forces = landscape.into_forces();
        Ok(course.end(
            problem,
            particles,
            frozen_lattice,
            surfaces,
            &forces,
            stop_reason,
        ))
    }
}

/// Surface particles, and the sites that are left to bodies and fluid.
fn place<const D: usize>(
    problem: &Problem<D>,
    surfaces: &[ParticleSurface<D>],
    samples: &[Vec<Closest<D>>],
) -> Seeds<D> {
    let (filling, frozen_lattice) = seed_lattice(problem);
    let sites = filling.sites();
    let volume = filling.volume_per_site();
    let depths = Depths::of(
        &problem.bodies,
        problem.domain.bounds,
        problem.spacing,
        2.0 * problem.spacing,
        &sites,
    );
    let on_surface: Vec<usize> = samples.iter().map(Vec::len).collect();
    let shares = shares::shares(problem, surfaces, &on_surface, sites.len(), volume);
    let region_of = shares::choose(&depths, sites.len(), &shares.regions, problem.seed);
    let mut particles = Particles::default();
    for (&site, region) in sites.iter().zip(region_of) {
        if let Some(region) = region {
            let volume = shares.regions[region].particle_volume;
            particles.push(site, Kind::Free, volume, None);
        }
    }
    for ((points, &volume), body) in samples.iter().zip(&shares.surface_volume).zip(0_u16..) {
        for point in points {
            let kind = match point.feature {
                Feature::Smooth => Kind::Boundary,
                Feature::Edge | Feature::Corner => Kind::Fixed,
            };
            particles.push(point.point, kind, volume, Some(body));
        }
    }
    Seeds::surrounded(problem, particles, frozen_lattice, volume)
}

/// About N_s points on every particle surface: where corners divide a curve into runs, one more or less may divide
/// them more evenly.
fn sample<const D: usize>(
    problem: &Problem<D>,
    surfaces: &[ParticleSurface<D>],
) -> Result<Vec<Vec<Closest<D>>>, PackingError> {
    let of = |(surface, body): (&ParticleSurface<D>, &Body<D>)| {
        let target = surface.target_count;
        let counts = if D == 2 && !surface.surface.features().corners.is_empty() {
            vec![target, target - 1, target + 1]
        } else {
            vec![target]
        };
        let mut best: Option<(f64, Vec<Closest<D>>)> = None;
        for count in counts {
            let points = surface.surface.sample(count).map_err(|source| {
                let body = body.name.clone();
                PackingError::Surface { body, source }
            })?;
            let places: Vec<[f64; D]> = points.iter().map(|hit| hit.point).collect();
            let uneven = Spacing::of(&places).cv;
            if best.as_ref().is_none_or(|(least, _)| uneven < least - 1e-6) {
                best = Some((uneven, points));
            }
        }
        Ok(best.map_or(Vec::new(), |(_, points)| points))
    };
    surfaces.iter().zip(&problem.bodies).map(of).collect()
}
