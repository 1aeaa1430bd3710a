//! Entropically damped artificial compressibility with transport velocity (Ramachandran & Puri 2019, on Adami, Hu & Adams 2013).
//!
//! Pressure is integrated, density only serves for volumes: with σ_i = Σ_j W_ij over fluid and walls ρ_i = m_i σ_i and
//! V_i = 1/σ_i, of walls too, whose density is ρ₀.

mod number_density;
mod rates;

use sphpack_kernels::{Kernel, Quintic};
use sphpack_neighbors::{Domain, point};

use crate::fringe::Fringe;
use crate::medium::Medium;
use crate::neighborhood::Neighborhood;
use crate::parallel::each;
use crate::particles::{Particles, reorder};
use crate::softening::softening;
use crate::unstable::Unstable;
use crate::walls::Walls;
use number_density::NumberDensity;
use rates::{RateSum, Rates, stride};

/// What the scheme needs to know.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdacSettings<const D: usize> {
    /// The fluid.
    pub medium: Medium<D>,
    /// The kinematic viscosity ν.
    pub viscosity: f64,
    /// α_e in ν_e = α_e h c/8, by which pressure diffuses.
    pub damping: f64,
    /// A strip that makes the stream uniform again.
    pub fringe: Option<Fringe<D>>,
}

impl<const D: usize> EdacSettings<D> {
    /// With α_e = 0.5 and no fringe.
    pub fn new(medium: Medium<D>, viscosity: f64) -> Self {
        Self {
            medium,
            viscosity,
            damping: 0.5,
            fringe: None,
        }
    }
}

/// A flow that this scheme carries on.
#[derive(Debug)]
pub struct Edac<const D: usize> {
    settings: EdacSettings<D>,
    domain: Domain<D>,
    particles: Particles<D>,
    near: Neighborhood<D>,
    walls: Walls<D>,
    /// ũ of the fluid.
    transport: Vec<[f64; D]>,
    /// V of all.
    volume: Vec<f64>,
    /// Of the fluid, as last evaluated.
    rates: Vec<EdacRate<D>>,
    /// The fluid at the beginning of a step.
    before: Before<D>,
    time: f64,
    steps: usize,
    /// What the two walks found, kept so that nothing is allocated again.
    number_density: Vec<f64>,
    sums: Vec<RateSum>,
}

/// How a particle of fluid changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdacRate<const D: usize> {
    /// du/dt.
    pub acceleration: [f64; D],
    /// ã: what the transport velocity makes of an uneven packing.
    pub transport: [f64; D],
    /// dp/dt.
    pub pressure: f64,
    /// The force that it has on walls by its pressure, and by friction.
    pub on_walls: [[f64; D]; 2],
}

impl<const D: usize> EdacRate<D> {
    const NONE: Self = Self {
        acceleration: [0.0; D],
        transport: [0.0; D],
        pressure: 0.0,
        on_walls: [[0.0; D]; 2],
    };
}

#[derive(Debug, Default)]
struct Before<const D: usize> {
    position: Vec<[f64; D]>,
    velocity: Vec<[f64; D]>,
    pressure: Vec<f64>,
}

/// Steps between two times that particles are put in the order of the cells.
const REORDER_EVERY: usize = 200;

impl<const D: usize> Edac<D> {
    /// A flow that begins with these particles.
    pub fn new(domain: &Domain<D>, particles: Particles<D>, settings: EdacSettings<D>) -> Self {
        let h = settings.medium.smoothing_length;
        let fluid = particles.fluid;
        let mut volume: Vec<f64> = particles.mass.clone();
        for volume in &mut volume {
            *volume /= settings.medium.density;
        }
        let mut flow = Self {
            settings,
            domain: *domain,
            near: Neighborhood::new(domain, h),
            walls: Walls::new(domain, h),
            transport: particles.velocity[..fluid].to_vec(),
            volume,
            rates: Vec::new(),
            before: Before::default(),
            particles,
            time: 0.0,
            steps: 0,
            number_density: Vec::new(),
            sums: Vec::new(),
        };
        flow.particles.density.fill(settings.medium.density);
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

    /// How the fluid changes, as last evaluated.
    pub fn rates(&self) -> &[EdacRate<D>] {
        &self.rates
    }

    /// The volumes V of all, likewise.
    pub fn volume(&self) -> &[f64] {
        &self.volume
    }

    /// The velocities that viscosity sees in the walls, likewise, wall by wall.
    pub fn dummy_velocity(&self) -> &[[f64; D]] {
        &self.walls.dummy_velocity
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
        self.before.pressure.clear();
        (self.before.position).extend_from_slice(&self.particles.position[..fluid]);
        (self.before.velocity).extend_from_slice(&self.particles.velocity[..fluid]);
        (self.before.pressure).extend_from_slice(&self.particles.pressure[..fluid]);
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

    /// The state after a time from the beginning of the step, with the last rates:
    /// u = u⁰ + ∆t du/dt, ũ = u + ∆t ã, r = r⁰ + ∆t ũ, p = p⁰ + ∆t dp/dt.
    fn go(&mut self, time: f64) {
        let (before, rates) = (&self.before, &self.rates);
        let fluid = self.particles.fluid;
        let velocity = &mut self.particles.velocity[..fluid];
        each(velocity, |i| {
            point::add_scaled(before.velocity[i], time, rates[i].acceleration)
        });
        let velocity = &*velocity;
        each(&mut self.transport, |i| {
            point::add_scaled(velocity[i], time, rates[i].transport)
        });
        let transport = &self.transport;
        each(&mut self.particles.position[..fluid], |i| {
            point::add_scaled(before.position[i], time, transport[i])
        });
        each(&mut self.particles.pressure[..fluid], |i| {
            before.pressure[i] + time * rates[i].pressure
        });
    }

    /// Rates at the present state: walls from the fluid as it was last, volumes, and all sums over pairs.
    fn evaluate(&mut self) {
        let EdacSettings {
            medium, viscosity, ..
        } = self.settings;
        let h = medium.smoothing_length;
        let fluid = self.particles.fluid;
        let no_least = f64::NEG_INFINITY;
        (self.walls).extrapolate(&mut self.particles, &medium, no_least);
        let of = &mut self.particles;
        (self.near).update(&of.position, &self.volume, |i| i < fluid);
        self.near.sum(&NumberDensity, &mut self.number_density);
        let (near, walls, sigma) = (&self.near, &self.walls, &self.number_density);
        each(&mut self.volume, |i| {
            if i < fluid {
                1.0 / near.of(sigma, i)
            } else {
                1.0 / walls.number_density(i)
            }
        });
        let (volume, mass) = (&self.volume, &of.mass);
        each(&mut of.density[..fluid], |i| mass[i] / volume[i]);

        self.near.weigh(&self.volume);
        let (of, transport) = (&self.particles, &self.transport);
        self.near.fill(stride(D), |i, row| {
            let u = of.velocity[i];
            let (first, second) = if i < fluid {
                (
                    u,
                    point::scale(point::sub(transport[i], u), 0.5 * of.density[i]),
                )
            } else {
                (walls.dummy_velocity[i - fluid], u)
            };
            row[..D].copy_from_slice(&first);
            row[D..2 * D].copy_from_slice(&second);
            row[2 * D..].copy_from_slice(&[of.pressure[i], of.density[i]]);
        });
        let terms = Rates {
            viscosity,
            diffusivity: self.settings.damping * h * medium.sound_speed / 8.0,
            sound_squared: medium.sound_speed * medium.sound_speed,
            background: medium.density * medium.sound_speed * medium.sound_speed,
            softening: softening(h),
            support_squared: Quintic::<2>::new(h).support().powi(2),
        };
        self.near.sum(&terms, &mut self.sums);
        let (near, sums) = (&self.near, &self.sums);
        let (fringe, domain) = (&self.settings.fringe, &self.domain);
        self.rates.resize(fluid, EdacRate::NONE);
        each(&mut self.rates, |i| {
            let sum = near.of(sums, i);
            let mut rate = EdacRate {
                acceleration: point::add(point::of_slice(&sum.acceleration), medium.force),
                transport: point::of_slice(&sum.transport),
                pressure: sum.pressure,
                on_walls: sum.on_walls.map(|force| point::of_slice(&force)),
            };
            if let Some(fringe) = fringe {
                let lambda = fringe.rate(domain, of.position[i]);
                let led = fringe.acceleration(lambda, of.velocity[i]);
                rate.acceleration = point::add(rate.acceleration, led);
                rate.pressure -= lambda * of.pressure[i];
            }
            rate
        });
    }

    /// Puts the fluid in the order of the list, block by block, and back into the box: what is near in space is near in memory.
    fn reorder(&mut self) {
        let order = self.near.list().target_particles().to_vec();
        self.particles.reorder(&order);
        reorder(&mut self.transport, &order);
        reorder(&mut self.volume, &order);
        reorder(&mut self.rates, &order);
        let fluid = self.particles.fluid;
        for position in &mut self.particles.position[..fluid] {
            *position = self.domain.wrap(*position);
        }
        self.near.invalidate();
        self.walls.invalidate();
    }
}
