//! Who gets how many particles, and which lattice sites they are.

use sphpack_geometry::Surface;
use sphpack_neighbors::point;

use super::clashes::Clash;
use crate::depths::Depths;
use crate::packed::ParticleSurface;
use crate::problem::{Body, Problem};

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

/// Surface particles keep within this factor of a site's volume while there are others to take the rest.
const VOLUME_LIMIT: f64 = 1.5;

/// Shares out `sites` lattice sites, as many particles as there are to be in all; `on_surface` counts each body's
/// surface particles. A region has the volume of its body, or of the box, without the bodies inside it that come
/// before, and without the layers of surface particles. Where a region has no room for a particle of its own beside its
/// surface particles, these have its whole volume; where it has neither, less than half a particle, its volume is left to
/// what is around it. The sum of all particles' volumes is the box's.
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
    let direct = directly_inside(bodies, problem.spacing);
    let mut left = sites.saturating_sub(on_surface.iter().sum());
    let mut regions: Vec<Share> = Vec::with_capacity(bodies.len() + 1);
    let mut surface_volume = Vec::with_capacity(bodies.len());
    // What each body takes from whatever is around it.
    let mut taken: Vec<f64> = Vec::with_capacity(bodies.len());
    for (number, body) in bodies.iter().enumerate() {
        let within: f64 = direct[number].iter().map(|&a| taken[a]).sum();
        let room = body.surface.volume() - within;
        let clash = clashes[number];
        // Points that were left to another body are still part of this one's layer.
        let count = (on_surface[number] + clash.removed) as f64;
        let layer = Layer::of(body, surfaces[number].surface.as_ref(), spacing);
        let whole = layer.inner + layer.outer;
        let inner_share = layer.inner / whole.max(f64::MIN_POSITIVE);
        let usual = (whole / count.max(1.0)).clamp(
            volume_per_site / VOLUME_LIMIT,
            volume_per_site * VOLUME_LIMIT,
        );
        let rest = room - usual * count * inner_share;
        let own = ((rest / volume_per_site).round().max(0.0) as usize).min(left);
        left -= own;
        // What the particles of the layer do not take is left to the sites within.
        let (volume, particle_volume) = if own > 0 {
            (usual, rest / own as f64)
        } else if count * inner_share > 0.0 {
            (room / (count * inner_share), volume_per_site)
        } else {
            (usual, volume_per_site)
        };
        let outer = volume * count * (1.0 - inner_share) - 0.5 * volume * clash.shared as f64;
        taken.push(if own > 0 || count > 0.0 {
            body.surface.volume() + outer.max(0.0)
        } else {
            within
        });
        surface_volume.push(volume);
        regions.push(Share {
            sites: own,
            particle_volume,
        });
    }
    let within: f64 = direct[bodies.len()].iter().map(|&a| taken[a]).sum();
    let room = problem.domain.bounds.volume() - within;
    let fit = (room / volume_per_site).round().max(0.0);
    // All sites that are left, unless bodies have almost all the room: then there may be some too many.
    let own = if left as f64 > VOLUME_LIMIT * fit {
        fit as usize
    } else {
        left
    };
    regions.push(Share {
        sites: own,
        particle_volume: if own > 0 {
            room / own as f64
        } else {
            volume_per_site
        },
    });
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
