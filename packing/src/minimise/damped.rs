//! The papers' damped dynamics.

use std::io::{self, Write};

use super::{Landscape, Minimiser, Step, vectors};
use crate::motion::time_step;
use crate::state::{Damaged, State};
use sphpack_neighbors::point;

/// Semi-implicit Euler with damping −ζu, ζ = C_ζ/∆s, and the time step of 001 eq. 25 (p_b = 1).
#[derive(Debug, Clone, Default)]
pub struct Damped<const D: usize> {
    velocity: Vec<[f64; D]>,
    place: Vec<[f64; D]>,
    fastest: f64,
}

/// C_ζ; 001 gives 0.2 … 0.5.
const DAMPING: f64 = 0.2;

impl<const D: usize> Minimiser<D> for Damped<D> {
    fn step(&mut self, landscape: &mut Landscape<'_, D>) -> Step {
        let h = landscape.smoothing_length();
        let zeta = DAMPING / landscape.spacing();
        self.velocity.resize(landscape.len(), [0.0; D]);
        let dt = time_step(h, zeta, 1.0, self.fastest);
        for (u, &force) in self.velocity.iter_mut().zip(landscape.force()) {
            *u = point::add_scaled(*u, dt, point::add_scaled(force, -zeta, *u));
        }
        landscape.make_tangential(&mut self.velocity);
        self.fastest = vectors::longest(&self.velocity);
        landscape.places(&mut self.place);
        landscape.move_to(&self.place, dt, &self.velocity);
        Step::Taken
    }

    fn reset(&mut self) {
        // Which particles move may have changed: a velocity would land on another one.
        self.velocity.clear();
        self.fastest = 0.0;
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.velocity.save(out)?;
        self.fastest.save(out)
    }

    fn load(&mut self, from: &mut &[u8], _: usize) -> Result<(), Damaged> {
        self.velocity.load(from)?;
        self.fastest.load(from)
    }
}
