//! Analytic shapes against samples of themselves.

use std::f64::consts::PI;
use std::sync::Arc;

use proptest::prelude::*;
use sphpack_neighbors::point;

use super::*;
use crate::surface::{Closest, Feature, Surface};
use crate::{GeometryError, InsetError, ParameterError, Placed, Similarity};

/// What every surface must do at `p`.
fn check<const D: usize>(body: &dyn Surface<D>, p: [f64; D]) {
    let hit = body.closest(p);
    assert!(point::is_finite(hit.point), "{body:?} {p:?} {hit:?}");
    assert!((point::norm(hit.normal) - 1.0).abs() < 1e-9, "{hit:?}");
    assert!(
        (point::distance(p, hit.point) - hit.distance.abs()).abs() < 1e-9,
        "{body:?} {p:?} {hit:?}"
    );
    assert!(
        body.closest(hit.point).distance.abs() < 1e-9,
        "{body:?} {p:?} {hit:?}"
    );
    if hit.distance.abs() > 1e-9 {
        assert_eq!(body.inside(p), hit.distance < 0.0, "{body:?} {p:?}");
    }
    if hit.distance.abs() > 1e-3 {
        // Along the way to the surface the distance changes by the way; the way is along the normal where smooth.
        let step = point::scale(point::sub(hit.point, p), 1e-4);
        let there = body.closest(point::add(p, step)).distance;
        assert!(((hit.distance - there).abs() / point::norm(step) - 1.0).abs() < 1e-5);
        if hit.feature == Feature::Smooth {
            let back = point::add_scaled(hit.point, hit.distance, hit.normal);
            assert!(point::distance(back, p) < 1e-7, "{body:?} {p:?} {hit:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn shapes_answer_consistently(p in [-2.0..2.0, -2.0..2.0, -2.0..2.0], degrees in 0.0..360.0) {
        let ball = Ball::new([0.1, 0.2, 0.3], 0.7).unwrap();
        let cuboid = Cuboid::new([-1.0, -0.5, -0.7], [0.5, 0.6, 1.0]).unwrap();
        let rod = Cylinder::new([0.1, -0.5, -0.7], [0.5, 0.6, 1.0], 0.4).unwrap();
        let ring = Torus::new([0.1, 0.2, 0.3], [1.0, 2.0, 3.0], 0.8, 0.3).unwrap();
        let egg = Ellipsoid::new([0.1, 0.0, 0.0], [1.0, 0.5, 0.75]).unwrap();
        let shapes: [Arc<dyn Surface<3>>; 5] =
            [Arc::new(ball), Arc::new(cuboid), Arc::new(rod), Arc::new(ring), Arc::new(egg)];
        let place = Similarity::<3>::new(1.7, [0.3, -1.0, 0.2], degrees, [0.1, 0.2, -0.4]).unwrap();
        for shape in shapes {
            check(shape.as_ref(), p);
            let placed = Placed::new(shape.clone(), place);
            check(&placed, p);
            prop_assert!((placed.measure() / shape.measure() / 1.7_f64.powi(2) - 1.0).abs() < 1e-12);
            prop_assert!((placed.volume() / shape.volume() / 1.7_f64.powi(3) - 1.0).abs() < 1e-12);
            prop_assert!(placed.bounds().grown(1e-9).contains(placed.closest(p).point));
            prop_assert!(shape.bounds().grown(1e-9).contains(shape.closest(p).point));
            // The inset is the level set where that is smooth; inside it always.
            let inset = shape.inset(0.1).unwrap();
            let (outer, inner) = (shape.closest(p), inset.closest(p));
            if outer.distance < -0.1 {
                prop_assert!((inner.distance - outer.distance - 0.1).abs() < 1e-7, "{:?}", shape);
            } else {
                prop_assert!(inner.distance > outer.distance + 0.1 - 1e-7);
            }
        }
    }

    #[test]
    fn plane_shapes_answer_consistently(p in [-2.0..2.0, -2.0..2.0], a in 0.05..2.0, b in 0.05..2.0) {
        check(&Ellipsoid::new([0.1, 0.0], [a, b]).unwrap(), p);
        check(&Ball::new([0.1, 0.0], a).unwrap(), p);
        check(&Cuboid::new([-a, -b], [b, a]).unwrap(), p);
    }

    #[test]
    fn ellipsoids_answer_on_their_axes(a in 0.05..2.0, b in 0.05..2.0, c in 0.05..2.0, t in -2.0..2.0, k in 0..3_usize) {
        for axes in [[a, b, c], [a, a, c], [a, c, c], [a, a, a], [a, a * (1.0 + 1e-14), c]] {
            let egg = Ellipsoid::new([0.0; 3], axes).unwrap();
            let mut p = [0.0; 3];
            check(&egg, p);
            p[k] = t;
            check(&egg, p);
            // No sampled point is nearer.
            let best = egg.closest(p).distance.abs();
            for i in 0..200 {
                let (u, v) = (f64::from(i) * 2.399_963, 1.0 - f64::from(2 * i + 1) / 200.0);
                let r = (1.0 - v * v).sqrt();
                let q = [axes[0] * r * u.cos(), axes[1] * r * u.sin(), axes[2] * v];
                prop_assert!(point::distance(p, q) > best - 1e-9);
            }
        }
    }
}

#[test]
fn contents() {
    let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    close(Ball::new([0.0; 2], 2.0).unwrap().measure(), 4.0 * PI);
    close(Ball::new([0.0; 3], 2.0).unwrap().measure(), 16.0 * PI);
    close(Ball::new([0.0; 3], 2.0).unwrap().volume(), 32.0 * PI / 3.0);
    close(
        Ellipsoid::new([0.0; 3], [2.0; 3]).unwrap().measure(),
        16.0 * PI,
    );
    close(
        Ellipsoid::new([0.0; 2], [2.0; 2]).unwrap().measure(),
        4.0 * PI,
    );
    // Known to ten digits: the perimeter of the ellipse 2 : 1, and the prolate and oblate spheroids' formulas.
    close(
        Ellipsoid::new([0.0; 2], [2.0, 1.0]).unwrap().measure(),
        9.688_448_220_5,
    );
    let e = 0.75_f64.sqrt();
    close(
        Ellipsoid::new([0.0; 3], [1.0, 1.0, 2.0]).unwrap().measure(),
        2.0 * PI * (1.0 + 2.0 / e * e.asin()),
    );
    close(
        Ellipsoid::new([0.0; 3], [2.0, 1.0, 2.0]).unwrap().measure(),
        2.0 * PI * 4.0 * (1.0 + 0.25 / e * e.atanh()),
    );
    close(
        Cuboid::new([0.0; 3], [1.0, 2.0, 3.0]).unwrap().measure(),
        22.0,
    );
    close(Cuboid::new([0.0; 2], [1.0, 2.0]).unwrap().measure(), 6.0);
    assert_eq!(
        Cuboid::new([0.0; 3], [1.0, 2.0, 3.0])
            .unwrap()
            .features()
            .edges
            .len(),
        12
    );
    assert_eq!(
        Cuboid::new([0.0; 2], [1.0, 2.0])
            .unwrap()
            .features()
            .corners
            .len(),
        4
    );
    let rims = Cylinder::new([0.0; 3], [0.0, 0.0, 1.0], 1.0)
        .unwrap()
        .features()
        .edges;
    assert!(rims.len() == 2 && rims[0].first() == rims[0].last());
}

#[test]
fn bad_parameters() {
    let bad = |r: Result<(), GeometryError>| {
        assert!(matches!(
            r,
            Err(GeometryError::Parameter(ParameterError::OutOfRange { .. }))
        ));
    };
    bad(Ball::new([0.0; 2], 0.0).map(drop));
    bad(Ball::new([f64::NAN, 0.0], 1.0).map(drop));
    bad(Cuboid::new([0.0; 2], [1.0, 0.0]).map(drop));
    bad(Ellipsoid::new([0.0; 3], [1.0, -1.0, 1.0]).map(drop));
    bad(Cylinder::new([0.0; 3], [0.0; 3], 1.0).map(drop));
    bad(Torus::new([0.0; 3], [0.0; 3], 1.0, 0.5).map(drop));
    bad(Torus::new([0.0; 3], [0.0, 0.0, 1.0], 1.0, 1.0).map(drop));
    bad(Similarity::<3>::new(1.0, [0.0; 3], 1.0, [0.0; 3]).map(drop));
    bad(Similarity::<2>::new(0.0, 1.0, [0.0; 2]).map(drop));
    bad(Similarity::<2>::new(1.0, f64::INFINITY, [0.0; 2]).map(drop));
    bad(Ball::new([0.0; 2], 1.0).unwrap().inset(-0.1).map(drop));
    for vanished in [
        Ball::new([0.0; 3], 1.0).unwrap().inset(1.0),
        Cuboid::new([0.0; 3], [1.0; 3]).unwrap().inset(0.5),
        Cylinder::new([0.0; 3], [1.0, 0.0, 0.0], 1.0)
            .unwrap()
            .inset(0.5),
        Torus::new([0.0; 3], [1.0, 0.0, 0.0], 1.0, 0.5)
            .unwrap()
            .inset(0.5),
        Ellipsoid::new([0.0; 3], [1.0, 2.0, 3.0])
            .unwrap()
            .inset(1.0),
    ] {
        assert!(matches!(
            vanished,
            Err(GeometryError::Inset(InsetError::Vanished { .. }))
        ));
    }
}

/// Points of an ellipsoid are on it, look along its normals, and each stands for the same area: that of a piece is integrated over the
/// plane it is seen on, by midpoints.
#[test]
fn points_scattered_over_an_ellipsoid_stand_for_equal_areas() {
    let fits = |e: [f64; 3], count: usize| {
        let body = Ellipsoid::new([0.3, -0.2, 0.1], e).unwrap();
        let sites = body.scatter(count);
        assert_eq!(sites.len(), count);
        for site in sites.iter().step_by(7) {
            let hit = body.closest(site.point);
            let size = e.iter().copied().fold(0.0, f64::max);
            assert!(hit.distance.abs() < 1e-12 * size, "{e:?}: {hit:?}");
            assert!(
                point::dot(site.normal, hit.normal) > 1.0 - 1e-6,
                "{e:?}: {site:?}, {hit:?}"
            );
        }
        // The part of all with x above a quarter of the first axis, and with z above the middle.
        let part = |is_in: &dyn Fn([f64; 3]) -> bool| {
            sites.iter().filter(|site| is_in(site.point)).count() as f64 / count as f64
        };
        // Of a body of revolution about x (e₁ = e₂): the area beyond x is an integral over x alone.
        let (a, b) = (e[0], e[1]);
        let area = |from: f64| {
            let n = 20_000;
            (0..n)
                .map(|i| {
                    let t = from + (1.0 - from) * (f64::from(i) + 0.5) / f64::from(n);
                    (b * b * t * t + a * a * (1.0 - t * t)).sqrt() * (1.0 - from)
                })
                .sum::<f64>()
        };
        for from in [-0.5, 0.25, 0.9] {
            let found = part(&|p| p[0] > 0.3 + from * a);
            let exact = area(from) / area(-1.0);
            let off = (found - exact).abs();
            assert!(
                off < 0.01 + 3.0 / count as f64,
                "{e:?} {from}: {found}, {exact}"
            );
        }
        let half = part(&|p| p[2] > 0.1);
        assert!(
            (half - 0.5).abs() < 0.02 + 3.0 / count as f64,
            "{e:?}: {half}"
        );
    };
    for count in [200, 5000] {
        for e in [
            [1.0, 1.0, 1.0],
            [3.0, 0.5, 0.5],
            [0.2, 1.5, 1.5],
            [1e-3, 70.0, 70.0],
            [1e6, 0.9, 0.9],
        ] {
            fits(e, count);
        }
    }
    let ellipse = Ellipsoid::new([0.0; 2], [3.0, 0.01]).unwrap();
    let sites = ellipse.scatter(1000);
    assert!(
        sites
            .iter()
            .all(|site| ellipse.closest(site.point).distance.abs() < 1e-12)
    );
    let outer = sites
        .iter()
        .filter(|site| site.point[0].abs() > 1.5)
        .count();
    assert!((495..=505).contains(&outer), "{outer}");
}

/// Of flat and slender boxes, rods and rings every part has the points that its area asks for, on the surface and with its normals.
#[test]
fn points_scattered_over_shapes_stand_for_equal_areas() {
    type Part = (&'static str, fn(&Closest<3>) -> bool, f64);
    let fits = |body: &dyn Surface<3>, parts: &[Part]| {
        for count in [200, 5000] {
            let sites = body.scatter(count);
            assert_eq!(sites.len(), count);
            let size = body.bounds().diagonal();
            for site in sites.iter().step_by(7) {
                let hit = body.closest(site.point);
                assert!(
                    hit.distance.abs() < 1e-12 * size,
                    "{body:?}: {site:?}, {hit:?}"
                );
                // At an edge the nearest point has a normal between those of its sides.
                let facing = point::dot(site.normal, hit.normal);
                assert!(
                    facing > 1.0 - 1e-6 || hit.feature != Feature::Smooth,
                    "{body:?}: {site:?}"
                );
            }
            for &(name, is_in, area) in parts {
                let found = sites.iter().filter(|site| is_in(site)).count() as f64 / count as f64;
                let off = (found - area / body.measure()).abs();
                assert!(
                    off < 0.01 + 3.0 / count as f64,
                    "{name} of {body:?}: {found}"
                );
            }
        }
    };
    let on = |min, max| Cuboid::<3>::new(min, max).unwrap();
    let plate = on([0.0; 3], [100.0, 80.0, 0.01]);
    fits(
        &plate,
        &[
            ("top", |s| s.normal[2] == 1.0, 8000.0),
            ("left half", |s| s.point[0] < 50.0, 8001.8),
        ],
    );
    let rod = on([0.0; 3], [1.0, 2.0, 1e6]);
    fits(
        &rod,
        &[
            ("side", |s| s.normal[0] == -1.0, 2e6),
            ("front", |s| s.normal[1] == 1.0, 1e6),
            ("upper tenth", |s| s.point[2] > 9e5, 6e5),
        ],
    );
    let disk = Cylinder::new([0.0; 3], [0.0, 0.0, 0.02], 50.0).unwrap();
    fits(
        &disk,
        &[
            ("top", |s| s.normal[2] > 0.5, PI * 2500.0),
            (
                "middle",
                |s| s.point[0].hypot(s.point[1]) < 25.0,
                PI * 1250.0,
            ),
        ],
    );
    let wire = Cylinder::new([0.0; 3], [0.0, 0.0, 1e5], 0.5).unwrap();
    fits(
        &wire,
        &[
            ("upper tenth", |s| s.point[2] > 9e4, PI * 1e4),
            ("right half", |s| s.point[0] > 0.0, 0.5 * PI * 1e5),
        ],
    );
    for (major, minor) in [(3e4, 1.0), (1.0, 1e-9)] {
        let ring = Torus::new([0.0; 3], [0.0, 0.0, 1.0], major, minor).unwrap();
        let outer = PI * minor * (2.0 * PI * major + 4.0 * minor);
        let eighth = ring.measure() / 8.0;
        fits(
            &ring,
            &[
                (
                    "outer side",
                    |s| s.point[0] * s.normal[0] + s.point[1] * s.normal[1] > 0.0,
                    outer,
                ),
                ("upper side", |s| s.normal[2] > 0.0, 4.0 * eighth),
                (
                    "an eighth",
                    |s| s.point[0] > s.point[1] && s.point[1] > 0.0,
                    eighth,
                ),
            ],
        );
    }
}
