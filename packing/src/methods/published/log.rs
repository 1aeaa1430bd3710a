//! What the papers' methods do alike: how they begin, look at where they stand, and end where nothing moves.

use std::time::Instant;

use sphpack_pairs::Repulsion;

use crate::forces::Forces;
use crate::lattice::Filling;
use crate::methods::info::MethodInfo;
use crate::observer::Stage;
use crate::packed::{Packed, ParticleSurface, StopReason};
use crate::particles::Particles;
use crate::problem::{PackingError, Problem};
use crate::run_log::RunLog;
use crate::seeding::particle_surfaces;

impl RunLog<'_> {
    /// The particle surfaces of a problem that makes sense: how methods begin.
    pub(crate) fn surfaces<const D: usize>(
        &mut self,
        problem: &Problem<D>,
    ) -> Result<Vec<ParticleSurface<D>>, PackingError> {
        problem.check_uniform()?;
        self.enter(Stage::Geometry);
        let geometry = Instant::now();
        let surfaces = particle_surfaces(problem)?;
        self.progress.target = surfaces.iter().map(|surface| surface.target_count).sum();
        self.seconds.geometry = geometry.elapsed().as_secs_f64();
        Ok(surfaces)
    }

    /// Looks at where a loop stands, tells and notes it: whether `criterion` is below the tolerance.
    pub(crate) fn look<const D: usize>(
        &mut self,
        evaluation: usize,
        criterion: f64,
        forces: &Forces<D>,
        particles: &Particles<D>,
    ) -> bool {
        self.progress.evaluation = evaluation;
        self.progress.criterion = criterion;
        self.tell();
        self.note(forces, particles);
        criterion < self.progress.tolerance
    }

    /// The result of a method whose particles stay where they were put, measured once.
    pub(crate) fn end_unmoved<const D: usize>(
        &mut self,
        problem: &Problem<D>,
        particles: Particles<D>,
        frozen_lattice: Filling<D>,
        surfaces: Vec<ParticleSurface<D>>,
    ) -> Packed<D> {
        let mut forces = Forces::of(problem, Repulsion::none());
        forces.evaluate(&particles);
        self.progress.evaluation = 1;
        self.note(&forces, &particles);
        self.end(
            problem,
            particles,
            frozen_lattice,
            surfaces,
            &forces,
            StopReason::Converged,
        )
        .with_known_sides()
    }
}

impl MethodInfo {
    /// Whether a method whose particle surfaces are the true ones moved inward will take the problem.
    ///
    /// # Errors
    /// Those of [`Method::pack`](crate::Method::pack).
    pub(crate) fn check<const D: usize>(&self, problem: &Problem<D>) -> Result<(), PackingError> {
        self.check_dimension(D)?;
        problem.check_uniform()?;
        particle_surfaces(problem).map(drop)
    }

    /// Whether it works in `dimension`.
    ///
    /// # Errors
    /// [`PackingError::OnlyPlane`].
    pub(crate) fn check_dimension(&self, dimension: usize) -> Result<(), PackingError> {
        if self.dimensions.contains(&dimension) {
            return Ok(());
        }
        Err(PackingError::OnlyPlane { method: self.name })
    }
}
