//! The papers' damped dynamics.

use std::io::{self, Write};

use super::{Minimiser, Potential, Step, vectors};
use crate::state::{Damaged, State};
use sphpack_neighbors::point;

/// Semi-implicit Euler with damping −ζu, ζ = C_ζ/∆s, and the time step of Negi & Ramachandran (2021), eq. 25 (p_b =
/// 1).
#[derive(Debug, Clone, Default)]
pub struct Damped<const D: usize> {
    velocity: Vec<[f64; D]>,
    place: Vec<[f64; D]>,
    fastest: f64,
}

/// C_ζ; Negi & Ramachandran (2021) give 0.2 … 0.5.
const DAMPING: f64 = 0.2;

/// The time step of Negi & Ramachandran (2021), eq. 25 for a background pressure `pressure`:
/// no farther than a tenth of `h` by what the pressure does from rest, nor by damping `zeta` at the speed of the
/// `fastest`.
pub(crate) fn time_step(h: f64, zeta: f64, pressure: f64, fastest: f64) -> f64 {
    (0.1 * h / pressure.sqrt()).min((0.1 * h / (zeta * fastest)).sqrt())
}

impl<const D: usize> Minimiser<D> for Damped<D> {
    fn step(&mut self, energy: &mut dyn Potential<D>) -> Step {
        let h = energy.smoothing_length();
        let zeta = DAMPING / energy.spacing();
        self.velocity.resize(energy.len(), [0.0; D]);
        let dt = time_step(h, zeta, 1.0, self.fastest);
        for (u, &force) in self.velocity.iter_mut().zip(energy.force()) {
            *u = point::add_scaled(*u, dt, point::add_scaled(force, -zeta, *u));
        }
        energy.make_tangential(&mut self.velocity);
        self.fastest = vectors::longest(&self.velocity);
        energy.places(&mut self.place);
        energy.move_to(&self.place, dt, &self.velocity);
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
