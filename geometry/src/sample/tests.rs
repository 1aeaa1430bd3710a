//! Sampled surfaces: how many points, where, how even; the same for any number of threads and any size.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use proptest::prelude::*;
use sphpack_neighbors::{Bounds, KdTree, point};

use crate::surface::{Closest, Feature, Features, Surface};
use crate::{
    Ball, Cuboid, Cylinder, Ellipsoid, GeometryError, LevelInset, Mesh, Outline, Placed,
    Similarity, Torus,
};

/// The bodies in space that the bars below are held on.
fn solids() -> Vec<Arc<dyn Surface<3>>> {
    let cube = Arc::new(Cuboid::new([0.0; 3], [1.0; 3]).unwrap());
    let turn = Similarity::<3>::new(1.0, [0.3, -1.0, 0.2], 17.0, [0.1, 0.2, -0.4]).unwrap();
    let turned = Placed::new(cube.clone(), turn);
    let egg = Ellipsoid::new([0.0; 3], [1.0, 0.5, 0.75]).unwrap();
    vec![
        Arc::new(Ball::new([0.1, 0.2, 0.3], 0.7).unwrap()),
        Arc::new(Torus::new([0.1, 0.2, 0.3], [1.0, 2.0, 3.0], 0.8, 0.3).unwrap()),
        cube,
        Arc::new(LevelInset::new(Arc::new(turned.clone()), 0.05).unwrap()),
        Arc::new(turned),
        Arc::new(Cylinder::new([0.1, -0.5, -0.7], [0.5, 0.6, 1.0], 0.4).unwrap()),
        Arc::new(LevelInset::new(Arc::new(egg), 0.1).unwrap()),
        Arc::new(egg),
    ]
}

fn curves() -> Vec<Arc<dyn Surface<2>>> {
    let square = Arc::new(Cuboid::new([-1.0; 2], [1.0; 2]).unwrap());
    let turn = Similarity::<2>::new(1.3, 17.0, [0.2, -0.1]).unwrap();
    let ring = |radius: f64, sides: usize| -> Vec<[f64; 2]> {
        (0..sides)
            .map(|i| {
                let (sin, cos) = (std::f64::consts::TAU * i as f64 / sides as f64).sin_cos();
                [radius * cos, radius * sin]
            })
            .collect()
    };
    let egg = Ellipsoid::new([0.0; 2], [1.0, 0.4]).unwrap();
    vec![
        square.clone(),
        Arc::new(Placed::new(square.clone(), turn)),
        Arc::new(LevelInset::new(square, 0.2).unwrap()),
        Arc::new(Ball::new([0.1, 0.2], 0.7).unwrap()),
        Arc::new(egg),
        Arc::new(LevelInset::new(Arc::new(egg), 0.1).unwrap()),
        Arc::new(Outline::naca("0015", 1.0).unwrap()),
        Arc::new(Outline::starfish([0.0; 2], 0.5, 0.25, 5).unwrap()),
        Arc::new(Outline::new(vec![ring(1.0, 4), ring(0.5, 500)]).unwrap()),
    ]
}

fn spot() -> Mesh {
    Mesh::read_stl(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/spot.stl")).unwrap()
}

/// Exactly as many as asked for, all on the surface, with unit normals.
fn check_places<const D: usize>(surface: &dyn Surface<D>, count: usize) -> Vec<Closest<D>> {
    let sites = surface.sample(count).unwrap();
    assert_eq!(sites.len(), count, "{count}");
    let size = surface.bounds().diagonal();
    for site in &sites {
        let off = surface.closest(site.point).distance.abs();
        assert!(off < 1e-9 * size, "{off} {site:?}");
        assert!((point::norm(site.normal) - 1.0).abs() < 1e-9, "{site:?}");
        assert_eq!(site.distance, 0.0);
    }
    sites
}

/// Mean of the nearest distances on the same side of the body, and their coefficient of variation.
fn nearest(sites: &[Closest<3>]) -> (f64, f64) {
    let points: Vec<[f64; 3]> = sites.iter().map(|site| site.point).collect();
    let tree = KdTree::new(&points).unwrap();
    let distances: Vec<f64> = sites
        .iter()
        .enumerate()
        .filter_map(|(i, site)| {
            let near = tree.nearest_n(site.point, 12);
            let same_side = |k: usize| k != i && point::dot(sites[k].normal, site.normal) >= 0.0;
            near.into_iter()
                .find(|found| same_side(found.index))
                .map(|found| found.distance)
        })
        .collect();
    let count = distances.len() as f64;
    let mean = distances.iter().sum::<f64>() / count;
    let variance = distances.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count;
    (mean, variance.sqrt() / mean)
}

#[test]
fn solids_are_covered_evenly() {
    for body in solids() {
        for count in [600, 2300] {
            let sites = check_places(body.as_ref(), count);
            let (mean, variation) = nearest(&sites);
            let spacing = (body.measure() / count as f64).sqrt();
            assert!(variation < 0.04, "{variation} {count}");
            assert!((mean / spacing - 1.0).abs() < 0.05, "{mean} {spacing}");
        }
    }
}

#[test]
fn meshes_are_covered_evenly() {
    let body = spot();
    // Its creases are longer than a spacing or two only for the finer one.
    for (count, bar) in [(2300, 0.055), (14_000, 0.04)] {
        let (_, variation) = nearest(&check_places(&body, count));
        assert!(variation < bar, "{variation} {count}");
    }
    let inset = body.inset(0.025).unwrap();
    let (_, variation) = nearest(&check_places(inset.as_ref(), 2300));
    assert!(variation < 0.04, "{variation}");
}

#[test]
fn density_does_not_drift() {
    // Zones of equal height have equal area on a sphere (Archimedes).
    let sites = Ball::new([0.0; 3], 1.0).unwrap().sample(4000).unwrap();
    for axis in 0..3 {
        for zone in 0..4 {
            let low = 0.5 * zone as f64 - 1.0;
            let inside = |site: &&Closest<3>| (low..low + 0.5).contains(&site.point[axis]);
            let count = sites.iter().filter(inside).count();
            assert!(count.abs_diff(1000) < 25, "{axis} {zone} {count}");
        }
    }
    // The inner half of a torus's tube has (1/2 − r/(π R)) of the area.
    let ring = Torus::new([0.0; 3], [0.0, 0.0, 1.0], 0.8, 0.3).unwrap();
    let sites = ring.sample(4000).unwrap();
    let inner = sites
        .iter()
        .filter(|s| s.point[0].hypot(s.point[1]) < 0.8)
        .count() as f64;
    let part = 0.5 - 0.3 / (std::f64::consts::PI * 0.8);
    assert!((inner / 4000.0 / part - 1.0).abs() < 0.02, "{inner}");
}

#[test]
fn corners_and_edges_are_occupied() {
    let cube = Cuboid::new([0.0; 3], [1.0; 3]).unwrap();
    let sites = cube.sample(602).unwrap();
    let on = |feature: Feature| sites.iter().filter(move |s| s.feature == feature);
    assert_eq!(on(Feature::Corner).count(), 8);
    // Spacing 0.1: nine points between the corners of each of twelve edges, ten intervals.
    assert_eq!(on(Feature::Edge).count(), 12 * 9);
    for site in on(Feature::Edge) {
        let tenths = site.point.map(|x| (10.0 * x - (10.0 * x).round()).abs());
        assert!(tenths.iter().all(|x| *x < 1e-9), "{site:?}");
    }
    let features = sites.iter().take_while(|s| s.feature != Feature::Smooth);
    assert_eq!(features.count(), 8 + 12 * 9, "features come first");
    // The rims of a cylinder, evenly.
    let rod = Cylinder::new([0.0; 3], [0.0, 0.0, 1.0], 0.5).unwrap();
    let rims = rod.sample(1000).unwrap();
    let top: Vec<&Closest<3>> = rims
        .iter()
        .filter(|s| s.feature == Feature::Edge && s.point[2] == 1.0)
        .collect();
    let step = std::f64::consts::PI / top.len() as f64;
    assert!((step / (rod.measure() / 1000.0).sqrt() - 1.0).abs() < 0.05);
    for pair in top.windows(2) {
        let chord = point::distance(pair[0].point, pair[1].point);
        assert!((chord / step.sin() - 1.0).abs() < 2e-4, "{chord} {step}");
    }
}

#[test]
fn curves_are_covered_evenly() {
    for (number, body) in curves().into_iter().enumerate() {
        for count in [37, 400] {
            let sites = check_places(body.as_ref(), count);
            let corners = body.features().corners;
            for c in &corners {
                let there = |s: &Closest<2>| point::distance(s.point, *c) < 1e-9;
                let site = sites.iter().find(|s| there(s));
                assert_eq!(site.map(|s| s.feature), Some(Feature::Corner), "{c:?}");
            }
            let spacing = body.measure() / count as f64;
            for (i, site) in sites.iter().enumerate() {
                let same_side = |(k, other): &(usize, &Closest<2>)| {
                    *k != i && point::dot(site.normal, other.normal) > 0.0
                };
                let near = sites
                    .iter()
                    .enumerate()
                    .filter(same_side)
                    .map(|(_, other)| point::distance(site.point, other.point))
                    .fold(f64::INFINITY, f64::min);
                // Chords are shorter than arcs, and runs between corners are rounded to whole intervals.
                let part = near / spacing;
                assert!((0.6..1.1).contains(&part), "{part} {number} {site:?}");
            }
        }
    }
    // Exactly even by arc length.
    let square = Outline::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).unwrap();
    for site in square.sample(40).unwrap() {
        let tenths = site.point.map(|x| (10.0 * x - (10.0 * x).round()).abs());
        assert!(tenths.iter().all(|x| *x < 1e-12), "{site:?}");
    }
    // A blunt trailing edge thinner than half a spacing has one point.
    let blunt = Outline::polygon(&[[0.0, 0.0], [1.0, -0.01], [1.0, 0.01]]).unwrap();
    let corners = |count: usize| {
        let sites = blunt.sample(count).unwrap();
        sites
            .iter()
            .filter(|s| s.feature == Feature::Corner)
            .count()
    };
    assert_eq!((corners(20), corners(400)), (2, 3));
}

#[test]
fn few_points() {
    for count in [0, 1, 2, 3, 5, 7, 9, 20] {
        for body in solids() {
            check_places(body.as_ref(), count);
        }
        for body in curves() {
            check_places(body.as_ref(), count);
        }
    }
    assert_eq!(spot().sample(50).unwrap().len(), 50);
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let with_threads = |threads: usize, body: &dyn Surface<3>| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| body.sample(1500).unwrap())
    };
    let bodies: [Arc<dyn Surface<3>>; 2] = [Arc::new(spot()), spot().inset(0.03).unwrap()];
    for body in bodies {
        assert_eq!(
            with_threads(1, body.as_ref()),
            with_threads(2, body.as_ref())
        );
    }
}

#[test]
fn powers_of_two_scale_exactly() {
    for factor in [2.0_f64.powi(-20), 2.0_f64.powi(20)] {
        let make =
            |size: f64| Torus::new([0.0; 3], [0.0, 0.0, 1.0], 0.75 * size, 0.25 * size).unwrap();
        let one = make(1.0).sample(500).unwrap();
        let other = make(factor).sample(500).unwrap();
        for (a, b) in one.iter().zip(&other) {
            assert_eq!(point::scale(a.point, factor), b.point);
        }
        let mesh = spot();
        let other = mesh.scaled(factor).unwrap().sample(500).unwrap();
        for (a, b) in mesh.sample(500).unwrap().iter().zip(&other) {
            assert_eq!(point::scale(a.point, factor), b.point);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn boxes_of_any_size(
        sides in [0.02..3.0, 0.02..3.0, 0.02..3.0],
        count in 0_usize..400,
        exponent in -6..=6_i32,
        degrees in 0.0..360.0,
    ) {
        let scale = 10.0_f64.powi(exponent);
        let place = Similarity::<3>::new(scale, [0.2, 0.5, -1.0], degrees, [0.0; 3]).unwrap();
        let body = Placed::new(Arc::new(Cuboid::new([0.0; 3], sides).unwrap()), place);
        check_places(&body, count);
        let place = Similarity::<2>::new(scale, degrees, [0.0; 2]).unwrap();
        let body = Placed::new(Arc::new(Cuboid::new([0.0; 2], [sides[0], sides[1]]).unwrap()), place);
        check_places(&body, count);
    }

    #[test]
    fn any_scale_is_as_even(exponent in -6..=6_i32, a in 0.4..1.0, b in 0.4..1.0) {
        let scale = 10.0_f64.powi(exponent);
        let egg = Ellipsoid::new([0.0; 3], [scale, a * scale, b * scale]).unwrap();
        let (mean, variation) = nearest(&check_places(&egg, 700));
        let spacing = (egg.measure() / 700.0).sqrt();
        prop_assert!(variation < 0.045, "{}", variation);
        prop_assert!((mean / spacing - 1.0).abs() < 0.05);
    }
}

#[test]
fn scattered_points_stand_for_equal_areas() {
    // Both sides of plates much thinner than the mean distance between the points.
    for thickness in [0.02, 0.1, 0.5] {
        let plate = Cuboid::new([0.0; 3], [2.0, 1.0, thickness]).unwrap();
        let strip = Cuboid::new([0.0; 2], [2.0, thickness]).unwrap();
        let up: Vec<f64> = plate.scatter(1000).iter().map(|s| s.normal[2]).collect();
        let up_there: Vec<f64> = strip.scatter(1000).iter().map(|s| s.normal[1]).collect();
        for (normals, part) in [
            (up, 2.0 / plate.measure()),
            (up_there, 2.0 / strip.measure()),
        ] {
            assert_eq!(normals.len(), 1000);
            for side in [1.0, -1.0] {
                let there = normals.iter().filter(|n| **n == side).count() as f64;
                assert!((there / 1000.0 - part).abs() < 0.02, "{there} {part}");
            }
        }
    }
    let cow = spot();
    for site in cow.scatter(2000) {
        assert!(cow.closest(site.point).distance.abs() < 1e-12);
    }
    assert_eq!(Outline::naca("0015", 1.0).unwrap().scatter(500).len(), 500);
}

/// A torus that counts how often it is asked for a closest point.
#[derive(Debug)]
struct Asked {
    torus: Torus,
    times: AtomicUsize,
}

impl Surface<3> for Asked {
    fn closest(&self, p: [f64; 3]) -> Closest<3> {
        self.times.fetch_add(1, Ordering::Relaxed);
        self.torus.closest(p)
    }

    fn inside(&self, p: [f64; 3]) -> bool {
        self.torus.inside(p)
    }

    fn measure(&self) -> f64 {
        self.torus.measure()
    }

    fn volume(&self) -> f64 {
        self.torus.volume()
    }

    fn bounds(&self) -> Bounds<3> {
        self.torus.bounds()
    }

    fn features(&self) -> Features<3> {
        self.torus.features()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<3>>, GeometryError> {
        self.torus.inset(depth)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_thin_tube_costs_no_more_than_a_curve(
        radius in (-12.0..-1.0_f64).prop_map(|power| 10.0_f64.powf(power)),
        axis in [-1.0..1.0_f64, -1.0..1.0, 0.1..1.0],
        count in 20..2000_usize,
    ) {
        let torus = Torus::new([0.1, 0.2, 0.3], axis, 1.9, radius).unwrap();
        let asked = Asked { torus, times: AtomicUsize::new(0) };
        let sites = asked.scatter(count);
        prop_assert_eq!(sites.len(), count);
        let times = asked.times.into_inner();
        prop_assert!(times < 20_000 * count, "{times}");
        // Every eighth of the ring has its part of them: a thread is found by more boxes where it runs across their corners.
        let mut parts = [0_usize; 8];
        let across = Axis::new(axis);
        for site in &sites {
            prop_assert!(torus.closest(site.point).distance.abs() < 1e-9);
            parts[across.eighth(point::sub(site.point, [0.1, 0.2, 0.3]))] += 1;
        }
        let due = count as f64 / 8.0;
        let is_fair = |n: usize| (0.4 * due - 3.0..1.8 * due + 3.0).contains(&(n as f64));
        prop_assert!(parts.iter().all(|&n| is_fair(n)), "{parts:?}");
    }
}

/// Two directions across an axis.
struct Axis([[f64; 3]; 2]);

impl Axis {
    fn new(axis: [f64; 3]) -> Self {
        let axis = point::scale(axis, 1.0 / point::norm(axis));
        let u = point::reject([1.0, 0.0, 0.0], axis);
        let u = point::scale(u, 1.0 / point::norm(u));
        let v = std::array::from_fn(|k| {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            axis[a] * u[b] - axis[b] * u[a]
        });
        Self([u, v])
    }

    fn eighth(&self, at: [f64; 3]) -> usize {
        let angle = point::dot(at, self.0[1]).atan2(point::dot(at, self.0[0]));
        ((angle + std::f64::consts::PI) / std::f64::consts::FRAC_PI_4).floor() as usize % 8
    }
}

#[test]
fn creases_that_were_not_given_a_point_hold_none() {
    let thick = spot().inset(0.15).unwrap();
    let sites = thick.sample(800).unwrap();
    let features = sites.iter().take_while(|s| s.feature != Feature::Smooth);
    let given = features.count();
    assert!(sites[given..].iter().all(|s| s.feature == Feature::Smooth));
    let creased = |s: &Closest<3>| thick.closest(s.point).feature != Feature::Smooth;
    assert!(sites[given..].iter().any(creased));
}

#[test]
fn weights_rule_the_density() {
    // Twice as dense at one end as at the other.
    let weight = |s: &Closest<3>| 1.5 + 0.5 * s.point[2];
    let ball = Ball::new([0.0; 3], 1.0).unwrap();
    let sites = crate::sample_weighted(&ball, 3000, &weight).unwrap();
    assert_eq!(sites.len(), 3000);
    for zone in 0..4 {
        let low = 0.5 * zone as f64 - 1.0;
        let count = sites
            .iter()
            .filter(|s| (low..low + 0.5).contains(&s.point[2]))
            .count();
        let due = 3000.0 / 4.0 * (1.5 + 0.5 * (low + 0.25)) / 1.5;
        assert!((count as f64 / due - 1.0).abs() < 0.05, "{count} {due}");
    }
    let square = Cuboid::new([0.0; 2], [1.0; 2]).unwrap();
    let weight = |s: &Closest<2>| 1.0 + 3.0 * s.point[0];
    let sites = crate::sample_weighted(&square, 200, &weight).unwrap();
    let on = |x: f64| sites.iter().filter(|s| s.point[0] == x).count();
    // Corners belong to two sides each: 80 and 20 points, of which two halves are the corners'.
    assert_eq!(sites.len(), 200);
    assert!(
        on(1.0).abs_diff(81) <= 3 && on(0.0).abs_diff(21) <= 1,
        "{} {}",
        on(1.0),
        on(0.0)
    );
    assert!(crate::sample_weighted(&square, 10, &|_| 0.0).is_err());
}
