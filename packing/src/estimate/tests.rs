//! Estimates follow what is packed, and how.

use sphpack_geometry::{Ball, Cuboid, Ellipsoid, Surface, Torus};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::Domain;

use super::*;
use crate::confinement::Confinement;
use crate::{Resolution, Spacing, SpacingFunction};

const PLAIN: Work = Work::PLAIN;

fn ball(radius: f64) -> Problem<3> {
    Problem::new(Domain::new([0.0; 3], [20.0; 3]), 1.0)
        .body("ball", Ball::new([10.0; 3], radius).expect("a ball"))
}

fn of(problem: &Problem<3>, work: &Work) -> Estimate {
    problem
        .estimate(f64::INFINITY, work)
        .expect("a sound problem")
}

#[test]
fn all_that_a_method_does_takes_its_part() {
    let problem = ball(5.0);
    let plain = of(&problem, &PLAIN);
    for (name, work) in [
        (
            "sides",
            Work {
                confined_sides: 1.0,
                ..PLAIN
            },
        ),
        (
            "lists",
            Work {
                lists: 20.0,
                ..PLAIN
            },
        ),
        (
            "bytes",
            Work {
                bytes: [5e3; 2],
                ..PLAIN
            },
        ),
    ] {
        let more = of(&problem, &work);
        assert!(more.memory_bytes > 1.2 * plain.memory_bytes, "{name}");
    }
    let slow = Work {
        times_plain: 3.0,
        ..PLAIN
    };
    let ratio = of(&problem, &slow).seconds_per_evaluation / plain.seconds_per_evaluation;
    assert!((ratio - 3.0).abs() < 1e-9, "{ratio}");
    for work in [
        Work {
            placing: 1e-4,
            ..PLAIN
        },
        Work {
            sampling: [1e-3; 2],
            ..PLAIN
        },
    ] {
        assert!(of(&problem, &work).seconds_beside > 1.5 * plain.seconds_beside);
    }
}

#[test]
fn more_surface_and_longer_kernels_are_confined_longer() {
    let confined = Work {
        confined_sides: 2.0,
        ..PLAIN
    };
    let confining = |problem: &Problem<3>| of(problem, &confined).confining_seconds;
    let (small, large) = (ball(3.0), ball(6.0));
    assert!((confining(&large) / confining(&small) - 4.0).abs() < 0.1);
    let mut long = ball(3.0);
    long.h_over_spacing *= 2.0;
    assert!((confining(&long) / confining(&small) - 8.0).abs() < 0.1);
    // A thousand particles in the box of a body that fills it: the patches are most of the work.
    let mut full = Problem::new(Domain::new([0.0; 3], [6.0, 14.0, 10.0]), 1.0).body(
        "box",
        Cuboid::new([1.0; 3], [5.0, 13.0, 9.0]).expect("a box"),
    );
    (full.kernel, full.h_over_spacing) = (KernelKind::WendlandC2, 1.3);
    assert!(confining(&full) > of(&full, &PLAIN).seconds_per_evaluation);
}

#[test]
fn sharp_edges_are_cut_finer() {
    let domain = Domain::new([0.0; 3], [20.0; 3]);
    let cube = Cuboid::new([6.0; 3], [14.0; 3]).expect("a box");
    let area = 6.0 * 64.0;
    let radius = (area / 4.0 / std::f64::consts::PI).sqrt();
    let confined = Work {
        confined_sides: 1.0,
        ..PLAIN
    };
    let bytes = |problem: &Problem<3>| {
        of(problem, &confined).memory_bytes - of(problem, &PLAIN).memory_bytes
    };
    let cube = Problem::new(domain, 1.0).body("cube", cube);
    assert!(bytes(&cube) > 1.5 * bytes(&ball(radius)));
}

/// Patches of a surface within a box of half as many ∆s along an edge, over those that are expected.
fn patches_over_expected<const D: usize>(surface: &dyn Surface<D>, half: f64) -> f64 {
    let domain = Domain::new([-half; D], [half; D]);
    let confinement = Confinement::inside(surface, &domain, KernelKind::WendlandC2, 1.3, 1.0);
    confinement.patches() as f64 / expected_patches(surface, 1.0)
}

#[test]
fn patches_are_about_as_many_as_reckoned() {
    for radius in [0.2, 0.4, 0.7, 1.0, 1.5, 2.0, 4.0] {
        let ratio = patches_over_expected(&Ball::new([0.0; 3], radius).expect("a ball"), 9.0);
        assert!((0.75..1.33).contains(&ratio), "ball of {radius}: {ratio}");
        let ratio = patches_over_expected(&Ball::new([0.0; 2], radius).expect("a disc"), 9.0);
        assert!((0.7..1.4).contains(&ratio), "disc of {radius}: {ratio}");
    }
    for minor in [0.3, 0.6, 0.9, 1.3, 1.9] {
        let torus = Torus::new([0.0; 3], [0.0, 0.3, 1.0], 2.0, minor).expect("a torus");
        let ratio = patches_over_expected(&torus, 9.0);
        assert!((0.75..1.33).contains(&ratio), "torus of {minor}: {ratio}");
    }
    for axis in [0.4, 1.0, 2.5] {
        let ellipsoid = Ellipsoid::new([0.0; 3], [axis, 3.0, 1.2]).expect("an ellipsoid");
        let ratio = patches_over_expected(&ellipsoid, 9.0);
        assert!(
            (0.75..1.33).contains(&ratio),
            "ellipsoid of {axis}: {ratio}"
        );
    }
}

#[test]
fn what_stays_on_its_lattice_costs_little() {
    let problem = ball(5.0);
    let part = problem.estimate(2.0, &PLAIN).expect("a sound problem");
    let all = of(&problem, &PLAIN);
    assert!(part.seconds_per_evaluation < 0.5 * all.seconds_per_evaluation);
    assert_eq!(part.particles, all.particles);
    let none = problem.estimate(0.0, &PLAIN).expect("a sound problem");
    assert_eq!(none.seconds_per_evaluation, 0.0);
}

#[test]
fn who_judges_with_a_longer_kernel_lists_more() {
    let mut problem = ball(5.0);
    let short = of(&problem, &PLAIN).memory_bytes;
    problem.judging_reach = 4.0 * problem.support();
    assert!(of(&problem, &PLAIN).memory_bytes > 1.5 * short);
}

#[test]
fn images_across_periodic_sides_are_seen() {
    let problem = ball(5.0);
    let mut periodic = problem.clone();
    periodic.domain = periodic.domain.with_periodic([true; 3]);
    let many = Work {
        lists: 10.0,
        ..PLAIN
    };
    let (open, closed) = (of(&problem, &many), of(&periodic, &many));
    assert_eq!(closed.frozen, 0.0);
    assert!(closed.memory_bytes > 0.8 * open.memory_bytes);
}

/// Spacings that grow along x as a + g x: ∫ s⁻² over the unit square is (1/a − 1/(a + g)) / g.
#[test]
fn particles_of_a_field_are_counted_or_said_to_be_too_many() {
    let growth = 0.08;
    for (least, near) in [
        (1e-2, 0.01),
        (1e-4, 0.01),
        (2e-6, 0.1),
        (1e-12, f64::INFINITY),
    ] {
        let field = SpacingFunction::new([least, 1.0], move |p: [f64; 2]| Spacing {
            value: least + growth * p[0],
            gradient: [growth, 0.0],
        });
        let domain = Domain::new([0.0; 2], [1.0; 2]);
        let [count, _] = Resolution::from(field).count_in_box(&domain, 0.0);
        let exact = (1.0 / least - 1.0 / (least + growth)) / growth;
        assert!(
            (count / exact - 1.0).abs() <= near,
            "{least}: {count}, {exact}"
        );
        assert_eq!(count.is_finite(), near < 1.0, "{least}: {count}");
    }
}
