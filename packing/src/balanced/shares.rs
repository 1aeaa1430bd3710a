//! Who gets how many particles, and which lattice sites they are.

use rayon::prelude::*;
use sphpack_geometry::Surface;
use sphpack_neighbors::{Bounds, point};

use super::clashes::Clash;
use crate::packed::ParticleSurface;
use crate::problem::{Body, Problem};

/// Sites per edge of a cube of sites that is asked about as a whole.
const CUBE: f64 = 4.0;

/// Signed distances of sites to every body: exact near a surface, right to first order and of the right sign elsewhere.
#[derive(Debug)]
pub(crate) struct Depths {
    bodies: usize,
    /// Site after site, one entry per body.
    phi: Vec<f64>,
}

/// What is seen of a body from a place: the signed distance, and the direction in which it grows.
#[derive(Debug, Clone, Copy)]
struct Seen<const D: usize> {
    distance: f64,
    gradient: [f64; D],
}

impl<const D: usize> Seen<D> {
    fn from(body: &Body<D>, place: [f64; D]) -> Self {
        let hit = body.surface.closest(place);
        let away = point::unit(point::sub(place, hit.point)).unwrap_or([0.0; D]);
        Self {
            distance: hit.distance,
            gradient: point::scale(away, hit.distance.signum()),
        }
    }
}

impl Depths {
    /// How far a distance may be off where it is not exact, scene units.
    pub(super) fn error<const D: usize>(spacing: f64) -> f64 {
        CUBE * spacing * (D as f64).sqrt()
    }

    /// Exact within `near` (scene units) of a surface, and nowhere nearer than that by mistake. One query per cube of
    /// [`CUBE`] sites a side, and one per site where that cube is near a surface; elsewhere the distance of the cube's
    /// middle is continued along its gradient, off by the cube's diagonal at most.
    pub(crate) fn of<const D: usize>(
        bodies: &[Body<D>],
        bounds: Bounds<D>,
        spacing: f64,
        near: f64,
        sites: &[[f64; D]],
    ) -> Self {
        let size = bounds.size();
        let cubes: [usize; D] =
            std::array::from_fn(|k| (size[k] / (CUBE * spacing)).ceil().max(1.0) as usize);
        let edge: [f64; D] = std::array::from_fn(|k| size[k] / cubes[k] as f64);
        let radius = 0.5 * point::norm(edge);
        let centers: Vec<[f64; D]> = (0..cubes.iter().product::<usize>())
            .map(|cube| {
                let mut rest = cube;
                std::array::from_fn(|k| {
                    let i = rest % cubes[k];
                    rest /= cubes[k];
                    bounds.min[k] + edge[k] * (i as f64 + 0.5)
                })
            })
            .collect();
        let far: Vec<Vec<Seen<D>>> = bodies
            .iter()
            .map(|body| {
                centers
                    .par_iter()
                    .with_min_len(64)
                    .map(|&c| Seen::from(body, c))
                    .collect()
            })
            .collect();
        let cube_of = |p: [f64; D]| {
            let mut cube = 0;
            for k in (0..D).rev() {
                // The cast saturates at 0.
                let i = ((p[k] - bounds.min[k]) / edge[k]) as usize;
                cube = cube * cubes[k] + i.min(cubes[k] - 1);
            }
            cube
        };
        let mut phi = vec![0.0; sites.len() * bodies.len()];
        if !bodies.is_empty() {
            phi.par_chunks_mut(bodies.len())
                .zip(sites)
                .with_min_len(256)
                .for_each(|(phi, &site)| {
                    let cube = cube_of(site);
                    for ((phi, body), far) in phi.iter_mut().zip(bodies).zip(&far) {
                        let seen = &far[cube];
                        *phi = if seen.distance.abs() > radius + near {
                            let way = point::sub(site, centers[cube]);
                            seen.distance + point::dot(seen.gradient, way)
                        } else {
                            body.surface.closest(site).distance
                        };
                    }
                });
        }
        Self {
            bodies: bodies.len(),
            phi,
        }
    }

    /// How far a site is from the nearest surface, infinite where there is none.
    pub(super) fn to_surface(&self, site: usize) -> f64 {
        self.phi[site * self.bodies..(site + 1) * self.bodies]
            .iter()
            .fold(f64::INFINITY, |least, phi| least.min(phi.abs()))
    }

    /// How deep a site is in a region, negative outside: in body `region` and no earlier one, or, with `region` the
    /// number of bodies, in the fluid.
    pub(super) fn within(&self, region: usize, site: usize) -> f64 {
        let phi = &self.phi[site * self.bodies..(site + 1) * self.bodies];
        let outside = phi[..region].iter().copied().fold(f64::INFINITY, f64::min);
        match phi.get(region) {
            Some(&own) => outside.min(-own),
            None => outside,
        }
    }
}

/// The volumes on both sides of a true surface that its surface particles stand for: a layer ∆s thick around the
/// particle surface.
#[derive(Debug, Clone, Copy)]
struct Layer {
    inner: f64,
    outer: f64,
}

impl Layer {
    /// For an inset surface, exactly what a deeper inset of the body leaves. For one that is nearer to the true surface
    /// than ∆s/2, by the convention of all volume balances: its area times ∆s, in the parts that count as inside and
    /// outside. (Where the surface bends, less than that is inside: 1.1 % of the bunny at ∆s = 0.05. The sites beside
    /// the surface make up for it by some hundredths of ∆s; Γ changes by 0.1 %.)
    fn of<const D: usize>(body: &Body<D>, surface: &dyn Surface<D>, spacing: f64) -> Self {
        if body.inset_over_spacing < 0.5 {
            let whole = surface.measure() * spacing;
            return Self {
                inner: body.inner_share() * whole,
                outer: (1.0 - body.inner_share()) * whole,
            };
        }
        let volume = body.surface.volume();
        let depth = (body.inset_over_spacing + 0.5) * spacing;
        let core = body
            .surface
            .inset(depth)
            .map_or(0.0, |core| core.volume().clamp(0.0, volume));
        Self {
            inner: volume - core,
            outer: 0.0,
        }
    }
}

/// What a region, a body or the fluid, is to hold beside surface particles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Share {
    /// Its lattice sites.
    pub(crate) sites: usize,
    /// The volume of each of their particles: together they have what the layers of surface particles leave.
    pub(crate) particle_volume: f64,
}

/// Who gets what.
#[derive(Debug)]
pub(super) struct Shares {
    /// Each body's, in their order, and the fluid's last.
    pub(super) regions: Vec<Share>,
    /// The volume of a surface particle of each body: together they have their layer's.
    pub(super) surface_volume: Vec<f64>,
}

/// Volumes stay within this factor of a site's, whatever the bodies' formulas say.
const VOLUME_LIMIT: f64 = 1.5;

/// Shares out `sites` lattice sites, as many particles as there are to be in all; `on_surface` counts each body's
/// surface particles. A region has the volume of its body, or of the box, without the bodies inside it that come
/// before, and without the layers of surface particles. The sum of all particles' volumes is the box's.
pub(super) fn shares<const D: usize>(
    problem: &Problem<D>,
    surfaces: &[ParticleSurface<D>],
    on_surface: &[usize],
    clashes: &[Clash],
    sites: usize,
    volume_per_site: f64,
) -> Shares {
    let bodies = &problem.bodies;
    let spacing = volume_per_site.powf(1.0 / D as f64);
    let mut layers: Vec<Layer> = bodies
        .iter()
        .zip(surfaces)
        .map(|(body, surface)| Layer::of(body, surface.surface.as_ref(), spacing))
        .collect();
    let surface_volume: Vec<f64> = layers
        .iter_mut()
        .zip(on_surface.iter().zip(clashes))
        .map(|(layer, (&count, clash))| {
            // Points that were left to another body are still part of this one's layer.
            let count = count + clash.removed;
            let whole = layer.inner + layer.outer;
            let one = whole / count.max(1) as f64;
            let volume = one.clamp(
                volume_per_site / VOLUME_LIMIT,
                volume_per_site * VOLUME_LIMIT,
            );
            // What the particles of the layer do not take is left to the sites around.
            let taken = volume * count as f64 / whole.max(f64::MIN_POSITIVE);
            *layer = Layer {
                inner: layer.inner * taken,
                outer: (layer.outer * taken - 0.5 * volume * clash.shared as f64).max(0.0),
            };
            volume
        })
        .collect();
    let direct = directly_inside(bodies, problem.spacing);
    let mut left = sites.saturating_sub(on_surface.iter().sum());
    let mut regions = Vec::with_capacity(bodies.len() + 1);
    for region in 0..=bodies.len() {
        let mut volume = match bodies.get(region) {
            Some(body) => body.surface.volume() - layers[region].inner,
            None => problem.domain.bounds.volume(),
        };
        for &a in &direct[region] {
            volume -= bodies[a].surface.volume() + layers[a].outer;
        }
        let own = if region < bodies.len() {
            ((volume / volume_per_site).round().max(0.0) as usize).min(left)
        } else {
            left
        };
        left -= own;
        let particle_volume = if own > 0 {
            (volume / own as f64).clamp(
                volume_per_site / VOLUME_LIMIT,
                volume_per_site * VOLUME_LIMIT,
            )
        } else {
            volume_per_site
        };
        regions.push(Share {
            sites: own,
            particle_volume,
        });
    }
    Shares {
        regions,
        surface_volume,
    }
}

/// For every body, and for the fluid last, the bodies that come before and lie in it, without those inside another of
/// them.
pub(crate) fn directly_inside<const D: usize>(bodies: &[Body<D>], spacing: f64) -> Vec<Vec<usize>> {
    let mut inside: Vec<Vec<usize>> = (0..bodies.len())
        .map(|b| {
            let outer = bodies[b].surface.as_ref();
            (0..b)
                .filter(|&a| is_inside(bodies[a].surface.as_ref(), outer, spacing))
                .collect()
        })
        .collect();
    inside.push((0..bodies.len()).collect());
    (inside.iter())
        .map(|within| {
            (within.iter().copied())
                .filter(|a| !within.iter().any(|&c| inside[c].contains(a)))
                .collect()
        })
        .collect()
}

/// How far behind a body's surface it is asked whether another holds it, in ∆s: more than what bodies that touch may be
/// in each other, so that the common side of two is in neither's way.
const BEHIND_OVER_SPACING: f64 = 0.2;

/// Whether the whole of `inner` is in `outer`, if their surfaces do not pass through each other.
fn is_inside<const D: usize>(inner: &dyn Surface<D>, outer: &dyn Surface<D>, spacing: f64) -> bool {
    let at = inner.closest(inner.bounds().center());
    let behind = point::add_scaled(at.point, -BEHIND_OVER_SPACING * spacing, at.normal);
    outer.inside(behind)
}

/// The region of every site that is kept, `None` for those left out: in every region the deepest are kept. Fewer than
/// asked for only where there are not enough sites. Depths are compared to within 10⁻⁹ ∆s, so that neither the unit of
/// length nor the place of the origin decides between equals.
pub(crate) fn choose(
    depths: &Depths,
    sites: usize,
    regions: &[Share],
    spacing: f64,
    seed: u64,
) -> Vec<Option<usize>> {
    let mut region_of = vec![None; sites];
    for (region, share) in regions.iter().enumerate() {
        let mut candidates: Vec<(f64, u64, usize)> = (0..sites)
            .filter(|&i| region_of[i].is_none())
            .map(|i| {
                let depth = (depths.within(region, i) / spacing * 1e9).round();
                (depth, scrambled(i as u64 ^ seed), i)
            })
            .collect();
        // Deepest first; equals in no order that favours a side.
        let order =
            |a: &(f64, u64, usize), b: &(f64, u64, usize)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
        if share.sites < candidates.len() {
            candidates.select_nth_unstable_by(share.sites, order);
            candidates.truncate(share.sites);
        }
        for (_, _, i) in candidates {
            region_of[i] = Some(region);
        }
    }
    region_of
}

/// A one-to-one scramble of 64 bits (the finaliser of SplitMix64).
fn scrambled(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
