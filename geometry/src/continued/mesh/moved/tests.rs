//! What is left of a ball that another one has cut, within a box that it passes, moved inward.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, Domain, point};

use crate::{Ball, LevelSet, Surface, cut_on_grid};

/// A direction of so many all around, evenly spread.
fn direction(n: usize, count: usize) -> [f64; 3] {
    let high = (2.0 * n as f64 + 1.0) / count as f64 - 1.0;
    let flat = (1.0 - high * high).sqrt();
    let (sin, cos) = (2.399_963 * n as f64).sin_cos();
    [flat * cos, flat * sin, high]
}

/// The mesh that a grid makes has small folds along the edge where the balls meet: its area and volume once it has moved are those of
/// balls of other radii all the same.
#[test]
fn folds_of_a_cut_do_not_count() {
    let (radius, other, depth) = (6.0, 2.5, 0.5);
    let whole = Bounds::new([-20.0; 3], [20.0; 3]);
    for turn in 0..12 {
        let along = direction(turn, 12);
        let center = point::scale(along, 5.5);
        let lower: Arc<dyn Surface<3>> = Arc::new(Ball::new([0.0; 3], radius).unwrap());
        let higher: Arc<dyn Surface<3>> = Arc::new(Ball::new(center, other).unwrap());
        let left = cut_on_grid(lower, higher, 0.25, 0.1, &whole)
            .unwrap()
            .unwrap();
        // A side goes through both.
        let domain = Domain::new([0.7 * center[0] - 0.3, -8.0, -8.0], [9.0, 8.0, 8.0]);
        let continued = left.continued(&domain).unwrap().unwrap();
        let moved = continued.inset(depth).unwrap();
        let (inner, outer) = (radius - depth, other + depth);
        let holds = |p: [f64; 3]| {
            domain.bounds.contains(p)
                && point::norm(p) <= inner + 1e-9
                && point::distance(p, center) >= outer - 1e-9
        };
        let part = |center: [f64; 3], radius: f64| {
            let count = 40_000;
            let on = |n: usize| point::add_scaled(center, radius, direction(n, count));
            let held = (0..count).filter(|&n| holds(on(n))).count();
            4.0 * std::f64::consts::PI * radius * radius * held as f64 / count as f64
        };
        let area = part([0.0; 3], inner) + part(center, outer);
        assert!(
            (moved.measure() / area - 1.0).abs() < 0.02,
            "{turn}: {}, {area}",
            moved.measure()
        );
        let size = domain.bounds.size();
        let steps = 64;
        let held = (0..steps * steps * steps)
            .filter(|n| {
                let place = [n % steps, n / steps % steps, n / steps / steps];
                holds(std::array::from_fn(|k| {
                    let part = (place[k] as f64 + 0.5) / steps as f64;
                    domain.bounds.min[k] + part * size[k]
                }))
            })
            .count();
        let volume = domain.bounds.volume() * held as f64 / (steps * steps * steps) as f64;
        assert!(
            (moved.volume() / volume - 1.0).abs() < 0.01,
            "{turn}: {}, {volume}",
            moved.volume()
        );
    }
}

/// A ball that a grid has made a mesh, cut by a side at any height: caps, whose formulas are known.
#[test]
fn caps_of_a_ball_are_those_of_a_smaller_one() {
    let ball: Arc<dyn Surface<3>> = Arc::new(Ball::new([0.0; 3], 6.0).unwrap());
    let mesh = LevelSet::of(ball, 0.25).unwrap().mesh().unwrap().unwrap();
    for side in [-5.0, -1.3, 0.2, 3.1, 5.0] {
        let domain = Domain::new([side, -8.0, -8.0], [9.0, 8.0, 8.0]);
        let continued = mesh.continued(&domain).unwrap().unwrap();
        let moved = continued.inset(0.5).unwrap();
        let height = 5.5 - side;
        let area = 11.0 * std::f64::consts::PI * height;
        let volume = std::f64::consts::PI * height * height * (5.5 - height / 3.0);
        assert!(
            (moved.measure() / area - 1.0).abs() < 0.01,
            "{side}: {}, {area}",
            moved.measure()
        );
        assert!(
            (moved.volume() / volume - 1.0).abs() < 0.01,
            "{side}: {}, {volume}",
            moved.volume()
        );
    }
}
