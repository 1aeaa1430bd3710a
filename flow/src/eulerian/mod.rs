//! Eulerian weakly compressible SPH, as Zhao et al. (2025) run it: particles stay, mass and momentum go from one to the next.
//!
//! What a packing has uneven stays where it is: no scheme sees it more clearly.

mod correction;
mod flux;

use sphpack_neighbors::{Domain, point};

use crate::fringe::Fringe;
use crate::medium::Medium;
use crate::neighborhood::Neighborhood;
use crate::parallel::each;
use crate::particles::Particles;
use crate::unstable::Unstable;
use correction::{Moments, entries, inverse};
use flux::{Mass, Momentum, MomentumSum, stride};

/// What the scheme needs to know.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EulerianSettings<const D: usize> {
    /// The fluid; its body force too.
    pub medium: Medium<D>,
    /// The kinematic viscosity ν.
    pub viscosity: f64,
    /// L₀: how much of the difference of pressures speeds up what is between two particles, at least. With 0, as published, pressures that
    /// alternate from particle to particle are not damped, and grow where a packing is uneven.
    pub damping: f64,
    /// A strip that makes the stream uniform again.
    pub fringe: Option<Fringe<D>>,
}

impl<const D: usize> EulerianSettings<D> {
    /// With L₀ = 0.05 and no fringe.
    pub fn new(medium: Medium<D>, viscosity: f64) -> Self {
        Self {
            medium,
            viscosity,
            damping: 0.05,
            fringe: None,
        }
    }
}

/// A flow that this scheme carries on. Its particles stay where they are, and in their order.
#[derive(Debug)]
pub struct Eulerian<const D: usize> {
    settings: EulerianSettings<D>,
    particles: Particles<D>,
    near: Neighborhood<D>,
    /// V of all.
    volume: Vec<f64>,
    /// m u of the fluid, and as it was a step ago.
    momentum: Vec<[f64; D]>,
    momentum_before: Vec<[f64; D]>,
    /// B of the fluid.
    correction: Vec<[f64; 6]>,
    /// Of walls the unit normal into the fluid, or zero.
    normals: Vec<[f64; D]>,
    /// λ of the fringe.
    led: Vec<f64>,
    on_walls: Vec<[[f64; D]; 2]>,
    time: f64,
    steps: usize,
    /// What the two walks found, kept so that nothing is allocated again.
    momentum_sums: Vec<MomentumSum>,
    mass_sums: Vec<f64>,
}

impl<const D: usize> Eulerian<D> {
    /// A flow that begins with these particles: their masses are ρ₀V, and become ρV by their pressures. `normals` are the
    /// walls' unit normals into the fluid, of every layer; where one is zero the line to the fluid takes its place, which has
    /// too much pressure and too little friction at a wall.
    ///
    /// # Panics
    /// Where there are not as many normals as wall particles.
    pub fn new(
        domain: &Domain<D>,
        particles: Particles<D>,
        normals: Vec<[f64; D]>,
        settings: EulerianSettings<D>,
    ) -> Self {
        let Medium {
            smoothing_length,
            density,
            sound_speed,
            ..
        } = settings.medium;
        let fluid = particles.fluid;
        assert_eq!(
            normals.len(),
            particles.len() - fluid,
            "every wall particle has a normal, or zero"
        );
        let mut particles = particles;
        let volume: Vec<f64> = particles.mass.iter().map(|m| m / density).collect();
        for i in 0..fluid {
            let own = density + particles.pressure[i] / (sound_speed * sound_speed);
            particles.density[i] = own;
            particles.mass[i] = own * volume[i];
        }
        particles.density[fluid..].fill(density);
        let momentum: Vec<[f64; D]> = (particles.velocity.iter().zip(&particles.mass))
            .take(fluid)
            .map(|(&u, &m)| point::scale(u, m))
            .collect();
        let mut near = Neighborhood::fixed(domain, smoothing_length);
        near.update(&particles.position, &volume, |i| i < fluid);
        let mut moments = Vec::new();
        near.sum(&Moments { unit: 1.0 }, &mut moments);
        let correction = (0..fluid)
            .map(|i| inverse::<D>(&near.of(&moments, i)))
            .collect();
        let led = (particles.position[..fluid].iter())
            .map(|&at| (settings.fringe).map_or(0.0, |fringe| fringe.rate(domain, at)))
            .collect();
        Self {
            settings,
            near,
            volume,
            momentum_before: momentum.clone(),
            momentum,
            correction,
            normals,
            led,
            on_walls: vec![[[0.0; D]; 2]; fluid],
            particles,
            time: 0.0,
            steps: 0,
            momentum_sums: Vec::new(),
            mass_sums: Vec::new(),
        }
    }

    /// The particles as they are now.
    pub fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    /// The body force, the viscosities and the fringe's stream may be changed between steps, so that a stream begins gently; nothing else.
    pub fn settings_mut(&mut self) -> &mut EulerianSettings<D> {
        &mut self.settings
    }

    /// The volumes V of all, which stay.
    pub fn volume(&self) -> &[f64] {
        &self.volume
    }

    /// The force that each particle of fluid has on walls by its pressure, and by friction, in the last step.
    pub fn on_walls(&self) -> &[[[f64; D]; 2]] {
        &self.on_walls
    }

    /// m u of the fluid, which is conserved where there are no walls.
    pub fn momentum(&self) -> &[[f64; D]] {
        &self.momentum
    }

    /// The time.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The steps that were done.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Goes on by `steps` steps of ∆t: momentum by the density as it is, then mass by the new velocity.
    ///
    /// # Errors
    /// [`Unstable`] where a particle is faster than sound.
    pub fn run(&mut self, steps: usize, time_step: f64) -> Result<(), Unstable> {
        // Within the pool: each parallel loop would have to call it otherwise.
        rayon::scope(|_| (0..steps).try_for_each(|_| self.step(time_step)))
    }

    fn step(&mut self, time_step: f64) -> Result<(), Unstable> {
        self.accelerate(time_step);
        self.transfer(time_step);
        self.steps += 1;
        self.time += time_step;
        let sound_speed = self.settings.medium.sound_speed;
        Unstable::look(&self.particles, sound_speed, self.steps, self.time)
    }

    /// New momenta, and velocities by the masses as they are.
    fn accelerate(&mut self, time_step: f64) {
        let EulerianSettings {
            medium,
            viscosity,
            damping,
            fringe,
        } = self.settings;
        let fluid = self.particles.fluid;
        self.fill();
        let terms = Momentum::new(&medium, viscosity, damping);
        self.near.sum(&terms, &mut self.momentum_sums);
        let (near, sums, volume) = (&self.near, &self.momentum_sums, &self.volume);
        each(&mut self.on_walls, |i| {
            let of_walls = near.of(sums, i).on_walls;
            of_walls.map(|force| point::scale(point::of_slice(&force), volume[i]))
        });
        let (mass, led) = (&self.particles.mass, &self.led);
        std::mem::swap(&mut self.momentum, &mut self.momentum_before);
        let before = &self.momentum_before;
        each(&mut self.momentum, |i| {
            let rate = point::of_slice(&near.of(sums, i).rate);
            let pushed = point::add_scaled(before[i], time_step * volume[i], rate);
            let pushed = point::add_scaled(pushed, time_step * mass[i], medium.force);
            let Some(fringe) = fringe else {
                return pushed;
            };
            // Implicitly: the strip may be stronger than a step has time for.
            let part = time_step * led[i];
            let drawn = point::add_scaled(pushed, part * mass[i], fringe.velocity);
            point::scale(drawn, 1.0 / (1.0 + part))
        });
        let momentum = &self.momentum;
        each(&mut self.particles.velocity[..fluid], |i| {
            point::scale(momentum[i], 1.0 / mass[i])
        });
    }

    /// New masses, densities and pressures by the new velocities.
    fn transfer(&mut self, time_step: f64) {
        let EulerianSettings {
            medium, damping, ..
        } = self.settings;
        let fluid = self.particles.fluid;
        self.fill();
        let terms = Mass::new(&medium, damping);
        self.near.sum(&terms, &mut self.mass_sums);
        let (near, sums, volume, led) = (&self.near, &self.mass_sums, &self.volume, &self.led);
        let of = &mut self.particles;
        let old = &of.mass;
        each(&mut of.density[..fluid], |i| {
            let moved = old[i] / volume[i] + time_step * near.of(sums, i);
            let part = time_step * led[i];
            (moved + part * medium.density) / (1.0 + part)
        });
        let density = &of.density;
        each(&mut of.mass[..fluid], |i| density[i] * volume[i]);
        let squared = medium.sound_speed * medium.sound_speed;
        each(&mut of.pressure[..fluid], |i| {
            squared * (density[i] - medium.density)
        });
    }

    /// Takes the fields that both walks read.
    fn fill(&mut self) {
        let (of, normals, correction) = (&self.particles, &self.normals, &self.correction);
        let fluid = of.fluid;
        self.near.fill(stride(D), |i, row| {
            row[..D].copy_from_slice(&of.velocity[i]);
            if i < fluid {
                row[D] = of.pressure[i];
                row[D + 1] = of.density[i];
                row[D + 2..].copy_from_slice(&correction[i][..entries(D)]);
            } else {
                row[D..2 * D].copy_from_slice(&normals[i - fluid]);
                row[2 * D..].fill(0.0);
            }
        });
    }
}
