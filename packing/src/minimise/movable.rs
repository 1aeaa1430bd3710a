//! What moves, and what holds it: surfaces, sides of surfaces, sides of the box.

use std::io::{self, Write};
use std::time::Instant;

use rayon::prelude::*;
use sphpack_neighbors::{Domain, point};

use super::sides::Sides;
use super::walls::Walls;
use crate::on_surface::OnSurface;
use crate::packed::ParticleSurface;
use crate::particles::{Kind, Particles};
use crate::problem::Body;
use crate::state::{Damaged, State, Value};

/// The mobile particles of a set: free ones, and boundary ones that stay on their surfaces, in which coordinates of
/// particles that differ in size are divided by their size over the finest.
#[derive(Debug)]
pub(crate) struct Movable<'a, const D: usize> {
    pub(crate) particles: &'a mut Particles<D>,
    surfaces: &'a [ParticleSurface<D>],
    bodies: &'a [Body<D>],
    on_surface: OnSurface<D>,
    sides: Sides<D>,
    walls: Walls<D>,
    reach: f64,
    /// What every particle's coordinates are divided by; empty where by nothing.
    scale: Vec<f64>,
    pub(crate) mobile: Vec<u32>,
    is_surface_held: bool,
    /// Seconds spent on keeping particles where they belong.
    pub(crate) seconds: f64,
}

/// Times that surface particles are moved off a side of the box and back onto their surface.
const PUSHES: usize = 4;

impl<'a, const D: usize> Movable<'a, D> {
    /// Boundary particles are put onto their surfaces first, which are looked for within `reach` (scene units).
    pub(crate) fn new(
        particles: &'a mut Particles<D>,
        surfaces: &'a [ParticleSurface<D>],
        domain: Domain<D>,
        reach: f64,
    ) -> Self {
        let mobile: Vec<u32> = (0..particles.len())
            .filter(|&i| particles.kind[i].is_mobile())
            .map(|i| i as u32)
            .collect();
        let mut on_surface = OnSurface::default();
        on_surface.refresh(particles);
        let mut movable = Self {
            scale: particles
                .sizes
                .relative()
                .map_or(Vec::new(), <[f64]>::to_vec),
            particles,
            surfaces,
            bodies: &[],
            on_surface,
            sides: Sides::default(),
            walls: Walls::new(domain),
            reach,
            mobile,
            is_surface_held: false,
            seconds: 0.0,
        };
        movable.project();
        movable
    }

    /// From now on free particles stay on their side of every surface ([`Energy::keep_sides`](super::Energy::keep_sides)).
    pub(crate) fn keep_sides(&mut self, bodies: &'a [Body<D>], domain: &Domain<D>) {
        let start = Instant::now();
        self.bodies = bodies;
        self.sides = Sides::of(self.particles, self.surfaces, bodies, domain);
        self.seconds += start.elapsed().as_secs_f64();
    }

    /// From now on no particle comes nearer to an open side of the box than `margin`, in its spacings.
    pub(crate) fn keep_off_sides(&mut self, margin: f64) {
        self.walls.margin = margin;
        self.project();
    }

    /// From now on the coordinates of every particle are divided by its entry.
    pub(crate) fn rescale(&mut self, scale: Vec<f64>) {
        self.scale = scale;
    }

    /// What the coordinates of particle `i` are divided by.
    #[inline]
    pub(crate) fn scale(&self, i: usize) -> f64 {
        self.scale.get(i).copied().unwrap_or(1.0)
    }

    /// Makes forces on the mobile particles, tangential already, those on their coordinates; what holds a particle takes the force
    /// that pushes it there.
    pub(crate) fn constrain(&self, force: &mut [[f64; D]]) {
        if !self.scale.is_empty() {
            for (force, &i) in force.iter_mut().zip(&self.mobile) {
                *force = point::scale(*force, self.scale[i as usize]);
            }
        }
        for (place, away) in self.held() {
            if point::dot(force[place], away) < 0.0 {
                force[place] = point::reject(force[place], away);
            }
        }
    }

    /// Writes the coordinates of the mobile particles.
    pub(crate) fn places(&self, out: &mut Vec<[f64; D]>) {
        out.clear();
        let position = &self.particles.position;
        if self.scale.is_empty() {
            out.extend(self.mobile.iter().map(|&i| position[i as usize]));
        } else {
            out.extend(self.mobile.iter().map(|&i| {
                let i = i as usize;
                position[i].map(|x| x / self.scale[i])
            }));
        }
    }

    /// Puts the mobile particles at `from + step · direction`, boundary ones onto their surface from there.
    pub(crate) fn move_to(&mut self, from: &[[f64; D]], step: f64, direction: &[[f64; D]]) {
        for ((&i, &x), &d) in self.mobile.iter().zip(from).zip(direction) {
            self.particles.position[i as usize] = point::add_scaled(x, step, d);
        }
        if !self.scale.is_empty() {
            for &i in &self.mobile {
                let i = i as usize;
                let x = &mut self.particles.position[i];
                *x = point::scale(*x, self.scale[i]);
            }
        }
        self.project();
    }

    /// `v` of every mobile particle without its part along the normal of the surface that it sits on.
    pub(crate) fn make_tangential(&self, v: &mut [[f64; D]]) {
        v.par_iter_mut()
            .zip(&self.mobile)
            .with_min_len(4096)
            .for_each(|(v, &i)| *v = self.tangential(i as usize, *v));
    }

    /// `v` of particle `i` without its part along the normal of the surface that it sits on.
    #[inline]
    pub(crate) fn tangential(&self, i: usize, v: [f64; D]) -> [f64; D] {
        self.on_surface.tangential(i, v)
    }

    /// Holds boundary particles where they are from now on.
    pub(crate) fn hold_surface(&mut self) {
        let kind = &self.particles.kind;
        self.mobile.retain(|&i| kind[i as usize] == Kind::Free);
        self.is_surface_held = true;
    }

    /// Particles that lie against what holds them: their numbers among the mobile ones, and the direction that they cannot go
    /// against.
    pub(crate) fn held(&self) -> impl Iterator<Item = (usize, [f64; D])> {
        let along = |axis: usize, inward: f64| {
            let mut away = [0.0; D];
            away[axis] = inward;
            away
        };
        let walls = self.walls.held();
        let walls = walls.map(move |(i, axis, inward)| (i, along(axis, inward)));
        (self.sides.held().chain(walls)).filter_map(|(i, away)| {
            let place = self.mobile.binary_search(&(i as u32)).ok()?;
            Some((place, away))
        })
    }

    fn project(&mut self) {
        let start = Instant::now();
        if !self.is_surface_held {
            self.on_surface
                .project(self.particles, self.surfaces, self.reach);
            // A surface that crosses a side at a slant takes a few.
            for _ in 0..PUSHES {
                if !self.walls.clear(self.particles, &self.mobile) {
                    break;
                }
                self.on_surface
                    .project(self.particles, self.surfaces, self.reach);
            }
        }
        self.sides.keep(self.particles, self.surfaces, self.bodies);
        self.walls.keep(self.particles, &self.mobile);
        self.seconds += start.elapsed().as_secs_f64();
    }
}

/// Of the same problem.
impl<const D: usize> State for Movable<'_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.particles.save(out)?;
        self.scale.save(out)?;
        self.is_surface_held.save(out)?;
        self.on_surface.save(out)?;
        self.sides.save(out)?;
        self.walls.save(out)?;
        self.seconds.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.particles.load(from)?;
        self.scale.load(from)?;
        if !(self.scale.is_empty() || self.scale.len() == self.particles.len()) {
            return Err(Damaged);
        }
        self.is_surface_held.load(from)?;
        self.on_surface.load(from)?;
        let count = self.particles.len();
        self.sides.load(from, count, self.surfaces.len())?;
        self.walls.load(from)?;
        self.seconds = f64::take(from)?;
        let kind = &self.particles.kind;
        self.mobile.clear();
        self.mobile.extend((0..count as u32).filter(|&i| {
            let kind = kind[i as usize];
            kind == Kind::Free || (kind == Kind::Boundary && !self.is_surface_held)
        }));
        Ok(())
    }
}
