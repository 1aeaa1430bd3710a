//! Where relaxation starts: a lattice for each body and for the fluid (Zhao et al. 2025, §2.1.2).

use sphpack_geometry::GeometryError;

use crate::depths::Depths;
use crate::lattice::{Filling, Lattice};
use crate::methods::balanced::rim::deepest;
use crate::methods::balanced::shares::{Share, directly_inside};
use crate::packed::ParticleSurface;
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::seeding::{Seeds, seed_lattice};

/// The particles at the start, each body's for itself.
///
/// The paper has "a preconditioned Lattice particle distribution within the interior domain" (Zhao et al. 2025,
/// §2.1.2) and says no more. Three choices (the boxes of the first are in `docs/methods.md`):
///
/// - A solid's lattice, unless the problem names one, is that of the least Γ at the solid's kernel and h
///   ([`Lattice::auto`]). With the paper's kernel and h/∆s = 1.05 a hexagonal lattice is unstable: in a
///   periodic box, with no body at all, it comes to rest with Γ between −1.4 and +1.0 % of its own. In bodies of a few
///   hundred particles the surface disturbs either lattice, and little is gained.
/// - N_s particles start evenly on the bounding set (eq. 7) and stay on it. Squeezing the sites beyond it onto it can put
///   two in one place, which feel no force from each other and never part. Eq. 7 alone lets particles leave the
///   set inward, and what is missing there is too much inside.
/// - Every region has the particles that its volume asks for, the rest of them the deepest sites, and shares its volume
///   among them evenly.
#[derive(Debug)]
pub(super) struct Start<const D: usize> {
    /// The solids' particles.
    pub(super) solids: Vec<Particles<D>>,
    /// The fluid's, and the frozen ones around the box.
    pub(super) fluid: Particles<D>,
    /// The lattice that the frozen ones continue.
    pub(super) frozen_lattice: Filling<D>,
}

impl<const D: usize> Start<D> {
    /// Of a problem whose bodies have the given particle surfaces.
    pub(super) fn of(
        problem: &Problem<D>,
        surfaces: &[ParticleSurface<D>],
        solid_h_over_spacing: f64,
    ) -> Result<Self, PackingError> {
        let bodies = problem.bodies.len();
        let lattice =
            (problem.lattice).unwrap_or(Lattice::auto(D, problem.kernel, solid_h_over_spacing));
        let solid_sites = Sites::of(problem, lattice);
        let room = room(problem, surfaces);
        let mut solids = Vec::with_capacity(bodies);
        for (number, held) in (0_u16..).zip(surfaces) {
            let region = usize::from(number);
            let share = solid_sites.share(room[region]);
            let on_surface = held.target_count.min(share.sites);
            let fail = |source: GeometryError| PackingError::Surface {
                body: problem.bodies[region].name.clone(),
                error: source,
            };
            let points = held.surface.sample(on_surface).map_err(fail)?;
            let deep = share.sites.saturating_sub(points.len());
            let mut solid = Particles::new(problem.sizes());
            let mut push = |place, kind| {
                solid.push(place, kind, share.particle_volume, Some(number));
            };
            for point in points {
                push(point.point, Kind::Boundary);
            }
            for site in solid_sites.deepest(problem, region, deep) {
                push(site, Kind::Free);
            }
            solids.push(solid);
        }
        let fluid_sites = Sites::of(problem, problem.chosen_lattice());
        let share = fluid_sites.share(room[bodies]);
        let mut fluid = Particles::new(problem.sizes());
        for site in fluid_sites.deepest(problem, bodies, share.sites) {
            fluid.push(site, Kind::Free, share.particle_volume, None);
        }
        let (_, frozen_lattice) = seed_lattice(problem);
        let Seeds {
            particles: fluid,
            frozen_lattice,
        } = Seeds::surrounded(problem, fluid, frozen_lattice, fluid_sites.volume);
        Ok(Self {
            solids,
            fluid,
            frozen_lattice,
        })
    }
}

/// A lattice that fills the box, and how deep its sites are in the bodies.
struct Sites<const D: usize> {
    sites: Vec<[f64; D]>,
    depths: Depths,
    /// That of the box, per site.
    volume: f64,
}

impl<const D: usize> Sites<D> {
    fn of(problem: &Problem<D>, lattice: Lattice) -> Self {
        let own = Problem {
            lattice: Some(lattice),
            ..problem.clone()
        };
        let (filling, _) = seed_lattice(&own);
        let (sites, bounds) = (filling.sites(), problem.domain.bounds);
        let (spacing, near) = (problem.spacing(), 2.0 * problem.spacing());
        Self {
            depths: Depths::of(&problem.bodies, bounds, spacing, near, &sites),
            sites,
            volume: filling.volume_per_site(),
        }
    }

    /// The particles of a region of the given volume.
    fn share(&self, volume: f64) -> Share {
        let sites = (volume / self.volume).round().max(1.0) as usize;
        Share {
            sites,
            particle_volume: volume / sites as f64,
        }
    }

    /// The deepest sites of a region, the bodies' or, last, the fluid's.
    fn deepest(&self, problem: &Problem<D>, region: usize, count: usize) -> Vec<[f64; D]> {
        let depths = (0..self.sites.len()).map(|i| (i, self.depths.within(region, i)));
        let mut kept = deepest(depths, count, problem.spacing(), problem.seed);
        kept.sort_unstable();
        kept.into_iter().map(|i| self.sites[i]).collect()
    }
}

/// The volume of every body, and of the fluid last, without the bodies in it that come before. A body's reaches as far
/// as its surface particles do, ∆s/2 beyond its surface where they sit on it.
fn room<const D: usize>(problem: &Problem<D>, surfaces: &[ParticleSurface<D>]) -> Vec<f64> {
    let bodies = &problem.bodies;
    let volume = |number: usize| {
        let (body, held) = (&bodies[number], &surfaces[number].surface);
        body.surface.volume() + (1.0 - body.inner_share()) * held.measure() * problem.spacing()
    };
    (directly_inside(bodies, problem.spacing())
        .into_iter()
        .enumerate())
    .map(|(region, within)| {
        let whole = if region < bodies.len() {
            volume(region)
        } else {
            problem.domain.bounds.volume()
        };
        let taken: f64 = within.iter().map(|&a| volume(a)).sum();
        (whole - taken).max(0.0)
    })
    .collect()
}
