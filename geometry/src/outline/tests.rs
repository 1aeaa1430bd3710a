//! Outlines against brute force, and the three inside tests against one another.

use std::f64::consts::TAU;

use proptest::prelude::*;
use sphpack_neighbors::point;

use super::*;
use crate::segment::meeting;
use crate::surface::{Feature, Surface};
use crate::{GeometryError, InsetError, LoopSide, OutlineError, ParameterError, ReadError};

/// Star-shaped about the origin.
fn star() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec(0.2..1.0, 3..24).prop_map(|radii: Vec<f64>| {
        let n = radii.len() as f64;
        let at = |(i, r): (usize, &f64)| {
            let (sin, cos) = (TAU * (i as f64 + 0.3) / n).sin_cos();
            [r * cos, r * sin]
        };
        radii.iter().enumerate().map(at).collect()
    })
}

/// A random tour without crossings: crossing pairs of sides are exchanged until none is left (each exchange shortens
/// the tour).
fn untangled() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec([-1.0..1.0, -1.0..1.0], 4..14).prop_map(|mut p: Vec<[f64; 2]>| {
        let n = p.len();
        'again: for _ in 0..1000 {
            for i in 0..n {
                for j in i + 2..n {
                    if (j + 1) % n != i && meeting(p[i], p[i + 1], p[j], p[(j + 1) % n]).is_some() {
                        p[i + 1..=j].reverse();
                        continue 'again;
                    }
                }
            }
            break;
        }
        p
    })
}

fn simple() -> impl Strategy<Value = Outline> {
    prop_oneof![star(), untangled()].prop_filter_map("degenerate", |p| Outline::polygon(&p).ok())
}

fn tilted_square() -> Outline {
    let square = Outline::polygon(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]).unwrap();
    square.transformed(&Similarity::<2>::new(1.0, 17.0, [0.0, 0.0]).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn inside_tests_agree(outline in simple(), p in [-1.2..1.2, -1.2..1.2]) {
        let points = outline.points();
        prop_assume!(outline.closest(p).distance.abs() > 1e-9);
        let inside = outline.inside(p);
        prop_assert_eq!(angle_sum(points, p) > std::f64::consts::PI, inside);
        prop_assert_eq!(winding_number(points, p), i64::from(inside));
        prop_assert_eq!(crossing_number(points, p) % 2 == 1, inside);
        prop_assert_eq!(outline.closest(p).distance < 0.0, inside);
    }

    #[test]
    fn rays_through_vertices_count_right(outline in simple(), i in 0..24_usize, back in 0.01..2.0) {
        let v = outline.points()[i % outline.points().len()];
        let p = [v[0] - back, v[1]];
        prop_assume!(outline.closest(p).distance.abs() > 1e-9);
        prop_assert_eq!(outline.inside(p), winding_number(outline.points(), p) == 1);
    }

    #[test]
    fn closest_is_closest_and_slopes_by_one(outline in simple(), p in [-1.5..1.5, -1.5..1.5]) {
        let hit = outline.closest(p);
        let brute = outline.sides.iter().map(|s| s.distance_squared(p)).fold(f64::INFINITY, f64::min);
        prop_assert!((hit.distance.abs() - brute.sqrt()).abs() < 1e-14);
        prop_assert!((point::norm(hit.normal) - 1.0).abs() < 1e-12);
        let at = |x: f64| outline.closest_within(p, x).is_some();
        prop_assert!(at(hit.distance.abs() + 1e-12) && !at(hit.distance.abs() - 1e-9));
        // Towards the closest point the distance falls as fast as the way is long.
        prop_assume!(hit.distance.abs() > 1e-3);
        let step = point::scale(point::sub(hit.point, p), 1e-4);
        let there = outline.closest(point::add(p, step)).distance;
        prop_assert!(((hit.distance - there).abs() / point::norm(step) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn contents_follow_a_similarity(
        outline in simple(), degrees in -360.0..360.0, scale in 0.1..10.0, shift in [-5.0..5.0, -5.0..5.0],
    ) {
        let by = Similarity::<2>::new(scale, degrees, shift).unwrap();
        let moved = outline.transformed(&by);
        prop_assert!((moved.measure() / outline.measure() / scale - 1.0).abs() < 1e-12);
        prop_assert!((moved.volume() / outline.volume() / scale / scale - 1.0).abs() < 1e-9);
        prop_assert_eq!(moved.features().corners.len(), outline.features().corners.len());
        let p = [0.3, 0.4];
        prop_assert!(point::distance(by.point_back(by.point(p)), p) < 1e-12);
    }

    #[test]
    fn convex_offset_and_back_returns(n in 5..40_usize, distance in 0.01..0.5) {
        let circle = |i: usize| { let (s, c) = (TAU * i as f64 / n as f64).sin_cos(); [1.3 * c, s] };
        let outline = Outline::polygon(&(0..n).map(circle).collect::<Vec<_>>()).unwrap();
        let back = outline.offset(distance).unwrap().offset(-distance).unwrap();
        prop_assert_eq!(back.points().len(), n);
        for p in back.points() {
            let nearest = outline.points().iter().map(|&q| point::distance(q, *p)).fold(f64::INFINITY, f64::min);
            prop_assert!(nearest < 1e-12, "{} off", nearest);
        }
    }

    #[test]
    fn inset_points_are_at_their_depth(outline in simple(), part in 0.02..0.6) {
        let depth: f64 = part * outline.points().iter().map(|&p| point::norm(p)).fold(0.0, f64::max) * 0.2;
        let Ok(inset) = outline.offset(-depth) else { return Ok(()) };
        let mut area = 0.0;
        for points in inset.loops() {
            area += crate::segment::signed_area(points);
        }
        prop_assert!(area > 0.0 && area < outline.volume());
        for &p in inset.points() {
            let distance = outline.closest(p).distance;
            // Bevelled corners (turns of more than 151°) may be nearer than the depth, mitres up to 4 × it.
            prop_assert!(distance < 0.0 && distance > -(MITRE_LIMIT + 1e-6) * depth, "{} at depth {}", distance, depth);
        }
    }
}

#[test]
fn every_inset_point_is_at_the_depth() {
    for (name, outline, depth, corners) in [
        ("wing", Outline::naca("0015", 1.0).unwrap(), 0.01, 1),
        (
            "starfish",
            Outline::starfish([0.0; 2], 0.5, 0.25, 5).unwrap(),
            0.025,
            0,
        ),
        (
            "zigzag",
            Outline::zigzag(2.0, 1.0, 0.25, 2).unwrap(),
            0.025,
            8,
        ),
        ("square", tilted_square(), 0.05, 4),
    ] {
        let inset = outline.offset(-depth).unwrap();
        let mut deeper = 0;
        for &p in inset.points() {
            let distance = outline.closest(p).distance;
            assert!(distance < -depth + 1e-9, "{name}: {distance}");
            // (The nodes of smooth reflex curves are mitred too, by some 10⁻⁷ of the depth.)
            if distance < -depth - 1e-6 * depth {
                deeper += 1;
            }
        }
        // Only the reflex corners of the zigzag are mitred, at √2 × the depth.
        assert_eq!(deeper, if name == "zigzag" { 2 } else { 0 }, "{name}");
        assert_eq!(inset.features().corners.len(), corners, "{name}");
        assert!(
            (outline.volume() - inset.volume() - depth * outline.measure()).abs()
                < 20.0 * depth * depth
        );
    }
}

#[test]
fn smooth_offset_and_back_returns() {
    let body = Outline::starfish([0.1, 0.2], 0.5, 0.25, 5).unwrap();
    let back = body.offset(0.01).unwrap().offset(-0.01).unwrap();
    for &p in back.points() {
        assert!(body.closest(p).distance.abs() < 1e-9);
    }
    assert!((back.volume() - body.volume()).abs() < 1e-8);
}

#[test]
fn holes_split_and_merge() {
    let square = |c: [f64; 2], r: f64| {
        vec![
            [c[0] - r, c[1] - r],
            [c[0] + r, c[1] - r],
            [c[0] + r, c[1] + r],
            [c[0] - r, c[1] + r],
        ]
    };
    // A frame with an island, given clockwise and the other way round alike.
    let mut loops = vec![
        square([0.0; 2], 3.0),
        square([0.0; 2], 2.0),
        square([0.0; 2], 1.0),
    ];
    loops[0].reverse();
    let frame = Outline::new(loops).unwrap();
    assert!((frame.volume() - (36.0 - 16.0 + 4.0)).abs() < 1e-12);
    assert!(frame.inside([2.5, 0.0]) && !frame.inside([1.5, 0.0]) && frame.inside([0.5, 0.0]));
    assert!(frame.closest([1.5, 0.2]).distance > 0.0);
    assert!(
        (frame.offset(-0.4).unwrap().volume() - (5.2 * 5.2 - 4.8 * 4.8 + 1.2 * 1.2)).abs() < 1e-9
    );
    // The frame vanishes, the island stays.
    let island = frame.offset(-0.6).unwrap();
    assert_eq!(island.loops().len(), 1);
    assert!((island.volume() - 0.64).abs() < 1e-9);
    // Outward the gap closes.
    assert!((frame.offset(0.6).unwrap().volume() - 7.2 * 7.2).abs() < 1e-9);
    assert!(matches!(
        frame.offset(-1.1),
        Err(GeometryError::Inset(InsetError::Vanished { depth: 1.1 }))
    ));
    // A dumbbell splits in two.
    let bell = Outline::polygon(&[
        [-3.0, -1.0],
        [-1.0, -1.0],
        [-1.0, -0.1],
        [1.0, -0.1],
        [1.0, -1.0],
        [3.0, -1.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 0.1],
        [-1.0, 0.1],
        [-1.0, 1.0],
        [-3.0, 1.0],
    ])
    .unwrap();
    let two = bell.inset(0.2).unwrap();
    assert!((two.volume() - 2.0 * 1.6 * 1.6).abs() < 1e-9);
    assert_eq!(two.features().corners.len(), 8);
    // Corners stay exact through the overlay.
    for c in two.features().corners {
        let want = [
            c[0].signum() * if c[0].abs() > 2.0 { 2.8 } else { 1.2 },
            c[1].signum() * 0.8,
        ];
        assert!(point::distance(c, want) < 1e-12);
    }
}

#[test]
fn airfoils() {
    let wing = Outline::naca("0015", 1.0).unwrap();
    assert!((wing.volume() - 0.1019).abs() < 5e-4, "{}", wing.volume());
    assert_eq!(wing.features().corners, [[1.0, 0.0]]);
    assert!((wing.measure() - 2.05).abs() < 0.02);
    let bounds = wing.bounds();
    assert!(bounds.min[0].abs() < 1e-9 && (bounds.size()[1] - 0.15).abs() < 2e-4);
    assert!(wing.points().contains(&[0.0, 0.0]));
    let cambered = Outline::naca("2412", 2.0).unwrap();
    assert!(cambered.inside([0.8, 0.14]) && !cambered.inside([0.8, -0.1]));
    assert_eq!(cambered.features().corners.len(), 1);
    assert!(
        wing.inset(0.01).unwrap().bounds().max[0] < 0.96,
        "the tail ends where it gets thin"
    );
    for digits in ["", "001", "00150", "0000", "2012", "00a5", "é015", "2400"] {
        assert!(
            matches!(
                Outline::naca(digits, 1.0),
                Err(GeometryError::Parameter(ParameterError::BadNaca { .. }))
            ),
            "{digits}"
        );
    }
    assert!(matches!(
        Outline::naca("0015", 0.0),
        Err(GeometryError::Parameter(ParameterError::OutOfRange { .. }))
    ));
}

#[test]
fn starfish_is_sampled_finely() {
    let body = Outline::starfish([0.0; 2], 0.5, 0.25, 5).unwrap();
    assert!(body.points().len() < 20_000);
    assert!(body.features().corners.is_empty());
    // ∫ ½ r² = π R² (1 + a²/2).
    let exact = 0.5 * TAU * 0.25 * (1.0 + 0.5 * 0.0625);
    assert!((body.volume() / exact - 1.0).abs() < 1e-6);
    for i in 0..4000 {
        let angle = TAU * (f64::from(i) + 0.37) / 4000.0;
        let r = 0.5 * (1.0 + 0.25 * (5.0 * angle).cos());
        let hit = body.closest([r * angle.cos(), r * angle.sin()]);
        assert!(hit.distance.abs() < 1.3e-7, "{}", hit.distance);
    }
    for bad in [
        (0.0, 0.1, 5),
        (1.0, 1.0, 5),
        (1.0, f64::NAN, 5),
        (1.0, 0.1, 0),
    ] {
        assert!(Outline::starfish([0.0; 2], bad.0, bad.1, bad.2).is_err());
    }
}

#[test]
fn the_zigzag_is_the_papers() {
    let wall = Outline::zigzag(2.0, 1.0, 0.25, 2).unwrap();
    let want = [
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, 0.0],
        [0.75, 0.25],
        [0.25, -0.25],
        [-0.25, 0.25],
        [-0.75, -0.25],
        [-1.0, 0.0],
    ];
    assert_eq!(wall.points(), want);
    assert!(Outline::zigzag(2.0, 0.2, 0.25, 2).is_err());
}

#[test]
fn corners_answer_as_corners() {
    let square = Outline::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).unwrap();
    let hit = square.closest([2.0, 2.0]);
    assert_eq!((hit.point, hit.feature), ([1.0, 1.0], Feature::Corner));
    assert!((hit.normal[0] - 0.5_f64.sqrt()).abs() < 1e-15);
    // Normals are not smeared towards corners.
    assert_eq!(square.closest([0.999, -0.1]).normal, [0.0, -1.0]);
    assert_eq!(square.closest([f64::NAN, 0.0]).feature, Feature::Smooth);
    assert!(square.closest_within([0.5, 0.5], -1.0).is_none());
}

#[test]
fn bad_outlines_are_refused() {
    let of = |p: &[[f64; 2]]| Outline::polygon(p).unwrap_err();
    assert!(matches!(
        Outline::new(vec![]),
        Err(GeometryError::Outline(OutlineError::TooFewPoints { .. }))
    ));
    assert!(matches!(
        of(&[[0.0; 2], [1.0, 0.0], [1.0, 0.0]]),
        GeometryError::Outline(OutlineError::TooFewPoints { count: 2, .. })
    ));
    assert!(matches!(
        of(&[[0.0; 2], [1.0, 0.0], [2.0, 0.0]]),
        GeometryError::Outline(OutlineError::NoArea { .. })
    ));
    assert!(matches!(
        of(&[[0.0; 2], [1.0, 0.0], [2.0, 0.0], [1.5, 0.0]]),
        GeometryError::Outline(OutlineError::NoArea { .. })
    ));
    assert!(matches!(
        of(&[[0.0; 2], [1.0, f64::NAN], [2.0, 0.0]]),
        GeometryError::Outline(OutlineError::NotFinite { index: 1, .. })
    ));
    assert!(matches!(
        of(&[[0.0; 2], [1e200, 0.0], [2.0, 1.0]]),
        GeometryError::Outline(OutlineError::NotFinite { index: 1, .. })
    ));
    let bow = of(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(
        bow,
        GeometryError::Outline(OutlineError::SelfIntersecting {
            first: LoopSide {
                loop_index: 0,
                side: 0
            },
            second: LoopSide {
                loop_index: 0,
                side: 2
            },
            place: [0.5, 0.5]
        })
    );
    // A spike that folds back, and a vertex that touches another side.
    let spike = of(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    assert!(matches!(
        spike,
        GeometryError::Outline(OutlineError::SelfIntersecting { .. })
    ));
    let touch = of(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
    assert!(matches!(
        touch,
        GeometryError::Outline(OutlineError::SelfIntersecting {
            place: [1.0, 0.0],
            ..
        })
    ));
    let cross = Outline::new(vec![
        vec![[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]],
        vec![[1.0, 0.5], [3.0, 0.5], [3.0, 1.0]],
    ]);
    assert!(matches!(
        cross,
        Err(GeometryError::Outline(OutlineError::SelfIntersecting {
            first: LoopSide { loop_index: 0, .. },
            second: LoopSide { loop_index: 1, .. },
            ..
        }))
    ));
    let square = tilted_square();
    assert!(matches!(
        square.inset(-1.0),
        Err(GeometryError::Parameter(ParameterError::OutOfRange { .. }))
    ));
    assert!(matches!(
        square.inset(f64::NAN),
        Err(GeometryError::Parameter(ParameterError::OutOfRange { .. }))
    ));
    assert!(matches!(
        square.inset(1.0),
        Err(GeometryError::Inset(InsetError::Vanished { .. }))
    ));
    assert!(square.offset(f64::MAX).is_err());
}

#[test]
fn outlines_from_text() {
    let text = "# two loops\nx,y\n0,0\n4, 0\n4 4 # corner\n0;4\n0,0\n\n1,1\n2,1\n2,2\n1,2\n";
    let outline = Outline::from_text(text).unwrap();
    assert_eq!(outline.loops().len(), 2);
    assert!((outline.volume() - 15.0).abs() < 1e-12);
    let bad = |text: &str| Outline::from_text(text).unwrap_err();
    assert!(matches!(
        bad("0,0\n1,0\nnan,1\n"),
        GeometryError::Read(ReadError::BadLine { line: 3, .. })
    ));
    assert!(matches!(
        bad("0,0\n1,0,2\n1,1\n"),
        GeometryError::Read(ReadError::BadLine { line: 2, .. })
    ));
    assert!(matches!(
        bad("name\nname\n0,0\n"),
        GeometryError::Read(ReadError::BadLine { line: 2, .. })
    ));
    assert!(matches!(
        bad(""),
        GeometryError::Outline(OutlineError::TooFewPoints { .. })
    ));
    let missing = Outline::from_csv("no/such/file.csv").unwrap_err();
    assert!(
        missing.to_string().starts_with("no/such/file.csv: "),
        "{missing}"
    );
}

#[test]
fn many_loops_nest() {
    // A board of square rings, each with a square in its hole, all drawn clockwise.
    let square = |x: f64, y: f64, r: f64| {
        vec![
            [x - r, y - r],
            [x - r, y + r],
            [x + r, y + r],
            [x + r, y - r],
        ]
    };
    let count = 100;
    let loops = (0..count * count)
        .flat_map(|k| {
            let (x, y) = (f64::from(k % count), f64::from(k / count));
            [0.4, 0.3, 0.1].map(|r| square(x, y, r))
        })
        .collect();
    let outline = Outline::new(loops).unwrap();
    let areas: Vec<f64> = outline.loops().map(crate::segment::signed_area).collect();
    assert!(
        areas
            .chunks(3)
            .all(|a| a[0] > 0.0 && a[1] < 0.0 && a[2] > 0.0)
    );
    let one = 0.64 - 0.36 + 0.04;
    assert!((outline.volume() / (f64::from(count * count) * one) - 1.0).abs() < 1e-9);
}

#[test]
fn strips_as_thick_as_two_depths_vanish_at_every_angle() {
    for n in 0..60 {
        let (sin, cos) = (0.11 * f64::from(n)).sin_cos();
        let strip = |thick: f64| {
            let points = [[0.0, 0.0], [1.1, 0.0], [1.1, thick], [0.0, thick]];
            let turned = points.map(|[x, y]| [0.3 + x * cos - y * sin, 0.7 + x * sin + y * cos]);
            Outline::new(vec![turned.to_vec()]).unwrap()
        };
        let thick = 0.05;
        let vanishes = |depth: f64| {
            matches!(
                strip(thick).offset(-depth),
                Err(GeometryError::Inset(InsetError::Vanished { .. }))
            )
        };
        assert!(vanishes(0.5 * thick), "{n}");
        assert!(vanishes(0.5 * thick * (1.0 - 1e-8)), "{n}");
        let left = strip(thick).offset(-0.5 * thick * (1.0 - 1e-4)).unwrap();
        assert!(
            (left.area / (1e-4 * thick * 1.05) - 1.0).abs() < 1e-3,
            "{n}"
        );
    }
}
