//! The energy over the places of the mobile particles.

use std::io::{self, Write};
use std::time::Instant;

use rayon::prelude::*;
use sphpack_neighbors::point;

use super::movable::Movable;
use super::vectors;
use super::{GradientPenalty, Potential};
use crate::forces::{Forces, Levelling};
use crate::packed::ParticleSurface;
use crate::particles::Particles;
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
    movable: Movable<'a, D>,
    forces: Forces<D>,
    added: Option<Forces<D>>,
    gradient_penalty: Option<GradientPenalty<D>>,
    spacing: f64,
    smoothing_length: f64,
    /// Whether particles have moved, or the energy has become another one, since it was evaluated.
    is_stale: bool,
    /// Whether it is another energy, or one of other particles, than when [`Energy::take_changed`] was last asked.
    is_changed: bool,
    value: f64,
    force: Vec<[f64; D]>,
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
        let domain = *forces.list().domain();
        let spacing = particles.sizes.finest();
        let movable = Movable::new(particles, surfaces, domain, reach);
        Self {
            smoothing_length: forces.smoothing_length(),
            force: vec![[0.0; D]; movable.mobile.len()],
            spacing,
            movable,
            forces,
            added: None,
            gradient_penalty: None,
            is_stale: true,
            is_changed: false,
            value: 0.0,
            penalty_seconds: 0.0,
        }
    }

    /// Indices of the mobile particles, ascending.
    pub fn mobile(&self) -> &[u32] {
        &self.movable.mobile
    }

    /// All particles, where they are now.
    pub fn particles(&self) -> &Particles<D> {
        self.movable.particles
    }

    /// Density and force where the particles are.
    pub fn forces(&mut self) -> &Forces<D> {
        self.evaluate();
        &self.forces
    }

    /// What was found where the particles are, and these.
    pub fn evaluated(&mut self) -> (&Forces<D>, &Particles<D>) {
        self.evaluate();
        (&self.forces, self.movable.particles)
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
        self.movable.seconds
    }

    /// Seconds spent on the [`GradientPenalty`].
    pub fn penalty_seconds(&self) -> f64 {
        self.penalty_seconds
    }

    /// From now on free particles stay on the side of every surface where they are: within, 0.4 ∆s away from the particle
    /// surface; outside, as far from it and not beyond the true surface, unless they are nearer now. `bodies` are the true
    /// ones. Costs a look at every particle near a surface.
    pub fn keep_sides(&mut self, bodies: &'a [Body<D>]) {
        let domain = *self.forces.list().domain();
        self.movable.keep_sides(bodies, &domain);
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

    /// Holds boundary particles where they are from now on.
    pub fn hold_surface(&mut self) {
        self.movable.hold_surface();
        self.force.resize(self.movable.mobile.len(), [0.0; D]);
        self.mark_changed();
    }

    fn evaluate(&mut self) {
        if !self.is_stale {
            return;
        }
        self.is_stale = false;
        self.forces.evaluate(self.movable.particles);
        if let Some(added) = &mut self.added {
            added.evaluate(self.movable.particles);
        }
        self.add_up();
    }

    /// Energy and forces of what the evaluators found.
    fn add_up(&mut self) {
        let unit = self.spacing.powi(D as i32);
        let (movable, particles) = (&self.movable, &*self.movable.particles);
        let volume = &particles.volume;
        self.value = self.forces.weighted_energy(|i| volume[i] / unit);
        if let Some(added) = &self.added {
            self.value += added.weighted_energy(|i| volume[i] / unit);
        }
        if let Some(penalty) = &mut self.gradient_penalty {
            let start = Instant::now();
            self.value += penalty.evaluate(&self.forces, particles, unit);
            self.penalty_seconds += start.elapsed().as_secs_f64();
        }
        let (forces, added) = (&self.forces, &self.added);
        let penalty = self.gradient_penalty.as_ref().map(GradientPenalty::force);
        self.force
            .par_iter_mut()
            .zip(&movable.mobile)
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
                    movable.tangential(i, force)
                };
            });
        movable.constrain(&mut self.force);
    }
}

impl<const D: usize> Potential<D> for Energy<'_, D> {
    fn len(&self) -> usize {
        self.movable.mobile.len()
    }

    fn spacing(&self) -> f64 {
        self.spacing
    }

    fn smoothing_length(&self) -> f64 {
        self.smoothing_length
    }

    fn value(&mut self) -> f64 {
        self.evaluate();
        self.value
    }

    fn force(&mut self) -> &[[f64; D]] {
        self.evaluate();
        &self.force
    }

    fn places(&self, out: &mut Vec<[f64; D]>) {
        self.movable.places(out);
    }

    fn move_to(&mut self, from: &[[f64; D]], step: f64, direction: &[[f64; D]]) {
        self.movable.move_to(from, step, direction);
        self.is_stale = true;
    }

    fn make_tangential(&self, v: &mut [[f64; D]]) {
        self.movable.make_tangential(v);
    }
}

/// Of the same problem, with the same evaluators and penalties; afterwards it is evaluated where it stands.
impl<const D: usize> State for Energy<'_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.movable.save(out)?;
        self.forces.save(out)?;
        if let Some(added) = &self.added {
            added.save(out)?;
        }
        self.penalty_seconds.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.movable.load(from)?;
        self.forces.load(from)?;
        if let Some(added) = &mut self.added {
            added.load(from)?;
        }
        let seconds = f64::take(from)?;
        self.force.resize(self.movable.mobile.len(), [0.0; D]);
        self.forces.evaluate_again(self.movable.particles);
        if let Some(added) = &mut self.added {
            added.evaluate_again(self.movable.particles);
        }
        self.add_up();
        self.is_stale = false;
        self.is_changed = false;
        self.penalty_seconds = seconds;
        Ok(())
    }
}
