//! What holds of every balanced packing.

mod uneven;

use std::sync::Arc;

use proptest::prelude::*;
use sphpack_geometry::{Ball, Cuboid, GeometryError, Outline, Similarity, Surface, Thin};
use sphpack_neighbors::{Domain, point};

use crate::minimise::Finish;
use crate::{
    Balanced, Body, Kind, MinimiserKind, Packed, Problem, RunLog, Settling, Silent, StopReason,
    correct_masses,
};

fn pack<const D: usize>(problem: &Problem<D>) -> Packed<D> {
    Balanced::default()
        .pack_in(problem, &mut RunLog::new(&mut Silent))
        .expect("a sound problem")
}

fn linf<const D: usize>(problem: &Problem<D>, packed: &Packed<D>) -> f64 {
    let fields = packed.fields(problem.kernel, problem.h_over_spacing);
    packed.quality_by(&fields).density.linf
}

/// A polygon with corners both ways, its place and size free.
fn arrow(place: &Similarity<2>) -> Result<Outline, GeometryError> {
    let points = [[-0.6, -0.4], [0.7, 0.0], [-0.6, 0.5], [-0.3, 0.05]];
    Ok(Outline::polygon(&points)?.transformed(place))
}

fn arrow_problem(scale: f64, shift: [f64; 2]) -> Problem<2> {
    let place = Similarity::<2>::new(scale, 0.0, shift).expect("a similarity");
    let corner = |sign: f64| point::add(shift, [sign * scale; 2]);
    Problem::new(Domain::new(corner(-1.0), corner(1.0)), 0.1 * scale)
        .body("arrow", arrow(&place).expect("an outline"))
}

/// An L, its place and size free.
fn corner_problem(scale: f64, shift: [f64; 2]) -> Problem<2> {
    let points = [
        [-0.6, -0.4],
        [0.7, -0.4],
        [0.7, 0.1],
        [0.1, 0.1],
        [0.1, 0.5],
        [-0.6, 0.5],
    ];
    let place = Similarity::<2>::new(scale, 0.0, shift).expect("a similarity");
    let corner = |sign: f64| point::add(shift, [sign * scale; 2]);
    let body = Outline::polygon(&points).expect("an outline");
    Problem::new(Domain::new(corner(-1.0), corner(1.0)), 0.07 * scale)
        .body("corner", body.transformed(&place))
}

fn volume_of<const D: usize>(packed: &Packed<D>, is_wanted: impl Fn(usize) -> bool) -> f64 {
    (0..packed.particles.len())
        .filter(|&i| packed.particles.kind[i] != Kind::Frozen && is_wanted(i))
        .map(|i| packed.particles.volume[i])
        .sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn volumes_are_exact(radius in 0.3..0.8_f64, spacing in 0.06..0.13_f64, seed in 0..100_u64) {
        let mut problem = Problem::new(Domain::new([-1.0; 2], [1.0; 2]), spacing)
            .body("disc", Ball::new([0.02, -0.03], radius).unwrap());
        problem.seed = seed;
        let packed = pack(&problem);
        let inner = problem.bodies[0].surface.clone();
        let is_solid = |i: usize| packed.particles.kind[i].is_on_surface()
            || inner.closest(packed.particles.position[i]).distance < -0.5 * spacing;
        let solid = volume_of(&packed, is_solid);
        let area = std::f64::consts::PI * radius * radius;
        prop_assert!((solid / area - 1.0).abs() < 1e-9, "{solid} {area}");
        let all = volume_of(&packed, |_| true);
        prop_assert!((all / 4.0 - 1.0).abs() < 1e-9, "{all}");
        // A disc of three spacings' radius has few ways to be filled.
        prop_assert!(linf(&problem, &packed) < 1e-2);
        prop_assert_eq!(packed.stop_reason, StopReason::Converged);
    }

    /// Where a problem is moved, rounding is coarser and grows on the way; the particles are not the same, the figures are.
    #[test]
    fn units_and_place_do_not_matter(exponent in -6..=6_i32, shift in prop::array::uniform2(-3.0..3.0_f64)) {
        let scale = 10.0_f64.powi(exponent);
        let here = corner_problem(1.0, [0.0; 2]);
        let there = corner_problem(scale, shift.map(|x| x * scale));
        let (a, b) = (pack(&here), pack(&there));
        prop_assert_eq!(a.particles.len(), b.particles.len());
        for kind in Kind::ALL {
            prop_assert_eq!(a.particles.count(kind), b.particles.count(kind));
        }
        let (a, b) = (linf(&here, &a), linf(&there, &b));
        prop_assert!((a - b).abs() < 3e-4, "{a} {b}");
    }
}

#[test]
fn units_do_not_matter() {
    // With a tip of 35°: which of equally good places is taken there is not for rounding to say.
    let of = |exponent: i32| {
        let problem = arrow_problem(10.0_f64.powi(exponent), [0.0; 2]);
        let packed = pack(&problem);
        let counts = Kind::ALL.map(|kind| packed.particles.count(kind));
        (packed.force_evaluations, counts, linf(&problem, &packed))
    };
    let (evaluations, counts, error) = of(0);
    for exponent in [-6, -1, 3, 6] {
        let found = of(exponent);
        assert_eq!((found.0, found.1), (evaluations, counts), "{exponent}");
        assert!((found.2 - error).abs() < 1e-6, "{error} {}", found.2);
    }
}

/// The hexagonal lattice is mirrored with the box, but not turned with it: a turned problem is as good, not the same. The
/// greatest error is one particle's and varies between seeds; its mean over some of them keeps the bar, and the mean error is
/// the same.
#[test]
fn a_mirrored_or_turned_problem_packs_as_well() {
    let flat = [[-0.6, -0.4], [0.7, 0.0], [-0.6, 0.5], [-0.3, 0.05]];
    let of = |map: fn([f64; 2]) -> [f64; 2]| {
        let points: Vec<[f64; 2]> = flat.into_iter().map(map).collect();
        let mut problem = Problem::new(Domain::new([-1.0; 2], [1.0; 2]), 0.07)
            .body("arrow", Outline::polygon(&points).expect("an outline"));
        let (mut linf, mut free, mut rms) = (0.0, 0, 0.0);
        const SEEDS: u64 = 4;
        for seed in 0..SEEDS {
            problem.seed = seed;
            let packed = pack(&problem);
            let density = packed
                .quality_by(&packed.fields(problem.kernel, problem.h_over_spacing))
                .density;
            linf += density.linf / SEEDS as f64;
            free += packed.particles.count(Kind::Free);
            rms += density.rms / SEEDS as f64;
        }
        assert!(linf < 2e-3, "{linf}");
        (free, rms)
    };
    let (count, error) = of(|p| p);
    for map in [
        (|p| [-p[0], p[1]]) as fn([f64; 2]) -> [f64; 2],
        |p| [p[0], -p[1]],
        |p| [-p[1], p[0]],
    ] {
        let (other_count, other) = of(map);
        assert_eq!(other_count, count);
        assert!((other / error - 1.0).abs() < 0.3, "{other} {error}");
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let flat = arrow_problem(1.0, [0.0; 2]);
    let tried = small_square(2.5, 1.1);
    let solid = Problem::new(Domain::new([-1.0; 3], [1.0; 3]), 0.2)
        .body("cube", Cuboid::new([-0.5; 3], [0.4; 3]).expect("a cube"));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a thread pool");
        pool.install(|| {
            (
                pack(&flat).particles,
                pack(&tried).particles,
                pack(&solid).particles,
            )
        })
    };
    assert!(with(1) == with(2) && with(1) == with(3));
}

#[test]
fn a_box_in_space_has_its_edges_and_corners() {
    let problem = Problem::new(Domain::new([-1.0; 3], [1.0; 3]), 0.2)
        .body("cube", Cuboid::new([-0.5; 3], [0.5; 3]).expect("a cube"));
    let packed = pack(&problem);
    let particles = &packed.particles;
    // The inset cube has edges of 0.8: four intervals on each of twelve, eight corners.
    assert_eq!(particles.count(Kind::Fixed), 12 * 3 + 8);
    assert_eq!(packed.surfaces[0].target_count, 96);
    assert_eq!(particles.count(Kind::Boundary), 96 - 44);
    assert!(linf(&problem, &packed) < 6e-3);
}

#[test]
fn bodies_inside_bodies_and_holes_get_their_share() {
    let (outer, inner) = (0.9, 0.4);
    let problem = Problem::new(Domain::new([-1.2; 2], [1.2; 2]), 0.06)
        .body("core", Ball::new([0.0; 2], inner).expect("a disc"))
        .body("shell", Ball::new([0.0; 2], outer).expect("a disc"));
    let packed = pack(&problem);
    let radius = |i: usize| point::norm(packed.particles.position[i]);
    let core = volume_of(&packed, |i| {
        radius(i) < inner - 0.03 || packed.particles.body[i] == Some(0)
    });
    let shell = volume_of(&packed, |i| {
        (inner - 0.03..outer - 0.03).contains(&radius(i)) && packed.particles.body[i] != Some(0)
            || packed.particles.body[i] == Some(1)
    });
    let disc = |r: f64| std::f64::consts::PI * r * r;
    assert!((core / disc(inner) - 1.0).abs() < 1e-9, "{core}");
    assert!(
        (shell / (disc(outer) - disc(inner)) - 1.0).abs() < 1e-9,
        "{shell}"
    );
    assert!(linf(&problem, &packed) < 4e-3);
}

/// Bodies that touch, and bodies with a slit between them, on exact and on inset surfaces.
/// Long flat sides along the rows of the lattice, at any height between them.
#[test]
fn rows_along_a_flat_side_have_nothing_to_carry_away() {
    for spacing in [0.0228, 0.0258] {
        let margin = 8.0 * spacing;
        let domain = Domain::new(
            [-1.0 - margin, -0.05 - margin],
            [1.0 + margin, 2.15 + margin],
        );
        let mut problem = Problem::new(domain, spacing);
        for (name, k) in [("a", 0), ("b", 1), ("c", 2), ("d", 3), ("e", 4)] {
            let (middle, half) = (0.5 * f64::from(k), 0.05 + 0.025 * f64::from(k));
            let strip = Cuboid::new([-1.0, middle - half], [1.0, middle + half]);
            problem = problem.body(name, strip.expect("a strip"));
        }
        let packed = pack(&problem);
        // 124 and 133; where a row is in or out as a whole, 290 and 294.
        let evaluations = packed.force_evaluations;
        assert!(evaluations < 200, "{evaluations} at {spacing}");
        assert_eq!(packed.stop_reason, StopReason::Converged);
        assert!(linf(&problem, &packed) < 3e-3);
    }
}

#[test]
fn surfaces_near_each_other_keep_particles_apart() {
    for gap in [0.0, 0.3, 1.5] {
        for inset_over_spacing in [0.0, 0.5] {
            let body = |name: &str, min: [f64; 2], max: [f64; 2]| Body {
                name: name.to_owned(),
                surface: Arc::new(Cuboid::new(min, max).expect("a box")),
                inset_over_spacing,
                thin: Thin::Mass,
            };
            let spacing = 0.07;
            let problem = Problem::new(Domain::new([-1.2, -1.0], [1.2, 1.0]), spacing)
                .placed_body(body("left", [-0.8, -0.4], [-gap * spacing, 0.4]))
                .placed_body(body("right", [0.0, -0.4], [0.8, 0.4]));
            let packed = pack(&problem);
            let quality = packed.quality_by(&packed.fields(problem.kernel, problem.h_over_spacing));
            let what = format!("gap {gap}, inset {inset_over_spacing}: {quality:?}");
            assert!(quality.closest_pair_over_spacing > 0.6, "{what}");
            assert!(quality.density.linf < 0.05, "{what}");
        }
    }
}

#[test]
fn periodic_boxes_and_no_body_at_all() {
    let mut domain = Domain::new([-1.0; 2], [1.0; 2]);
    domain.periodic = [true, true];
    let problem = Problem::new(domain, 0.1);
    let packed = pack(&problem);
    assert_eq!(packed.stop_reason, StopReason::Converged);
    assert!(linf(&problem, &packed) < 1e-3);
    let problem = problem.body("disc", Ball::new([0.0; 2], 0.4).expect("a disc"));
    let packed = pack(&problem);
    assert_eq!(packed.stop_reason, StopReason::Converged);
    assert!(linf(&problem, &packed) < 5e-3);
}

#[test]
fn a_consistent_finish_leaves_no_force_and_every_minimiser_arrives() {
    let problem = Problem::new(Domain::new([-2.0; 2], [2.0; 2]), 0.12)
        .body("disc", Ball::new([0.0; 2], 1.0).expect("a disc"));
    for (minimiser, finish) in [
        (MinimiserKind::Lbfgs, Finish::Consistent),
        (MinimiserKind::Fire, Finish::Even),
        (MinimiserKind::Damped, Finish::Even),
    ] {
        let settling = Settling {
            minimiser,
            finish,
            ..Settling::default()
        };
        let packed = Balanced {
            settling,
            ..Balanced::default()
        }
        .pack_in(&problem, &mut RunLog::new(&mut Silent))
        .expect("a sound problem");
        assert_eq!(packed.stop_reason, StopReason::Converged, "{minimiser:?}");
        let fields = packed.fields(problem.kernel, problem.h_over_spacing);
        let quality = packed.quality_by(&fields);
        assert!(quality.density.linf < 5e-3, "{minimiser:?}");
        if finish == Finish::Consistent {
            assert!(quality.residual.max < 1.1e-5);
            assert!(quality.closest_pair_over_spacing > 0.6);
        } else {
            assert!(quality.closest_pair_over_spacing > 0.85, "{minimiser:?}");
        }
    }
}

#[test]
fn corrected_masses_even_the_density_and_keep_the_sums() {
    let problem = arrow_problem(1.0, [0.0; 2]);
    let mut packed = pack(&problem);
    let before = packed.particles.volume.clone();
    let group: Vec<Option<usize>> = (0..packed.particles.len())
        .map(|i| match packed.particles.kind[i] {
            Kind::Frozen => None,
            kind => Some(usize::from(
                kind.is_on_surface()
                    || problem.bodies[0]
                        .surface
                        .inside(packed.particles.position[i]),
            )),
        })
        .collect();
    let spread = 0.02;
    let correction = correct_masses(
        &problem.domain,
        &packed.particles.position,
        &mut packed.particles.volume,
        &group,
        problem.kernel,
        problem.smoothing_length(),
        spread,
    );
    let after = linf(&problem, &packed);
    assert!((after - correction.linf[1]).abs() < 1e-12);
    assert!(after < 0.6 * correction.linf[0], "{correction:?}");
    for wanted in [None, Some(0), Some(1)] {
        let sum = |volume: &[f64]| -> f64 {
            let of = volume.iter().zip(&group).filter(|(_, g)| **g == wanted);
            of.map(|(v, _)| v).sum()
        };
        let (old, new) = (sum(&before), sum(&packed.particles.volume));
        assert!((new / old - 1.0).abs() < 1e-12, "{wanted:?}: {old} {new}");
    }
    for (new, old) in packed.particles.volume.iter().zip(&before) {
        assert!((new / old - 1.0).abs() <= spread * (1.0 + 1e-9));
    }
}

fn circle(center: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    (0..120)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 120.0).sin_cos();
            [center[0] + radius * cos, center[1] + radius * sin]
        })
        .collect()
}

fn shoelace(points: &[[f64; 2]]) -> f64 {
    let twice = |k: usize| {
        let ([x, y], [u, v]) = (points[k], points[(k + 1) % points.len()]);
        x * v - u * y
    };
    0.5 * (0..points.len()).map(twice).sum::<f64>().abs()
}

/// A ring with an island, and a block beside it: each part and the pocket between ring and island has its own volume, whatever
/// the spacing, by where the particles are.
#[test]
fn no_part_pays_for_another() {
    let (outer, inner) = (circle([0.0; 2], 1.0), circle([0.0; 2], 0.75));
    let island = circle([0.05, 0.0], 0.33);
    let block = vec![[1.2, -0.2], [1.6, -0.2], [1.6, 0.25], [1.2, 0.25]];
    let area = [&outer, &inner, &island, &block].map(|points| shoelace(points));
    let exact = [area[0] - area[1], area[1] - area[2], area[2], area[3]];
    let body = Outline::new(vec![outer, inner, island, block]).expect("an outline");
    for step in 0..10 {
        let spacing = 0.03 * 1.15_f64.powi(step);
        let problem = Problem::new(Domain::new([-1.7, -1.7], [2.3, 1.7]), spacing)
            .body("parts", body.clone());
        let packed = pack(&problem);
        let mut held = [0.0; 4];
        for i in 0..packed.particles.len() {
            let [x, y] = packed.particles.position[i];
            let is_solid = packed.particles.body[i].is_some();
            let from = |u: f64| (x - u).hypot(y);
            let region = match (is_solid, from(0.0), from(0.05)) {
                (true, _, to_island) if to_island < 0.33 => 2,
                (true, to_ring, _) if to_ring < 1.0 => 0,
                (true, _, _) => 3,
                (false, to_ring, _) if to_ring < 0.75 => 1,
                _ => continue,
            };
            held[region] += packed.particles.volume[i];
        }
        for (held, exact) in held.iter().zip(exact) {
            let half = 0.5 * spacing * spacing;
            assert!(
                (held - exact).abs() < half.max(0.01 * exact),
                "{spacing}: {held} {exact}"
            );
        }
    }
}

/// A part of less than half a particle has none, and its volume is left to the fluid.
#[test]
fn a_part_too_small_for_a_particle_is_told() {
    let large = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let small = vec![[1.5, 0.5], [1.53, 0.5], [1.53, 0.53], [1.5, 0.53]];
    let body = Outline::new(vec![large, small]).expect("an outline");
    let problem = Problem::new(Domain::new([-0.5, -0.5], [2.0, 1.5]), 0.05).body("two", body);
    let packed = pack(&problem);
    assert_eq!(packed.omitted.len(), 1);
    assert!((packed.omitted[0].volume - 9e-4).abs() < 1e-12);
    let volume = |is_solid: bool| -> f64 {
        (0..packed.particles.len())
            .filter(|&i| packed.particles.kind[i] != Kind::Frozen)
            .filter(|&i| packed.particles.body[i].is_some() == is_solid)
            .map(|i| packed.particles.volume[i])
            .sum()
    };
    assert!((volume(true) - 1.0).abs() < 1e-9);
    assert!((volume(false) - 4.0).abs() < 1e-9);
}

/// A square of so many spacings, turned and off the middle.
fn small_square(side: f64, turn: f64) -> Problem<2> {
    let half = 0.5 * side;
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    let place = Similarity::<2>::new(1.0, turn, [0.13, 0.21]).expect("a similarity");
    let body = Outline::polygon(&corners).expect("an outline");
    Problem::new(Domain::new([-8.0; 2], [8.0; 2]), 1.0).body("square", body.transformed(&place))
}

/// No two particles nearer than 0.8 ∆s, by brute force, L∞ of the density at most 0.5 %, and as much body as there is.
fn assert_even<const D: usize>(problem: &Problem<D>, name: &str) {
    let packed = pack(problem);
    let (place, kind) = (&packed.particles.position, &packed.particles.kind);
    let nearest = (0..place.len())
        .filter(|&i| kind[i] != Kind::Frozen)
        .flat_map(|i| {
            (0..place.len())
                .filter(move |&j| j != i)
                .map(move |j| (i, j))
        })
        .map(|(i, j)| point::distance(place[i], place[j]) / problem.spacing())
        .fold(f64::INFINITY, f64::min);
    assert!(nearest >= 0.8, "{name}: a pair {nearest} ∆s apart");
    let linf = linf(problem, &packed);
    assert!(linf <= 5e-3, "{name}: L∞ {linf}");
    let volume = volume_of(&packed, |i| packed.particles.body[i] == Some(0));
    let exact = problem.bodies[0].surface.volume();
    assert!(
        (volume / exact - 1.0).abs() < 1e-9,
        "{name}: volume {volume}, not {exact}"
    );
}

#[test]
fn small_parts_get_counts_that_settle_evenly() {
    // With the usual counts, pairs of the squares are 0.6 … 0.77 ∆s apart; L∞ is 0.7 % in the strip and 1.8 % in the ball.
    for (side, turn) in [(2.2, 0.37), (2.5, 1.1), (2.7, 0.0), (3.25, 0.74)] {
        assert_even(&small_square(side, turn), &format!("a square of {side}"));
    }
    let strip = Outline::polygon(&[[-6.0, -1.25], [6.0, -1.25], [6.0, 1.25], [-6.0, 1.25]]);
    let strip = strip
        .expect("an outline")
        .transformed(&Similarity::<2>::new(1.0, 0.37, [0.13, 0.21]).expect("a similarity"));
    assert_even(&Problem::around(&strip, 1.0).margin(6.0), "a strip of 2.5");
    let ball = Ball::new([0.1, 0.2, 0.3], 1.5).expect("a ball");
    assert_even(&Problem::around(&ball, 1.0).margin(5.0), "a ball of 3");
}

#[test]
fn parts_that_settle_evenly_keep_their_usual_counts() {
    let problem = small_square(4.0, 0.37);
    let packed = pack(&problem);
    let on_surface = (packed.particles.kind.iter())
        .filter(|kind| matches!(kind, Kind::Boundary | Kind::Fixed))
        .count();
    assert_eq!(on_surface, 12);
    assert_eq!(packed.particles.body.iter().flatten().count(), 16);
}

#[test]
fn no_particle_slips_into_a_tail() {
    let wing = Outline::naca("0012", 10.0).expect("an airfoil");
    let problem = Problem::around(&wing, 0.1).margin(0.6);
    let packed = pack(&problem);
    let deepest = (0..packed.particles.len())
        .filter(|&i| packed.particles.kind[i] == Kind::Free && packed.particles.body[i].is_none())
        .map(|i| wing.closest(packed.particles.position[i]).distance)
        .fold(f64::INFINITY, f64::min);
    assert!(deepest > 0.0, "a particle of the fluid is {deepest} in");
}
