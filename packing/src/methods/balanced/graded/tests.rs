//! Particles of many sizes: energies against differences and all pairs, places, cells, packings.

use std::f64::consts::PI;

use sphpack_geometry::{Ball, Outline, Surface};
use sphpack_neighbors::random::SplitMix64;
use sphpack_neighbors::{Bounds, Domain, point};

use super::bisection::{Piece, places};
use super::cells::{Cells, Layers};
use super::energy::{Aim, GradedEnergy, NONE, Regions, target};
use super::mirror::Mirror;
use super::pockets;
use crate::methods::Balanced;
use crate::minimise::{Movable, Potential};
use crate::particles::{Kind, Particles};
use crate::problem::Problem;
use crate::refinement::Refinement;
use crate::sizes::Sizes;

fn around<const D: usize>(domain: Domain<D>, finest: f64, growth: f64) -> Problem<D> {
    let ball = Ball::new([0.1; D], 0.5).expect("a ball");
    let plain = Problem::new(domain, finest).body("ball", ball);
    let surface = plain.bodies[0].surface.clone();
    let field = Refinement::new(6.0 * finest, growth).around(surface, finest);
    Problem {
        resolution: field.into(),
        ..plain
    }
}

/// Particles on a shaken grid, the spacing of each that of the field there; one in seven is held.
fn shaken<const D: usize>(problem: &Problem<D>, seed: u64) -> (Particles<D>, Regions) {
    let mut random = SplitMix64::new(seed);
    let bounds = problem.domain.bounds;
    let size = bounds.size();
    let n = if D == 2 { 14_usize } else { 7 };
    let mut particles = Particles::new(problem.sizes());
    let mut spacing = Vec::new();
    let mut regions = Regions {
        of: Vec::new(),
        volume: vec![0.0; 2],
    };
    for number in 0..n.pow(D as u32) {
        let place: [f64; D] = std::array::from_fn(|k| {
            let cell = (number / n.pow(k as u32) % n) as f64;
            bounds.min[k] + size[k] * (cell + 0.2 + 0.6 * random.unit()) / n as f64
        });
        let is_held = number % 7 == 3;
        let kind = if is_held { Kind::Fixed } else { Kind::Free };
        let here = problem.resolution.at(place).value * (0.9 + 0.2 * random.unit());
        let volume = here.powi(D as i32);
        particles.push(place, kind, volume, is_held.then_some(0));
        spacing.push(here);
        let region = number as u32 % 2;
        regions.of.push(if is_held { NONE } else { region });
        if !is_held {
            regions.volume[region as usize] += volume;
        }
    }
    particles.sizes = Sizes::each(&spacing, problem.h_over_spacing);
    (particles, regions)
}

/// Central differences along random directions, in both energies, boxes open, periodic and mixed.
fn check_gradient<const D: usize>(finest: f64, growth: f64) {
    for periodic in [[false; D], [true; D], std::array::from_fn(|k| k == 0)] {
        let domain = Domain::new([-1.0; D], [1.2; D]).with_periodic(periodic);
        let problem = around(domain, finest, growth);
        for aim in [Aim::Order, Aim::Level { stiffness: 30.0 }] {
            let (mut particles, regions) = shaken(&problem, 7);
            let movable = Movable::new(&mut particles, &[], domain, 1.0);
            let mut energy = GradedEnergy::new(&problem, movable, regions, 0.005);
            energy.pursue(aim, 0.005);
            let mut start = Vec::new();
            energy.places(&mut start);
            let force = energy.force().to_vec();
            let mut random = SplitMix64::new(3);
            for _ in 0..8 {
                let direction: Vec<[f64; D]> = (0..start.len())
                    .map(|_| std::array::from_fn(|_| random.unit() - 0.5))
                    .collect();
                let slope: f64 = (force.iter().zip(&direction))
                    .map(|(f, d)| -point::dot(*f, *d))
                    .sum();
                let step = 1e-6 * finest;
                let mut at = |step: f64| {
                    energy.move_to(&start, step, &direction);
                    energy.value()
                };
                let measured = (at(step) - at(-step)) / (2.0 * step);
                let size = force.iter().map(|f| point::norm(*f)).sum::<f64>();
                assert!(
                    (slope - measured).abs() < 1e-5 * size,
                    "{D}-D, {periodic:?}, {aim:?}: {slope} {measured} of {size}"
                );
            }
        }
    }
}

#[test]
fn forces_are_the_negative_gradient_in_the_plane() {
    check_gradient::<2>(0.07, 1.1);
    check_gradient::<2>(0.05, 1.3);
}

#[test]
fn forces_are_the_negative_gradient_in_space() {
    check_gradient::<3>(0.2, 1.1);
}

/// Γ as the energy has it is that of all pairs, with images across every side.
#[test]
fn images_are_mirrored_at_open_sides() {
    let domain = Domain::new([-1.0; 2], [1.2; 2]).with_periodic([true, false]);
    let problem = around(domain, 0.07, 1.1);
    let (mut particles, regions) = shaken(&problem, 5);
    let copy = particles.clone();
    let movable = Movable::new(&mut particles, &[], domain, 1.0);
    let mut energy = GradedEnergy::new(&problem, movable, regions.clone(), 0.0);
    energy.pursue(Aim::Level { stiffness: 1.0 }, 0.0);
    let [level, ..] = energy.figures();
    // Sizes and volumes follow the field before Γ is taken.
    let followed = |i: usize| match regions.of[i] {
        NONE => copy.sizes.spacing(i),
        _ => problem.resolution.at(copy.position[i]).value,
    };
    let volume = |i: usize| {
        let own = regions.of[i];
        if own == NONE {
            return copy.volume[i];
        }
        let all: f64 = (0..copy.len())
            .filter(|&j| regions.of[j] == own)
            .map(|j| followed(j).powi(2))
            .sum();
        regions.volume[own as usize] * followed(i).powi(2) / all
    };
    let target = target(&problem);
    let mut worst: f64 = 0.0;
    for i in 0..copy.len() {
        let h = problem.h_over_spacing * followed(i);
        let mut gamma = 0.0;
        for j in 0..copy.len() {
            let [x, y] = copy.position[j];
            for (shift, side) in (-2..=2).flat_map(|a| (-1..=1).map(move |b| (a, b))) {
                let image = [
                    x + 2.2 * f64::from(shift),
                    match side {
                        0 => y,
                        1 => 2.4 - y,
                        _ => -2.0 - y,
                    },
                ];
                // The quintic by its definition (Morris et al. 1997).
                let q = point::distance(copy.position[i], image) / h;
                let power = |edge: f64| (edge - q).max(0.0).powi(5);
                let w = power(3.0) - 6.0 * power(2.0) + 15.0 * power(1.0);
                gamma += volume(j) * w * 7.0 / (478.0 * PI * h * h);
            }
        }
        worst = worst.max((gamma - target).abs());
    }
    assert!((level - worst).abs() < 1e-10, "{level} {worst}");
}

/// Particles leave a periodic box while they settle; what is frozen in the end is in it.
#[test]
fn frozen_images_are_wrapped_along_periodic_axes() {
    let domain = Domain::new([-1.0; 2], [1.2; 2]).with_periodic([true, false]);
    let problem = around(domain, 0.07, 1.1);
    let (mut particles, _) = shaken(&problem, 9);
    let own = particles.len();
    for place in &mut particles.position {
        place[0] += 0.5;
    }
    let mirror = Mirror::new(domain, problem.resolution.clone(), 3.6);
    mirror.freeze(&mut particles, 3.6);
    let frozen = &particles.position[own..];
    assert!(frozen.len() > 20);
    for place in frozen {
        assert!((-1.0..1.2).contains(&place[0]), "{place:?}");
        assert!(!(-1.0..=1.2).contains(&place[1]), "{place:?}");
    }
}

#[test]
fn places_of_equal_mass_are_as_many_as_asked_and_evenly_apart() {
    // An L of two densities.
    let pieces = vec![
        Piece {
            bounds: Bounds::new([0.0, 0.0], [2.0, 1.0]),
            density: 1.0,
        },
        Piece {
            bounds: Bounds::new([0.0, 1.0], [1.0, 2.0]),
            density: 4.0,
        },
    ];
    for count in [1, 2, 3, 7, 100, 1500] {
        let found = places(pieces.clone(), count);
        assert_eq!(found.len(), count);
        let inside = |p: &[f64; 2]| p[0] <= 2.0 && p[1] <= 2.0 && (p[0] <= 1.0 || p[1] <= 1.0);
        assert!(found.iter().all(inside));
        // Two thirds of the mass are in the upper piece.
        let upper = found.iter().filter(|p| p[1] > 1.0).count();
        assert!((upper as f64 - 2.0 / 3.0 * count as f64).abs() < 2.0 + 0.02 * count as f64);
        if count > 50 {
            for (i, &p) in found.iter().enumerate() {
                let own: f64 = if p[1] > 1.0 { 4.0 } else { 1.0 };
                let fair = (6.0 / (count as f64 * own)).sqrt();
                let nearest = (found.iter().enumerate())
                    .filter(|(j, _)| *j != i)
                    .map(|(_, &q)| point::distance(p, q))
                    .fold(f64::INFINITY, f64::min);
                assert!(nearest > 0.3 * fair, "{count}: {nearest} of {fair}");
            }
        }
    }
}

/// Cells know the areas of a disc's core, of what is around it, and which pockets of fluid there are.
#[test]
fn cells_know_regions_and_pockets() {
    let circle = |radius: f64| -> Vec<[f64; 2]> {
        (0..240)
            .map(|k| {
                let (sin, cos) = (2.0 * PI * f64::from(k) / 240.0).sin_cos();
                [radius * cos, radius * sin]
            })
            .collect()
    };
    let ring = Outline::new(vec![circle(1.0), circle(0.6)]).expect("a ring");
    let (outer, inner) = (
        120.0 * (PI / 120.0).sin(),
        0.36 * 120.0 * (PI / 120.0).sin(),
    );
    let plain = Problem::new(Domain::new([-2.0; 2], [2.0; 2]), 0.05).body("ring", ring);
    let surface = plain.bodies[0].surface.clone();
    let problem = Problem {
        resolution: Refinement::new(0.3, 1.1)
            .around(surface.clone(), 0.05)
            .into(),
        ..plain
    };
    let layers = Layers {
        inner: vec![1.0],
        outer: vec![0.0],
        spacing: vec![Some(0.05)],
        coarsest: 0.3,
    };
    let cells = Cells::of(&problem, &layers);
    let (pocket, count) = pockets::of(&cells, &problem);
    assert_eq!(count, 2);
    let contents = cells.contents(&pocket, count);
    assert!(
        (contents[0][0] - (16.0 - outer)).abs() < 2e-3,
        "{contents:?}"
    );
    assert!((contents[1][0] - inner).abs() < 2e-3, "{contents:?}");
    let core = surface.inset(0.05).expect("a core").volume();
    assert!((cells.volume_of(0) - core).abs() < 2e-3);
    for (place, expected) in [([0.0, 0.0], 1), ([1.5, 0.3], 0), ([-0.58, 0.0], 1)] {
        assert_eq!(pocket[cells.at(place)], expected, "{place:?}");
    }
}

/// Volumes to rounding, sizes those of the field, and an even density: a disc in boxes of every kind.
#[test]
fn packings_keep_volumes_and_sizes() {
    for periodic in [[false; 2], [true, false], [true; 2]] {
        let domain = Domain::new([-1.5, -1.4], [1.7, 1.6]).with_periodic(periodic);
        let problem = around(domain, 0.03, 1.08);
        let packed = problem.pack(&Balanced::default()).expect("a packing");
        let particles = &packed.particles;
        let inner: Vec<usize> = (0..particles.len())
            .filter(|&i| particles.kind[i] != Kind::Frozen)
            .collect();
        let all: f64 = inner.iter().map(|&i| particles.volume[i]).sum();
        assert!((all / domain.bounds.volume() - 1.0).abs() < 1e-12);
        let solid: f64 = (inner.iter())
            .filter(|&&i| particles.body[i].is_some())
            .map(|&i| particles.volume[i])
            .sum();
        assert!((solid / (PI * 0.25) - 1.0).abs() < 1e-12, "{solid}");
        for &i in &inner {
            let asked = problem.resolution.at(particles.position[i]).value;
            if particles.kind[i] == Kind::Free {
                assert!((particles.sizes.spacing(i) / asked - 1.0).abs() < 1e-12);
                let got = particles.volume[i].sqrt();
                assert!((got / asked - 1.0).abs() < 5e-3, "{got} {asked}");
            }
        }
        let quality = packed.quality();
        assert!(quality.density.linf < 2e-3, "{quality}");
        assert!(quality.residual.max < 3e-2, "{quality}");
        assert!(quality.closest_pair_over_spacing > 0.78, "{quality}");
        assert!(packed.force_evaluations <= 132);
    }
}
