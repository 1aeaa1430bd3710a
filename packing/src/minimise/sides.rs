//! Free particles stay on their side of every surface.

use std::io::{self, Write};

use rayon::prelude::*;
use sphpack_geometry::Closest;
use sphpack_neighbors::{Domain, KdTree, point};

use crate::off_bound::off_bound;
use crate::packed::ParticleSurface;
use crate::particles::{Kind, Particles};
use crate::problem::Body;
use crate::state::{Damaged, State, values};

/// No free particle comes nearer to a particle surface than this, in ∆s, if it was not nearer before. Those of the first layer
/// are 0.8 ∆s away.
const FLOOR: f64 = 0.4;

/// Outside, the distance from the true surface is asked, which is another one around corners: 0.45 ∆s less the inset, but
/// at least this, so that nobody crosses it.
const OUTSIDE: [f64; 2] = [0.45, 0.005];

/// A particle of the fluid that begins no deeper than this in a body, in ∆s, is put out of it: lattice planes along a flat face
/// are cut by number, so that some of a plane just within it are the fluid's.
const STRAYED: f64 = 0.4;

/// A particle this near to its floor, in ∆s, lies on it. Without some room rounding says who does (±10⁻¹⁷ on a
/// flat face, and on one that bends whoever slides is off by s²/2R), and the reaction of the surface comes and goes in
/// the forces: a minimiser then finds no rest (blades of a CAD mesh: 1,126 evaluations, 86 with it).
const ON_FLOOR: f64 = 0.004;

/// Free particles that have a surface particle within this, in ∆s, are watched. At the tail of an airfoil, where particles in the
/// middle stand for both sides, one was 1.7 ∆s from all of them, and went in.
const SIGHT: f64 = 2.2;

/// Watches the free particles near surfaces. Without it a few slip through the layer of a body's surface particles,
/// one by one over some hundred evaluations, wherever a disordered interior has the higher pressure; their body loses
/// their volume.
#[derive(Debug, Default)]
pub(super) struct Sides<const D: usize> {
    watched: Vec<Watched<D>>,
}

/// A free particle near a surface.
#[derive(Debug, Clone, Copy)]
struct Watched<const D: usize> {
    particle: u32,
    surface: u16,
    /// Whether it is out of the body and the true surface counts, not the particle surface.
    is_out: bool,
    /// 1 outside, −1 inside.
    side: f64,
    /// No nearer to the surface than this, on its side.
    floor: f64,
    /// So near to it, it lies on it.
    slack: f64,
    /// Where it was seen last, and how far it may go from there without being looked at.
    seen: [f64; D],
    room: f64,
    /// The normal where it lies on the floor, away from the surface.
    held: Option<[f64; D]>,
}

values!(Watched[const D: usize] {
    particle: u32,
    surface: u16,
    is_out: bool,
    side: f64,
    floor: f64,
    slack: f64,
    seen: [f64; D],
    room: f64,
    held: Option<[f64; D]>,
});

impl<const D: usize> Watched<D> {
    /// Looks at the particle anew, and puts it back where it came too near.
    fn look(&mut self, surfaces: &[ParticleSurface<D>], bodies: &[Body<D>], p: &mut [f64; D]) {
        let number = usize::from(self.surface);
        let surface = if self.is_out {
            &bodies[number].surface
        } else {
            &surfaces[number].surface
        };
        let hit = surface.closest(*p);
        let bound = Closest {
            normal: point::scale(hit.normal, -self.side),
            distance: -self.side * hit.distance,
            ..hit
        };
        let lacking = bound.distance + self.floor;
        self.held = (lacking >= -self.slack).then(|| point::scale(bound.normal, -1.0));
        if let Some(back) = off_bound(*p, &bound, self.floor) {
            *p = back;
        }
        self.seen = *p;
        // Who lies on the floor is looked at every time.
        self.room = -lacking - self.slack;
    }
}

impl<const D: usize> Sides<D> {
    /// Begins to watch, each particle on the side where it is now.
    pub(super) fn of(
        particles: &Particles<D>,
        surfaces: &[ParticleSurface<D>],
        bodies: &[Body<D>],
        domain: &Domain<D>,
    ) -> Self {
        let of_kind = |wanted: fn(Kind) -> bool| -> Vec<u32> {
            (0..particles.len() as u32)
                .filter(|&i| wanted(particles.kind[i as usize]))
                .collect()
        };
        let on_surface = of_kind(Kind::is_on_surface);
        let places: Vec<[f64; D]> = on_surface
            .iter()
            .map(|&i| domain.wrap(particles.position[i as usize]))
            .collect();
        let Ok(tree) = KdTree::new(&places) else {
            return Self::default();
        };
        let sizes = &particles.sizes;
        let watched = |&i: &u32| {
            let p = particles.position[i as usize];
            let spacing = sizes.spacing(i as usize);
            let sight = SIGHT * spacing;
            let mut around: Vec<u16> = (domain.images(p, sight))
                .flat_map(|image| tree.within(image, sight))
                .filter_map(|found| particles.body[on_surface[found.index] as usize])
                .collect();
            around.sort_unstable();
            around.dedup();
            around.into_iter().map(move |surface| {
                let number = usize::from(surface);
                // A site of the fluid may lie a little within a body: it goes out at once.
                let is_fluid = particles.body[i as usize].is_none();
                let deepest = if is_fluid { STRAYED * spacing } else { 0.0 };
                let out = (bodies.get(number))
                    .map(|body| (body.surface.closest(p).distance, body.inset_over_spacing))
                    .filter(|(distance, _)| *distance > -deepest);
                let (distance, floor) = match out {
                    Some((distance, inset)) if distance > 0.0 => {
                        let floor = (OUTSIDE[0] - inset).max(OUTSIDE[1]) * spacing;
                        (distance, floor.min(distance))
                    }
                    Some((distance, _)) => (distance, OUTSIDE[1] * spacing),
                    None => {
                        let distance = surfaces[number].surface.closest(p).distance;
                        (distance, (FLOOR * spacing).min(distance.abs()))
                    }
                };
                let side = if out.is_some() {
                    1.0
                } else {
                    distance.signum()
                };
                let slack = ON_FLOOR * spacing;
                Watched {
                    particle: i,
                    surface,
                    is_out: out.is_some(),
                    side,
                    floor,
                    slack,
                    seen: p,
                    room: side * distance - floor - slack,
                    held: None,
                }
            })
        };
        Self {
            watched: of_kind(|kind| kind == Kind::Free)
                .par_iter()
                .with_min_len(256)
                .flat_map_iter(watched)
                .collect(),
        }
    }

    /// Puts particles back that came too near to a surface.
    pub(super) fn keep(
        &mut self,
        particles: &mut Particles<D>,
        surfaces: &[ParticleSurface<D>],
        bodies: &[Body<D>],
    ) {
        let position = &particles.position;
        let moved: Vec<Option<[f64; D]>> = self
            .watched
            .par_iter_mut()
            .with_min_len(1024)
            .map(|watched| {
                let mut p = position[watched.particle as usize];
                if point::distance(p, watched.seen) <= watched.room {
                    return None;
                }
                watched.look(surfaces, bodies, &mut p);
                watched.held.map(|_| p)
            })
            .collect();
        for (watched, moved) in self.watched.iter().zip(moved) {
            if let Some(p) = moved {
                particles.position[watched.particle as usize] = p;
            }
        }
    }

    /// Appends who is watched, and what was seen.
    pub(super) fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.watched.save(out)
    }

    /// What was saved, of so many particles and surfaces.
    pub(super) fn load(
        &mut self,
        from: &mut &[u8],
        particles: usize,
        surfaces: usize,
    ) -> Result<(), Damaged> {
        self.watched.load(from)?;
        let is_known = |watched: &Watched<D>| {
            (watched.particle as usize) < particles && usize::from(watched.surface) < surfaces
        };
        (self.watched.iter().all(is_known))
            .then_some(())
            .ok_or(Damaged)
    }

    /// Particles that lie on their floor, and which way is away from the surface.
    pub(super) fn held(&self) -> impl Iterator<Item = (usize, [f64; D])> {
        self.watched
            .iter()
            .filter_map(|watched| watched.held.map(|away| (watched.particle as usize, away)))
    }
}
