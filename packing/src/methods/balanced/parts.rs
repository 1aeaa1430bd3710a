//! Bodies taken apart: every connected part is packed as a body of its own, so that none pays for another.

use std::sync::Arc;

use sphpack_geometry::Surface;

use super::shares::directly_inside;
use crate::packed::{Omitted, Packed};
use crate::problem::{Body, Problem};

/// A problem whose bodies are in one piece each.
#[derive(Debug)]
pub(crate) struct Parts<const D: usize> {
    /// The problem with a body for every part, in the order of the bodies.
    pub(crate) problem: Problem<D>,
    /// The body that each part is of.
    owner: Vec<u16>,
    /// How many bodies there are.
    bodies: usize,
    /// Whether any has more than one part.
    is_split: bool,
}

impl<const D: usize> Parts<D> {
    /// Takes the bodies apart; leaves them whole where there would be more parts than numbers for them.
    pub(crate) fn of(problem: &Problem<D>) -> Self {
        let parts: Vec<Vec<Arc<dyn Surface<D>>>> = (problem.bodies.iter())
            .map(|body| body.surface.parts())
            .collect();
        let count: usize = parts.iter().map(|parts| parts.len().max(1)).sum();
        let mut all = Self {
            problem: problem.clone(),
            owner: (0..problem.bodies.len()).map(|b| b as u16).collect(),
            bodies: problem.bodies.len(),
            is_split: false,
        };
        if count == problem.bodies.len() || count > usize::from(u16::MAX) {
            return all;
        }
        all.is_split = true;
        all.owner.clear();
        all.problem.bodies.clear();
        for ((body, parts), number) in problem.bodies.iter().zip(parts).zip(0_u16..) {
            let parts = if parts.is_empty() {
                vec![body.surface.clone()]
            } else {
                parts
            };
            for surface in parts {
                all.owner.push(number);
                all.problem.bodies.push(Body {
                    surface,
                    ..body.clone()
                });
            }
        }
        all
    }

    /// The volume of every part without what lies in it, and of the fluid last, scene units to the power D.
    pub(crate) fn rooms(&self) -> Vec<f64> {
        let bodies = &self.problem.bodies;
        let volume = |part: usize| bodies[part].surface.volume();
        let inside = directly_inside(bodies, self.problem.spacing());
        (inside.into_iter().enumerate())
            .map(|(region, within)| {
                let whole = if region < bodies.len() {
                    volume(region)
                } else {
                    self.problem.domain.bounds.volume()
                };
                whole - within.into_iter().map(volume).sum::<f64>()
            })
            .collect()
    }

    /// The body that a part is of; the number of bodies for the fluid behind the parts.
    pub(crate) fn owner(&self, part: usize) -> usize {
        self.owner
            .get(part)
            .map_or(self.bodies, |&body| usize::from(body))
    }

    /// The packing of the parts as one of the bodies, whose particle surfaces are `surface`.
    pub(crate) fn gather(
        &self,
        mut packed: Packed<D>,
        problem: &Problem<D>,
        surface: impl Fn(&Body<D>) -> Option<Arc<dyn Surface<D>>>,
    ) -> Packed<D> {
        if !self.is_split {
            return packed;
        }
        for part in packed.particles.body.iter_mut().flatten() {
            *part = self.owner[usize::from(*part)];
        }
        for Omitted { body, .. } in &mut packed.omitted {
            *body = usize::from(self.owner[*body]);
        }
        let mut excess = vec![0.0; problem.bodies.len()];
        for (part, more) in packed.excess.iter().enumerate() {
            excess[usize::from(self.owner[part])] += more;
        }
        packed.excess = excess;
        let mut targets = vec![0; problem.bodies.len()];
        for (part, &owner) in packed.surfaces.iter().zip(&self.owner) {
            targets[usize::from(owner)] += part.target_count;
        }
        packed.surfaces = (problem.bodies.iter().zip(targets))
            .map(|(body, target_count)| crate::ParticleSurface {
                surface: surface(body).unwrap_or_else(|| body.surface.clone()),
                target_count,
            })
            .collect();
        packed.problem = problem.clone();
        packed.bodies = problem
            .bodies
            .iter()
            .map(|body| body.name.clone())
            .collect();
        packed
    }
}

impl<const D: usize> Problem<D> {
    /// The volume of every body without the bodies in it that come before, and that of the box without all of them last,
    /// scene units to the power D.
    pub fn rooms(&self) -> Vec<f64> {
        let parts = Parts::of(self);
        let room = parts.rooms();
        let mut rooms = vec![0.0; self.bodies.len() + 1];
        for (region, room) in room.into_iter().enumerate() {
            rooms[parts.owner(region)] += room;
        }
        rooms
    }
}
