//! The flood agrees with the inside tests, on every kind of body.

use std::sync::Arc;

use proptest::prelude::*;
use sphpack_geometry::{Ball, Cuboid, Ellipsoid, Outline, Repeated, Surface, Torus};
use sphpack_neighbors::{Domain, random::Congruential};

use crate::{SeparationError, Side, separate, separate_by_flood, separate_with_on_surface};

/// A ball with images, which are far outside of its box.
fn repeated<const D: usize>() -> Arc<dyn Surface<D>> {
    let ball = Ball::new([0.1; D], 0.3).expect("a sound ball");
    let cell = Domain::new([-0.5; D], [0.5; D]).with_periodic([true; D]);
    Arc::new(Repeated::new(Arc::new(ball), &cell))
}

fn bodies_2d() -> Vec<Arc<dyn Surface<2>>> {
    let wedge = |degrees: f64| {
        let half = 0.5 * degrees.to_radians().tan();
        Outline::polygon(&[[-0.7, 0.0], [0.7, -1.4 * half], [0.7, 1.4 * half]])
            .expect("a sound wedge")
    };
    let ring = Outline::new(vec![
        vec![[-0.6, -0.6], [0.6, -0.6], [0.6, 0.6], [-0.6, 0.6]],
        vec![[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]],
    ]);
    vec![
        Arc::new(Ball::new([0.1, 0.0], 0.6).expect("a sound ball")),
        Arc::new(wedge(20.0)),
        Arc::new(wedge(6.0)),
        Arc::new(ring.expect("a sound ring")),
        Arc::new(Outline::starfish([0.0; 2], 0.5, 0.25, 5).expect("a sound starfish")),
        Arc::new(Outline::naca("0012", 1.2).expect("a sound airfoil")),
        repeated(),
    ]
}

fn bodies_3d() -> Vec<Arc<dyn Surface<3>>> {
    vec![
        Arc::new(Ball::new([0.1, 0.0, 0.0], 0.6).expect("a sound ball")),
        Arc::new(Cuboid::new([-0.5; 3], [0.4, 0.6, 0.5]).expect("a sound box")),
        Arc::new(Ellipsoid::new([0.0; 3], [0.7, 0.4, 0.3]).expect("a sound ellipsoid")),
        Arc::new(Torus::new([0.0; 3], [0.0, 0.0, 1.0], 0.5, 0.2).expect("a sound torus")),
        repeated(),
    ]
}

/// A shaken grid over [−1, 1]^D.
fn grid<const D: usize>(spacing: f64, shake: f64, seed: u64) -> Vec<[f64; D]> {
    let n = (2.0 / spacing) as usize;
    let mut random = Congruential::new(seed);
    (0..n.pow(D as u32))
        .map(|i| {
            std::array::from_fn(|k| {
                -1.0 + spacing
                    * ((i / n.pow(k as u32) % n) as f64 + 0.5 + shake * (random.unit() - 0.5))
            })
        })
        .collect()
}

fn check<const D: usize>(
    points: &[[f64; D]],
    bodies: &[Arc<dyn Surface<D>>],
    reach: f64,
) -> Result<(), TestCaseError> {
    let nobody = vec![None; points.len()];
    for body in bodies {
        let one: [&dyn Surface<D>; 1] = [body];
        let flood = separate_by_flood(points, &nobody, &one, reach).expect("sound input");
        let asked = separate(points, &one).expect("sound input");
        for i in 0..points.len() {
            let on_it = body.closest(points[i]).distance.abs() < 1e-12;
            prop_assert!(
                on_it || flood.body[i] == asked.body[i],
                "{body:?} at {:?}",
                points[i]
            );
            prop_assert_eq!(flood.side[i] == Side::Solid, flood.body[i].is_some());
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn flood_and_inside_tests_agree(seed in any::<u64>(), spacing in 0.06..0.2_f64, shake in 0.0..1.5_f64, reach in 0.5..3.0_f64) {
        check(&grid::<2>(spacing, shake, seed), &bodies_2d(), reach * spacing)?;
        check(&grid::<3>(1.5 * spacing, shake, seed), &bodies_3d(), 1.5 * reach * spacing)?;
    }
}

#[test]
fn the_first_of_overlapping_bodies_wins_and_surfaces_have_the_last_word() {
    let at = |x: f64| Ball::new([x, 0.0], 0.5).expect("a sound ball");
    let bodies: [&dyn Surface<2>; 2] = [&at(0.0), &at(0.6)];
    let points = [[0.3, 0.0], [0.9, 0.0], [-0.3, 0.0], [0.0, 0.9]];
    let first = [Some(0), Some(1), Some(0), None];
    let labels = separate(&points, &bodies).expect("sound input");
    assert_eq!(labels.body, first);
    let labels = separate_by_flood(&points, &[None; 4], &bodies, 0.3).expect("sound input");
    assert_eq!(labels.body, first);
    let on_surface = [Some(1), None, None, Some(1)];
    let last_word = [Some(1), Some(1), Some(0), Some(1)];
    let labels = separate_by_flood(&points, &on_surface, &bodies, 0.3).expect("sound input");
    assert_eq!(labels.body, last_word);
    let labels = separate_with_on_surface(&points, &on_surface, &bodies).expect("sound input");
    assert_eq!(labels.body, last_word);
}

#[test]
fn lonely_particles_are_asked_about() {
    let ball = Ball::new([0.0; 2], 1.0).expect("a sound ball");
    let flood = |points: &[[f64; 2]], bodies: &[&dyn Surface<2>]| {
        let nobody = vec![None; points.len()];
        (separate_by_flood(points, &nobody, bodies, 0.01).expect("sound input")).side
    };
    let both = flood(&[[0.0, 0.0], [9.0, 9.0]], &[&ball]);
    assert_eq!(both, [Side::Solid, Side::Fluid]);
    assert!(flood(&[], &[&ball]).is_empty());
    assert_eq!(flood(&[[0.0, 0.0]], &[]), [Side::Fluid]);
}

#[test]
fn senseless_input_is_refused() {
    let ball = Ball::new([0.0; 2], 1.0).expect("a sound ball");
    let refused = |points: &[[f64; 2]], on: &[Option<u16>], reach: f64| {
        separate_by_flood(points, on, &[&ball], reach).expect_err("refused")
    };
    assert!(matches!(
        refused(&[[f64::NAN, 0.0]], &[None], 0.1),
        SeparationError::NotFinite { index: 0 }
    ));
    assert!(matches!(
        refused(&[[0.0, 0.0]], &[], 0.1),
        SeparationError::LengthMismatch { .. }
    ));
    assert!(matches!(
        refused(&[[0.0, 0.0]], &[Some(3)], 0.1),
        SeparationError::UnknownBody { body: 3, .. }
    ));
    assert!(matches!(
        refused(&[[0.0, 0.0]], &[None], 0.0),
        SeparationError::BadReach(_)
    ));
    let many: Vec<&dyn Surface<2>> = vec![&ball; (1 << 16) + 1];
    assert!(matches!(
        separate(&[], &many),
        Err(SeparationError::TooManyBodies(65_537))
    ));
}

#[cfg(feature = "serde")]
#[test]
fn serde_has_the_same_names() {
    for side in Side::ALL {
        let written = serde_json::to_value(side).expect("a name");
        assert_eq!(written, side.name());
        assert_eq!(serde_json::from_value::<Side>(written).ok(), Some(side));
    }
}
