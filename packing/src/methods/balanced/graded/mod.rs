//! Packing by a field of spacings: the balanced method where particles differ in size.
//!
//! 1. Surfaces first, each with the spacing that the field has there.
//! 2. Every part's core and every pocket of fluid gets as many particles as ∫ s^−D dV asks for, at places of equal mass
//!    ([`bisection`]).
//! 3. Order: an energy of background pressure and repulsion, sizes frozen.
//! 4. Level: Γ → 1 while every size follows the field and every region keeps its volume ([`energy`]).
//!
//! Γ is by each particle's own h. Beyond open sides are mirror images ([`mirror`]).

mod anchor;
mod bisection;
mod cells;
mod columns;
mod energy;
mod kept;
mod mirror;
mod pockets;
mod settle;
mod surfaces;
#[cfg(test)]
mod tests;

use std::sync::Arc;
use std::time::Instant;

use sphpack_geometry::{Closest, Feature, Surface};

use super::clashes::{self, Clash};
use super::parts::Parts;
use super::shares::{self, Held};
use super::{Within, reaches, rooms};
use crate::minimise::{Movable, Settling};
use crate::observer::Stage;
use crate::packed::{Omitted, Packed, ParticleSurface};
use crate::particles::{Kind, Particles};
use crate::problem::{Body, PackingError, Problem};
use crate::run_log::RunLog;
use crate::sizes::Sizes;
use bisection::Piece;
use cells::{Cells, Layers};
use energy::{GradedEnergy, NONE, Regions};
use surfaces::{Along, FollowingInset};

/// Packs a problem whose spacings differ from place to place.
pub(super) fn pack<const D: usize>(
    whole: &Problem<D>,
    settling: &Settling,
    log: &mut RunLog<'_>,
) -> Result<Packed<D>, PackingError> {
    log.enter(Stage::Geometry);
    let geometry = Instant::now();
    let parts = Parts::of(whole);
    let problem = &parts.problem;
    let Sampled {
        mut surfaces,
        mut samples,
        excess,
        along,
    } = sample(problem)?;
    let spacings: Vec<f64> = along.iter().map(|along| along.mean).collect();
    let clashes = clashes::resolve(&mut samples, &spacings);
    for (surface, points) in surfaces.iter_mut().zip(&samples) {
        surface.target_count = points.len();
    }
    log.progress.target = surfaces.iter().map(|surface| surface.target_count).sum();
    log.progress.on_surface = samples.iter().map(Vec::len).sum();
    log.seconds.geometry = geometry.elapsed().as_secs_f64();

    log.enter(Stage::Seeding);
    let seeding = Instant::now();
    let placed = place(&parts, &surfaces, (&samples, &excess), &clashes, &along);
    let Placed {
        mut particles,
        regions,
        omitted,
    } = placed;
    log.seconds.seeding = seeding.elapsed().as_secs_f64();

    log.enter(Stage::Settling);
    let reach = problem.support() * problem.resolution.range()[1] / problem.spacing();
    let mut movable = Movable::new(&mut particles, &surfaces, problem.domain, reach);
    movable.keep_sides(&problem.bodies, &problem.domain);
    movable.keep_off_sides(OFF_SIDES);
    let mut energy = GradedEnergy::new(problem, movable, regions, settling.repulsion[0]);
    let stop_reason = settle::run(&mut energy, settling, log)?;
    log.seconds.projection += energy.movable.seconds;
    log.seconds.neighbors += energy.neighbor_seconds;
    log.seconds.forces += energy.force_seconds;
    log.earlier_evaluations += energy.evaluations;
    let sight = problem.support().max(problem.judging_reach) / problem.spacing();
    energy.freeze(sight);
    let frozen_lattice = problem.filling();
    let mut packed = log
        .end_counted(problem, particles, frozen_lattice, surfaces, stop_reason)
        .with_known_sides();
    packed.omitted = omitted;
    packed.excess = excess;
    Ok(parts.gather(packed, whole, |body| surface(whole, body).ok().flatten()))
}

/// No particle comes nearer to an open side than this, in its spacings: beyond is its mirror image, and where both meet nothing
/// tells which way is apart.
const OFF_SIDES: f64 = 0.3;

/// The particle surface of a body; `None` where it is too thin to have one.
fn surface<const D: usize>(
    problem: &Problem<D>,
    body: &Body<D>,
) -> Result<Option<Arc<dyn Surface<D>>>, PackingError> {
    let along = Along::of(
        &problem.resolution,
        body.surface.as_ref(),
        problem.spacing(),
    );
    if along.is_uniform {
        return super::inset(body, along.mean);
    }
    Ok(Some(Arc::new(FollowingInset::new(
        body,
        &problem.resolution,
        along,
    ))))
}

/// The surfaces of all parts, with their points.
struct Sampled<const D: usize> {
    surfaces: Vec<ParticleSurface<D>>,
    samples: Vec<Vec<Closest<D>>>,
    excess: Vec<f64>,
    along: Vec<Along>,
}

/// Parts with one spacing are sampled as ever, the others by the field.
fn sample<const D: usize>(problem: &Problem<D>) -> Result<Sampled<D>, PackingError> {
    let mut sampled = Sampled {
        surfaces: Vec::new(),
        samples: Vec::new(),
        excess: Vec::new(),
        along: Vec::new(),
    };
    for body in &problem.bodies {
        let along = Along::of(
            &problem.resolution,
            body.surface.as_ref(),
            problem.spacing(),
        );
        sampled.along.push(along);
        if along.is_uniform {
            let uniform = super::sample(std::slice::from_ref(body), &[along.mean])?;
            sampled.surfaces.extend(uniform.surfaces);
            sampled.samples.extend(uniform.samples);
            sampled.excess.extend(uniform.excess);
            continue;
        }
        let inset = FollowingInset::new(body, &problem.resolution, along);
        let points = inset.sample().map_err(|error| PackingError::Surface {
            body: body.name.clone(),
            error,
        })?;
        sampled.surfaces.push(ParticleSurface {
            surface: Arc::new(inset),
            target_count: points.len(),
        });
        sampled.samples.push(points);
        sampled.excess.push(0.0);
    }
    Ok(sampled)
}

/// Particles at the start.
struct Placed<const D: usize> {
    particles: Particles<D>,
    regions: Regions,
    omitted: Vec<Omitted<D>>,
}

/// Regions that ask for less than this many particles get none.
const LEAST: f64 = 0.5;

fn place<const D: usize>(
    parts: &Parts<D>,
    surfaces: &[ParticleSurface<D>],
    (samples, excess): (&[Vec<Closest<D>>], &[f64]),
    clashes: &[Clash],
    along: &[Along],
) -> Placed<D> {
    let problem = &parts.problem;
    let spacings: Vec<f64> = along.iter().map(|along| along.mean).collect();
    let layers = Layers {
        inner: (problem.bodies.iter())
            .map(|body| 0.5 + body.inset_over_spacing)
            .collect(),
        outer: (problem.bodies.iter())
            .map(|body| (0.5 - body.inset_over_spacing).max(0.0))
            .collect(),
        spacing: (along.iter())
            .map(|along| along.is_uniform.then_some(along.mean))
            .collect(),
        coarsest: problem.resolution.range()[1],
    };
    let cells = Cells::of(problem, &layers);
    let (mut pocket, found) = pockets::of(&cells, problem);
    // Pockets without a particle of their own leave their volume to the first.
    let contents = cells.contents(&pocket, found);
    let mut number = vec![0_u32; found];
    let mut kept = 1;
    for k in 1..found {
        if contents[k][1] >= LEAST {
            number[k] = kept;
            kept += 1;
        }
    }
    for pocket in &mut pocket {
        *pocket = number[*pocket as usize];
    }
    let pockets = kept as usize;
    let parts_count = problem.bodies.len();
    let pieces = cells.pieces(&pocket, parts_count + pockets);
    let asked: Vec<f64> = (pieces.iter())
        .map(|pieces| pieces.iter().map(Piece::mass).sum())
        .collect();
    let least: Vec<f64> = spacings.iter().map(|s| LEAST * s.powi(D as i32)).collect();
    let (mut room, omitted) = rooms(parts, (samples, excess), &least);
    let fluid = room.pop().unwrap_or(0.0);
    let measured = cells.contents(&pocket, pockets);
    let others: f64 = measured[1..].iter().map(|sums| sums[0]).sum();
    room.push(fluid - others);
    room.extend(measured[1..].iter().map(|sums| sums[0]));
    // By cells, a region's core has so much volume and asks for so many particles; what the shares leave it is nearly that.
    let volume_per_site: Vec<f64> = (0..room.len())
        .map(|region| {
            let count = asked[region];
            let volume: f64 = match region.checked_sub(parts_count) {
                Some(pocket) => measured[pocket][0],
                None => cells.volume_of(region),
            };
            if count > 0.0 {
                volume / count
            } else {
                spacings
                    .get(region)
                    .copied()
                    .unwrap_or(problem.spacing())
                    .powi(D as i32)
            }
        })
        .collect();
    // The spacings of every part's surface particles.
    let along_each: Vec<Vec<f64>> = (samples.iter().zip(along).zip(&problem.bodies))
        .map(|((points, along), body)| {
            (points.iter())
                .map(|point| {
                    if along.is_uniform {
                        return along.mean;
                    }
                    let on_body = body.surface.closest(point.point);
                    problem.resolution.at(on_body.point).value
                })
                .collect()
        })
        .collect();
    let volume_of = |sizes: &[f64]| sizes.iter().map(|s| s.powi(D as i32)).sum::<f64>();
    let at = |place: [f64; D]| Some(pocket[cells.at(problem.domain.wrap(place))] as usize);
    let within = Within { pockets, at: &at };
    let held: Vec<Held<'_, D>> = (problem.bodies.iter().zip(surfaces).enumerate())
        .map(|(part, (body, surface))| Held {
            body,
            spacing: spacings[part],
            // Where spacings differ much the mean of volumes is far from the volume of the mean.
            volume_per_point: match &along_each[part][..] {
                each if along[part].is_uniform || each.is_empty() => spacings[part].powi(D as i32),
                each => volume_of(each) / each.len() as f64,
            },
            layer: (!along[part].is_uniform)
                .then(|| (room[part] - cells.volume_of(part)).max(0.0) / body.inner_share()),
            surface: surface.surface.as_ref(),
            points: samples[part].len(),
            removed: clashes[part].removed,
            excess: excess[part],
            inside: None,
            reaches: reaches(
                &problem.bodies,
                part,
                &samples[part],
                spacings[part],
                &within,
            ),
        })
        .collect();
    let most = vec![usize::MAX; room.len()];
    let shares = shares::shares(&held, &room, &most, None, &volume_per_site);
    let mut particles = Particles::new(problem.sizes());
    let mut spacing = Vec::new();
    let mut regions = Regions {
        of: Vec::new(),
        volume: Vec::new(),
    };
    for (region, (share, pieces)) in shares.regions.iter().zip(pieces).enumerate() {
        let volume = share.particle_volume * share.sites as f64;
        regions.volume.push(volume);
        let body = (region < parts_count).then_some(region as u16);
        let places = bisection::places(pieces, share.sites);
        let sizes: Vec<f64> = (places.iter())
            .map(|&place| problem.resolution.at(place).value)
            .collect();
        let all: f64 = sizes.iter().map(|s| s.powi(D as i32)).sum();
        for (&place, &size) in places.iter().zip(&sizes) {
            particles.push(place, Kind::Free, volume * size.powi(D as i32) / all, body);
            spacing.push(size);
            regions.of.push(region as u32);
        }
    }
    let surfaces = samples.iter().zip(&shares.surface_volume).zip(along_each);
    for (((points, &volume), sizes), part) in surfaces.zip(0_u16..) {
        let along = along[usize::from(part)];
        let all = volume_of(&sizes);
        for (point, size) in points.iter().zip(sizes) {
            let kind = match point.feature {
                Feature::Smooth => Kind::Boundary,
                Feature::Edge | Feature::Corner => Kind::Fixed,
            };
            // Together they have as much as equal ones would.
            let share = if along.is_uniform {
                volume
            } else {
                volume * points.len() as f64 * size.powi(D as i32) / all
            };
            particles.push(point.point, kind, share, Some(part));
            spacing.push(size);
            regions.of.push(NONE);
        }
    }
    particles.sizes = Sizes::each(&spacing, problem.h_over_spacing);
    Placed {
        particles,
        regions,
        omitted,
    }
}
