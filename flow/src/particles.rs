//! What flows, and the walls that it flows along.

use sphpack_neighbors::point;

/// Particles of fluid, and after them those of walls: a column per field.
///
/// Walls are *dummy particles* (Adami, Hu & Adams 2012): layers within the body, as deep as the kernel reaches, that carry the
/// pressure and the velocity which the fluid beside them asks for. The crate knows no geometry: normals and speeds come from
/// whoever made the particles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Particles<const D: usize> {
    /// How many are fluid: the first ones.
    pub fluid: usize,
    /// A number that stays with the particle, for the fluid's change their places.
    pub id: Vec<u32>,
    /// Positions.
    pub position: Vec<[f64; D]>,
    /// Velocities u; of walls the true ones.
    pub velocity: Vec<[f64; D]>,
    /// Masses; of walls ρ₀ times their volume.
    pub mass: Vec<f64>,
    /// Pressures; of walls extrapolated from the fluid.
    pub pressure: Vec<f64>,
    /// Densities.
    pub density: Vec<f64>,
    /// Of walls alone: their acceleration.
    pub wall_acceleration: Vec<[f64; D]>,
    /// Of walls alone: the unit normal where fluid slips along them, zero where it does not.
    pub slip_normal: Vec<[f64; D]>,
}

impl<const D: usize> Particles<D> {
    /// Appends a particle of fluid.
    ///
    /// # Panics
    /// Where there are walls already: the fluid comes first.
    pub fn add_fluid(&mut self, position: [f64; D], velocity: [f64; D], mass: f64, pressure: f64) {
        assert_eq!(self.fluid, self.len(), "the fluid comes before the walls");
        self.add(position, velocity, mass, pressure);
        self.fluid += 1;
    }

    /// Appends a particle of a wall at rest along which fluid does not slip.
    pub fn add_wall(&mut self, position: [f64; D], mass: f64) {
        self.add(position, [0.0; D], mass, 0.0);
        self.wall_acceleration.push([0.0; D]);
        self.slip_normal.push([0.0; D]);
    }

    fn add(&mut self, position: [f64; D], velocity: [f64; D], mass: f64, pressure: f64) {
        self.id.push(self.len() as u32);
        self.position.push(position);
        self.velocity.push(velocity);
        self.mass.push(mass);
        self.pressure.push(pressure);
        self.density.push(0.0);
    }

    /// Number of particles, walls included.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// The fluid's kinetic energy.
    pub fn kinetic_energy(&self) -> f64 {
        (self.velocity[..self.fluid].iter().zip(&self.mass))
            .map(|(&u, m)| 0.5 * m * point::norm_squared(u))
            .sum()
    }

    /// The fluid's momentum.
    pub fn momentum(&self) -> [f64; D] {
        (self.velocity[..self.fluid].iter().zip(&self.mass))
            .fold([0.0; D], |sum, (&u, &m)| point::add_scaled(sum, m, u))
    }

    /// The fluid's greatest speed.
    pub fn fastest(&self) -> f64 {
        (self.velocity[..self.fluid].iter())
            .map(|&u| point::norm_squared(u))
            .fold(0.0, f64::max)
            .sqrt()
    }

    /// The place of each particle by its id.
    pub fn by_id(&self) -> Vec<usize> {
        let mut places = vec![0; self.len()];
        for (place, &id) in self.id.iter().enumerate() {
            places[id as usize] = place;
        }
        places
    }

    /// Puts the fluid into another order.
    pub(crate) fn reorder(&mut self, order: &[u32]) {
        reorder(&mut self.id, order);
        reorder(&mut self.position, order);
        reorder(&mut self.velocity, order);
        reorder(&mut self.mass, order);
        reorder(&mut self.pressure, order);
        reorder(&mut self.density, order);
    }
}

/// Puts the first entries, as many as `order` has, into that order.
pub(crate) fn reorder<T: Copy>(values: &mut [T], order: &[u32]) {
    let ordered: Vec<T> = order.iter().map(|&i| values[i as usize]).collect();
    values[..order.len()].copy_from_slice(&ordered);
}
