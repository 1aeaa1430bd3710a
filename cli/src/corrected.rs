//! Masses corrected for the kernel that judges.

use sphpack_packing::{Kind, MassCorrection, Packed, Problem, correct_masses};

use crate::labels::Sorted;

/// Corrects the packing's volumes for the kernel that judges. Those of a body, of the fluid, and of
/// what is left out each keep their sum; so do those on a surface that is partly in the fluid.
pub(crate) fn correct<const D: usize>(
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
    let group: Vec<Option<usize>> = (0..particles.len())
        .map(|i| {
            let body = sorted.labels.body[i].map_or(0, |body| usize::from(body) + 1);
            let part = 2 * usize::from(is_shared(i)) + usize::from(sorted.keep[i]);
            (particles.kind[i] != Kind::Frozen).then_some(4 * body + part)
        })
        .collect();
    correct_masses(
        &judge.domain,
        &particles.position,
        &mut particles.volume,
        &group,
        judge.kernel,
        judge.smoothing_length(),
        spread,
    )
}
