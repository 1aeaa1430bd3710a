//! A lattice clipped by the bodies: what everyone starts from (000 §3).

use std::time::Instant;

use crate::course::Course;
use crate::observer::{Observer, Phase};
use crate::packed::Packed;
use crate::particles::Kind;
use crate::problem::{PackingError, Problem};
use crate::seeding::{Seeds, particle_surfaces, seed};

/// Leaves every particle on its lattice site; a site inside a body is the body's. The density is the lattice's, the
/// surface a staircase, volumes off by what the sites happen to be.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Clipped;

impl Clipped {
    /// Fills the box. One evaluation, to measure.
    ///
    /// # Errors
    /// Those of [`Problem::check`], and [`PackingError::Surface`].
    pub(crate) fn pack_in<const D: usize>(
        &self,
        problem: &Problem<D>,
        observer: &mut dyn Observer,
    ) -> Result<Packed<D>, PackingError> {
        let mut course = Course::new(observer, 0.0, 1);
        course.enter(Phase::Seeding);
        let seeding = Instant::now();
        let Seeds {
            mut particles,
            frozen_lattice,
        } = seed(problem)?;
        for (body, number) in problem.bodies.iter().zip(0_u16..) {
            let inside = body.surface.inside_batch(&particles.position);
            for i in 0..particles.len() {
                if inside[i] && particles.kind[i] == Kind::Free && particles.body[i].is_none() {
                    particles.body[i] = Some(number);
                }
            }
        }
        let surfaces = particle_surfaces(problem)?;
        course.seconds.seeding = seeding.elapsed().as_secs_f64();
        Ok(course.end_unmoved(problem, particles, frozen_lattice, surfaces))
    }
}
