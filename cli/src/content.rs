//! How much of every body the particles hold.

use sphpack_neighbors::point;
use sphpack_packing::{Kind, Problem};

use crate::solution::Solution;

/// How far behind a surface it is asked who is there, in ∆s.
const BEYOND_OVER_SPACING: f64 = 0.1;

/// The volume of every body's particles, and of the fluid's last, by labels: what roles leave out is in it too. Of a
/// particle on a surface that is less than ∆s/2 inside the true one, a part is beyond it (half, on an exact surface): that
/// belongs to whatever is there, another body or the fluid.
pub(crate) fn volumes<const D: usize>(problem: &Problem<D>, solution: &Solution<D>) -> Vec<f64> {
    let Solution { packed, labels, .. } = solution;
    let particles = &packed.particles;
    let bodies = &problem.bodies;
    let mut volumes = vec![0.0; bodies.len() + 1];
    for i in (0..particles.len()).filter(|&i| particles.kind[i] != Kind::Frozen) {
        let volume = particles.volume[i];
        let on = (particles.on_surface(i).map(usize::from))
            .map(|own| (own, bodies[own].inner_share()))
            .filter(|(_, share)| *share < 1.0);
        let holder = labels.body[i].map_or(bodies.len(), usize::from);
        // On an exact void the label is of what is around it.
        let (inner, share) = on.unwrap_or((holder, 1.0));
        volumes[inner] += share * volume;
        if let Some((own, share)) = on {
            let hit = bodies[own].surface.closest(particles.position[i]);
            let beyond = point::add_scaled(
                hit.point,
                BEYOND_OVER_SPACING * problem.spacing(),
                hit.normal,
            );
            let there = (0..bodies.len())
                .find(|&b| b != own && bodies[b].surface.inside(beyond))
                .unwrap_or(bodies.len());
            volumes[there] += (1.0 - share) * volume;
        }
    }
    volumes
}
