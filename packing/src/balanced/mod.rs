//! The balanced method: surface first, exact counts, then a minimiser. No paper has it.

mod band;
mod clashes;
mod round;
pub(crate) mod shares;
#[cfg(test)]
mod tests;

use std::sync::Arc;
use std::time::Instant;

use sphpack_geometry::{
    Closest, Feature, GeometryError, Surface, SurfaceSamples, sample_particles,
};

use crate::course::Course;
use crate::depths::Depths;
use crate::forces::Forces;
use crate::minimise::{Landscape, Settling};
use crate::observer::{Observer, Phase};
use crate::packed::{Packed, ParticleSurface, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{Body, DEFAULT_INSET_OVER_SPACING, PackingError, Problem};
use crate::seeding::{Seeds, seed_lattice};
pub use band::Band;
use band::Part;
use clashes::Clash;
use round::Round;

/// The balanced method.
///
/// 1. Surface first: N_s particles are spread evenly over every particle surface, corners and edges first.
/// 2. Exact counts: every body, and the fluid, gets as many particles as its volume asks for: those on the surface and
///    the deepest lattice sites. The particles of a region share its volume equally, to the last digit.
/// 3. Minimise the energy of background pressure and repulsion; boundary particles slide along their surface. Far from
///    every surface particles stay on their lattice ([`Band`]).
///
/// Nothing waits for particles to wander onto the surface, so some sixty evaluations do where 001 takes thousands.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Balanced {
    /// How the particles come to rest.
    pub settling: Settling,
    /// Which of them move.
    pub band: Band,
}

/// The force beyond the band that asks for a wider one, in tolerances, and by how much wider it gets. Near surfaces
/// levelling leaves up to twice the tolerance of the background's force; a stricter rim costs widening after widening
/// where the lattice is soft (h/∆s = 1.0 in space), for the same density.
const RIM: f64 = 1.6;
const WIDER: f64 = 1.5;

/// How many times the band may be widened.
const MOST_WIDENINGS: usize = 8;

impl Balanced {
    /// Whether the problem can be packed, as far as that is known before particles are placed.
    ///
    /// # Errors
    /// Those of [`Balanced::pack`].
    pub fn check<const D: usize>(problem: &Problem<D>) -> Result<(), PackingError> {
        problem.check()?;
        problem
            .bodies
            .iter()
            .try_for_each(|body| inset(problem, body).map(drop))
    }

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
        let (mut surfaces, mut samples) = sample(problem)?;
        let clashes = clashes::resolve(&mut samples, problem.spacing);
        for (surface, points) in surfaces.iter_mut().zip(&samples) {
            surface.target_count = points.len();
        }
        course.progress.target = surfaces.iter().map(|surface| surface.target_count).sum();
        course.progress.on_surface = samples.iter().map(Vec::len).sum();
        course.seconds.geometry = geometry.elapsed().as_secs_f64();

        course.enter(Phase::Seeding);
        let seeding = Instant::now();
        let Seeds {
            mut particles,
            frozen_lattice,
        } = place(problem, &surfaces, &samples, &clashes);
        course.seconds.seeding = seeding.elapsed().as_secs_f64();

        course.enter(Phase::Settling);
        let perfect_gamma = problem.perfect_gamma();
        let mut forces = Forces::of(problem, settling.early_repulsion(problem.spacing));
        let mut stop_reason = StopReason::Converged;
        let mut begin = Round {
            number: 0,
            width: self.band.first_width(problem, settling.finish),
            particles: &mut particles,
            forces: &mut forces,
        };
        course.go_on(&mut [&mut begin])?;
        let (mut round, mut width) = (begin.number, begin.width);
        while round <= MOST_WIDENINGS {
            let begin = Round {
                number: round,
                width,
                particles: &mut particles,
                forces: &mut forces,
            };
            course.set_aside(0, &[&begin]);
            let mut part = Part::of(problem, &particles, width);
            forces.targets_changed();
            let mut landscape = Landscape::new(
                &mut part.particles,
                &surfaces,
                forces,
                problem.spacing,
                problem.support(),
            );
            landscape.keep_sides();
            stop_reason = settling.run(&mut landscape, &mut course, perfect_gamma, round > 0)?;
            forces = landscape.into_forces();
            part.write_back(&mut particles);
            let is_settled = stop_reason == StopReason::Converged;
            if part.is_all
                || !is_settled
                || part.rim_residual(problem, &mut forces) < RIM * settling.tolerance()
            {
                break;
            }
            width *= WIDER;
            round += 1;
        }
        Ok(course
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
}

/// Surface particles, and the sites that are left to bodies and fluid.
fn place<const D: usize>(
    problem: &Problem<D>,
    surfaces: &[ParticleSurface<D>],
    samples: &[Vec<Closest<D>>],
    clashes: &[Clash],
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
    let shares = shares::shares(problem, surfaces, &on_surface, clashes, sites.len(), volume);
    let region_of = shares::choose(
        &depths,
        sites.len(),
        &shares.regions,
        problem.spacing,
        problem.seed,
    );
    let mut particles = Particles::default();
    for (&site, region) in sites.iter().zip(region_of) {
        if let Some(region) = region {
            let volume = shares.regions[region].particle_volume;
            let body = (region < problem.bodies.len()).then_some(region as u16);
            particles.push(site, Kind::Free, volume, body);
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

/// Whether a body is packed without a particle surface where it is too thin for one. A deeper surface than usual is asked
/// for as it is.
fn is_usual<const D: usize>(body: &Body<D>) -> bool {
    body.inset_over_spacing <= DEFAULT_INSET_OVER_SPACING
}

/// A body's particle surface, `None` where it is so thin that it has none.
fn inset<const D: usize>(
    problem: &Problem<D>,
    body: &Body<D>,
) -> Result<Option<Arc<dyn Surface<D>>>, PackingError> {
    let depth = body.inset_over_spacing * problem.spacing;
    match body.surface.inset(depth) {
        Ok(inset) => Ok(Some(inset)),
        Err(GeometryError::Vanished { .. }) if is_usual(body) => Ok(None),
        Err(source) => Err(PackingError::Surface {
            body: body.name.clone(),
            source,
        }),
    }
}

type Sampled<const D: usize> = (Vec<ParticleSurface<D>>, Vec<Vec<Closest<D>>>);

/// Every particle surface with its points. Points in the middle of parts that are too thin to have a surface count as
/// corners: they stay where they are.
fn sample<const D: usize>(problem: &Problem<D>) -> Result<Sampled<D>, PackingError> {
    let mut surfaces = Vec::new();
    let mut samples = Vec::new();
    for body in &problem.bodies {
        let fail = |source| PackingError::Surface {
            body: body.name.clone(),
            source,
        };
        let depth = body.inset_over_spacing * problem.spacing;
        let is_usual = is_usual(body);
        let inset = inset(problem, body)?;
        let found = match &inset {
            Some(surface) if !is_usual => {
                let count = surface.measure() / problem.spacing.powi(D as i32 - 1);
                surface
                    .sample(count.round().max(1.0) as usize)
                    .map(|on_surface| SurfaceSamples {
                        on_surface,
                        medial: Vec::new(),
                        medial_volume: 0.0,
                    })
            }
            _ => sample_particles(
                body.surface.as_ref(),
                inset.as_deref(),
                problem.spacing,
                depth,
            ),
        }
        .map_err(fail)?;
        let mut points = found.on_surface;
        points.extend(found.medial.into_iter().map(|point| Closest {
            feature: Feature::Corner,
            point,
            ..body.surface.closest(point)
        }));
        surfaces.push(ParticleSurface {
            surface: inset.unwrap_or_else(|| body.surface.clone()),
            target_count: points.len(),
        });
        samples.push(points);
    }
    Ok((surfaces, samples))
}
