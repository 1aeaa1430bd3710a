//! What a packing gives back.

use std::sync::Arc;

use rayon::prelude::*;
use sphpack_geometry::{Closest, Surface};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::Domain;

use crate::lattice::{Filling, Lattice};
use crate::methods::MethodInfo;
use crate::observer::HistoryPoint;
use crate::particles::Particles;
use crate::problem::Problem;

/// Why a packing stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum StopReason {
    /// The tolerance was reached.
    Converged,
    /// `max_iterations` came first.
    IterationLimit,
    /// Nothing changed any more although the tolerance was not reached.
    Stagnated,
    /// The observer stopped it.
    Interrupted,
}

impl StopReason {
    /// The word that reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::IterationLimit => "iteration-limit",
            Self::Stagnated => "stagnated",
            Self::Interrupted => "interrupted",
        }
    }
}

/// Where the time went, in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Seconds {
    /// Moving surfaces inward, areas and counts.
    pub geometry: f64,
    /// Placing particles.
    pub seeding: f64,
    /// Keeping the neighbour lists.
    pub neighbors: f64,
    /// Density and forces.
    pub forces: f64,
    /// Keeping boundary particles on their surface, and the others on their side of it.
    pub projection: f64,
    /// What else settling takes: the minimiser's own vectors, or moving and capturing.
    pub minimiser: f64,
    /// The whole packing.
    pub total: f64,
}

/// A surface as the particles see it.
#[derive(Debug, Clone)]
pub struct ParticleSurface<const D: usize> {
    /// The set that boundary particles sit on: the body's surface, moved inward by the inset.
    pub surface: Arc<dyn Surface<D>>,
    /// N_s = A_s/∆s^(D−1), the number of particles that it should carry, rounded.
    pub target_count: usize,
}

/// A particle on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceParticle<const D: usize> {
    /// Its index.
    pub particle: usize,
    /// The nearest point of its body's particle surface, with the normal there.
    pub hit: Closest<D>,
}

/// A part of a body that has no particles because it holds less than half of one. Its volume is with what is around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Omitted<const D: usize> {
    /// The body's index.
    pub body: usize,
    /// A point of its surface, scene units.
    pub at: [f64; D],
    /// Its volume, scene units to the power D.
    pub volume: f64,
}

/// Particles at rest, with what is known about them and how they came there.
#[derive(Debug, Clone)]
pub struct Packed<const D: usize> {
    /// What was to be packed.
    pub problem: Problem<D>,
    /// The method that packed it.
    pub method: &'static MethodInfo,
    /// All particles, frozen ones included.
    pub particles: Particles<D>,
    /// The box.
    pub domain: Domain<D>,
    /// ∆s, scene units.
    pub spacing: f64,
    /// The lattice that it started from.
    pub lattice: Lattice,
    /// The lattice that the frozen particles continue, and go on continuing beyond them.
    pub frozen_lattice: Filling<D>,
    /// The kernel that packed.
    pub kernel: KernelKind,
    /// Its smoothing length over ∆s.
    pub h_over_spacing: f64,
    /// The names of the bodies.
    pub bodies: Vec<String>,
    /// The surface of each body, in the order of the problem's bodies.
    pub surfaces: Vec<ParticleSurface<D>>,
    /// The boundary and fixed particles, ascending, each with where it is on its surface: asked once, at the end.
    pub on_surface: Vec<SurfaceParticle<D>>,
    /// Whether `particles.body` says of every free particle which body it is part of, `None` for the fluid.
    pub knows_sides: bool,
    /// Parts that were too small for a particle, by methods that pack parts.
    pub omitted: Vec<Omitted<D>>,
    /// The volume that each body's particles have beyond its own ([`Thin::Watertight`](sphpack_geometry::Thin)), by methods that know
    /// thin parts; what is around it has so much less.
    pub excess: Vec<f64>,
    /// Why it stopped.
    pub stop_reason: StopReason,
    /// Iterations of the method.
    pub iterations: usize,
    /// Evaluations of density and force.
    pub force_evaluations: usize,
    /// Figures along the way.
    pub history: Vec<HistoryPoint>,
    /// Where the time went.
    pub seconds: Seconds,
}

impl<const D: usize> ParticleSurface<D> {
    /// Where the particles of these surfaces are on them. One query for each, parallel.
    pub(crate) fn seats(surfaces: &[Self], particles: &Particles<D>) -> Vec<SurfaceParticle<D>> {
        let on_surface: Vec<usize> = (0..particles.len())
            .filter(|&i| particles.on_surface(i).is_some())
            .collect();
        (on_surface.into_par_iter().with_min_len(64))
            .filter_map(|particle| {
                let body = usize::from(particles.on_surface(particle)?);
                let hit = surfaces
                    .get(body)?
                    .surface
                    .closest(particles.position[particle]);
                Some(SurfaceParticle { particle, hit })
            })
            .collect()
    }
}

impl<const D: usize> Packed<D> {
    /// Where all particles are, frozen ones included.
    pub fn positions(&self) -> &[[f64; D]] {
        &self.particles.position
    }

    pub(crate) fn with_known_sides(self) -> Self {
        Self {
            knows_sides: true,
            ..self
        }
    }
}
