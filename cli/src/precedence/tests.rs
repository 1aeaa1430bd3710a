//! What is left and what both claimed make up the body, at any depth.

use std::f64::consts::TAU;

use proptest::prelude::*;
use sphpack_geometry::{Ball, Similarity, Torus};

use super::*;

type Points = Vec<[f64; 2]>;

const SPACING: f64 = 1.0;

/// The part of a convex polygon to the left of every side of another: both counter-clockwise.
fn clipped(mut points: Points, by: &[[f64; 2]]) -> Points {
    for (k, &a) in by.iter().enumerate() {
        let b = by[(k + 1) % by.len()];
        let height = |p: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        let mut kept = Vec::new();
        for (i, &p) in points.iter().enumerate() {
            let q = points[(i + 1) % points.len()];
            let (from, to) = (height(p), height(q));
            if from >= 0.0 {
                kept.push(p);
            }
            if (from >= 0.0) != (to >= 0.0) {
                let t = from / (from - to);
                kept.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
            }
        }
        points = kept;
    }
    points
}

fn area(points: &[[f64; 2]]) -> f64 {
    let mut twice = 0.0;
    for (i, p) in points.iter().enumerate() {
        let q = points[(i + 1) % points.len()];
        twice += p[0] * q[1] - p[1] * q[0];
    }
    0.5 * twice
}

/// A disc, a regular polygon, a box or a needle about the origin, counter-clockwise.
fn convex() -> impl Strategy<Value = Points> {
    let regular = |n: usize, r: f64| -> Points {
        let at = |k: usize| (TAU * k as f64 / n as f64).sin_cos();
        (0..n).map(at).map(|(s, c)| [r * c, r * s]).collect()
    };
    prop_oneof![
        (3..12_usize, 1.0..4.0).prop_map(move |(n, r)| regular(n, r)),
        (1.0..4.0).prop_map(move |r| regular(500, r)),
        (0.5..4.0, 0.5..4.0).prop_map(|(x, y): (f64, f64)| vec![
            [-x, -y],
            [x, -y],
            [x, y],
            [-x, y]
        ]),
        (-5.0..-1.0).prop_map(|width| {
            let half = 10.0_f64.powf(width);
            vec![[-5.0, 0.0], [5.0, -half], [5.0, half]]
        }),
    ]
}

/// From 10⁻⁶ to 0.2 ∆s.
fn depth() -> impl Strategy<Value = f64> {
    (-6.0..-0.7).prop_map(|power| SPACING * 10.0_f64.powf(power))
}

fn outline(points: &[[f64; 2]]) -> Outline {
    Outline::polygon(points).expect("a convex polygon")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn areas_add_up_at_any_depth(
        (a, b) in (convex(), convex()), turns in (0.0..360.0, 0.0..360.0), depth in depth(), through in any::<bool>(),
    ) {
        let turned = |points: &Points, degrees, shift| {
            let by = Similarity::<2>::new(1.0, degrees, shift).expect("a turn");
            points.iter().map(|&p| by.point(p)).collect::<Points>()
        };
        let a = turned(&a, turns.0, [0.0; 2]);
        let b = turned(&b, turns.1, [0.0; 2]);
        // Through the middle, or so that the boxes overlap by the depth along x.
        let ends = |points: &Points, of: fn(f64, f64) -> f64| points.iter().map(|p| p[0]).reduce(of).unwrap_or(0.0);
        let x = if through { depth } else { ends(&a, f64::max) - ends(&b, f64::min) - depth };
        let b = turned(&b, 0.0, [x, 0.0]);
        let (lower, higher) = (outline(&a), outline(&b));
        let both = area(&clipped(a.clone(), &b));
        // What is thinner than 10⁻⁶ of the body need not be told apart.
        let bounds = lower.bounds();
        let least = 1e-6 * bounds.diagonal() * lower.measure();
        let exact = area(&a) - both;
        let left = Space::<2>::minus(&lower, &higher, SPACING, &Room::open(SPACING)).expect("in the plane all is cut");
        let (volume, pieces) = match &left {
            Left::All => (lower.volume(), 1),
            Left::Part(left) => (left.volume(), left.loops().len()),
            Left::Nothing => (0.0, 0),
        };
        // Crumbs are dropped; each such cut of these leaves at most so many.
        let dropped = exact - volume;
        prop_assert!(dropped > -least, "{} too much", -dropped);
        prop_assert!(dropped < least + 12.0 * CRUMB * SPACING * SPACING, "{} missing", dropped);
        let whole = lower.minus(&higher).map_or(0.0, |left| left.volume());
        prop_assert!((whole - exact).abs() < least, "{} off, {} pieces", whole - exact, pieces);
        if both == 0.0 {
            prop_assert!(matches!(left, Left::All));
        }
    }
}

fn solid(min: [f64; 3], max: [f64; 3], degrees: f64) -> Solid {
    let turn = Similarity::<3>::new(1.0, [0.3, -0.5, 0.8], degrees, [0.0; 3]).expect("a turn");
    let ends = [min, max];
    let corner = |bits: usize| turn.point(std::array::from_fn(|k| ends[bits >> k & 1][k]));
    Solid::Mesh(Arc::new(hexahedron(corner).expect("a box")))
}

#[test]
fn volumes_add_up_at_any_depth() {
    for degrees in [0.0, 33.0, 71.0] {
        let lower = solid([0.0; 3], [4.0; 3], degrees);
        for depth in [1e-5, 1e-4, 1e-3, 0.01, 0.05, 0.099, 0.2] {
            // Across a face, over an edge and at a corner; no edges of both meet, which would move the higher one.
            for (y, z) in [
                (-1.0, -1.3),
                (4.0 - 0.8 * depth, -1.3),
                (4.0 - 0.8 * depth, 4.0 - 0.9 * depth),
            ] {
                let higher = solid([4.0 - depth, y, z], [7.0, y + 7.0, z + 7.0], degrees);
                let both = depth * (4.0 - y.max(0.0)) * (4.0 - z.max(0.0));
                let left = Space::<3>::minus(&lower, &higher, SPACING, &Room::open(SPACING))
                    .expect("it is cut");
                let volume = match left {
                    Left::All => 64.0,
                    Left::Part(left) => left.volume(),
                    Left::Nothing => 0.0,
                };
                let off = volume + both - 64.0;
                // An edge or a corner of little room may be missed.
                assert!(
                    off.abs() < 1e-8 || (both < 7e-3 && off < 1.001 * both),
                    "{depth} {y} {z}: {off}"
                );
            }
        }
        // What touches stays as it is.
        for higher in [
            solid([4.0, -1.0, -1.0], [7.0; 3], degrees),
            solid([4.0; 3], [7.0; 3], degrees),
        ] {
            assert!(matches!(
                Space::<3>::minus(&lower, &higher, SPACING, &Room::open(SPACING)),
                Ok(Left::All)
            ));
        }
    }
    let ball = |x: f64| {
        let ball = Ball::new([x, 0.0, 0.0], 2.0).expect("a ball");
        Solid::Smooth(Arc::new(ball) as Arc<dyn Surface<3>>)
    };
    assert!(matches!(
        Space::<3>::minus(&ball(0.0), &ball(4.0), SPACING, &Room::open(SPACING)),
        Ok(Left::All)
    ));
    assert!(matches!(
        Space::<3>::minus(&ball(0.0), &ball(3.9), SPACING, &Room::open(SPACING)),
        Ok(Left::Part(_))
    ));
}

/// A ring through a board: its lower half is left, and above the board a ring with the section of a circle's segment.
#[test]
fn thin_slices_are_not_lost_on_a_grid() {
    let (major, minor) = (1.84, 0.94);
    let mut refined = 0;
    for n in 1..=16 {
        let height = 0.03 * f64::from(n);
        let ring = Torus::new([0.03 * height, 0.0, 0.01], [0.0, 0.0, 1.0], major, minor);
        let board = [[-4.0, -4.0, 0.01], [4.0, 4.0, 0.01 + minor - height]];
        let left = Space::<3>::minus(
            &Solid::Smooth(Arc::new(ring.expect("a ring"))),
            &solid(board[0], board[1], 0.0),
            SPACING,
            &Room::open(SPACING),
        );
        let chord = minor - height;
        let segment =
            minor * minor * (chord / minor).acos() - chord * (minor * minor - chord * chord).sqrt();
        let exact = TAU * major * (0.25 * TAU * minor * minor + segment);
        let Ok(Left::Part(left)) = left else {
            panic!("{height}: not cut");
        };
        let off = (left.volume() - exact).abs();
        assert!(off < LOST_ON_GRID + 3e-3 * exact, "{height}: {off}");
        refined += usize::from(left.triangles().len() > 20_000);
    }
    assert!(refined > 0, "cells of a quarter of ∆s were enough");
}

/// Of a planet only what is in the room is cut, and only the room is paid for; it is cut as a flat board would be.
#[test]
fn of_bodies_larger_than_the_room_only_what_is_in_it_is_cut() {
    let ball = |z: f64, radius: f64| {
        let ball = Ball::new([0.0, 0.0, z], radius).expect("a ball");
        Solid::Smooth(Arc::new(ball) as Arc<dyn Surface<3>>)
    };
    let room = Room::around(&Domain::new([-4.0; 3], [4.0; 3]), SPACING);
    for radius in [50.0, 1e3, 1e6] {
        let planet = ball(-radius, radius);
        let below = |shift: f64| ball(-radius - shift, radius);
        // Beyond the room all goes on for a while: a box of 10 × 10 × 10 in it counts.
        let Solid::Mesh(inner) = solid([-5.0; 3], [5.0; 3], 0.0) else {
            panic!("a box is a mesh");
        };
        let volume = |left: Result<Left<Mesh>, GeometryError>| match left {
            Ok(Left::Part(left)) => {
                let beyond = left.minus(&inner).expect("it is cut");
                left.volume() - beyond.map_or(0.0, |beyond| beyond.volume())
            }
            Ok(Left::All) => f64::INFINITY,
            other => panic!("{radius}: {:?}", other.map(|_| ())),
        };
        // A layer between two spheres: one is as far below the other everywhere.
        let sagitta = 100.0 * (25.0 / 3.0) / radius;
        let layer = volume(Space::<3>::minus(&planet, &below(2.0), SPACING, &room));
        assert!((layer - 200.0).abs() < 1e-3 * 200.0, "{layer}");
        let small = volume(Space::<3>::minus(&ball(0.0, 3.0), &planet, SPACING, &room));
        let half = TAU * 9.0;
        let cap = TAU * 81.0 / 8.0 / radius;
        assert!(
            (small - half - cap).abs() < 3e-3 * half,
            "{small}, {half}, {cap}"
        );
        let ground = volume(Space::<3>::minus(&planet, &ball(0.0, 3.0), SPACING, &room));
        let exact = 100.0 * 5.0 - sagitta - (half - cap);
        assert!((ground - exact).abs() < 3e-3 * exact, "{ground}, {exact}");
        // What meets beyond the room does not matter.
        let away = Domain::new([-4.0, -4.0, 6.0], [4.0, 4.0, 7.0]);
        let away = Room::around(&away, SPACING);
        assert!(matches!(
            Space::<3>::minus(&planet, &ball(0.0, 3.0), SPACING, &away),
            Ok(Left::All)
        ));
    }
}

/// What is left of a ball around rods thinner than a particle, at any angle, does not overlap them.
#[test]
fn thin_rods_are_cut_out_as_they_are() {
    for n in 0..12 {
        let n = f64::from(n);
        let part = |a: f64| (a * (n + 0.5)) % 1.0;
        let [x, y, z] = [0.819_172_5, 0.671_043_6, 0.549_700_5].map(part);
        let along = [x - 0.5, y - 0.5, z - 0.5];
        let radius = 0.3 + 0.1 * (n % 5.0);
        let rod = Cylinder::new([x, y, z], point::add_scaled([x, y, z], 3.0, along), radius);
        let rod: Arc<dyn Surface<3>> = Arc::new(rod.expect("a rod"));
        let ball: Arc<dyn Surface<3>> = Arc::new(Ball::new([0.0; 3], 5.0).expect("a ball"));
        let [lower, higher] = [ball, Arc::clone(&rod)].map(Solid::Smooth);
        let left = Space::<3>::minus(&lower, &higher, SPACING, &Room::open(SPACING));
        let Ok(Left::Part(left)) = left else {
            panic!("{n}: not cut");
        };
        let deep =
            overlap::deeper_than(overlap::TOUCHING_OVER_SPACING, &left, rod.as_ref(), SPACING);
        assert!(deep.is_none(), "{n}: {deep:?}");
        let whole = 2.0 / 3.0 * TAU * 125.0;
        let off = (whole - left.volume() - rod.volume()).abs();
        assert!(off < LOST_ON_GRID + 1e-3 * whole, "{n}: {off}");
    }
}

/// What others have left of a curve that passes a side of the box is what goes on there: the whole curve did, over those that had cut it.
#[test]
fn cuts_last_beyond_the_sides() {
    for (shape, radii) in [
        (
            "circle = { center = [-30.0, 4.0], radius = 34.0 }",
            [34.0, 34.0],
        ),
        (
            "ellipse = { center = [-30.0, 4.0], semi_axes = [34.0, 40.0] }",
            [34.0, 40.0],
        ),
    ] {
        let text = format!(
            "spacing = 0.5\n[domain]\nmin = [0.0, 0.0]\nmax = [9.0, 8.0]\n\
             [[body]]\nname = \"wall\"\nshape = {{ {shape} }}\n\
             [[body]]\nname = \"disc\"\nprecedence = 1\nshape = {{ circle = {{ center = [4.0, 4.0], radius = 2.0 }} }}\n"
        );
        let scene = Scene::parse(&text, "wall.toml").expect("a scene");
        let outcome = crate::run(
            &scene,
            &crate::Options::default(),
            &mut sphpack_packing::Silent,
        );
        let report = outcome.expect("it is packed").report;
        assert!(report.audit.passed, "{:?}", report.audit.messages);
        // Of the box what the curve holds and the disc does not, in strips.
        let steps = 100_000;
        let exact: f64 = (0..steps)
            .map(|n| {
                let y = 8.0 * (f64::from(n) + 0.5) / f64::from(steps);
                let across = (1.0 - ((y - 4.0) / radii[1]).powi(2)).sqrt();
                let end = -30.0 + radii[0] * across;
                let half = (4.0 - (y - 4.0) * (y - 4.0)).max(0.0).sqrt();
                let disc = (end.min(4.0 + half) - (4.0 - half)).max(0.0);
                (end - disc) * 8.0 / f64::from(steps)
            })
            .sum();
        let wall = report.bodies.iter().find(|body| body.name == "wall");
        let volume = wall.map_or(0.0, |body| body.volume);
        assert!((volume - exact).abs() < 1e-3, "{volume}, {exact}");
    }
}
