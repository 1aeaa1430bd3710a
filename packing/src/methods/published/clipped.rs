//! A lattice clipped by the bodies: what everyone starts from (Negi & Ramachandran preprint, §3).

use std::time::Instant;

use crate::estimate::Work;
use crate::methods::info::{MethodInfo, Moves};
use crate::observer::Stage;
use crate::packed::Packed;
use crate::particles::Kind;
use crate::problem::{PackingError, Problem};
use crate::run_log::RunLog;
use crate::seeding::{Seeds, particle_surfaces, seed};

/// Leaves every particle on its lattice site; a site inside a body is the body's. The density is the lattice's, the
/// surface a staircase, volumes off by what the sites happen to be.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Clipped;

impl Clipped {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "clipped",
        summary: "the lattice as it is, clipped by the bodies: what to compare with",
        moves: Moves::Nothing,
        work: Work::PLAIN,
        ..MethodInfo::USUAL
    };

    /// Fills the box. One evaluation, to measure.
    ///
    /// # Errors
    /// Those of [`Problem::check`], and [`PackingError::Surface`].
    pub(crate) fn pack_in<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
    ) -> Result<Packed<D>, PackingError> {
        log.begin(&Self::INFO, 0.0, 1);
        log.enter(Stage::Seeding);
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
        log.seconds.seeding = seeding.elapsed().as_secs_f64();
        Ok(log.end_unmoved(problem, particles, frozen_lattice, surfaces))
    }
}
