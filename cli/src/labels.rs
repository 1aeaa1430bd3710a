//! Which particle belongs to what, and which are left out because of the bodies' roles.

use sphpack_geometry::Surface;
use sphpack_packing::{Kind, Packed};
use sphpack_separation::{Labels, SeparationError, Side, separate_by_flood};

use crate::asked::Asked;
use crate::scene::Role;

/// How near to a surface particles are asked about it, in ∆s; the others follow their neighbours.
const REACH_OVER_SPACING: f64 = 2.0;

/// How far from the particle surface its layer reaches, in ∆s.
const LAYER_OVER_SPACING: f64 = 0.5;

/// Labels of all particles, frozen ones as fluid, and whether each is kept.
pub(crate) struct Sorted {
    pub(crate) labels: Labels,
    pub(crate) keep: Vec<bool>,
}

/// How many particles are asked about surfaces at once, so that the answers never take more memory than they.
const AT_ONCE: usize = 1 << 18;

/// Sorts packed particles by body and role.
///
/// Solids and voids hold what is inside their particle surface; a container holds only its wall, the particles on its
/// surface. Left out are: particles beyond every container's wall, particles in a void (those on the surface of a void too,
/// unless it is exact: then they belong to what is around it, a solid or the fluid), and fluid where `fluid.fill` is false.
/// Frozen particles count as fluid, and as beyond any wall.
pub(crate) fn sort<const D: usize>(
    packed: &Packed<D>,
    asked: &Asked,
) -> Result<Sorted, SeparationError> {
    let particles = &packed.particles;
    let role = |body: u16| asked.role(usize::from(body));
    // The bodies that hold their inside.
    let holders: Vec<u16> = (0..packed.surfaces.len() as u16)
        .filter(|&body| role(body) != Role::Container)
        .collect();
    let surface = |body: u16| packed.surfaces[usize::from(body)].surface.as_ref();
    let surfaces: Vec<&dyn Surface<D>> = holders.iter().map(|&body| surface(body)).collect();
    let inner: Vec<usize> = (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen)
        .collect();
    let on_surface: Vec<Option<u16>> = inner
        .iter()
        .map(|&i| {
            let body = particles.on_surface(i)?;
            place_of(&holders, body)
        })
        .collect();
    let held = if packed.knows_sides {
        let placed: Vec<Option<u16>> = (inner.iter())
            .map(|&i| place_of(&holders, particles.body[i]?))
            .collect();
        known(packed, &inner, &on_surface, &placed, &surfaces)
    } else {
        let positions: Vec<[f64; D]> = inner.iter().map(|&i| particles.position[i]).collect();
        let reach = REACH_OVER_SPACING * packed.spacing;
        separate_by_flood(&positions, &on_surface, &surfaces, reach)?.body
    };

    let mut labels = Labels {
        side: vec![Side::Fluid; particles.len()],
        body: vec![None; particles.len()],
    };
    let mut keep = vec![true; particles.len()];
    for (&i, held) in inner.iter().zip(&held) {
        let sits_on = particles.on_surface(i);
        let body = held.map(|place| holders[usize::from(place)]);
        match (body, sits_on) {
            (_, Some(wall)) if role(wall) == Role::Container => labels.body[i] = Some(wall),
            (Some(void), _) if role(void) == Role::Void => {
                let is_exact = packed.problem.bodies[usize::from(void)].inset_over_spacing == 0.0;
                keep[i] = sits_on == Some(void) && is_exact;
                if keep[i] {
                    let around = |&solid: &u16| {
                        role(solid) == Role::Solid && surface(solid).inside(particles.position[i])
                    };
                    labels.body[i] = holders.iter().copied().find(around);
                }
            }
            _ => labels.body[i] = body,
        }
        if labels.body[i].is_some() {
            labels.side[i] = Side::Solid;
        }
    }
    let containers: Vec<u16> = (0..packed.surfaces.len() as u16)
        .filter(|&body| role(body) == Role::Container)
        .collect();
    let is_contained = !containers.is_empty();
    for inner in inner.chunks(AT_ONCE) {
        let positions: Vec<[f64; D]> = inner.iter().map(|&i| particles.position[i]).collect();
        let mut is_held = vec![!is_contained; inner.len()];
        for &container in &containers {
            let held = surface(container).inside_batch(&positions);
            (is_held.iter_mut().zip(held)).for_each(|(any, held)| *any |= held);
        }
        for (&i, is_held) in inner.iter().zip(is_held) {
            keep[i] &= is_held || particles.kind[i].is_on_surface();
        }
    }
    for i in 0..particles.len() {
        let is_left_out = (!asked.has_fluid && labels.side[i] == Side::Fluid)
            || (is_contained && particles.kind[i] == Kind::Frozen);
        keep[i] &= !is_left_out;
    }
    Ok(Sorted { labels, keep })
}

/// The place of a body among those that hold their inside.
fn place_of(holders: &[u16], body: u16) -> Option<u16> {
    let place = holders.iter().position(|&holder| holder == body)?;
    Some(place as u16)
}

/// Which surface holds each of the particles `inner`, where it is known in which each was `placed`. Those far from every
/// surface are where they were placed; the others are asked. A particle that has slipped into the layer of surface
/// particles is still part of what it was placed in.
fn known<const D: usize>(
    packed: &Packed<D>,
    inner: &[usize],
    on_surface: &[Option<u16>],
    placed: &[Option<u16>],
    surfaces: &[&dyn Surface<D>],
) -> Vec<Option<u16>> {
    let layer = LAYER_OVER_SPACING * packed.spacing;
    let reach = REACH_OVER_SPACING * packed.spacing;
    let mut all = placed.to_vec();
    let chunks = (inner.chunks(AT_ONCE).zip(on_surface.chunks(AT_ONCE)))
        .zip(placed.chunks(AT_ONCE).zip(all.chunks_mut(AT_ONCE)));
    for ((inner, on_surface), (placed, all)) in chunks {
        let positions: Vec<[f64; D]> = (inner.iter())
            .map(|&i| packed.particles.position[i])
            .collect();
        // The surfaces near to each particle, ascending, and the signed distances from them. A list for each, as few are
        // near: a column for every surface would take 440 MiB for 94,000 particles and 100 bodies.
        let mut near: Vec<Vec<(u16, f64)>> = vec![Vec::new(); positions.len()];
        for (surface, place) in surfaces.iter().zip(0_u16..) {
            let hits = surface.closest_batch(&positions, reach);
            for (near, hit) in near.iter_mut().zip(hits) {
                near.extend(hit.map(|hit| (place, hit.distance)));
            }
        }
        for (i, held) in all.iter_mut().enumerate() {
            let distance = |place: u16| {
                let mut near = near[i].iter();
                near.find(|(near, _)| *near == place)
                    .map(|(_, distance)| *distance)
            };
            let is_within = |place: u16| match distance(place) {
                Some(distance) => distance < 0.0,
                None => placed[i] == Some(place),
            };
            let is_beside =
                |place: u16| distance(place).is_some_and(|distance| distance.abs() <= layer);
            let found =
                on_surface[i].or_else(|| (0..surfaces.len() as u16).find(|&s| is_within(s)));
            let mut crossed = [found, placed[i]].into_iter().flatten();
            if found != placed[i] && !crossed.all(is_beside) {
                *held = found;
            }
        }
    }
    all
}
