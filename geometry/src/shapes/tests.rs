//! Analytic shapes against samples of themselves.

use std::f64::consts::PI;
use std::sync::Arc;

use proptest::prelude::*;
use sphpack_neighbors::point;

use super::*;
use crate::surface::{Feature, Surface};
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
