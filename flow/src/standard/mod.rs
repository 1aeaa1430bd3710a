//! Standard weakly compressible SPH (Monaghan 2005), with a free surface and dummy walls, as for Bouscasse et al.'s tanks.
//!
//! The density is integrated, for a sum would lose it at a free surface; the pressure follows from it. Particles move with their
//! own velocity: no XSPH, no shifting.

mod rates;
mod state;

use sphpack_neighbors::{Domain, point};

use crate::medium::Medium;
use crate::neighborhood::Neighborhood;
use crate::parallel::each;
use crate::particles::{Particles, reorder};
use crate::softening::softening;
use crate::unstable::Unstable;
use crate::walls::Walls;
use rates::{RateSum, Rates, stride};

/// What the scheme needs to know.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandardSettings<const D: usize> {
    /// The fluid.
    pub medium: Medium<D>,
    /// α of the artificial viscosity, which acts on pairs that part too: ν = α c h/(2(d + 2)).
    pub viscosity: f64,
    /// Friction κ in du/dt −= κ u, for fluid that is to settle; zero in a flow.
    pub friction: f64,
}

/// A flow that this scheme carries on.
#[derive(Debug)]
pub struct Standard<const D: usize> {
    settings: StandardSettings<D>,
    domain: Domain<D>,
    particles: Particles<D>,
    near: Neighborhood<D>,
    walls: Walls<D>,
    /// V = m/ρ of all.
    volume: Vec<f64>,
    /// Of the fluid, as last evaluated.
    rates: Vec<StandardRate<D>>,
    /// The fluid at the beginning of a step.
    before: Before<D>,
    time: f64,
    steps: usize,
    /// What the walk found, kept so that nothing is allocated again.
    sums: Vec<RateSum>,
}

/// How a particle of fluid changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandardRate<const D: usize> {
    /// du/dt.
    pub acceleration: [f64; D],
    /// dρ/dt.
    pub density: f64,
    /// The force that it has on walls.
    pub on_walls: [f64; D],
}

impl<const D: usize> StandardRate<D> {
    const NONE: Self = Self {
        acceleration: [0.0; D],
        density: 0.0,
        on_walls: [0.0; D],
    };
}

#[derive(Debug, Default)]
struct Before<const D: usize> {
    position: Vec<[f64; D]>,
    velocity: Vec<[f64; D]>,
    density: Vec<f64>,
}

/// Steps between two times that particles are put in the order of the cells.
const REORDER_EVERY: usize = 200;

impl<const D: usize> Standard<D> {
    /// A flow that begins with these particles, the density of the fluid's as their pressure asks for.
    pub fn new(domain: &Domain<D>, particles: Particles<D>, settings: StandardSettings<D>) -> Self {
        let h = settings.medium.smoothing_length;
        let mut flow = Self {
            settings,
            domain: *domain,
            near: Neighborhood::new(domain, h),
            walls: Walls::new(domain, h),
            volume: vec![0.0; particles.len()],
            rates: Vec::new(),
            before: Before::default(),
            particles,
            time: 0.0,
            steps: 0,
            sums: Vec::new(),
        };
        let Particles {
            density, pressure, ..
        } = &mut flow.particles;
        for (density, &pressure) in density.iter_mut().zip(&*pressure) {
            *density = settings.medium.density_at(pressure);
        }
        flow.evaluate();
        flow
    }

    /// The particles as they are now.
    pub fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    /// The walls' positions, velocities and accelerations may be changed between steps, nothing else.
    pub fn particles_mut(&mut self) -> &mut Particles<D> {
        &mut self.particles
    }

    /// The time.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The steps that were done.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// New neighbour lists so far.
    pub fn list_builds(&self) -> usize {
        self.near.builds()
    }

    /// Another friction κ from here on: fluid that has settled is set free with zero.
    pub fn set_friction(&mut self, friction: f64) {
        self.settings.friction = friction;
    }

    /// How the fluid changes, as last evaluated.
    pub fn rates(&self) -> &[StandardRate<D>] {
        &self.rates
    }

    /// Goes on by `steps` steps of ∆t, with one evaluation each: half a step with the last rates, an evaluation, and a full step
    /// from the old state with the new rates.
    ///
    /// # Errors
    /// [`Unstable`] where a particle is faster than sound.
    pub fn run(&mut self, steps: usize, time_step: f64) -> Result<(), Unstable> {
        // Within the pool: each parallel loop would have to call it otherwise.
        rayon::scope(|_| (0..steps).try_for_each(|_| self.step(time_step)))
    }

    fn step(&mut self, time_step: f64) -> Result<(), Unstable> {
        if self.steps.is_multiple_of(REORDER_EVERY) {
            self.reorder();
        }
        let fluid = self.particles.fluid;
        self.before.position.clear();
        self.before.velocity.clear();
        self.before.density.clear();
        (self.before.position).extend_from_slice(&self.particles.position[..fluid]);
        (self.before.velocity).extend_from_slice(&self.particles.velocity[..fluid]);
        (self.before.density).extend_from_slice(&self.particles.density[..fluid]);
        self.go(0.5 * time_step);
        self.look()?;
        self.evaluate();
        self.go(time_step);
        self.steps += 1;
        self.time += time_step;
        self.look()
    }

    fn look(&self) -> Result<(), Unstable> {
        let sound_speed = self.settings.medium.sound_speed;
        Unstable::look(&self.particles, sound_speed, self.steps, self.time)
    }

    /// The state after a time from the beginning of the step, with the last rates: u = u⁰ + ∆t du/dt, r = r⁰ + ∆t ½(u⁰ + u),
    /// ρ = ρ⁰ + ∆t dρ/dt.
    fn go(&mut self, time: f64) {
        let (before, rates) = (&self.before, &self.rates);
        let fluid = self.particles.fluid;
        let velocity = &mut self.particles.velocity[..fluid];
        each(velocity, |i| {
            point::add_scaled(before.velocity[i], time, rates[i].acceleration)
        });
        let velocity = &*velocity;
        each(&mut self.particles.position[..fluid], |i| {
            let both = point::add(before.velocity[i], velocity[i]);
            point::add_scaled(before.position[i], 0.5 * time, both)
        });
        let medium = &self.settings.medium;
        let density = &mut self.particles.density[..fluid];
        each(density, |i| before.density[i] + time * rates[i].density);
        let density = &*density;
        each(&mut self.particles.pressure[..fluid], |i| {
            medium.pressure_at(density[i])
        });
    }

    /// Rates at the present state: walls from the fluid, and all sums over pairs.
    fn evaluate(&mut self) {
        let StandardSettings {
            medium,
            viscosity,
            friction,
        } = self.settings;
        let h = medium.smoothing_length;
        let fluid = self.particles.fluid;
        // Walls do not hold the fluid back: it may leave them.
        self.walls.extrapolate(&mut self.particles, &medium, 0.0);
        let Particles {
            density, pressure, ..
        } = &mut self.particles;
        let pressure = &*pressure;
        each(&mut density[fluid..], |w| {
            medium.density_at(pressure[fluid + w])
        });
        let of = &self.particles;
        each(&mut self.volume, |i| of.mass[i] / of.density[i]);
        (self.near).update(&of.position, &self.volume, |i| i < fluid);
        self.near.fill(stride(D), |i, row| {
            row[..D].copy_from_slice(&of.velocity[i]);
            row[D..].copy_from_slice(&[of.pressure[i], of.density[i]]);
        });
        let terms = Rates {
            viscosity: viscosity * medium.sound_speed * h * medium.density,
            softening: softening(h),
        };
        self.near.sum(&terms, &mut self.sums);
        let (near, sums, volume) = (&self.near, &self.sums, &self.volume);
        self.rates.resize(fluid, StandardRate::NONE);
        each(&mut self.rates, |i| {
            let sum = near.of(sums, i);
            let pushed = point::add(point::of_slice(&sum.acceleration), medium.force);
            StandardRate {
                acceleration: point::add_scaled(pushed, -friction, of.velocity[i]),
                density: sum.density,
                on_walls: point::scale(point::of_slice(&sum.on_walls), volume[i]),
            }
        });
    }

    /// Puts the fluid in the order of the list, block by block, and back into the box: what is near in space is near in memory.
    fn reorder(&mut self) {
        let order = self.near.list().target_particles().to_vec();
        self.particles.reorder(&order);
        reorder(&mut self.rates, &order);
        let fluid = self.particles.fluid;
        for position in &mut self.particles.position[..fluid] {
            *position = self.domain.wrap(*position);
        }
        self.near.invalidate();
        self.walls.invalidate();
    }
}
