//! Particles that live on surfaces: capturing them and keeping them there.

use std::io::{self, Write};

use rayon::prelude::*;
use sphpack_geometry::{Closest, within_window};
use sphpack_neighbors::point;

use crate::packed::ParticleSurface;
use crate::particles::{Kind, Particles};
use crate::state::{Damaged, State, load_as_many};

/// The boundary particles and the outward normals where they sit.
#[derive(Debug, Clone, Default)]
pub struct OnSurface<const D: usize> {
    /// Particle indices, ascending.
    pub index: Vec<usize>,
    /// Normals by particle, zero for those that are not on a surface.
    normal_of: Vec<[f64; D]>,
    /// The last projection's answers, kept for their memory.
    hits: Vec<Option<Closest<D>>>,
}

impl<const D: usize> OnSurface<D> {
    /// Finds the boundary particles anew.
    pub fn refresh(&mut self, particles: &Particles<D>) {
        self.index.clear();
        self.index
            .extend((0..particles.len()).filter(|&i| particles.kind[i] == Kind::Boundary));
        self.normal_of.clear();
        self.normal_of.resize(particles.len(), [0.0; D]);
    }

    /// Moves every boundary particle to the nearest point of its surface and takes the normal there. A particle that
    /// finds no surface within `reach` stays where it is.
    pub fn project(
        &mut self,
        particles: &mut Particles<D>,
        surfaces: &[ParticleSurface<D>],
        reach: f64,
    ) {
        self.project_by(particles, |p, body| {
            let surface = surfaces.get(usize::from(body))?.surface.as_ref();
            let hit = surface.closest_within(p, reach)?;
            // Where the body goes on beyond the box its particles do not.
            Some(match surface.window() {
                Some(window) => within_window(surface, &window, hit),
                None => hit,
            })
        });
    }

    /// [`OnSurface::project`] to wherever `nearest` says, of a place and a body.
    pub fn project_by(
        &mut self,
        particles: &mut Particles<D>,
        nearest: impl Fn([f64; D], u16) -> Option<Closest<D>> + Sync,
    ) {
        self.index
            .par_iter()
            .with_min_len(64)
            .map(|&i| nearest(particles.position[i], particles.body[i].unwrap_or(0)))
            .collect_into_vec(&mut self.hits);
        for (&i, hit) in self.index.iter().zip(&self.hits) {
            if let Some(hit) = hit {
                particles.position[i] = hit.point;
                self.normal_of[i] = hit.normal;
            }
        }
    }

    /// `v` without its part along the surface normal of particle `i`; `v` itself for particles on no surface.
    #[inline]
    pub fn tangential(&self, i: usize, v: [f64; D]) -> [f64; D] {
        point::reject(v, self.normal_of[i])
    }
}

impl<const D: usize> State for OnSurface<D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.normal_of.save(out)?;
        self.index.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        load_as_many(&mut self.normal_of, from)?;
        self.index.load(from)?;
        (self.index.iter().all(|&i| i < self.normal_of.len()))
            .then_some(())
            .ok_or(Damaged)
    }
}

/// Turns every free particle within `distance` (scene units) of a surface into a boundary particle of the nearest
/// one; returns how many. Negi & Ramachandran (2021), algorithm 1, with the exact closest point in place of r_pb ·
/// n_b.
pub fn capture<const D: usize>(
    particles: &mut Particles<D>,
    surfaces: &[ParticleSurface<D>],
    distance: f64,
) -> usize {
    let free: Vec<usize> = (0..particles.len())
        .filter(|&i| particles.kind[i] == Kind::Free)
        .collect();
    let nearest: Vec<Option<u16>> = free
        .par_iter()
        .with_min_len(256)
        .map(|&i| {
            let mut best: Option<(f64, u16)> = None;
            for (surface, body) in surfaces.iter().zip(0_u16..) {
                if let Some(hit) = surface
                    .surface
                    .closest_within(particles.position[i], distance)
                {
                    let d = hit.distance.abs();
                    if d < distance && best.is_none_or(|(least, _)| d < least) {
                        best = Some((d, body));
                    }
                }
            }
            best.map(|(_, body)| body)
        })
        .collect();
    let mut captured = 0;
    for (&i, body) in free.iter().zip(nearest) {
        if let Some(body) = body {
            particles.kind[i] = Kind::Boundary;
            particles.body[i] = Some(body);
            captured += 1;
        }
    }
    captured
}
