//! The energy over the places of the mobile particles.

use std::io::{self, Write};
use std::time::Instant;

use rayon::prelude::*;
use sphpack_neighbors::point;

use super::GradientPenalty;
use super::sides::Sides;
use super::vectors;
use super::walls::Walls;
use crate::forces::{Forces, Levelling};
use crate::on_surface::OnSurface;
use crate::packed::ParticleSurface;
use crate::particles::{Kind, Particles};
use crate::problem::Body;
use crate::state::{Damaged, State, Value};
use sphpack_pairs::Repulsion;

/// The energy E = ½ Σ_ij V_i V_j W_ij/∆s^D + Σ_pairs φ_R, and that of a [`Levelling`], over the places of the mobile
/// particles, and its forces −∇E; boundary particles stay on their surfaces, fixed and frozen ones where they are.
/// The energies of a second evaluator and of a [`GradientPenalty`] may be added.
///
/// It is evaluated when it is asked, once for every place: what changes it, or moves particles, only marks it.
///
/// Where particles differ in size, the coordinates of each are divided by its size over the finest, and forces multiplied:
/// a step, a force times h and what a minimiser learns then mean the same for all.
///
/// E is per ∆s^D and p_b; the force on a particle of that volume is its acceleration for p_b = 1, per scene unit.
/// Forces are −∇E along the surfaces for any volumes, so long as these do not change.
#[derive(Debug)]
pub struct Energy<'a, const D: usize> {
    particles: &'a mut Particles<D>,
    surfaces: &'a [ParticleSurface<D>],
    bodies: &'a [Body<D>],
    forces: Forces<D>,
    added: Option<Forces<D>>,
    gradient_penalty: Option<GradientPenalty<D>>,
    on_surface: OnSurface<D>,
    sides: Sides<D>,
    walls: Walls<D>,
    spacing: f64,
    smoothing_length: f64,
    reach: f64,
    mobile: Vec<u32>,
    is_surface_held: bool,
    /// Whether particles have moved, or the energy has become another one, since it was evaluated.
    is_stale: bool,
    /// Whether it is another energy, or one of other particles, than when [`Energy::take_changed`] was last asked.
    is_changed: bool,
    value: f64,
    force: Vec<[f64; D]>,
    projection_seconds: f64,
    penalty_seconds: f64,
}

impl<'a, const D: usize> Energy<'a, D> {
    /// The energy around the present places; boundary particles are put onto their surfaces first. Surfaces are looked for
    /// within `reach` (scene units).
    pub fn new(
        particles: &'a mut Particles<D>,
        surfaces: &'a [ParticleSurface<D>],
        forces: Forces<D>,
        reach: f64,
    ) -> Self {
        let mobile: Vec<u32> = (0..particles.len())
            .filter(|&i| particles.kind[i].is_mobile())
            .map(|i| i as u32)
            .collect();
        let mut on_surface = OnSurface::default();
        on_surface.refresh(particles);
        let domain = *forces.list().domain();
        let mut energy = Self {
            smoothing_length: forces.smoothing_length(),
            force: vec![[0.0; D]; mobile.len()],
            spacing: particles.sizes.finest(),
            particles,
            surfaces,
            bodies: &[],
            forces,
            added: None,
            gradient_penalty: None,
            on_surface,
            sides: Sides::default(),
            walls: Walls::new(domain),
            reach,
            mobile,
            is_surface_held: false,
            is_stale: true,
            is_changed: false,
            value: 0.0,
            projection_seconds: 0.0,
            penalty_seconds: 0.0,
        };
        energy.project();
        energy
    }

    /// ∆s, or the least, scene units.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Smoothing length of the kernel, scene units.
    pub fn smoothing_length(&self) -> f64 {
        self.smoothing_length
    }

    /// Number of mobile particles: the length of every vector here.
    pub fn len(&self) -> usize {
        self.mobile.len()
    }

    /// Whether nothing can move.
    pub fn is_empty(&self) -> bool {
        self.mobile.is_empty()
    }

    /// Indices of the mobile particles, ascending.
    pub fn mobile(&self) -> &[u32] {
        &self.mobile
    }

    /// All particles, where they are now.
    pub fn particles(&self) -> &Particles<D> {
        self.particles
    }

    /// Density and force where the particles are.
    pub fn forces(&mut self) -> &Forces<D> {
        self.evaluate();
        &self.forces
    }

    /// What was found where the particles are, and these.
    pub fn evaluated(&mut self) -> (&Forces<D>, &Particles<D>) {
        self.evaluate();
        (&self.forces, self.particles)
    }

    /// Adds the energy of an evaluator by another kernel or smoothing length.
    pub fn add(&mut self, forces: Forces<D>) {
        self.added = Some(forces);
        self.mark_changed();
    }

    /// Adds the energy of a penalty.
    pub fn penalise(&mut self, penalty: GradientPenalty<D>) {
        self.gradient_penalty = Some(penalty);
        self.mark_changed();
    }

    /// The evaluator that was added.
    pub fn added(&self) -> Option<&Forces<D>> {
        self.added.as_ref()
    }

    /// Gives the evaluator back.
    pub fn into_forces(mut self) -> Forces<D> {
        self.evaluate();
        self.forces
    }

    /// Evaluations so far.
    pub fn evaluations(&self) -> usize {
        self.forces.evaluations()
    }

    /// E where the particles are.
    pub fn value(&mut self) -> f64 {
        self.evaluate();
        self.value
    }

    /// −∇E of every mobile particle, along the surface for boundary particles.
    pub fn force(&mut self) -> &[[f64; D]] {
        self.evaluate();
        &self.force
    }

    /// The largest force, times h: dimensionless, what minimisers bring to zero.
    pub fn residual(&mut self) -> f64 {
        self.evaluate();
        self.smoothing_length * vectors::longest(&self.force)
    }

    /// Whether this has become another energy, or one of other particles, since it was asked before: what earlier steps
    /// taught a minimiser is of no use then.
    pub fn take_changed(&mut self) -> bool {
        std::mem::take(&mut self.is_changed)
    }

    /// Seconds spent on keeping boundary particles on their surfaces.
    pub fn projection_seconds(&self) -> f64 {
        self.projection_seconds
    }

    /// Seconds spent on the [`GradientPenalty`].
    pub fn penalty_seconds(&self) -> f64 {
        self.penalty_seconds
    }

    /// From now on free particles stay on the side of every surface where they are: within, 0.4 ∆s away from the particle
    /// surface; outside, as far from it and not beyond the true surface, unless they are nearer now. `bodies` are the true
    /// ones. Costs a look at every particle near a surface.
    pub fn keep_sides(&mut self, bodies: &'a [Body<D>]) {
        let start = Instant::now();
        self.bodies = bodies;
        self.sides = Sides::of(
            self.particles,
            self.surfaces,
            bodies,
            self.forces.list().domain(),
        );
        self.projection_seconds += start.elapsed().as_secs_f64();
    }

    /// Writes the coordinates of the mobile particles.
    pub fn places(&self, out: &mut Vec<[f64; D]>) {
        out.clear();
        let position = &self.particles.position;
        match self.particles.sizes.relative() {
            None => out.extend(self.mobile.iter().map(|&i| position[i as usize])),
            Some(over) => out.extend(self.mobile.iter().map(|&i| {
                let i = i as usize;
                position[i].map(|x| x / over[i])
            })),
        }
    }

    /// Puts the mobile particles at `from + step · direction`, boundary ones onto their surface from there.
    pub fn move_to(&mut self, from: &[[f64; D]], step: f64, direction: &[[f64; D]]) {
        for ((&i, &x), &d) in self.mobile.iter().zip(from).zip(direction) {
            self.particles.position[i as usize] = point::add_scaled(x, step, d);
        }
        if let Some(over) = self.particles.sizes.relative() {
            for &i in &self.mobile {
                let i = i as usize;
                let x = &mut self.particles.position[i];
                *x = point::scale(*x, over[i]);
            }
        }
        self.project();
        self.is_stale = true;
    }

    /// Changes the repulsion.
    pub fn set_repulsion(&mut self, repulsion: Repulsion) {
        self.forces.repulsion = repulsion;
        self.mark_changed();
    }

    /// Changes the levelling.
    pub fn set_levelling(&mut self, levelling: Option<Levelling>) {
        self.forces.levelling = levelling;
        self.mark_changed();
    }

    fn mark_changed(&mut self) {
        self.is_stale = true;
        self.is_changed = true;
    }

    /// `v` of every mobile particle without its part along the normal of the surface that it sits on.
    pub fn make_tangential(&self, v: &mut [[f64; D]]) {
        v.par_iter_mut()
            .zip(&self.mobile)
            .with_min_len(4096)
            .for_each(|(v, &i)| *v = self.on_surface.tangential(i as usize, *v));
    }

    /// Holds boundary particles where they are from now on.
    pub fn hold_surface(&mut self) {
        let kind = &self.particles.kind;
        self.mobile.retain(|&i| kind[i as usize] == Kind::Free);
        self.force.resize(self.mobile.len(), [0.0; D]);
        self.is_surface_held = true;
        self.mark_changed();
    }

    fn project(&mut self) {
        let start = Instant::now();
        if !self.is_surface_held {
            self.on_surface
                .project(self.particles, self.surfaces, self.reach);
        }
        self.sides.keep(self.particles, self.surfaces, self.bodies);
        self.walls.keep(self.particles, &self.mobile);
        self.projection_seconds += start.elapsed().as_secs_f64();
    }

    fn evaluate(&mut self) {
        if !self.is_stale {
            return;
        }
        self.is_stale = false;
        self.forces.evaluate(self.particles);
        if let Some(added) = &mut self.added {
            added.evaluate(self.particles);
        }
        self.add_up();
    }

    /// Energy and forces of what the evaluators found.
    fn add_up(&mut self) {
        let unit = self.spacing.powi(D as i32);
        let volume = &self.particles.volume;
        self.value = self.forces.weighted_energy(|i| volume[i] / unit);
        if let Some(added) = &self.added {
            self.value += added.weighted_energy(|i| volume[i] / unit);
        }
        if let Some(penalty) = &mut self.gradient_penalty {
            let start = Instant::now();
            self.value += penalty.evaluate(&self.forces, self.particles, unit);
            self.penalty_seconds += start.elapsed().as_secs_f64();
        }
        let (forces, added, on_surface) = (&self.forces, &self.added, &self.on_surface);
        let penalty = self.gradient_penalty.as_ref().map(GradientPenalty::force);
        self.force
            .par_iter_mut()
            .zip(&self.mobile)
            .with_min_len(4096)
            .for_each(|(force, &i)| {
                *force = {
                    let i = i as usize;
                    let weight = volume[i] / unit;
                    let mut force = forces.weighted_acceleration(i, weight);
                    if let Some(added) = added {
                        force = point::add(force, added.weighted_acceleration(i, weight));
                    }
                    if let Some(penalty) = penalty {
                        force = point::add(force, penalty[i]);
                    }
                    on_surface.tangential(i, force)
                };
            });
        if let Some(over) = self.particles.sizes.relative() {
            for (force, &i) in self.force.iter_mut().zip(&self.mobile) {
                *force = point::scale(*force, over[i as usize]);
            }
        }
        // What holds a particle on its floor takes the force towards the surface.
        for (i, away) in self.sides.held() {
            if let Ok(place) = self.mobile.binary_search(&(i as u32))
                && point::dot(self.force[place], away) < 0.0
            {
                self.force[place] = point::reject(self.force[place], away);
            }
        }
        for (i, axis, inward) in self.walls.held() {
            if let Ok(place) = self.mobile.binary_search(&(i as u32))
                && self.force[place][axis] * inward < 0.0
            {
                self.force[place][axis] = 0.0;
            }
        }
    }
}

/// Of the same problem, with the same evaluators and penalties; afterwards it is evaluated where it stands.
impl<const D: usize> State for Energy<'_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.particles.save(out)?;
        self.forces.save(out)?;
        if let Some(added) = &self.added {
            added.save(out)?;
        }
        self.is_surface_held.save(out)?;
        self.on_surface.save(out)?;
        self.sides.save(out)?;
        self.walls.save(out)?;
        (self.projection_seconds, self.penalty_seconds).save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.particles.load(from)?;
        self.forces.load(from)?;
        if let Some(added) = &mut self.added {
            added.load(from)?;
        }
        self.is_surface_held.load(from)?;
        self.on_surface.load(from)?;
        let count = self.particles.len();
        self.sides.load(from, count, self.surfaces.len())?;
        self.walls.load(from)?;
        let seconds = <(f64, f64)>::take(from)?;
        let kind = &self.particles.kind;
        self.mobile.clear();
        self.mobile.extend((0..count as u32).filter(|&i| {
            let kind = kind[i as usize];
            kind == Kind::Free || (kind == Kind::Boundary && !self.is_surface_held)
        }));
        self.force.resize(self.mobile.len(), [0.0; D]);
        self.forces.evaluate_again(self.particles);
        if let Some(added) = &mut self.added {
            added.evaluate_again(self.particles);
        }
        self.add_up();
        self.is_stale = false;
        self.is_changed = false;
        (self.projection_seconds, self.penalty_seconds) = seconds;
        Ok(())
    }
}
