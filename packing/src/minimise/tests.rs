//! Properties of the energy and of the ways down it.

use std::sync::Arc;

use proptest::prelude::*;
use sphpack_geometry::{Cuboid, Surface};
use sphpack_neighbors::random::Congruential;
use sphpack_neighbors::{Domain, point};

use super::*;
use crate::forces::{Forces, Levelling};
use crate::packed::ParticleSurface;
use crate::seeding::seed;
use crate::{Kind, Particles, Problem};
use sphpack_pairs::Repulsion;

fn either_way(random: &mut Congruential) -> f64 {
    random.unit() - 0.5
}

/// A shaken lattice of every kind of particle, of unequal volumes; boundary particles on the sides of a box.
fn shaken<const D: usize>(
    shake: f64,
    seed_value: u64,
) -> (Problem<D>, Particles<D>, Vec<ParticleSurface<D>>) {
    let spacing = if D == 2 { 0.08 } else { 0.2 };
    let problem = Problem::new(Domain::new([0.0; D], [1.0; D]), spacing);
    let mut particles = seed(&problem).expect("a sound problem").particles;
    let surface = Cuboid::new([0.25; D], [0.75; D]).expect("a box");
    let mut random = Congruential::new(seed_value);
    for i in 0..particles.len() {
        particles.volume[i] *= 1.0 + 0.2 * either_way(&mut random);
        if particles.kind[i] == Kind::Frozen {
            continue;
        }
        particles.kind[i] = [Kind::Free, Kind::Boundary, Kind::Fixed][i % 3];
        for k in 0..D {
            particles.position[i][k] += 2.0 * shake * problem.spacing() * either_way(&mut random);
        }
        if particles.kind[i] == Kind::Boundary {
            // Off the sides' ends, where a step along the surface would turn a corner.
            let hit = surface.closest(particles.position[i]);
            if point::distance(hit.point, particles.position[i]) < 0.1 && is_mid_side(hit.point) {
                particles.body[i] = Some(0);
            } else {
                particles.kind[i] = Kind::Free;
            }
        }
    }
    let surfaces = vec![ParticleSurface {
        surface: Arc::new(surface),
        target_count: 0,
    }];
    (problem, particles, surfaces)
}

/// Whether a point of the box's surface is well within one side.
fn is_mid_side<const D: usize>(p: [f64; D]) -> bool {
    p.into_iter().filter(|x| (x - 0.5).abs() > 0.2).count() == 1
}

/// An evaluator by another h that levels some of the particles, with leeway.
fn one_side<const D: usize>(problem: &Problem<D>, count: usize, state: u64) -> Forces<D> {
    let (kernel, h) = (problem.kernel, 0.9 * problem.smoothing_length());
    let none = Repulsion::none();
    let mut forces = Forces::new(&problem.domain, kernel, h, problem.skin(), none);
    forces.levelled = (0..count)
        .map(|i| !(i as u64 * 7 + state).is_multiple_of(3))
        .collect();
    forces.levelling = Levelling::new(20.0, 1.0).map(|level| Levelling {
        leeway: 0.005,
        ..level
    });
    forces
}

fn with_energy<const D: usize, R>(
    shake: f64,
    state: u64,
    work: impl FnOnce(&mut Energy<'_, D>) -> R,
) -> R {
    let (problem, mut particles, surfaces) = shaken::<D>(shake, state);
    let mut forces = Forces::of(
        &problem,
        Repulsion::new(problem.spacing(), Repulsion::STRENGTH),
    );
    // Every other time.
    forces.levelling = Levelling::new(10.0 * (state % 2) as f64, problem.perfect_gamma());
    let added = state
        .is_multiple_of(3)
        .then(|| one_side(&problem, particles.len(), state));
    let mut energy = Energy::new(&mut particles, &surfaces, forces, 2.0);
    if let Some(added) = added {
        energy.add(added);
        energy.penalise(GradientPenalty::of(vec![3, 8, 21], 50.0));
        let mut places = Vec::new();
        energy.places(&mut places);
        energy.move_to(&places, 0.0, &places);
    }
    work(&mut energy)
}

/// Which way is into the box from a place on one of its sides, 0 elsewhere.
fn on_side(x: f64) -> f64 {
    if x < 1e-4 {
        1.0
    } else if x > 1.0 - 1e-4 {
        -1.0
    } else {
        0.0
    }
}

fn force_is_downhill<const D: usize>(shake: f64, state: u64) -> Result<(), TestCaseError> {
    with_energy::<D, _>(shake, state, |energy| {
        let mut place = Vec::new();
        energy.places(&mut place);
        let force = energy.force().to_vec();
        let mut direction = vec![[0.0; D]; energy.len()];
        let mut random = Congruential::new(state ^ 0x5555);
        for d in &mut direction {
            *d = std::array::from_fn(|_| either_way(&mut random));
        }
        // Who lies on a side of the box goes along it: across, it goes one way only.
        for (d, p) in direction.iter_mut().zip(&place) {
            *d = std::array::from_fn(|k| if on_side(p[k]) == 0.0 { d[k] } else { 0.0 });
        }
        energy.make_tangential(&mut direction);
        let slope = vectors::dot(&direction, &force);
        let step = 1e-5 * energy.spacing();
        energy.move_to(&place, step, &direction);
        let up = energy.value();
        energy.move_to(&place, -step, &direction);
        let difference = (up - energy.value()) / (2.0 * step);
        let scale =
            vectors::dot(&direction, &direction).sqrt() * vectors::dot(&force, &force).sqrt();
        prop_assert!(
            (difference + slope).abs() < 1e-4 * scale,
            "−dE/ds = {}, force · direction = {slope}",
            -difference
        );
        Ok(())
    })
}

fn never_uphill<const D: usize>(shake: f64, state: u64) -> Result<(), TestCaseError> {
    with_energy::<D, _>(shake, state, |energy| {
        let start = energy.value();
        let mut lbfgs = Lbfgs::default();
        let mut lowest = start;
        for _ in 0..30 {
            if lbfgs.step(energy) == Step::Stuck {
                break;
            }
            prop_assert!(energy.value() <= lowest * (1.0 + 1e-14));
            lowest = energy.value();
        }
        prop_assert!(lowest < start);
        let on_surface = energy.particles();
        for i in 0..on_surface.len() {
            if on_surface.kind[i] == Kind::Boundary {
                let off = on_surface.position[i].map(|x| (x - 0.5).abs());
                let most = off.into_iter().fold(0.0, f64::max);
                prop_assert!((most - 0.25).abs() < 1e-12);
            }
        }
        Ok(())
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn forces_are_the_negative_gradient(shake in 0.0..0.3_f64, state in any::<u64>()) {
        force_is_downhill::<2>(shake, state)?;
        force_is_downhill::<3>(shake, state)?;
    }

    #[test]
    fn accepted_steps_never_raise_the_energy(shake in 0.05..0.4_f64, state in any::<u64>()) {
        never_uphill::<2>(shake, state)?;
        never_uphill::<3>(shake, state)?;
    }
}

/// Drawn once: one particle lies on a side of the box and is pushed off it. Steps across that side end on it, so that a difference of
/// both ways saw half the slope there; the way into the box has it all.
#[test]
fn forces_on_a_side_are_the_negative_gradient_into_the_box() {
    let (shake, state) = (0.2993876147936719, 7_649_147_146_414_495_450);
    force_is_downhill::<2>(shake, state).expect("along the sides");
    with_energy::<2, _>(shake, state, |energy| {
        let mut place = Vec::new();
        energy.places(&mut place);
        let (start, force) = (energy.value(), energy.force().to_vec());
        let into = |i: usize, k: usize| {
            let inward = on_side(place[i][k]);
            if inward * force[i][k] > 0.0 {
                inward
            } else {
                0.0
            }
        };
        let direction: Vec<[f64; 2]> = (0..place.len())
            .map(|i| std::array::from_fn(|k| into(i, k)))
            .collect();
        let slope = vectors::dot(&direction, &force);
        assert!(slope > 0.5, "nobody is pushed off a side: {slope}");
        let step = 1e-6 * energy.spacing();
        energy.move_to(&place, step, &direction);
        let difference = (energy.value() - start) / step;
        assert!(
            (difference + slope).abs() < 1e-4 * slope,
            "−dE/ds = {}, force · direction = {slope}",
            -difference
        );
    });
}

/// Pairs across a periodic side count once in the energy, as any other pair of moving particles.
#[test]
fn the_energy_goes_around_a_periodic_box() {
    let mut domain = Domain::new([0.0; 2], [1.0; 2]);
    domain.periodic = [true, true];
    let problem = Problem::new(domain, 0.08);
    let mut particles = seed(&problem).expect("a sound problem").particles;
    let mut random = Congruential::new(3);
    for p in &mut particles.position {
        *p = p.map(|x| x + 0.01 * either_way(&mut random));
    }
    let forces = Forces::of(
        &problem,
        Repulsion::new(problem.spacing(), Repulsion::STRENGTH),
    );
    let mut energy = Energy::new(&mut particles, &[], forces, 1.0);
    let (mut place, force) = (Vec::new(), energy.force().to_vec());
    energy.places(&mut place);
    let slope = vectors::dot(&force, &force);
    let step = 1e-6 * problem.spacing() / slope.sqrt();
    energy.move_to(&place, step, &force);
    let up = energy.value();
    energy.move_to(&place, -step, &force);
    let difference = (energy.value() - up) / (2.0 * step);
    assert!(
        (difference / slope - 1.0).abs() < 1e-4,
        "{difference} {slope}"
    );
    let momentum = force.iter().fold([0.0; 2], |sum, &f| point::add(sum, f));
    assert!(point::norm(momentum) < 1e-9 * slope.sqrt());
}

#[test]
fn names_that_are_none_are_refused_with_those_that_are() {
    let error = "newton".parse::<MinimiserKind>().expect_err("no minimiser");
    for kind in MinimiserKind::ALL {
        assert!(error.to_string().contains(kind.name()), "{error}");
    }
}

#[test]
fn every_minimiser_goes_down_and_holds_what_is_held() {
    for kind in MinimiserKind::ALL {
        assert_eq!(kind.to_string().parse(), Ok(kind));
        with_energy::<2, _>(0.2, 7, |energy| {
            let (start, residual) = (energy.value(), energy.residual());
            let before = energy.particles().clone();
            let mut minimiser = kind.build::<2>();
            for _ in 0..80 {
                minimiser.step(energy);
            }
            assert!(energy.value() < start, "{}", kind.name());
            assert!(energy.residual() < 0.5 * residual, "{}", kind.name());
            let after = energy.particles();
            for i in 0..after.len() {
                let moved = point::distance(before.position[i], after.position[i]);
                assert!(before.kind[i].is_mobile() || moved == 0.0);
            }
        });
    }
}

/// Shaken particles, of which those on the left are levelled, with this κ.
fn with_the_left_levelled<R>(
    stiffness: f64,
    work: impl FnOnce(&mut Energy<'_, 2>, &[bool]) -> R,
) -> R {
    let (problem, mut particles, surfaces) = shaken::<2>(0.1, 8);
    let mut forces = Forces::of(
        &problem,
        Repulsion::new(problem.spacing(), Repulsion::STRENGTH),
    );
    let is_left: Vec<bool> = particles.position.iter().map(|p| p[0] < 0.4).collect();
    forces.levelled = is_left.clone();
    forces.levelling = Levelling::new(stiffness, 1.0);
    let mut energy = Energy::new(&mut particles, &surfaces, forces, 2.0);
    work(&mut energy, &is_left)
}

/// Σ (Γ − 1)² of the particles that `is_asked` names.
fn unevenness(energy: &mut Energy<'_, 2>, is_asked: impl Fn(usize) -> bool) -> f64 {
    let (forces, particles) = energy.evaluated();
    (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen && is_asked(i))
        .map(|i| (forces.gamma(i) - 1.0).powi(2))
        .sum()
}

/// ½ κ Σ V (Γ − 1)² is the energy of the levelled particles alone, and no force comes from the others.
#[test]
fn levelling_acts_on_none_but_those_it_is_told() {
    const STIFFNESS: f64 = 3.0;
    let figures = |stiffness: f64| {
        with_the_left_levelled(stiffness, |energy, is_left| {
            let unit = energy.spacing().powi(2);
            let (forces, particles) = energy.evaluated();
            let of_left: f64 = (0..particles.len())
                .filter(|&i| is_left[i] && particles.kind[i] != Kind::Frozen)
                .map(|i| {
                    let off = forces.gamma(i) - 1.0;
                    0.5 * STIFFNESS * particles.volume[i] / unit * off * off
                })
                .sum();
            let support = 3.0 * energy.smoothing_length();
            let particles = energy.particles();
            // Who is near a particle that is levelled, or one, and who is not.
            let is_far: Vec<bool> = (energy.mobile().iter())
                .map(|&i| particles.position[i as usize][0] > 0.4 + support)
                .collect();
            let force = energy.force().to_vec();
            (energy.value(), of_left, is_far, force)
        })
    };
    let (without, _, _, plain) = figures(0.0);
    let (with, of_left, is_far, levelled) = figures(STIFFNESS);
    assert!(of_left > 1e-3, "{of_left}");
    let added = with - without;
    assert!((added / of_left - 1.0).abs() < 1e-9, "{added} {of_left}");
    let is_same = |i: usize| point::distance(plain[i], levelled[i]) < 1e-12;
    let far = (0..is_far.len()).filter(|&i| is_far[i]);
    assert!(far.clone().count() > 10);
    assert!(far.clone().all(is_same), "a force from afar");
    let near = (0..is_far.len()).filter(|&i| !is_far[i]);
    let pushed = near.clone().filter(|&i| !is_same(i)).count();
    assert!(pushed > near.count() / 2, "{pushed}");
}

#[test]
fn levelling_evens_out_where_it_is_told() {
    let settled = |stiffness: f64| {
        with_the_left_levelled(stiffness, |energy, is_left| {
            let mut lbfgs = Lbfgs::default();
            for _ in 0..60 {
                lbfgs.step(energy);
            }
            [true, false].map(|is_told| unevenness(energy, |i| is_left[i] == is_told))
        })
    };
    let (without, with) = (settled(0.0), settled(30.0));
    assert!(with[0] < 0.6 * without[0], "{with:?} {without:?}");
    assert!(with[1] > 0.9 * without[1], "{with:?} {without:?}");
}

/// A body in which the pressure is far too high keeps its particles.
#[test]
fn no_particle_slips_through_a_surface_that_is_watched() {
    let surface = Cuboid::new([0.25; 2], [0.75; 2]).expect("a box");
    let problem = Problem::new(Domain::new([0.0; 2], [1.0; 2]), 0.05);
    let surfaces = vec![ParticleSurface {
        surface: Arc::new(surface),
        target_count: 0,
    }];
    let slipped = |is_watched: bool| {
        let mut particles = seed(&problem).expect("a sound problem").particles;
        for i in 0..particles.len() {
            let hit = surface.closest(particles.position[i]);
            if particles.kind[i] == Kind::Free && hit.distance.abs() < 0.6 * problem.spacing() {
                particles.position[i] = hit.point;
                particles.kind[i] = Kind::Boundary;
                particles.body[i] = Some(0);
            } else if hit.distance < 0.0 {
                particles.volume[i] *= 1.5;
            }
        }
        let before = particles.position.clone();
        let forces = Forces::of(&problem, Repulsion::new(problem.spacing(), 0.001));
        let mut energy = Energy::new(&mut particles, &surfaces, forces, 1.0);
        if is_watched {
            energy.keep_sides(&problem.bodies);
        }
        energy.hold_surface();
        energy.set_repulsion(Repulsion::new(problem.spacing(), 0.001));
        let mut lbfgs = Lbfgs::default();
        for _ in 0..200 {
            lbfgs.step(&mut energy);
        }
        let after = energy.particles();
        (0..after.len())
            .filter(|&i| after.kind[i] == Kind::Free)
            .filter(|&i| surface.inside(before[i]) != surface.inside(after.position[i]))
            .count()
    };
    assert!(slipped(false) > 0);
    assert_eq!(slipped(true), 0);
}

#[test]
fn a_perfect_lattice_stays() {
    let problem = Problem::new(Domain::new([0.0; 2], [1.0; 2]), 0.1);
    let mut particles = seed(&problem).expect("a sound problem").particles;
    let before = particles.position.clone();
    let mut forces = Forces::of(
        &problem,
        Repulsion::new(problem.spacing(), Repulsion::STRENGTH),
    );
    forces.levelling = Levelling::new(10.0, problem.perfect_gamma());
    let mut energy = Energy::new(&mut particles, &[], forces, 1.0);
    assert!(energy.residual() < 1e-10);
    for kind in MinimiserKind::ALL {
        kind.build::<2>().step(&mut energy);
    }
    for (a, &b) in energy.particles().position.iter().zip(&before) {
        assert!(point::distance(*a, b) < 1e-8);
    }
}

/// Where surface particles stop moving, none of their velocities stays behind with others: whoever begins anew starts along
/// its own force.
#[test]
fn velocities_stay_with_their_particles() {
    for kind in [MinimiserKind::Damped, MinimiserKind::Fire] {
        with_energy::<2, _>(0.2, 4, |energy| {
            let mut minimiser = kind.build::<2>();
            for _ in 0..20 {
                minimiser.step(energy);
            }
            energy.hold_surface();
            minimiser.reset();
            let (mut before, mut after) = (Vec::new(), Vec::new());
            energy.places(&mut before);
            energy.move_to(&before, 0.0, &before);
            let force = energy.force().to_vec();
            minimiser.step(energy);
            energy.places(&mut after);
            for ((&from, &to), &force) in before.iter().zip(&after).zip(&force) {
                let step = point::sub(to, from);
                let across = point::norm(point::reject(step, unit_along(force)));
                assert!(
                    across < 1e-9 + 1e-6 * point::norm(step),
                    "{kind:?}: {across}"
                );
            }
        });
    }
}

fn unit_along<const D: usize>(force: [f64; D]) -> [f64; D] {
    point::scale(force, 1.0 / point::norm(force).max(1e-300))
}
