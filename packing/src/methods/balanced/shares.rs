//! Who gets how many particles, and how large they are.

use sphpack_geometry::Surface;
use sphpack_neighbors::point;

use crate::problem::Body;

/// The volumes on both sides of a true surface that its surface particles stand for: a layer ∆s thick around the
/// particle surface.
#[derive(Debug, Clone, Copy)]
struct Layer {
    inner: f64,
    outer: f64,
}

impl Layer {
    fn whole(self) -> f64 {
        self.inner + self.outer
    }

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
    /// The volume of each of their particles: together they have what the surface particles leave.
    pub(crate) particle_volume: f64,
}

/// Who gets what.
#[derive(Debug)]
pub(super) struct Shares {
    /// Each part's, in their order, and each pocket's of fluid behind.
    pub(super) regions: Vec<Share>,
    /// The volume of a surface particle of each part.
    pub(super) surface_volume: Vec<f64>,
}

/// A part of a body and its particle surface.
#[derive(Debug)]
pub(super) struct Held<'a, const D: usize> {
    pub(super) body: &'a Body<D>,
    /// That of its surface particles, scene units, and the volume that one of them has where space is evenly filled.
    pub(super) spacing: f64,
    pub(super) volume_per_point: f64,
    /// The volume that its surface particles stand for, where it is known otherwise than by a deeper inset.
    pub(super) layer: Option<f64>,
    pub(super) surface: &'a dyn Surface<D>,
    /// Particles on its surface.
    pub(super) points: usize,
    /// Points of it that were left to an earlier one: still part of its layer.
    pub(super) removed: usize,
    /// The volume that they stand for beyond the body's own.
    pub(super) excess: f64,
    /// Its own particles beside them, where that is known otherwise than by its volume; all share that evenly then.
    pub(super) inside: Option<usize>,
    /// How much of its surface particles is in which region, in particles: its own, and what lies beyond an exact surface.
    pub(super) reaches: Vec<(usize, f64)>,
}

/// Surface particles keep within this factor of a site's volume while there are others to take the rest.
const VOLUME_LIMIT: f64 = 1.5;

/// Rounds in which surface particles that have a region to themselves, and share others, find their volumes.
const ROUNDS: usize = 30;

/// No surface particle has less than this part of a site's volume.
const LEAST: f64 = 0.1;

/// Shares out the volume of every region, `room`: the parts' without what lies in them, and the pockets' of fluid behind; the
/// sum is the box's. Every region has its own to the last digit: its lattice sites take what surface particles leave. A
/// part with none, or with as many as it has places for (`most`), shares it evenly with its surface particles; one without
/// either (less than half a particle) has nothing. `sites` are as many particles as there are to be in all, where that is known;
/// `volume_per_site` is every region's.
pub(super) fn shares<const D: usize>(
    held: &[Held<'_, D>],
    room: &[f64],
    most: &[usize],
    sites: Option<usize>,
    volume_per_site: &[f64],
) -> Shares {
    let parts = held.len();
    let mut surface_volume: Vec<f64> = (held.iter())
        .map(|held| {
            // Points that were left to another body are still part of this one's layer.
            let count = (held.points + held.removed) as f64;
            let layer = || Layer::of(held.body, held.surface, held.spacing).whole();
            let whole = held.layer.unwrap_or_else(layer) + held.excess;
            (whole / count.max(1.0)).clamp(
                held.volume_per_point / VOLUME_LIMIT,
                held.volume_per_point * VOLUME_LIMIT,
            )
        })
        .collect();
    // What every region has of whose surface particles.
    let mut reached: Vec<Vec<(usize, f64)>> = vec![Vec::new(); room.len()];
    for (part, held) in held.iter().enumerate() {
        for &(region, count) in &held.reaches {
            reached[region].push((part, count));
        }
    }
    let rest = |region: usize, surface_volume: &[f64]| {
        let taken: f64 = (reached[region].iter())
            .map(|&(part, count)| count * surface_volume[part])
            .sum();
        room[region] - taken
    };
    let fit = |region: usize, surface_volume: &[f64]| {
        let fit = rest(region, surface_volume) / volume_per_site[region];
        fit.round().max(0.0) as usize
    };
    // Parts that have no place for all share their volume evenly; what that takes of others they have less.
    let is_full: Vec<bool> = (0..parts)
        .map(|part| {
            let fit = fit(part, &surface_volume);
            (fit == 0 || fit > most[part] || held[part].inside.is_some()) && held[part].points > 0
        })
        .collect();
    let own: Vec<usize> = (0..parts)
        .map(|part| {
            let asked = (held[part].inside).unwrap_or_else(|| fit(part, &surface_volume));
            asked.min(most[part])
        })
        .collect();
    for _ in 0..ROUNDS {
        for part in (0..parts).filter(|&part| is_full[part]) {
            let count = (held[part].reaches.iter())
                .find(|(region, _)| *region == part)
                .map_or(0.0, |&(_, count)| count);
            let all = count + own[part] as f64;
            if count > 0.0 {
                let left = rest(part, &surface_volume) + count * surface_volume[part];
                let least = held[part].volume_per_point * LEAST;
                surface_volume[part] = (left / all).max(least);
            }
        }
    }
    let main = parts;
    let mut own: Vec<usize> = (0..room.len())
        .map(|region| {
            if region < parts && is_full[region] {
                own[region]
            } else {
                fit(region, &surface_volume).min(most[region])
            }
        })
        .collect();
    // All sites that are left, unless bodies have almost all the room: then there may be some too many.
    if let Some(sites) = sites {
        let others: usize = own.iter().sum::<usize>() - own[main];
        let on_surface: usize = held.iter().map(|held| held.points).sum();
        let left = sites.saturating_sub(others + on_surface);
        if left as f64 <= VOLUME_LIMIT * own[main] as f64 {
            own[main] = left.min(most[main]);
        }
    }
    let regions = (own.into_iter().enumerate())
        .map(|(region, sites)| Share {
            sites,
            particle_volume: if sites > 0 {
                rest(region, &surface_volume) / sites as f64
            } else {
                volume_per_site[region]
            },
        })
        .collect();
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
            let around = outer.bounds().grown(BEHIND_OVER_SPACING * spacing);
            (0..b)
                // Most are elsewhere.
                .filter(|&a| around.contains_box(&bodies[a].surface.bounds()))
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
