//! Insets of 3-D bodies against what is known of them.

use std::sync::Arc;

use proptest::prelude::*;
use sphpack_neighbors::point;

use super::*;
use crate::{Ball, Cuboid, Ellipsoid, InsetError, ParameterError};

fn cube<const D: usize>() -> Arc<dyn Surface<D>> {
    Arc::new(Cuboid::new([-1.0; D], [1.0; D]).unwrap())
}

fn agree<const D: usize>(p: [f64; D], depth: f64) -> Result<(), TestCaseError> {
    let exact = cube::<D>().inset(depth).unwrap();
    let level = LevelInset::new(cube::<D>(), depth).unwrap();
    let (a, b) = (exact.closest(p), level.closest(p));
    prop_assert!(
        (a.distance - b.distance).abs() < 1e-8,
        "{:?} {:?} {:?}",
        p,
        a,
        b
    );
    if a.distance > 1e-6 {
        prop_assert!(
            point::distance(a.point, b.point) < 1e-8,
            "{:?} {:?} {:?}",
            p,
            a,
            b
        );
        // So near beside an edge that a look below finds the other side, the level inset calls it the edge.
        let off_edge = |x: f64| (x.abs() - (1.0 - depth)).abs();
        let beside = |&x: &f64| off_edge(x) > 1e-12 && off_edge(x) < 1e-3 * depth;
        if !a.point.iter().any(beside) {
            prop_assert_eq!(a.feature, b.feature, "{:?} {:?} {:?}", p, a, b);
            prop_assert!(point::distance(a.normal, b.normal) < 1e-6);
        }
    }
    prop_assert_eq!(
        level.closest_within(p, a.distance.abs() + 1e-6).is_some(),
        true
    );
    prop_assert!(level.closest_within(p, a.distance.abs() - 1e-6).is_none());
    if a.distance.abs() > 1e-6 {
        prop_assert_eq!(level.inside(p), a.distance < 0.0);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn of_a_cube_is_a_cube(p in [-1.6..1.6, -1.6..1.6, -1.6..1.6], depth in 0.05..0.6) {
        agree(p, depth)?;
        agree([p[0], p[1]], depth)?;
    }

    #[test]
    fn of_an_ellipsoid_is_on_the_level_set(p in [-1.6..1.6, -1.0..1.0, -1.2..1.2], depth in 0.05..0.4) {
        let egg = Ellipsoid::new([0.0; 3], [1.0, 0.5, 0.75]).unwrap();
        let inset = egg.inset(depth).unwrap();
        let hit = inset.closest(p);
        prop_assert!((egg.closest(hit.point).distance + depth).abs() < 1e-6 * depth, "{:?}", hit);
        prop_assert!(hit.distance.abs() > (egg.closest(p).distance + depth).abs() - 1e-9);
    }
}

#[test]
fn contents_and_features() {
    // Numerically integrated against exact.
    let ball = Arc::new(Ball::new([0.1, 0.2, 0.3], 1.0).unwrap());
    let (level, exact) = (
        LevelInset::new(ball.clone(), 0.2).unwrap(),
        ball.inset(0.2).unwrap(),
    );
    assert!(
        (level.measure() / exact.measure() - 1.0).abs() < 1e-3,
        "{}",
        level.measure()
    );
    assert!(
        (level.volume() / exact.volume() - 1.0).abs() < 1e-3,
        "{}",
        level.volume()
    );
    let (level, exact) = (
        LevelInset::new(cube::<3>(), 0.2).unwrap(),
        cube::<3>().inset(0.2).unwrap(),
    );
    assert!(
        (level.measure() / exact.measure() - 1.0).abs() < 2e-2,
        "{}",
        level.measure()
    );
    assert!(
        (level.volume() / exact.volume() - 1.0).abs() < 1e-2,
        "{}",
        level.volume()
    );
    // Steiner's formulas against integration.
    let egg: Arc<dyn Surface<3>> = Arc::new(Ellipsoid::new([0.0; 3], [1.0, 0.7, 0.8]).unwrap());
    let (level, exact) = (
        LevelInset::new(egg.clone(), 0.1).unwrap(),
        egg.inset(0.1).unwrap(),
    );
    assert!((level.measure() / exact.measure() - 1.0).abs() < 2e-3);
    assert!((level.volume() / exact.volume() - 1.0).abs() < 2e-3);
    let egg: Arc<dyn Surface<2>> = Arc::new(Ellipsoid::new([0.0; 2], [1.0, 0.7]).unwrap());
    let (level, exact) = (
        LevelInset::new(egg.clone(), 0.1).unwrap(),
        egg.inset(0.1).unwrap(),
    );
    assert!((level.measure() / exact.measure() - 1.0).abs() < 1e-3);
    assert!((level.volume() / exact.volume() - 1.0).abs() < 1e-3);
    // Sharp places stay sharp.
    let level = LevelInset::new(cube::<3>(), 0.25).unwrap();
    let features = level.features();
    assert_eq!((features.corners.len(), features.edges.len()), (8, 12));
    for c in features
        .corners
        .iter()
        .chain(features.edges.iter().flatten())
    {
        assert!(c.iter().all(|x| (x.abs() - 0.75).abs() < 1e-8), "{c:?}");
        assert_eq!(level.closest(*c).feature, Feature::Corner);
    }
    assert_eq!(level.closest([0.75, 0.75, 0.1]).feature, Feature::Edge);
    assert_eq!(level.closest([0.75, 0.1, 0.1]).feature, Feature::Smooth);
    // Twice inset is inset once.
    let twice = level.inset(0.25).unwrap();
    assert!((twice.closest([2.0, 0.0, 0.0]).distance - 1.5).abs() < 1e-9);
    assert!(matches!(
        level.inset(0.8),
        Err(GeometryError::Inset(InsetError::Vanished { .. }))
    ));
    assert!(matches!(
        LevelInset::new(cube::<2>(), 1.0),
        Err(GeometryError::Inset(InsetError::Vanished { .. }))
    ));
    assert!(matches!(
        LevelInset::new(cube::<2>(), f64::NAN),
        Err(GeometryError::Parameter(ParameterError::OutOfRange { .. }))
    ));
}
