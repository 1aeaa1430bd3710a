//! Distances and volumes against each other.

use super::super::random::Random;
use super::*;

fn bodies() -> Vec<Body> {
    let mut all = Vec::new();
    for number in 0..120 {
        let case = super::super::generate::case(3, number);
        all.extend(case.placed().bodies);
    }
    all
}

#[test]
fn distances_have_slope_one_and_agree_with_volumes() {
    let random = &mut Random::new(1, 1);
    for body in bodies() {
        let body_size = True::new(&body, 1.0).bounds();
        let size = (0..3)
            .map(|k| body_size[1][k] - body_size[0][k])
            .fold(0.0, f64::max);
        let own = True::new(&body, 0.1 * size);
        let [min, max] = own.bounds();
        let mut held = 0;
        let count = 4000;
        for _ in 0..count {
            let p: Point = std::array::from_fn(|k| random.between(min[k], max[k]));
            let q: Point = std::array::from_fn(|k| random.between(min[k], max[k]));
            let apart = (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
            let (a, b) = (own.distance(p), own.distance(q));
            assert!((a - b).abs() <= apart + 1e-9 * size, "{body:?} {p:?} {q:?}");
            held += usize::from(a < 0.0);
        }
        let dimension = body.shape.dimension();
        let room: f64 = (0..dimension).map(|k| max[k] - min[k]).product();
        let (share, is) = (own.volume() / room, held as f64 / f64::from(count));
        // Four standard deviations.
        let slack = 4.0 * (share * (1.0 - share).max(0.0) / f64::from(count)).sqrt() + 1e-3;
        assert!((share - is).abs() < slack, "{body:?}: {share} {is}");
    }
}

#[test]
fn what_is_left_of_a_body_is_measured() {
    let ball = |x: f64, precedence: i32| {
        let shape = Shape::Sphere {
            center: [x, 0.0, 0.0],
            radius: 1.0,
        };
        let mut body = Body::new("ball", shape);
        body.precedence = precedence;
        True::new(&body, 0.1)
    };
    let mut truth = Truth {
        sides: None,
        dimension: 3,
        bodies: vec![ball(0.0, 0), ball(1.0, 1)],
    };
    // The lens of two unit balls one apart.
    let lens = 5.0 / 12.0 * std::f64::consts::PI;
    let whole = 4.0 / 3.0 * std::f64::consts::PI;
    assert!((truth.volume(0) / (whole - lens) - 1.0).abs() < 2e-3);
    assert!((truth.volume(1) / whole - 1.0).abs() < 1e-12);
    let plate = |min: [f64; 2], max: [f64; 2], precedence: i32| {
        let shape = Shape::Box {
            min: min.to_vec(),
            max: max.to_vec(),
        };
        let mut body = Body::new("plate", shape);
        body.precedence = precedence;
        True::new(&body, 0.1)
    };
    truth = Truth {
        sides: None,
        dimension: 2,
        bodies: vec![
            plate([0.0, 0.0], [3.0, 2.0], 0),
            plate([1.0, -1.0], [2.0, 1.0], 5),
        ],
    };
    assert!((truth.volume(0) - 5.0).abs() < 1e-9);
    assert!((truth.distance(0, [1.5, 0.5, 0.0]) - 0.5).abs() < 1e-12);
}
