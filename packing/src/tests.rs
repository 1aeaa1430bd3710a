//! Properties of forces and packings.

use std::ops::ControlFlow;

use proptest::prelude::*;
use sphpack_geometry::{Ball, Cuboid, Outline};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::random::Congruential;
use sphpack_neighbors::{Domain, point};

use crate::forces::Forces;
use crate::methods::Method;
use crate::seeding::seed;
use crate::{
    Hybrid, Kind, Lattice, Observer, Packed, PackingError, Particles, Problem, Progress, RunLog,
    Silent, StopReason, Work,
};
use sphpack_pairs::Repulsion;

/// A small lattice whose particles are shaken by up to `shake` ∆s; every kind occurs.
fn shaken<const D: usize>(shake: f64, seed_value: u64) -> (Problem<D>, Particles<D>) {
    let domain = Domain::new([0.0; D], [1.0; D]);
    let problem = Problem::new(domain, if D == 2 { 0.12 } else { 0.2 });
    let mut particles = seed(&problem).expect("a sound problem").particles;
    let mut random = Congruential::new(seed_value);
    for i in 0..particles.len() {
        if particles.kind[i] == Kind::Frozen {
            continue;
        }
        particles.kind[i] = [Kind::Free, Kind::Boundary, Kind::Fixed][i % 3];
        for k in 0..D {
            particles.position[i][k] += 2.0 * shake * problem.spacing() * (random.unit() - 0.5);
        }
    }
    (problem, particles)
}

fn check_energy<const D: usize>(
    shake: f64,
    seed: u64,
    kernel: KernelKind,
) -> Result<(), TestCaseError> {
    let (mut problem, particles) = shaken::<D>(shake, seed);
    problem.kernel = kernel;
    let mut forces = Forces::of(
        &problem,
        Repulsion::new(problem.spacing(), Repulsion::STRENGTH),
    );
    forces.evaluate(&particles);
    let moving = (seed as usize * 7) % particles.count(Kind::Free);
    let i = (0..particles.len())
        .filter(|&i| particles.kind[i] == Kind::Free)
        .nth(moving)
        .expect("a free particle");
    let acceleration = forces.acceleration(i);
    let scale = 1.0 / problem.spacing();
    for k in 0..D {
        // The potential has kinks in its second derivative only: a central difference is good to O(step).
        let step = 1e-5 * problem.spacing();
        let mut energy_at = |shift: f64| {
            let mut moved = particles.clone();
            moved.position[i][k] += shift;
            forces.evaluate(&moved);
            // V W has no unit: the repulsion's potential is per particle, the pressure's per p_b.
            forces.energy()
        };
        let difference = (energy_at(step) - energy_at(-step)) / (2.0 * step);
        prop_assert!(
            (difference + acceleration[k]).abs() < 2e-4 * scale,
            "−∂E/∂x = {}, acceleration {}",
            -difference,
            acceleration[k]
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn force_is_minus_the_gradient_of_the_energy(shake in 0.0..0.7_f64, seed in 0..1000_u64, kernel in prop::sample::select(&KernelKind::ALL)) {
        check_energy::<2>(shake, seed, kernel)?;
        check_energy::<3>(shake, seed, kernel)?;
    }

    #[test]
    fn momentum_is_kept_on_a_periodic_box(shake in 0.0..0.7_f64, seed_value in 0..1000_u64) {
        let (problem, particles) = shaken::<2>(shake, seed_value);
        let keep: Vec<usize> = (0..particles.len()).filter(|&i| particles.kind[i] != Kind::Frozen).collect();
        let particles = particles.selected(&keep);
        let domain = problem.domain.with_periodic([true; 2]);
        let mut forces = Forces::new(&domain, KernelKind::Quintic, 0.12, 0.03, Repulsion::new(0.12, Repulsion::STRENGTH));
        forces.evaluate(&particles);
        let mut total = [0.0; 2];
        for i in 0..particles.len() {
            total = point::add(total, forces.acceleration(i));
        }
        prop_assert!(point::norm(total) < 1e-9 / problem.spacing() * particles.len() as f64);
    }
}

#[test]
fn a_perfect_lattice_stays() {
    for lattice in Lattice::ALL {
        if lattice.dimension() == 2 {
            check_stays::<2>(lattice);
        } else {
            check_stays::<3>(lattice);
        }
    }
}

fn check_stays<const D: usize>(lattice: Lattice) {
    let mut problem = Problem::new(Domain::new([0.0; D], [1.0; D]), 0.2);
    problem.lattice = Some(lattice);
    let particles = seed(&problem).expect("a sound problem").particles;
    let mut forces = Forces::of(&problem, Repulsion::none());
    forces.evaluate(&particles);
    for i in 0..particles.len() {
        let residual = problem.smoothing_length() * point::norm(forces.gradient(i));
        // Sites of hcp are no centres of inversion: the force vanishes only up to the stretch of the box.
        let bound = if lattice == Lattice::Hcp { 2e-3 } else { 1e-12 };
        assert!(residual < bound, "{lattice}: residual {residual}");
    }
}

fn cylinder(spacing: f64) -> Problem<2> {
    let body = Ball::new([0.0; 2], 0.5).expect("a sound ball");
    Problem::new(Domain::new([-1.0; 2], [1.0; 2]), spacing).body("cylinder", body)
}

fn quality<const D: usize>(packed: &Packed<D>) -> crate::Quality {
    packed.quality_by(&packed.fields(packed.kernel, packed.h_over_spacing))
}

#[test]
fn hybrid_packs_a_cylinder() {
    let packed = Hybrid::default()
        .pack(&cylinder(0.1), &mut RunLog::new(&mut Silent))
        .expect("packs");
    assert_eq!(packed.stop_reason, StopReason::Converged);
    let quality = quality(&packed);
    assert!(quality.density.total_variation < 0.04, "{quality:?}");
    assert!(quality.surface[0].max_distance_over_spacing < 1e-9);
    assert!(quality.closest_pair_over_spacing > 0.7);
    // Ids are a permutation: nobody is lost or doubled.
    let mut ids = packed.particles.id.clone();
    ids.sort_unstable();
    assert!(ids.iter().copied().eq(0..packed.particles.len() as u32));
}

#[test]
fn a_lattice_begins_where_the_body_gets_its_share() {
    // A disc in the middle of the box has the lattice's symmetry: whole rings of sites fall in or out together.
    for spacing in [0.1, 0.08, 0.06, 0.05, 0.04] {
        let problem = cylinder(spacing);
        let particles = seed(&problem).expect("a sound problem").particles;
        let body = &problem.bodies[0].surface;
        let inside = particles
            .position
            .iter()
            .filter(|&&p| body.inside(p))
            .count() as f64;
        let share = body.volume() / particles.volume[0];
        assert!(
            (inside - share).abs() <= 1.0,
            "∆s = {spacing}: {inside} sites for a share of {share}"
        );
    }
}

#[test]
fn hybrid_fixes_the_corners_of_a_box() {
    let body = Cuboid::new([-0.5, -0.5], [0.5, 0.5]).expect("a sound box");
    let problem = Problem::new(Domain::new([-1.0; 2], [1.0; 2]), 0.1).body("box", body);
    let packed = Hybrid::default()
        .pack(&problem, &mut RunLog::new(&mut Silent))
        .expect("packs");
    assert_eq!(packed.particles.count(Kind::Fixed), 4);
    for i in (0..packed.particles.len()).filter(|&i| packed.particles.kind[i] == Kind::Fixed) {
        let p = packed.particles.position[i];
        assert!(
            (p[0].abs() - 0.45).abs() < 1e-9 && (p[1].abs() - 0.45).abs() < 1e-9,
            "corner at {p:?}"
        );
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let in_pool = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a thread pool");
        let star = Outline::starfish([0.0; 2], 0.5, 0.25, 5).expect("a sound starfish");
        let problem = Problem::new(Domain::new([-1.0; 2], [1.0; 2]), 0.05).body("star", star);
        let method = Hybrid {
            max_iterations: 400,
            ..Hybrid::default()
        };
        let packed = pool
            .install(|| method.pack(&problem, &mut RunLog::new(&mut Silent)))
            .expect("packs");
        let measured = pool.install(|| quality(&packed));
        (packed.particles, measured)
    };
    let one = in_pool(1);
    assert_eq!(one, in_pool(2));
    assert_eq!(one, in_pool(3));
}

#[test]
fn scene_units_do_not_matter() {
    let at = |unit: f64| {
        let body = Ball::new([0.0; 2], 0.5 * unit).expect("a sound ball");
        let problem =
            Problem::new(Domain::new([-unit; 2], [unit; 2]), 0.1 * unit).body("ball", body);
        let method = Hybrid {
            max_iterations: 200,
            ..Hybrid::default()
        };
        quality(
            &method
                .pack(&problem, &mut RunLog::new(&mut Silent))
                .expect("packs"),
        )
    };
    let (small, one, large) = (at(1e-6), at(1.0), at(1e6));
    for other in [small, large] {
        assert!(
            (other.density.linf - one.density.linf).abs() < 1e-6,
            "{other:?} {one:?}"
        );
        assert_eq!(other.surface[0].count, one.surface[0].count);
    }
}

/// What moves first moves from rest by ∆t² times its acceleration: four times as far in a step twice as long.
#[test]
fn a_longer_time_step_goes_farther() {
    let after = |time_step: f64, max_iterations: usize| {
        let body = Ball::new([0.0; 2], 0.5).expect("a sound ball");
        let problem = Problem::new(Domain::new([-1.0; 2], [1.0; 2]), 0.1).body("ball", body);
        let method = Hybrid {
            time_step,
            max_iterations,
            ..Hybrid::default()
        };
        let packed = method.pack(&problem, &mut RunLog::new(&mut Silent));
        packed.expect("packs").particles
    };
    // The first iteration captures, the second sets off.
    let moved = |time_step: f64| {
        let [before, then] = [1, 2].map(|iterations| after(time_step, iterations));
        let free = (0..before.len()).filter(|&i| then.kind[i] == Kind::Free);
        free.map(|i| point::distance(before.position[i], then.position[i]))
            .fold(0.0, f64::max)
    };
    let [once, twice] = [1.0, 2.0].map(moved);
    assert!(
        once > 0.0 && (twice / once - 4.0).abs() < 1e-3,
        "{once} {twice}"
    );
}

#[test]
fn a_box_without_bodies_is_at_rest() {
    let packed = Hybrid::default()
        .pack(
            &Problem::new(Domain::new([0.0; 2], [1.0; 2]), 0.1),
            &mut RunLog::new(&mut Silent),
        )
        .expect("packs");
    assert_eq!(packed.stop_reason, StopReason::Converged);
    assert!(quality(&packed).density.linf < 1e-3);
}

#[test]
fn a_periodic_channel() {
    let mut problem = cylinder(0.1);
    problem.domain = problem.domain.with_periodic([true, false]);
    let packed = Hybrid::default()
        .pack(&problem, &mut RunLog::new(&mut Silent))
        .expect("packs");
    assert!(
        packed
            .particles
            .position
            .iter()
            .zip(&packed.particles.kind)
            .all(|(p, kind)| { *kind == Kind::Frozen || (-1.0..1.0).contains(&p[0]) })
    );
    assert!(quality(&packed).density.total_variation < 0.05);
}

/// Stops at the n-th call.
struct StopAt(usize);

impl Observer for StopAt {
    fn progress(&mut self, _: &Progress) -> ControlFlow<()> {
        if self.0 == 0 {
            return ControlFlow::Break(());
        }
        self.0 -= 1;
        ControlFlow::Continue(())
    }
}

#[test]
fn an_observer_stops_a_packing_at_any_time() {
    for calls in [0, 1, 2, 5] {
        let packed = Hybrid::default()
            .pack(&cylinder(0.1), &mut RunLog::new(&mut StopAt(calls)))
            .expect("packs");
        assert_eq!(packed.stop_reason, StopReason::Interrupted);
        assert!(
            packed
                .particles
                .position
                .iter()
                .all(|&p| point::is_finite(p))
        );
    }
}

#[test]
fn senseless_problems_are_refused() {
    type Check = fn(&PackingError) -> bool;
    let refused = |change: fn(&mut Problem<2>), is_expected: Check| {
        let mut problem = cylinder(0.1);
        change(&mut problem);
        let error = Hybrid::default()
            .pack(&problem, &mut RunLog::new(&mut Silent))
            .expect_err("refused");
        assert!(is_expected(&error), "{error}");
        assert_eq!(
            problem
                .estimate(f64::INFINITY, &Work::PLAIN)
                .expect_err("refused")
                .to_string(),
            error.to_string()
        );
    };
    refused(
        |p| p.resolution = (0.0).into(),
        |e| matches!(e, PackingError::NotPositive { .. }),
    );
    refused(
        |p| p.resolution = (f64::NAN).into(),
        |e| matches!(e, PackingError::NotPositive { .. }),
    );
    refused(
        |p| p.h_over_spacing = -1.0,
        |e| matches!(e, PackingError::NotPositive { .. }),
    );
    refused(
        |p| p.resolution = (1.5).into(),
        |e| matches!(e, PackingError::SpacingLargerThanBody { .. }),
    );
    refused(
        |p| p.resolution = (5.0).into(),
        |e| matches!(e, PackingError::SpacingLargerThanDomain { .. }),
    );
    refused(
        |p| p.domain.bounds.max = [0.2; 2],
        |e| matches!(e, PackingError::OutsideDomain { .. }),
    );
    refused(
        |p| p.lattice = Some(Lattice::Fcc),
        |e| matches!(e, PackingError::WrongLattice { .. }),
    );
    refused(
        |p| {
            p.resolution = (0.4).into();
            p.domain = p.domain.with_periodic([true; 2]);
        },
        |e| matches!(e, PackingError::PeriodTooShort { .. }),
    );
}
