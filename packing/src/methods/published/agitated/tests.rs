//! Repulsion across periodic sides, what agitators do to a lattice, and the whole method.

use sphpack_geometry::Ball;
use sphpack_neighbors::{Domain, point};

use super::near::{Near, REACH};
use super::{Agitated, Agitators};
use crate::particles::Particles;
use crate::{Kind, Lattice, Method, Problem, RunLog, Silent, Sizes, StopReason};

/// Repulsion reaches across periodic sides: it conserves momentum there, and pushes as it does within.
#[test]
fn repulsion_reaches_across_periodic_sides() {
    let domain = Domain::new([0.0; 2], [8.0; 2]).with_periodic([true, true]);
    let pushes = |shift: f64| {
        let mut particles = Particles::new(Sizes::uniform(1.0, 1.2));
        for place in [[0.2, 3.0], [1.3, 3.2], [7.4, 3.4], [0.4, 7.8], [0.9, 0.6]] {
            let place = domain.wrap(point::add(place, [shift, 0.4 * shift]));
            particles.push(place, Kind::Free, 1.0, None);
        }
        let mut near = Near::default();
        let mut out = Vec::new();
        near.update(&particles, &domain, REACH[1], 0.3);
        near.accelerations(&particles, &domain, 1.0, 1.0, &mut out);
        out
    };
    let here = pushes(0.0);
    for shift in [2.5, 3.0, 5.0] {
        for (a, b) in here.iter().zip(pushes(shift)) {
            assert!(point::norm(*a) > 1e-3);
            assert!(point::distance(*a, b) < 1e-12, "{a:?} {b:?}");
        }
    }
    let sum = here.iter().fold([0.0; 2], |sum, &a| point::add(sum, a));
    assert!(point::norm(sum) < 1e-12, "{sum:?}");
}

#[test]
fn a_lattice_without_agitators_stays() {
    let domain = Domain::new([0.0; 2], [1.0; 2]).with_periodic([true, true]);
    let mut problem = Problem::new(domain, 0.05);
    problem.lattice = Some(Lattice::Hexagonal);
    let with = |agitators| {
        let method = Agitated {
            agitators,
            ..Agitated::default()
        };
        let packed = method
            .pack(&problem, &mut RunLog::new(&mut Silent))
            .expect("a sound problem");
        assert_eq!(packed.stop_reason, StopReason::Converged);
        assert_eq!(packed.particles.count(Kind::Fixed), 0);
        packed
            .history
            .iter()
            .fold(0.0, |most: f64, s| most.max(s.linf))
    };
    let still = with(Agitators::None);
    assert!(still < 1e-3, "{still}");
    assert!((with(Agitators::Resting) - still).abs() < 1e-9);
    let stirred = with(Agitators::Turning);
    assert!(stirred > 0.01, "{stirred}");
}

#[test]
fn the_surface_has_its_share_and_the_error_settles() {
    let problem = Problem::new(Domain::new([-1.2; 2], [1.2; 2]), 0.12)
        .body("disc", Ball::new([0.0; 2], 0.6).expect("a disc"));
    let packed = Agitated::default()
        .pack(&problem, &mut RunLog::new(&mut Silent))
        .expect("a sound problem");
    assert_eq!(packed.stop_reason, StopReason::Converged);
    let (on, wanted) = (
        packed.particles.count(Kind::Boundary),
        packed.surfaces[0].target_count,
    );
    assert!(on.abs_diff(wanted) <= 3, "{on} {wanted}");
}
