//! How much of every body the particles hold, and where.

use sphpack_geometry::{MomentSums, Moments};
use sphpack_neighbors::point;
use sphpack_packing::{Kind, Problem};

use crate::solution::Solution;

/// How far behind a surface it is asked who is there, in ∆s.
const BEYOND_OVER_SPACING: f64 = 0.1;

/// What bodies hold.
pub(crate) struct Content<const D: usize> {
    /// The volume of every body's particles, and of the fluid's last, by labels: what roles leave out is in it too.
    pub(crate) volumes: Vec<f64>,
    /// Volume, centre and second moments of the particles of every body, as points, where the true body's are known. What has images
    /// across periodic sides is put together around the true centre.
    pub(crate) moments: Vec<Option<Moments<D>>>,
}

impl<const D: usize> Content<D> {
    pub(crate) fn of(problem: &Problem<D>, solution: &Solution<D>) -> Self {
        let mut volumes = vec![0.0; problem.bodies.len() + 1];
        let centers = problem.bodies.iter().map(|body| body.surface.moments());
        let mut sums: Vec<Option<MomentSums<D>>> = centers
            .map(|moments| moments.map(|moments| MomentSums::about(moments.center)))
            .collect();
        let domain = &problem.domain;
        let size = domain.bounds.size();
        for_each(problem, solution, &mut |holder, p, volume| {
            volumes[holder] += volume;
            if let Some(Some(sums)) = sums.get_mut(holder) {
                let near = std::array::from_fn(|k| {
                    let away = p[k] - sums.origin()[k];
                    let periods =
                        (away / size[k]).round() * f64::from(u8::from(domain.periodic[k]));
                    p[k] - size[k] * periods
                });
                sums.add(near, volume);
            }
        });
        Self {
            volumes,
            moments: sums.into_iter().map(|sums| sums?.moments()).collect(),
        }
    }
}

/// Tells which body, or the fluid, holds which volume where. Of a particle on a surface that is less than ∆s/2 inside the true one, a part is
/// beyond it (half, on an exact surface): that belongs to whatever is there, another body or the fluid.
fn for_each<const D: usize>(
    problem: &Problem<D>,
    solution: &Solution<D>,
    tell: &mut dyn FnMut(usize, [f64; D], f64),
) {
    let Solution { packed, labels, .. } = solution;
    let particles = &packed.particles;
    let bodies = &problem.bodies;
    for i in (0..particles.len()).filter(|&i| particles.kind[i] != Kind::Frozen) {
        let (place, volume) = (particles.position[i], particles.volume[i]);
        let on = (particles.on_surface(i).map(usize::from))
            .map(|own| (own, bodies[own].inner_share()))
            .filter(|(_, share)| *share < 1.0);
        let holder = labels.body[i].map_or(bodies.len(), usize::from);
        // On an exact void the label is of what is around it.
        let (inner, share) = on.unwrap_or((holder, 1.0));
        tell(inner, place, share * volume);
        if let Some((own, share)) = on {
            let hit = bodies[own].surface.closest(place);
            let beyond = point::add_scaled(
                hit.point,
                BEYOND_OVER_SPACING * problem.spacing(),
                hit.normal,
            );
            let there = (0..bodies.len())
                .find(|&b| b != own && bodies[b].surface.inside(beyond))
                .unwrap_or(bodies.len());
            tell(there, place, (1.0 - share) * volume);
        }
    }
}
