//! What Negi & Ramachandran (2021), §3.1.9 have done before the first step, so that fewer are needed.

use rayon::prelude::*;

use crate::packed::ParticleSurface;
use crate::particles::{Kind, Particles};

/// Turns the free particles nearest to every surface into its boundary particles, until it has `part` of its target
/// with the corners that it has already (Negi & Ramachandran 2021, §3.1.9). None farther than ∆s.
pub(crate) fn predict<const D: usize>(
    particles: &mut Particles<D>,
    surfaces: &[ParticleSurface<D>],
    part: f64,
    spacing: f64,
) {
    for (surface, body) in surfaces.iter().zip(0_u16..) {
        let mut near: Vec<(f64, usize)> = (0..particles.len())
            .into_par_iter()
            .with_min_len(256)
            .filter(|&i| particles.kind[i] == Kind::Free)
            .filter_map(|i| {
                let hit = surface
                    .surface
                    .closest_within(particles.position[i], spacing)?;
                Some((hit.distance.abs(), i))
            })
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let wanted = (part * surface.target_count as f64).round() as usize;
        let has = (0..particles.len())
            .filter(|&i| particles.kind[i] == Kind::Fixed && particles.body[i] == Some(body))
            .count();
        for (_, i) in near.into_iter().take(wanted.saturating_sub(has)) {
            particles.kind[i] = Kind::Boundary;
            particles.body[i] = Some(body);
        }
    }
}

/// Freezes the free particles farther than `distance` (scene units) from every surface; which these are.
pub(crate) fn hold<const D: usize>(
    particles: &mut Particles<D>,
    surfaces: &[ParticleSurface<D>],
    distance: f64,
) -> Vec<usize> {
    if !distance.is_finite() {
        return Vec::new();
    }
    let is_near = |i: usize| {
        let p = particles.position[i];
        (surfaces.iter()).any(|s| s.surface.closest_within(p, distance).is_some())
    };
    let far: Vec<usize> = (0..particles.len())
        .into_par_iter()
        .with_min_len(256)
        .filter(|&i| particles.kind[i] == Kind::Free && !is_near(i))
        .collect();
    for &i in &far {
        particles.kind[i] = Kind::Frozen;
    }
    far
}

#[cfg(test)]
mod tests {
    use sphpack_geometry::Ball;
    use sphpack_neighbors::{Domain, point};

    use crate::seeding::seed;
    use crate::{Hybrid, Kind, Method, Packed, Problem, RunLog, Silent};

    fn disc() -> Problem<2> {
        Problem::new(Domain::new([-1.2; 2], [1.2; 2]), 0.1)
            .body("disc", Ball::new([0.0; 2], 0.6).expect("a disc"))
    }

    fn packed(hybrid: Hybrid) -> Packed<2> {
        let hybrid = Hybrid {
            velocity_tolerance: 1e-3,
            ..hybrid
        };
        hybrid
            .pack(&disc(), &mut RunLog::new(&mut Silent))
            .expect("a sound problem")
    }

    #[test]
    fn what_is_off_changes_nothing() {
        let all = Hybrid {
            moving_over_spacing: 1e3,
            ..Hybrid::default()
        };
        let plain = packed(Hybrid::default());
        assert!(packed(all).particles == plain.particles);
    }

    #[test]
    fn predicted_particles_are_on_the_surface_at_once() {
        let first = packed(Hybrid {
            predicted: 0.9,
            max_iterations: 1,
            ..Hybrid::default()
        });
        let wanted = (0.9 * first.surfaces[0].target_count as f64).round() as usize;
        assert_eq!(first.particles.count(Kind::Boundary), wanted);
        for i in 0..first.particles.len() {
            if first.particles.kind[i] == Kind::Boundary {
                let hit = first.surfaces[0]
                    .surface
                    .closest(first.particles.position[i]);
                assert!(hit.distance.abs() < 1e-9, "{}", hit.distance);
            }
        }
    }

    #[test]
    fn what_is_held_stays_on_its_lattice_and_is_free_at_the_end() {
        let reach = 3.0;
        let held = packed(Hybrid {
            moving_over_spacing: reach,
            ..Hybrid::default()
        });
        let start = seed(&disc()).expect("a sound problem").particles;
        let plain = packed(Hybrid::default());
        let (is, was) = (&held.particles, &start);
        assert_eq!(is.count(Kind::Frozen), plain.particles.count(Kind::Frozen));
        let mut moved = 0;
        for i in 0..is.len() {
            let surface = &held.surfaces[0].surface;
            let away = surface.closest(was.position[i]).distance.abs();
            let way = point::distance(is.position[i], was.position[i]);
            if away > reach * 0.1 {
                assert!(way == 0.0, "{away} {way}");
            } else {
                moved += usize::from(way > 0.0);
            }
        }
        assert!(moved > 100, "{moved}");
    }

    #[test]
    fn captures_grow_rarer_after_their_phase() {
        let settled = packed(Hybrid {
            projection_growth: 2.0,
            predicted: 0.9,
            ..Hybrid::default()
        });
        assert!(settled.stop_reason == crate::StopReason::Converged);
        let (on, wanted) = (
            settled.particles.count(Kind::Boundary),
            settled.surfaces[0].target_count,
        );
        assert!(on.abs_diff(wanted) <= 3, "{on} {wanted}");
    }
}
