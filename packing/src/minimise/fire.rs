//! FIRE, the fast inertial relaxation engine.

use std::io::{self, Write};

use super::{Minimiser, Potential, Step, vectors};
use crate::state::{Damaged, State, Value};
use sphpack_neighbors::fire::Fire as Engine;
use sphpack_neighbors::point;

/// Dynamics without damping whose velocity is steered along the force, sped up while it runs downhill and stopped
/// where it runs uphill (Bitzek, Koskinen, Gähler, Moseler, Gumbsch, PRL 97, 170201, 2006; velocities first, as in
/// Guénolé et al., Comput. Mater. Sci. 175, 109584, 2020).
#[derive(Debug, Clone)]
pub struct Fire<const D: usize> {
    /// Steps are no longer than this, in ∆s.
    pub step_over_spacing: f64,
    velocity: Vec<[f64; D]>,
    place: Vec<[f64; D]>,
    /// Its time step is in h, for p_b = 1.
    fire: Engine,
}

/// Time steps in h: at first, and at most. The stiffest mode of a quintic lattice allows 1.6 h.
const FIRST_STEP: f64 = 0.4;
const LARGEST_STEP: f64 = 0.9;
const SMALLEST_STEP: f64 = 0.02;

impl<const D: usize> Default for Fire<D> {
    fn default() -> Self {
        Self {
            step_over_spacing: 0.1,
            velocity: Vec::new(),
            place: Vec::new(),
            fire: Engine::new(FIRST_STEP, [SMALLEST_STEP, LARGEST_STEP]),
        }
    }
}

impl<const D: usize> Minimiser<D> for Fire<D> {
    fn step(&mut self, energy: &mut dyn Potential<D>) -> Step {
        self.velocity.resize(energy.len(), [0.0; D]);
        let (h, limit) = (
            energy.smoothing_length(),
            self.step_over_spacing * energy.spacing(),
        );
        let force = energy.force();
        let power = vectors::dot(&self.velocity, force);
        if power > 0.0 {
            self.fire.downhill();
        } else {
            self.fire.uphill();
            self.velocity.fill([0.0; D]);
        }
        let steer = self.fire.mixing;
        let dt = self.fire.step * h;
        for (u, &force) in self.velocity.iter_mut().zip(force) {
            *u = point::add_scaled(*u, dt, force);
        }
        let speed = vectors::dot(&self.velocity, &self.velocity).sqrt();
        let pull = vectors::dot(force, force).sqrt();
        if pull > 0.0 {
            for (u, &force) in self.velocity.iter_mut().zip(force) {
                let along = point::scale(force, steer * speed / pull);
                *u = point::add_scaled(along, 1.0 - steer, *u);
            }
        }
        energy.make_tangential(&mut self.velocity);
        let longest = dt * energy.longest(&self.velocity);
        if longest > limit {
            vectors::scale(&mut self.velocity, limit / longest);
        }
        energy.places(&mut self.place);
        energy.move_to(&self.place, dt, &self.velocity);
        Step::Taken
    }

    fn reset(&mut self) {
        self.velocity.clear();
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.velocity.save(out)?;
        (self.fire.step, self.fire.mixing, self.fire.patience).save(out)
    }

    fn load(&mut self, from: &mut &[u8], _: usize) -> Result<(), Damaged> {
        self.velocity.load(from)?;
        (self.fire.step, self.fire.mixing, self.fire.patience) = Value::take(from)?;
        Ok(())
    }
}
