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
    /// How that of every body is spread, where that of the true one is known.
    pub(crate) spread: Vec<Option<Spread<D>>>,
}

/// How the volume of a body is spread.
pub(crate) struct Spread<const D: usize> {
    /// The true body's.
    pub(crate) exact: Moments<D>,
    /// Its particles', as points; `None` where there are none. What has images across periodic sides is put together around the true centre.
    pub(crate) particles: Option<Moments<D>>,
}

impl<const D: usize> Content<D> {
    pub(crate) fn of(problem: &Problem<D>, solution: &Solution<D>) -> Self {
        let mut volumes = vec![0.0; problem.bodies.len() + 1];
        let mut sums: Vec<Option<(Moments<D>, MomentSums<D>)>> = (problem.bodies.iter())
            .map(|body| {
                let exact = body.surface.moments()?;
                Some((exact, MomentSums::about(exact.center)))
            })
            .collect();
        for_each(problem, solution, &mut |holder, p, volume| {
            volumes[holder] += volume;
            if let Some(Some((exact, sums))) = sums.get_mut(holder) {
                let away = problem.domain.difference(p, exact.center);
                sums.add(point::add(exact.center, away), volume);
            }
        });
        let spread = (sums.into_iter())
            .map(|sums| {
                let (exact, sums) = sums?;
                Some(Spread {
                    exact,
                    particles: sums.moments(),
                })
            })
            .collect();
        Self { volumes, spread }
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
