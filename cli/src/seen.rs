//! What the kernel that judges sees of a packing, and masses corrected for it.

use std::borrow::Cow;

use sphpack_packing::{Fields, Kind, MassCorrection, Packed, Problem, correct_masses};

use crate::labels::Sorted;

/// What the kernel that judges sees beside a packing's particles: where it reaches beyond the frozen ones, more of their
/// lattice.
pub(crate) struct Seen<const D: usize> {
    beyond: Vec<[f64; D]>,
    /// The volume of each.
    volume: f64,
}

impl<const D: usize> Seen<D> {
    /// What the problem `judge` sees beside a packing that came from `problem`.
    pub(crate) fn by(judge: &Problem<D>, problem: &Problem<D>, packed: &Packed<D>) -> Self {
        let volume = problem.filling().volume_per_site();
        if judge.support() <= problem.frozen_depth() {
            return Self {
                beyond: Vec::new(),
                volume,
            };
        }
        let there = problem.domain.bounds.grown(problem.frozen_depth());
        let more = packed
            .frozen_lattice
            .continued(&problem.domain, judge.frozen_depth());
        Self {
            beyond: more.into_iter().filter(|&p| !there.contains(p)).collect(),
            volume,
        }
    }

    fn positions<'a>(&self, own: &'a [[f64; D]]) -> Cow<'a, [[f64; D]]> {
        if self.beyond.is_empty() {
            Cow::Borrowed(own)
        } else {
            Cow::Owned([own, &self.beyond].concat())
        }
    }

    fn volumes<'a>(&self, own: &'a [f64]) -> Cow<'a, [f64]> {
        if self.beyond.is_empty() {
            Cow::Borrowed(own)
        } else {
            let more = std::iter::repeat_n(self.volume, self.beyond.len());
            Cow::Owned(own.iter().copied().chain(more).collect())
        }
    }

    /// Γ and ∇Γ by the kernel that judges; zero for frozen particles.
    pub(crate) fn fields(&self, judge: &Problem<D>, packed: &Packed<D>) -> Fields<D> {
        let particles = &packed.particles;
        let is_measured = |i: usize| (particles.kind.get(i)).is_some_and(|&k| k != Kind::Frozen);
        let mut fields = Fields::measure(
            &judge.domain,
            &self.positions(&particles.position),
            &self.volumes(&particles.volume),
            is_measured,
            judge.kernel,
            judge.smoothing_length(),
        );
        fields.gamma.truncate(particles.len());
        fields.gradient.truncate(particles.len());
        fields
    }

    /// Corrects the packing's volumes for the kernel that judges. Those of a body, of the fluid, and of
    /// what is left out each keep their sum; so do those on a surface that is partly in the fluid.
    pub(crate) fn correct(
        &self,
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
        group.resize(particles.len() + self.beyond.len(), None);
        let mut volumes = self.volumes(&particles.volume).into_owned();
        let correction = correct_masses(
            &judge.domain,
            &self.positions(&particles.position),
            &mut volumes,
            &group,
            judge.kernel,
            judge.smoothing_length(),
            spread,
        );
        let count = particles.len();
        particles.volume.copy_from_slice(&volumes[..count]);
        correction
    }
}
