//! The balanced method: surface first, exact counts, then a minimiser. No paper has it.

mod band;
mod clashes;
mod goals;
mod graded;
pub(crate) mod parts;
mod places;
mod pockets;
mod remembered;
pub(crate) mod rim;
mod round;
mod sampled;
pub(crate) mod shares;
mod sites;
#[cfg(test)]
mod tests;
mod tried;

use std::time::Instant;

use sphpack_geometry::{Closest, Feature, InsetError};
use sphpack_neighbors::point;

use crate::depths::Depths;
use crate::estimate::Work;
use crate::finish::{self, Among, Goal, Uneven};
use crate::forces::Forces;
use crate::methods::info::{CHOOSING, MethodInfo, Moves};
use crate::minimise::{Energy, Finish, Settling};
use crate::observer::Stage;
use crate::packed::{Omitted, Packed, ParticleSurface, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{Body, PackingError, Problem};
use crate::run_log::RunLog;
use crate::seeding::{Seeds, seed_lattice};
pub use band::Band;
use band::Part;
use clashes::Clash;
use parts::Parts;
use pockets::Pockets;
use round::Round;
use sampled::{Sampled, inset, is_usual, sample};
use shares::{Held, Share};
use tried::{Choose, Counts};

/// The balanced method.
///
/// 1. Surface first: N_s particles are spread evenly over every particle surface, corners and edges first.
/// 2. Exact counts: every body, and the fluid, gets as many particles as its volume asks for: those on the surface and
///    the deepest lattice sites. The particles of a region share its volume equally, to the last digit.
/// 3. Minimise the energy of background pressure and repulsion; boundary particles slide along their surface. Far from
///    every surface particles stay on their lattice ([`Band`]).
///
/// Nothing waits for particles to wander onto the surface, so some sixty evaluations do where Negi & Ramachandran
/// (2021) take thousands.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

/// The number of the round in which the last stage comes.
const FINISHING: usize = MOST_WIDENINGS + 1;

/// Support radii around what is uneven in which particles move to make it even.
const UNEVEN_WIDTH: f64 = 1.5;

/// Particles of which a place of rest is looked for, at most, in the plane and in space. 6,400 in the plane take some ten
/// seconds, most of it for factors; a factor of 17,640 in space took 40.
const MOST_AT_REST: [f64; 2] = [8000.0, 1500.0];

impl Balanced {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "balanced",
        summary: "surface first, counts balanced, then a minimiser (the default)",
        is_published: false,
        moves: Moves::Band,
        minimises: true,
        gamma_within: 0.1,
        // 64 … 131 evaluations, each with a second sum that levels; ten pairs of L-BFGS in single precision, and its
        // vectors. 110 µs for a point of a sphere's surface that is spread evenly.
        work: Work {
            evaluations: 80.0,
            times_plain: 1.3,
            bytes: [260.0, 450.0],
            placing: CHOOSING,
            sampling: [1e-5, 1.1e-4],
            ..Work::PLAIN
        },
        ..MethodInfo::USUAL
    };

    /// [`Method::check`](crate::Method::check), for any dimension.
    pub(crate) fn check_in<const D: usize>(
        &self,
        problem: &Problem<D>,
    ) -> Result<(), PackingError> {
        problem.check()?;
        let size = problem.domain.bounds.size();
        let particles = size.iter().product::<f64>() / problem.spacing().powi(D as i32);
        let most = MOST_AT_REST[usize::from(D == 3)];
        if self.settling.finish == Finish::Calm && particles > most {
            return Err(PackingError::TooManyAtRest { particles, most });
        }
        for body in &problem.bodies {
            if inset(body, problem.spacing())?.is_none() && !is_usual(body) {
                let depth = body.inset_over_spacing * problem.spacing();
                return Err(PackingError::Surface {
                    body: body.name.clone(),
                    error: InsetError::Vanished { depth }.into(),
                });
            }
        }
        Ok(())
    }

    /// How particles settle before the last stage: what other finishes begin with is an even packing.
    fn beginning(&self) -> Settling {
        match self.settling.finish {
            Finish::Even | Finish::Consistent => self.settling,
            Finish::Calm | Finish::Both => Settling {
                finish: Finish::Even,
                residual_tolerance: None,
                ..self.settling
            },
        }
    }

    /// Packs the problem.
    ///
    /// # Errors
    /// Those of [`Problem::check`], and [`PackingError::Surface`].
    pub(crate) fn pack_in<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
    ) -> Result<Packed<D>, PackingError> {
        let settling = self.beginning();
        log.begin(&Self::INFO, settling.tolerance(), settling.max_evaluations);
        self.check_in(problem)?;
        if problem.resolution.uniform().is_none() {
            return graded::pack(problem, &self.settling, log);
        }
        let goals = goals::of(&self.settling);
        self.pack_counted(problem, log, &goals, &|problem, sampled, log| {
            tried::counts(self, problem, sampled, log)
        })
    }

    /// Packs a problem of one spacing, with the counts that `choose` knows better than areas and volumes tell, and comes to
    /// the goals in the end.
    fn pack_counted<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
        goals: &[Goal],
        choose: &Choose<'_, D>,
    ) -> Result<Packed<D>, PackingError> {
        let settling = &self.beginning();
        log.enter(Stage::Geometry);
        let geometry = Instant::now();
        let whole = problem;
        let parts = Parts::of(whole);
        let problem = &parts.problem;
        let spacings = vec![problem.spacing(); problem.bodies.len()];
        let mut sampled = sample(&problem.bodies, &spacings)?;
        let counts = choose(problem, &sampled, log);
        tried::sample_anew(&problem.bodies, &mut sampled, &counts)?;
        let Sampled {
            mut surfaces,
            mut samples,
            excess,
        } = sampled;
        let clashes = clashes::resolve(&mut samples, &spacings);
        for (surface, points) in surfaces.iter_mut().zip(&samples) {
            surface.target_count = points.len();
        }
        log.progress.target = surfaces.iter().map(|surface| surface.target_count).sum();
        log.progress.on_surface = samples.iter().map(Vec::len).sum();
        log.seconds.geometry = geometry.elapsed().as_secs_f64();

        log.enter(Stage::Seeding);
        let seeding = Instant::now();
        let (seeds, omitted) = place(&parts, &surfaces, (&samples, &excess), &clashes, &counts);
        let Seeds {
            mut particles,
            frozen_lattice,
        } = seeds;
        log.seconds.seeding = seeding.elapsed().as_secs_f64();

        log.enter(Stage::Settling);
        let perfect_gamma = problem.perfect_gamma();
        let stages = settling.schedule(problem.spacing(), perfect_gamma);
        let mut forces = Forces::of(problem, settling.early_repulsion(problem.spacing()));
        let mut stop_reason = StopReason::Converged;
        let mut begin = Round {
            number: 0,
            width: self.band.first_width(problem, settling.finish),
            particles: &mut particles,
            forces: &mut forces,
            is_at_rest: true,
            uneven: Uneven::default(),
        };
        log.go_on(&mut [&mut begin])?;
        let (mut round, mut width, mut uneven) = (begin.number, begin.width, begin.uneven);
        if !begin.is_at_rest {
            stop_reason = StopReason::Stagnated;
        }
        while round <= MOST_WIDENINGS {
            let begin = Round {
                number: round,
                width,
                particles: &mut particles,
                forces: &mut forces,
                is_at_rest: true,
                uneven: Uneven::default(),
            };
            log.set_aside(0, &[&begin]);
            let mut part = Part::of(problem, &particles, width);
            forces.targets_changed();
            let mut energy = Energy::new(&mut part.particles, &surfaces, forces, problem.support());
            energy.keep_sides(&problem.bodies);
            stop_reason = settling.run(&mut energy, log, &stages[round.min(1)..])?;
            forces = energy.into_forces();
            part.write_back(&mut particles);
            uneven = Uneven::of(problem, &part.particles, &forces);
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
        for (number, &goal) in goals.iter().enumerate() {
            let evens_out = goal.among == Among::Uneven;
            let may_begin = match stop_reason {
                StopReason::Converged => !(evens_out && uneven.places.is_empty()),
                StopReason::Stagnated => evens_out && !uneven.places.is_empty(),
                _ => false,
            };
            if !may_begin || FINISHING + number < round {
                continue;
            }
            let begin = Round {
                number: FINISHING + number,
                width,
                particles: &mut particles,
                forces: &mut forces,
                is_at_rest: stop_reason == StopReason::Converged,
                uneven: uneven.clone(),
            };
            log.set_aside(0, &[&begin]);
            let mut part = match goal.among {
                Among::Band => Part::of(problem, &particles, width),
                // What a body does to its surroundings falls off so slowly that a band around it has no place of rest.
                Among::All => Part::of(problem, &particles, f64::INFINITY),
                Among::Uneven => {
                    let around = UNEVEN_WIDTH * problem.support();
                    Part::around(problem, &particles, &uneven.places, around)
                }
            };
            let mut goal = goal;
            if evens_out {
                let so_far = log.progress.evaluation;
                goal.steps = uneven.affordable(goal.steps, &part.particles, so_far);
            }
            let set = finish::Set {
                particles: &mut part.particles,
                rim: &part.rim,
                surfaces: &surfaces,
            };
            let most = settling.max_evaluations;
            let (reason, unevenness) = finish::run(problem, set, goal, most, log)?;
            if !evens_out || unevenness < uneven.worst {
                part.write_back(&mut particles);
            }
            stop_reason = match reason {
                StopReason::Interrupted => reason,
                // Even is good enough, whatever force is left; and what was at rest before is.
                _ if evens_out && unevenness <= 1.0 => StopReason::Converged,
                _ if evens_out => stop_reason,
                _ => reason,
            };
        }
        let mut packed = log
            .end(
                problem,
                particles,
                frozen_lattice,
                surfaces,
                &forces,
                stop_reason,
            )
            .with_known_sides();
        packed.omitted = omitted;
        packed.excess = excess;
        Ok(parts.gather(packed, whole, |body| {
            inset(body, whole.spacing()).ok().flatten()
        }))
    }
}

/// Surface particles, and the sites that are left to parts and fluid; and the parts that get neither.
fn place<const D: usize>(
    parts: &Parts<D>,
    surfaces: &[ParticleSurface<D>],
    (samples, excess): (&[Vec<Closest<D>>], &[f64]),
    clashes: &[Clash],
    counts: &[Option<Counts>],
) -> (Seeds<D>, Vec<Omitted<D>>) {
    let problem = &parts.problem;
    let (filling, frozen_lattice) = seed_lattice(problem);
    let sites = filling.sites();
    let volume = filling.volume_per_site();
    let depths = Depths::of(
        &problem.bodies,
        problem.domain.bounds,
        problem.spacing(),
        2.0 * problem.spacing(),
        &sites,
    );
    let least = 0.5 * volume;
    // Whoever sampled the surface counted in ∆s^D, and a part too thin for a point has no place for a site either.
    let least_part = least.max(0.5 * problem.spacing().powi(D as i32));
    let (mut room, omitted) = rooms(
        parts,
        (samples, excess),
        &vec![least_part; problem.bodies.len()],
    );
    let fluid = room.pop().unwrap_or(0.0);
    let pockets = Pockets::of(problem, &sites, &depths, fluid, least);
    room.extend(&pockets.volume);
    let within = Within {
        pockets: pockets.volume.len(),
        at: &|place| pockets.at(problem, place),
    };
    let held: Vec<Held<'_, D>> = (problem.bodies.iter().zip(surfaces).enumerate())
        .map(|(part, (body, surface))| Held {
            body,
            spacing: volume.powf(1.0 / D as f64),
            volume_per_point: volume,
            layer: None,
            surface: surface.surface.as_ref(),
            points: samples[part].len(),
            removed: clashes[part].removed,
            excess: excess[part],
            inside: counts[part].map(|counts| counts.inside),
            reaches: reaches(
                &problem.bodies,
                part,
                &samples[part],
                problem.spacing(),
                &within,
            ),
        })
        .collect();
    let on_surface: Vec<Closest<D>> = samples.iter().flatten().copied().collect();
    let choose =
        |regions: &[Share]| sites::choose(problem, &depths, &pockets, &sites, &on_surface, regions);
    let all = Some(sites.len());
    let per_site = vec![volume; room.len()];
    let mut shares = shares::shares(&held, &room, &vec![usize::MAX; room.len()], all, &per_site);
    let mut chosen = choose(&shares.regions);
    let is_short = |region: usize, share: &Share| chosen.count[region] < share.sites;
    if (shares.regions.iter().enumerate()).any(|(region, share)| is_short(region, share)) {
        let most: Vec<usize> = (shares.regions.iter().enumerate())
            .map(|(region, share)| {
                if is_short(region, share) {
                    chosen.count[region]
                } else {
                    usize::MAX
                }
            })
            .collect();
        shares = shares::shares(&held, &room, &most, all, &per_site);
        chosen = choose(&shares.regions);
    }
    let mut particles = Particles::new(problem.sizes());
    let kept =
        (sites.iter().zip(chosen.region_of)).filter_map(|(&site, region)| Some((site, region?)));
    for (site, region) in kept.chain(chosen.more) {
        let volume = shares.regions[region as usize].particle_volume;
        let body = (region as usize) < problem.bodies.len();
        particles.push(site, Kind::Free, volume, body.then_some(region as u16));
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
    let seeds = Seeds::surrounded(problem, particles, frozen_lattice, volume);
    (seeds, omitted)
}

/// The volume of every part without what lies in it, and of the fluid last; and the parts of less than their `least` (half a
/// particle) without a surface particle, whose volume whatever is around them has. What a part takes beyond its own volume is
/// taken from what is around it.
fn rooms<const D: usize>(
    parts: &Parts<D>,
    (samples, excess): (&[Vec<Closest<D>>], &[f64]),
    least: &[f64],
) -> (Vec<f64>, Vec<Omitted<D>>) {
    let bodies = &parts.problem.bodies;
    let inside = shares::directly_inside(bodies, parts.problem.spacing());
    let mut room = parts.rooms();
    let mut omitted = Vec::new();
    for (region, within) in inside.iter().enumerate() {
        for &part in within {
            if samples[part].is_empty() && room[part] < least[part] {
                let surface = &bodies[part].surface;
                omitted.push(Omitted {
                    body: part,
                    at: surface.closest(surface.bounds().center()).point,
                    volume: room[part],
                });
                room[region] += std::mem::take(&mut room[part]);
            }
            room[part] += excess[part];
            room[region] -= excess[part];
        }
    }
    (room, omitted)
}

/// How far beyond an exact surface it is asked who is there, in ∆s.
const BEYOND_OVER_SPACING: f64 = 0.1;

/// The pockets of fluid: how many there are, and which one a place in the fluid is in.
struct Within<'a, const D: usize> {
    pockets: usize,
    at: &'a dyn Fn([f64; D]) -> Option<usize>,
}

/// How much of a part's surface particles, of the given spacing, is in which region, in particles.
fn reaches<const D: usize>(
    bodies: &[Body<D>],
    part: usize,
    points: &[Closest<D>],
    spacing: f64,
    within: &Within<'_, D>,
) -> Vec<(usize, f64)> {
    let own = bodies[part].inner_share();
    let mut reaches = vec![(part, own * points.len() as f64)];
    if own == 1.0 {
        return reaches;
    }
    let mut beyond = vec![0.0; bodies.len() + within.pockets];
    for point in points {
        let hit = bodies[part].surface.closest(point.point);
        let place = point::add_scaled(hit.point, BEYOND_OVER_SPACING * spacing, hit.normal);
        let there = (0..bodies.len())
            .find(|&b| b != part && bodies[b].surface.inside(place))
            .unwrap_or_else(|| bodies.len() + (within.at)(place).unwrap_or(0));
        beyond[there] += 1.0 - own;
    }
    reaches.extend((beyond.into_iter().enumerate()).filter(|(_, count)| *count > 0.0));
    reaches
}
