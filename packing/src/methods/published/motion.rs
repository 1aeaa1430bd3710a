//! Damped dynamics, as the papers' methods share it.

use std::io::{self, Write};

use rayon::prelude::*;
use sphpack_neighbors::{Domain, point};

use crate::forces::largest;
use crate::minimise::time_step;
use crate::on_surface::OnSurface;
use crate::particles::{Kind, Particles};
use crate::state::{Damaged, State, load_as_many};

/// Velocities, and how they change.
#[derive(Debug, Clone)]
pub(crate) struct Motion<const D: usize> {
    /// Free particles stay in it: where frozen particles are no barrier, as in narrow places beside a wall.
    domain: Domain<D>,
    velocity: Vec<[f64; D]>,
    /// The largest speed after the last step.
    pub(crate) fastest: f64,
}

impl<const D: usize> Motion<D> {
    /// `count` particles at rest.
    pub(crate) fn at_rest(domain: &Domain<D>, count: usize) -> Self {
        Self {
            domain: *domain,
            velocity: vec![[0.0; D]; count],
            fastest: 0.0,
        }
    }

    /// [`time_step`] with the last step's velocities.
    pub(crate) fn time_step(&self, h: f64, zeta: f64, pressure: f64) -> f64 {
        time_step(h, zeta, pressure, self.fastest)
    }

    /// Negi & Ramachandran (2021), eqs. 17 and 19, semi-implicit Euler with damping −`zeta` u; along the surface for
    /// boundary particles (eq. 22).
    pub(crate) fn advance(
        &mut self,
        particles: &mut Particles<D>,
        on_surface: &OnSurface<D>,
        dt: f64,
        zeta: f64,
        acceleration: impl Fn(usize) -> [f64; D] + Sync,
    ) {
        let (kind, domain) = (&particles.kind, &self.domain);
        self.velocity
            .par_iter_mut()
            .zip(&mut particles.position)
            .enumerate()
            .with_min_len(1024)
            .filter(|(i, _)| kind[*i].is_mobile())
            .for_each(|(i, (u, x))| {
                let a = point::add_scaled(acceleration(i), -zeta, *u);
                *u = on_surface.tangential(i, point::add_scaled(*u, dt, a));
                *x = point::add_scaled(*x, dt, *u);
                if kind[i] == Kind::Free {
                    let kept = domain.clamp(*x);
                    for k in 0..D {
                        if kept[k] != x[k] {
                            u[k] = 0.0;
                        }
                    }
                    *x = kept;
                }
            });
        self.fastest = largest(self.velocity.len(), |i| point::norm(self.velocity[i]));
    }

    /// Speed of a particle after the last step.
    pub(crate) fn speed(&self, i: usize) -> f64 {
        point::norm(self.velocity[i])
    }

    /// Brings a particle to rest.
    pub(crate) fn stop(&mut self, i: usize) {
        self.velocity[i] = [0.0; D];
    }

    /// Σ ½ u² over the free and boundary particles, over their number.
    pub(crate) fn mean_kinetic_energy(&self, kind: &[Kind]) -> f64 {
        let mobile: Vec<usize> = (0..kind.len()).filter(|&i| kind[i].is_mobile()).collect();
        let sum = crate::forces::blocked_sum(&mobile, |&i| {
            0.5 * point::dot(self.velocity[i], self.velocity[i])
        });
        sum / mobile.len().max(1) as f64
    }
}

impl<const D: usize> State for Motion<D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.velocity.save(out)?;
        self.fastest.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        load_as_many(&mut self.velocity, from)?;
        self.fastest.load(from)
    }
}
