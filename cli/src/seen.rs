//! What the kernel that judges sees of a packing, and masses corrected for it.

use sphpack_packing::{Fields, Kind, MassCorrection, Packed, Problem, correct_masses};

use crate::labels::Sorted;

/// The packing's particles, and, where the kernel that judges reaches beyond its frozen ones, more of their lattice.
pub(crate) struct Seen<const D: usize> {
    positions: Vec<[f64; D]>,
    volumes: Vec<f64>,
}

impl<const D: usize> Seen<D> {
    /// What the problem `judge` sees of a packing that came from `problem`.
    pub(crate) fn by(judge: &Problem<D>, problem: &Problem<D>, packed: &Packed<D>) -> Self {
        let mut positions = packed.particles.position.clone();
        let mut volumes = packed.particles.volume.clone();
        if judge.support() > problem.frozen_depth() {
            let there = problem.domain.bounds.grown(problem.frozen_depth());
            positions.extend(
                packed
                    .frozen_lattice
                    .continued(&problem.domain, judge.frozen_depth())
                    .into_iter()
                    .filter(|&p| !there.contains(p)),
            );
            volumes.resize(positions.len(), problem.filling().volume_per_site());
        }
        Self { positions, volumes }
    }

    /// Γ and ∇Γ by the kernel that judges; zero for frozen particles.
    pub(crate) fn fields(&self, judge: &Problem<D>, kind: &[Kind]) -> Fields<D> {
        let is_measured = |i: usize| kind.get(i).is_some_and(|&kind| kind != Kind::Frozen);
        let mut fields = Fields::measure(
            &judge.domain,
            &self.positions,
            &self.volumes,
            is_measured,
            judge.kernel,
            judge.smoothing_length(),
        );
        fields.gamma.truncate(kind.len());
        fields.gradient.truncate(kind.len());
        fields
    }

    /// Corrects the volumes for the kernel that judges, here and in the packing. Those of a body, of the fluid, and of
    /// what is left out each keep their sum; so do those on a surface that is partly in the fluid.
    pub(crate) fn correct(
        &mut self,
        judge: &Problem<D>,
        packed: &mut Packed<D>,
        sorted: &Sorted,
        spread: f64,
    ) -> MassCorrection {
        let particles = &mut packed.particles;
        let is_shared = |i: usize| {
            particles.kind[i].is_on_surface()
                && particles.body[i]
                    .is_some_and(|body| judge.bodies[usize::from(body)].inner_share() < 1.0)
        };
        let mut group: Vec<Option<usize>> = (0..particles.len())
            .map(|i| {
                let body = sorted.labels.body[i].map_or(0, |body| usize::from(body) + 1);
                let part = 2 * usize::from(is_shared(i)) + usize::from(sorted.keep[i]);
                (particles.kind[i] != Kind::Frozen).then_some(4 * body + part)
            })
            .collect();
        group.resize(self.positions.len(), None);
        let correction = correct_masses(
            &judge.domain,
            &self.positions,
            &mut self.volumes,
            &group,
            judge.kernel,
            judge.smoothing_length(),
            spread,
        );
        let count = particles.len();
        particles.volume.copy_from_slice(&self.volumes[..count]);
        correction
    }
}
