//! A periodic box of a lattice that moves by the forces that packings move by.

use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Domain, point};
use sphpack_packing::Lattice;
use sphpack_packing::forces::Forces;
use sphpack_pairs::Repulsion;

/// The skin of neighbour lists, in ∆s.
const SKIN: f64 = 0.3;

/// The published time step where nothing is fast (Negi & Ramachandran 2021, eq. 25, p_b = 1): this part of h.
pub(super) const PUBLISHED: f64 = 0.1;

/// Sites and the particles that began there; lengths in ∆s, times in ∆s √(ρ/p_b).
pub(super) struct Evolution<const D: usize> {
    pub(super) sites: Vec<[f64; D]>,
    places: Vec<[f64; D]>,
    velocities: Vec<[f64; D]>,
    volumes: Vec<f64>,
    forces: Forces<D>,
}

/// How many unit cells make a box of about this edge, in ∆s.
pub(super) fn cells<const D: usize>(lattice: Lattice, edge: f64) -> [usize; D] {
    let cell = lattice.unit_cell::<D>().cell();
    cell.map(|length| (edge / length).round().max(1.0) as usize)
}

impl<const D: usize> Evolution<D> {
    /// A lattice at rest in a periodic box of whole cells.
    pub(super) fn new(
        lattice: Lattice,
        kernel: KernelKind,
        h: f64,
        cells: [usize; D],
        repulsion: Repulsion,
    ) -> Self {
        let cell = lattice.unit_cell::<D>().cell();
        let edges = std::array::from_fn(|axis| cells[axis] as f64 * cell[axis]);
        let domain = Domain::new([0.0; D], edges).with_periodic([true; D]);
        let filling = lattice.fill(domain.bounds, 1.0);
        let sites = filling.sites();
        Self {
            places: sites.clone(),
            velocities: vec![[0.0; D]; sites.len()],
            volumes: vec![filling.volume_per_site(); sites.len()],
            forces: Forces::new(&domain, kernel, h, SKIN, repulsion),
            sites,
        }
    }

    /// Puts every particle off its site, at rest.
    pub(super) fn displace(&mut self, by: impl Fn(usize) -> [f64; D]) {
        for (i, (place, site)) in self.places.iter_mut().zip(&self.sites).enumerate() {
            *place = point::add(*site, by(i));
        }
        self.velocities.fill([0.0; D]);
    }

    /// One step of semi-implicit Euler with damping −ζu, as the damped methods take it.
    pub(super) fn step(&mut self, dt: f64, zeta: f64) {
        (self.forces).evaluate_plain(&self.places, &self.volumes, |_| true);
        for (i, (place, velocity)) in (self.places.iter_mut().zip(&mut self.velocities)).enumerate()
        {
            let force = point::add_scaled(self.forces.acceleration(i), -zeta, *velocity);
            *velocity = point::add_scaled(*velocity, dt, force);
            *place = point::add_scaled(*place, dt, *velocity);
        }
    }

    /// Σ u_i · f_i / Σ f_i²: how much of a field is in the displacements.
    pub(super) fn along(&self, field: &[[f64; D]]) -> f64 {
        let (mut sum, mut squares) = (0.0, 0.0);
        for (i, way) in field.iter().enumerate() {
            sum += point::dot(point::sub(self.places[i], self.sites[i]), *way);
            squares += point::norm_squared(*way);
        }
        sum / squares
    }

    /// The root mean square of the displacements.
    pub(super) fn spread(&self) -> f64 {
        let squares = (self.places.iter().zip(&self.sites))
            .map(|(place, site)| point::distance_squared(*place, *site));
        (squares.sum::<f64>() / self.places.len() as f64).sqrt()
    }

    /// The energy where the particles are, per p_b ∆s^D.
    pub(super) fn energy(&mut self) -> f64 {
        (self.forces).evaluate_plain(&self.places, &self.volumes, |_| true);
        self.forces.energy()
    }
}
