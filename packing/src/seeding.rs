//! Particles on a lattice, at the start.

use sphpack_neighbors::KdTree;

use crate::lattice::{Filling, Lattice};
use crate::packed::ParticleSurface;
use crate::particles::{Kind, Particles};
use crate::problem::{FrozenLayout, PackingError, Problem};

/// Phases that are tried, and the number of sites up to which they are: what a lattice happens to put into a body is
/// off by some of the sites near its surface, which is little of many.
const PHASES: u64 = 24;
const SITES_WORTH_A_SEARCH: u64 = 200_000;

/// Shifts the lattice so that every body gets as many sites as its volume asks for, as closely as [`PHASES`] tries
/// allow. The papers do not say where a lattice begins; on a lattice that shares the body's symmetry whole rings of
/// sites fall in or out together, and the density inside the body with them.
fn in_phase<const D: usize>(problem: &Problem<D>, filling: Filling<D>) -> Filling<D> {
    if filling.count() > SITES_WORTH_A_SEARCH || problem.bodies.is_empty() {
        return filling.shifted(phase(problem.seed));
    }
    let volume = filling.volume_per_site();
    let mut best = (f64::INFINITY, filling);
    for number in 0..PHASES {
        let candidate = filling.shifted(phase(
            problem.seed.wrapping_mul(PHASES).wrapping_add(number),
        ));
        let sites = candidate.sites();
        let mut worst: f64 = 0.0;
        for body in &problem.bodies {
            let bounds = body.surface.bounds();
            let near: Vec<[f64; D]> = sites
                .iter()
                .copied()
                .filter(|&p| bounds.contains(p))
                .collect();
            let count = body
                .surface
                .inside_batch(&near)
                .into_iter()
                .filter(|&inside| inside)
                .count();
            worst = worst.max((count as f64 - body.surface.volume() / volume).abs());
        }
        if worst < best.0 {
            best = (worst, candidate);
        }
    }
    best.1
}

/// The n-th point of an additive recurrence that covers the unit cube evenly; the 0th is the origin.
fn phase<const D: usize>(n: u64) -> [f64; D] {
    // Powers of the inverse of the root of x^(D+1) = x + 1.
    let root: f64 = if D == 2 {
        1.324_717_957_244_746
    } else {
        1.220_744_084_605_76
    };
    let n = (n % (1 << 32)) as f64;
    std::array::from_fn(|k| (n * root.powi(-(k as i32 + 1))).fract())
}

/// Particles at the start.
#[derive(Debug, Clone)]
pub struct Seeds<const D: usize> {
    /// Free particles in the box, frozen ones around it.
    pub particles: Particles<D>,
    /// The lattice that the frozen particles continue.
    pub frozen_lattice: Filling<D>,
}

impl<const D: usize> Seeds<D> {
    /// The particles of the box, surrounded by frozen ones of the given volume.
    pub(crate) fn surrounded(
        problem: &Problem<D>,
        mut particles: Particles<D>,
        frozen_lattice: Filling<D>,
        volume: f64,
    ) -> Self {
        for site in frozen_lattice.continued(&problem.domain, problem.frozen_depth()) {
            particles.push(site, Kind::Frozen, volume, None);
        }
        Self {
            particles,
            frozen_lattice,
        }
    }
}

/// Fills the box with free particles on the problem's lattice, and surrounds it with frozen ones.
///
/// # Errors
/// Those of [`Problem::check`].
pub fn seed<const D: usize>(problem: &Problem<D>) -> Result<Seeds<D>, PackingError> {
    problem.check_uniform()?;
    let filling = in_phase(problem, problem.filling());
    let volume = filling.volume_per_site();
    let mut particles = Particles::new(problem.sizes());
    for site in filling.sites() {
        particles.push(site, Kind::Free, volume, None);
    }
    let frozen = frozen_lattice(problem, filling);
    Ok(Seeds::surrounded(problem, particles, frozen, volume))
}

/// The lattice that fills the box, begun where the problem's seed says, and the one that continues it outside.
pub(crate) fn seed_lattice<const D: usize>(problem: &Problem<D>) -> (Filling<D>, Filling<D>) {
    let filling = problem.filling().shifted(phase(problem.seed));
    (filling, frozen_lattice(problem, filling))
}

fn frozen_lattice<const D: usize>(problem: &Problem<D>, filling: Filling<D>) -> Filling<D> {
    match problem.frozen {
        FrozenLayout::Lattice => filling,
        FrozenLayout::Square => {
            let ring = if D == 2 {
                Lattice::Square
            } else {
                Lattice::SimpleCubic
            };
            ring.fill(problem.domain.bounds, problem.spacing())
        }
    }
}

/// The particle surface of every body: the true surface moved inward by its inset.
///
/// # Errors
/// [`PackingError::Surface`] where nothing is left of a body.
pub fn particle_surfaces<const D: usize>(
    problem: &Problem<D>,
) -> Result<Vec<ParticleSurface<D>>, PackingError> {
    problem
        .bodies
        .iter()
        .map(|body| {
            let surface = if body.inset_over_spacing == 0.0 {
                body.surface.clone()
            } else {
                let depth = body.inset_over_spacing * problem.spacing();
                body.surface
                    .inset(depth)
                    .map_err(|source| PackingError::Surface {
                        body: body.name.clone(),
                        error: source,
                    })?
            };
            let target = surface.measure() / problem.spacing().powi(D as i32 - 1);
            Ok(ParticleSurface {
                surface,
                target_count: target.round().max(1.0) as usize,
            })
        })
        .collect()
}

/// Corners nearer than this to a fixed particle, in ∆s, get none of their own.
const CORNER_CLEARANCE: f64 = 0.5;

/// Puts the nearest free particle on every corner of every surface and fixes it there (Negi & Ramachandran 2021,
/// §3.1.1, fig. 4). Corners that crowd one another share a particle.
pub fn fix_corners<const D: usize>(
    particles: &mut Particles<D>,
    surfaces: &[ParticleSurface<D>],
    spacing: f64,
) {
    let corners: Vec<(u16, [f64; D])> = surfaces
        .iter()
        .zip(0_u16..)
        .flat_map(|(surface, body)| {
            surface
                .surface
                .features()
                .corners
                .into_iter()
                .map(move |c| (body, c))
        })
        .collect();
    if corners.is_empty() {
        return;
    }
    // The tree stands still while particles move onto corners: those are kinds other than free by then.
    let Ok(tree) = KdTree::new(&particles.position) else {
        return;
    };
    let mut taken: Vec<[f64; D]> = Vec::new();
    for (body, corner) in corners {
        let crowded = taken.iter().any(|&other| {
            sphpack_neighbors::point::distance(other, corner) < CORNER_CLEARANCE * spacing
        });
        if crowded {
            continue;
        }
        let near = tree.nearest_n(corner, 16);
        if let Some(hit) = near
            .into_iter()
            .find(|hit| particles.kind[hit.index] == Kind::Free)
        {
            particles.position[hit.index] = corner;
            particles.kind[hit.index] = Kind::Fixed;
            particles.body[hit.index] = Some(body);
            taken.push(corner);
        }
    }
}
