//! Which particle belongs to what, and which are left out because of the bodies' roles.

use std::sync::Arc;

use sphpack_geometry::Surface;
use sphpack_packing::{Kind, Packed};
use sphpack_separation::{Labels, SeparationError, Side, separate};

use crate::scene::{Role, Scene};

/// How near to a surface particles are asked about it, in ∆s; the others follow their neighbours.
const REACH_OVER_SPACING: f64 = 2.0;

/// How far from the particle surface its layer reaches, in ∆s.
const LAYER_OVER_SPACING: f64 = 0.5;

/// Labels of all particles, frozen ones as fluid, and whether each is kept.
pub(crate) struct Sorted {
    pub(crate) labels: Labels,
    pub(crate) keep: Vec<bool>,
}

/// Sorts packed particles by body and role.
///
/// Solids and voids hold what is inside their particle surface; a container holds only its wall, the particles on its
/// surface. Left out are: particles beyond a container's wall, particles in a void (those on the surface of a void too,
/// unless it is exact: then they are fluid), and fluid where `fluid.fill` is false. Frozen particles count as fluid, and as
/// beyond any wall.
pub(crate) fn sort<const D: usize>(
    packed: &Packed<D>,
    scene: &Scene,
) -> Result<Sorted, SeparationError> {
    let particles = &packed.particles;
    let role = |body: u16| {
        scene
            .body
            .get(usize::from(body))
            .map_or(Role::Solid, |b| b.role)
    };
    // The bodies that hold their inside.
    let holders: Vec<u16> = (0..packed.surfaces.len() as u16)
        .filter(|&body| role(body) != Role::Container)
        .collect();
    let surface = |body: u16| packed.surfaces[usize::from(body)].surface.clone();
    let surfaces: Vec<Arc<dyn Surface<D>>> = holders.iter().map(|&body| surface(body)).collect();
    let inner: Vec<usize> = (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen)
        .collect();
    let positions: Vec<[f64; D]> = inner.iter().map(|&i| particles.position[i]).collect();
    let on_surface: Vec<Option<u16>> = inner
        .iter()
        .map(|&i| {
            let body = particles.body[i].filter(|_| particles.kind[i].is_on_surface())?;
            holders
                .iter()
                .position(|&holder| holder == body)
                .map(|place| place as u16)
        })
        .collect();
    let reach = REACH_OVER_SPACING * packed.spacing;
    let inside = separate(&positions, &on_surface, &surfaces, reach)?;

    // A particle that has slipped into the layer of surface particles is still part of what it was placed in.
    let placed_in: Vec<Option<u16>> = if packed.knows_sides {
        let near = LAYER_OVER_SPACING * packed.spacing;
        let mut held = inside.body;
        for ((held, &i), p) in held.iter_mut().zip(&inner).zip(&positions) {
            let body = particles.body[i]
                .and_then(|body| holders.iter().position(|&holder| holder == body))
                .map(|place| place as u16);
            let crossed = [*held, body].into_iter().flatten();
            let is_near = |place: u16| surfaces[usize::from(place)].closest_within(*p, near);
            if *held != body && crossed.clone().all(|place| is_near(place).is_some()) {
                *held = body;
            }
        }
        held
    } else {
        inside.body
    };

    let mut labels = Labels {
        side: vec![Side::Fluid; particles.len()],
        body: vec![None; particles.len()],
    };
    let mut keep = vec![true; particles.len()];
    for (&i, held) in inner.iter().zip(&placed_in) {
        let sits_on = particles.body[i].filter(|_| particles.kind[i].is_on_surface());
        let body = held.map(|place| holders[usize::from(place)]);
        match (body, sits_on) {
            (_, Some(wall)) if role(wall) == Role::Container => labels.body[i] = Some(wall),
            (Some(void), _) if role(void) == Role::Void => {
                let is_exact = scene.body[usize::from(void)].surface.0 == 0.0;
                keep[i] = sits_on == Some(void) && is_exact;
            }
            _ => labels.body[i] = body,
        }
        if labels.body[i].is_some() {
            labels.side[i] = Side::Solid;
        }
    }
    for body in 0..packed.surfaces.len() as u16 {
        if role(body) == Role::Container {
            let held = surface(body).inside_batch(&positions);
            for (&i, held) in inner.iter().zip(held) {
                keep[i] &= held || particles.kind[i].is_on_surface();
            }
        }
    }
    let is_contained = scene.body.iter().any(|body| body.role == Role::Container);
    for i in 0..particles.len() {
        let is_left_out = (!scene.fluid.fill && labels.side[i] == Side::Fluid)
            || (is_contained && particles.kind[i] == Kind::Frozen);
        keep[i] &= !is_left_out;
    }
    Ok(Sorted { labels, keep })
}
