//! Thin bodies: mass kept, points apart from each other, tips reached; thick bodies as ever.

use std::sync::Arc;

use sphpack_neighbors::point;

use super::{SurfaceSamples, Thin, sample_particles, sample_thin};
use crate::soup::tests::cuboid;
use crate::surface::{Feature, Surface};
use crate::{Ball, Cuboid, Ellipsoid, Mesh, Outline, Placed, Similarity, Torus, thickness};

const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// No two points may be nearer than this many spacings.
const APART: f64 = 0.6;

/// The points of a body, particle surface half a spacing inside, checked for what holds for all.
fn sampled<const D: usize>(body: &dyn Surface<D>, spacing: f64) -> SurfaceSamples<D> {
    let inset = body.inset(0.5 * spacing).ok();
    let found = sample_particles(body, inset.as_deref(), spacing, 0.5 * spacing).unwrap();
    for site in &found.on_surface {
        let off = inset.as_ref().unwrap().closest(site.point).distance.abs();
        assert!(off < 1e-6 * spacing, "{off} {site:?}");
    }
    for &p in &found.medial {
        assert!(body.inside(p), "{p:?}");
    }
    let all = all_points(&found);
    for (i, a) in all.iter().enumerate() {
        for b in &all[..i] {
            let gap = point::distance(*a, *b) / spacing;
            assert!(gap > APART, "{gap} {a:?} {b:?}");
        }
    }
    found
}

fn all_points<const D: usize>(found: &SurfaceSamples<D>) -> Vec<[f64; D]> {
    let on_surface = found.on_surface.iter().map(|site| site.point);
    on_surface.chain(found.medial.iter().copied()).collect()
}

/// Points in all and the body's volume, in particles.
fn mass<const D: usize>(
    body: &dyn Surface<D>,
    spacing: f64,
    found: &SurfaceSamples<D>,
) -> (f64, f64) {
    let count = found.on_surface.len() + found.medial.len();
    (count as f64, body.volume() / spacing.powi(D as i32))
}

/// A wedge with its tip at the origin, opening along +x.
fn wedge(degrees: f64, length: f64) -> Outline {
    let half = length * (0.5 * degrees).to_radians().tan();
    Outline::polygon(&[[0.0, 0.0], [length, -half], [length, half]]).unwrap()
}

/// The same in space, its sharp edge along z.
fn prism(degrees: f64, length: f64, width: f64) -> Mesh {
    let half = length * (0.5 * degrees).to_radians().tan();
    let at = |z: f64| [[0.0, 0.0, z], [length, -half, z], [length, half, z]];
    let ([a, b, c], [d, e, f]) = (at(0.0), at(width));
    Mesh::from_loose(&[
        [a, c, b],
        [d, e, f],
        [a, b, e],
        [a, e, d],
        [b, c, f],
        [b, f, e],
        [c, a, d],
        [c, d, f],
    ])
    .unwrap()
}

/// A block of ten by ten with a fin of this thickness, eight long.
fn finned(thickness: f64) -> Outline {
    let (left, right) = (5.0 - 0.5 * thickness, 5.0 + 0.5 * thickness);
    Outline::polygon(&[
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 10.0],
        [right, 10.0],
        [right, 18.0],
        [left, 18.0],
        [left, 10.0],
        [0.0, 10.0],
    ])
    .unwrap()
}

fn spot() -> Mesh {
    Mesh::read_stl(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/spot.stl")).unwrap()
}

fn check_plate<const D: usize>(plate: &dyn Surface<D>, thickness: f64) {
    let found = sampled(plate, 1.0);
    let (count, volume) = mass(plate, 1.0, &found);
    if thickness <= 2.0 {
        let off = (count - volume).abs();
        assert!(
            off <= (0.05 * volume).max(1.0),
            "{thickness} {count} {volume}"
        );
    } else {
        check_thick(plate, 1.0);
    }
    if thickness <= 1.0 {
        assert!(found.on_surface.is_empty());
        assert!((found.medial_volume - volume).abs() < 1e-9 * volume);
        for p in &found.medial {
            let middle = plate.closest(*p).distance + 0.5 * thickness;
            assert!(middle < 0.5 * thickness, "{p:?}");
        }
    }
}

#[test]
fn strips_and_plates_keep_their_mass() {
    for thickness in [0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 3.0, 4.0, 6.0] {
        let strip = Cuboid::new([0.0; 2], [20.0, thickness]).unwrap();
        check_plate(&strip, thickness);
        let turn = Similarity::<2>::new(1.0, 17.0, [3.0, -1.0]).unwrap();
        check_plate(&Placed::new(Arc::new(strip), turn), thickness);
        let corners = [[0.0, 0.0], [20.0, 0.0], [20.0, thickness], [0.0, thickness]];
        check_plate(&Outline::polygon(&corners).unwrap(), thickness);
        let plate = Cuboid::new([0.0; 3], [10.0, 10.0, thickness]).unwrap();
        check_plate(&plate, thickness);
    }
}

/// Exactly what the particle surface alone would give.
fn check_thick<const D: usize>(body: &dyn Surface<D>, spacing: f64) {
    let each = spacing.powi(D as i32 - 1);
    for depth in [0.0, 0.5 * spacing] {
        let surface = body.inset(depth).unwrap();
        let count = (surface.measure() / each).round() as usize;
        let found = sample_particles(body, Some(surface.as_ref()), spacing, depth).unwrap();
        assert_eq!(found.on_surface, surface.sample(count).unwrap());
        assert!(found.medial.is_empty() && found.medial_volume == 0.0);
    }
}

#[test]
fn thick_bodies_get_what_their_surface_gives() {
    check_thick(&Cuboid::new([0.0; 2], [1.0; 2]).unwrap(), 0.1);
    check_thick(&Cuboid::new([0.0; 3], [1.0; 3]).unwrap(), 0.1);
    check_thick(&Ball::new([0.0; 2], 1.0).unwrap(), 0.1);
    check_thick(&Ball::new([0.0; 3], 1.0).unwrap(), 0.1);
    check_thick(&Ellipsoid::new([0.0; 3], [1.0, 0.5, 0.75]).unwrap(), 0.1);
    check_thick(&Outline::starfish([0.0; 2], 0.5, 0.25, 5).unwrap(), 0.05);
    // Its two corners of 45° would lack half a point each.
    check_thick(&Outline::zigzag(2.0, 1.0, 0.25, 2).unwrap(), 0.05);
}

#[test]
fn an_airfoils_tail_is_held() {
    let wing = Outline::naca("0015", 1.0).unwrap();
    for (spacing, most) in [(0.02, 1), (0.01, 2), (0.005, 2)] {
        let found = sampled(&wing, spacing);
        let particle = spacing * spacing;
        assert!((1..=most).contains(&found.medial.len()), "{spacing}");
        let part = found.medial_volume / particle;
        assert!((part - found.medial.len() as f64).abs() <= 0.5, "{part}");
        let tail = found.medial.iter().map(|p| 1.0 - p[0]);
        let nearest = tail.fold(f64::INFINITY, f64::min);
        assert!(nearest < 1.01 * spacing, "{nearest} {spacing}");
        assert!(found.medial.iter().all(|p| p[1].abs() < 1e-3 * spacing));
        // The area before the inset's own end, by the trapezoidal rule over its two sides.
        let inset = wing.inset(0.5 * spacing).unwrap();
        let end = inset.features().corners[0][0];
        let slices = 1000;
        let width = (1.0 - end) / f64::from(slices);
        let half = |x: f64| wing.closest([x, 0.0]).distance.abs();
        let area: f64 = (0..slices)
            .map(|i| 2.0 * half(end + (f64::from(i) + 0.5) * width) * width)
            .sum();
        assert!((part - area / particle).abs() < 0.1, "{part} {area}");
    }
}

#[test]
fn wedges_are_held_to_their_tips() {
    for (degrees, many) in [(6.0, 5), (20.0, 1), (60.0, 0), (90.0, 0), (120.0, 0)] {
        let found = sampled(&wedge(degrees, 20.0), 1.0);
        let mut along: Vec<f64> = found.medial.iter().map(|p| p[0]).collect();
        along.retain(|&x| x < 10.0);
        along.sort_by(f64::total_cmp);
        assert_eq!(along.len(), many, "{degrees}");
        let Some(&first) = along.first() else {
            continue;
        };
        assert!(first < 1.01, "{degrees} {first}");
        // Farther apart towards the tip.
        let end = 0.5 / (0.5 * degrees).to_radians().sin();
        along.push(end);
        let gaps: Vec<f64> = along.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(gaps.iter().all(|gap| *gap > 0.8), "{gaps:?}");
        assert!(gaps.windows(2).all(|pair| pair[0] > pair[1]), "{gaps:?}");
    }
    for (degrees, bar) in [(6.0, 0.03), (20.0, 0.05)] {
        let body = prism(degrees, 12.0, 15.0);
        let found = sampled(&body, 1.0);
        // All of it beyond the end of the inset.
        let volume = 0.25 / (0.5 * degrees).to_radians().tan() * 15.0;
        let off = found.medial.len() as f64 / volume - 1.0;
        assert!(off.abs() < bar, "{off}");
        let first = found
            .medial
            .iter()
            .map(|p| p[0])
            .fold(f64::INFINITY, f64::min);
        assert!(first < 1.01, "{first}");
    }
    assert!(sampled(&prism(90.0, 12.0, 15.0), 1.0).medial.is_empty());
}

#[test]
fn fins_are_held_as_dense_as_they_are_thick() {
    for thickness in [0.3, 0.5, 0.75, 1.0] {
        let found = sampled(&finned(thickness), 1.0);
        // The block as without the fin.
        assert_eq!(found.on_surface.len(), 36);
        let due = 8.0 * thickness;
        assert!((found.medial.len() as f64 - due).abs() <= 0.5);
        assert!((found.medial_volume - due).abs() < 0.05);
        let highest = found.medial.iter().map(|p| p[1]).fold(0.0, f64::max);
        assert!(highest > 16.5, "{highest}");
        assert!(found.medial.iter().all(|p| (p[0] - 5.0).abs() < 1e-9));
    }
    let found = sampled(&finned(1.3), 1.0);
    assert!(found.medial.is_empty());
    // The block and the fin, which is cut off half a spacing up the block.
    assert!(found.on_surface.len().abs_diff(36 + 10) <= 1);
}

#[test]
fn exact_surfaces_carry_half_a_particle_per_side() {
    for thickness in [0.4, 0.75] {
        let strip = Cuboid::new([0.0; 2], [20.0, thickness]).unwrap();
        let found = sample_particles(&strip, Some(&strip), 1.0, 0.0).unwrap();
        let count = found.on_surface.len() as f64;
        // Twice the mass and what the ends have in addition.
        assert!((count - 2.0 * strip.volume()).abs() <= 2.0, "{count}");
        assert!(found.medial.is_empty());
    }
    let strip = Cuboid::new([0.0; 2], [20.0, 1.5]).unwrap();
    check_thick_exact(&strip);
    assert!(sample_particles(&strip, None, 1.0, 0.0).is_err());
    assert!(sample_particles(&strip, Some(&strip), -1.0, 0.0).is_err());
}

fn check_thick_exact(body: &dyn Surface<2>) {
    let count = body.measure().round() as usize;
    let found = sample_particles(body, Some(body), 1.0, 0.0).unwrap();
    assert_eq!(found.on_surface, body.sample(count).unwrap());
}

#[test]
fn scanned_bodies_are_sane() {
    let cow = spot();
    let inset = cow.inset(0.05).unwrap();
    let found = sampled(&cow, 0.1);
    // Horns, ears and tail are thinner than two spacings: within 2 % of the thick count.
    let plain = inset.measure() / 0.01;
    let count = found.on_surface.len() as f64;
    assert!((count / plain - 1.0).abs() < 0.02, "{count} {plain}");
    assert!(found.medial.len() <= 2, "{:?}", found.medial);
    // At twice the spacing much more is thin.
    let coarse = sampled(&cow, 0.2);
    let (count, volume) = mass(&cow, 0.2, &coarse);
    assert!(count < volume, "{count} {volume}");
}

#[test]
fn round_thin_bodies_keep_their_mass() {
    for radius in [0.3, 0.45, 0.5, 0.6, 0.8, 0.95] {
        let ring = Torus::new([0.0; 3], [0.0, 0.0, 1.0], 4.0, radius).unwrap();
        let found = sampled(&ring, 1.0);
        let (count, volume) = mass(&ring, 1.0, &found);
        assert!((count - volume).abs() <= 0.5, "{radius} {count} {volume}");
    }
    let lens = Ellipsoid::new([0.0; 3], [5.0, 4.0, 0.6]).unwrap();
    let found = sampled(&lens, 1.0);
    let (count, volume) = mass(&lens, 1.0, &found);
    assert!((count - volume).abs() <= 0.5, "{count} {volume}");
    assert!(!found.medial.is_empty() && !found.on_surface.is_empty());
}

#[test]
fn any_depth() {
    let block = Cuboid::new([0.0; 2], [20.0, 8.0]).unwrap();
    for depth in [0.25, 1.5] {
        let inset = block.inset(depth).unwrap();
        let count = inset.measure().round() as usize;
        let found = sample_particles(&block, Some(inset.as_ref()), 1.0, depth).unwrap();
        assert_eq!(found.on_surface, inset.sample(count).unwrap());
    }
    // Deeper than half the strip: all of it is on the middle.
    let strip = Cuboid::new([0.0; 2], [20.0, 2.0]).unwrap();
    let found = sample_particles(&strip, None, 1.0, 1.5).unwrap();
    assert_eq!(found.medial.len(), 40);
    assert!(found.medial.iter().all(|p| (p[1] - 1.0).abs() < 0.01));
}

#[test]
fn any_unit() {
    for exponent in [-6, 6] {
        let unit = 10.0_f64.powi(exponent);
        let strip = Cuboid::new([0.0; 2], [20.0 * unit, 0.75 * unit]).unwrap();
        assert_eq!(sampled(&strip, unit).medial.len(), 15);
        let plate = Cuboid::new([0.0; 3], [10.0 * unit, 10.0 * unit, 1.5 * unit]).unwrap();
        assert_eq!(sampled(&plate, unit).on_surface.len(), 150);
        let wing = Outline::naca("0015", unit).unwrap();
        assert_eq!(sampled(&wing, 0.02 * unit).medial.len(), 1);
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let body = prism(20.0, 12.0, 15.0);
    let with_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| sampled(&body, 1.0))
    };
    assert_eq!(with_threads(1), with_threads(2));
}

#[test]
fn thickness_is_that_between_opposite_sides() {
    let at =
        |body: &dyn Surface<2>, p: [f64; 2], limit: f64| thickness(body, &body.closest(p), limit);
    let strip = Cuboid::new([0.0; 2], [20.0, 0.5]).unwrap();
    for x in [0.001, 0.1, 0.24, 0.26, 10.0] {
        assert!((at(&strip, [x, 1.0], 2.0) - 0.5).abs() < 1e-9, "{x}");
    }
    assert_eq!(at(&strip, [10.0, 1.0], 0.4), 0.4);
    let ball = Ball::new([0.3, 0.2], 0.5).unwrap();
    assert!((at(&ball, [1.0, 1.0], 5.0) - 1.0).abs() < 2e-3);
    // A corner is as thick as the body beside it: a square's is not thin, that of a wedge of 20° is.
    let square = Cuboid::new([0.0; 2], [1.0; 2]).unwrap();
    let corner = square.closest([2.0, 2.0]);
    assert_eq!(corner.feature, Feature::Corner);
    assert_eq!(thickness(&square, &corner, 0.2), 0.2);
    for d in [0.001, 0.01, 0.05] {
        assert_eq!(at(&square, [d, -1.0], 0.2), 0.2, "{d}");
    }
    let tip = at(&wedge(20.0, 20.0), [-1.0, 0.0], 2.0);
    assert!((0.1..0.3).contains(&tip), "{tip}");
    // In a wedge, the circle that touches a side at distance s from the tip: 2 s tan(α/2).
    let (sin, cos) = 10.0_f64.to_radians().sin_cos();
    let side = at(&wedge(20.0, 20.0), [3.0 * cos - sin, 3.0 * sin + cos], 5.0);
    assert!((side / (6.0 * sin / cos) - 1.0).abs() < 2e-3, "{side}");
    // Facets of a coarse circle are not thin.
    let ring: Vec<[f64; 2]> = (0..24)
        .map(|i| {
            let (sin, cos) = (f64::from(i) / 24.0 * std::f64::consts::TAU).sin_cos();
            [cos, sin]
        })
        .collect();
    let faceted = Outline::polygon(&ring).unwrap();
    for hit in faceted.scatter(200) {
        assert_eq!(thickness(&faceted, &hit, 0.5), 0.5);
    }
}

/// Which of equals is taken is not left to rounding.
#[test]
fn scene_units_do_not_matter() {
    let points = [[-0.6, -0.4], [0.7, 0.0], [-0.6, 0.5], [-0.3, 0.05]];
    let of = |unit: f64| {
        let body = Outline::polygon(&points.map(|p| point::scale(p, unit))).unwrap();
        let found = all_points(&sampled(&body, 0.07 * unit));
        found
            .into_iter()
            .map(|p| point::scale(p, 1.0 / unit))
            .collect::<Vec<_>>()
    };
    let here = of(1.0);
    for exponent in [-6, -3, -1, 1, 2, 5] {
        let there = of(10.0_f64.powi(exponent));
        assert_eq!(there.len(), here.len());
        let farthest = here
            .iter()
            .zip(&there)
            .map(|(a, b)| point::distance(*a, *b))
            .fold(0.0, f64::max);
        assert!(farthest < 1e-9, "10^{exponent}: {farthest}");
    }
}

/// How far the farthest place of the middle of a plate, its edges along the axes and its lower corner at the origin, is from any
/// point, in spacings.
fn farthest(edges: [f64; 3], points: &[[f64; 3]]) -> f64 {
    const STEPS: usize = 120;
    let at = |k: usize, edge: f64| (k as f64 + 0.5) / STEPS as f64 * edge;
    let nearest = |p: [f64; 3]| {
        let squares = points
            .iter()
            .map(|&q| point::norm_squared(point::sub(p, q)));
        squares.fold(f64::INFINITY, f64::min)
    };
    (0..STEPS * STEPS)
        .map(|k| {
            nearest([
                at(k % STEPS, edges[0]),
                at(k / STEPS, edges[1]),
                0.5 * edges[2],
            ])
        })
        .fold(0.0, f64::max)
        .sqrt()
}

#[test]
fn watertight_plates_have_no_holes() {
    // A fifth more than in a layer of squares: 0.85 spacings. With a fourth of the places some of these had larger holes, and those
    // one spacing thick a fifth more points than their mass.
    for number in 0..40 {
        let part = |k: u64| (GOLDEN * (number * 3 + k) as f64).fract();
        let thick = if number % 3 == 0 {
            1.0 + 0.004 * part(2)
        } else {
            0.02 + 0.98 * part(2)
        };
        let edges = [8.0 + 5.0 * part(0), 8.0 + 5.0 * part(1), thick];
        let plate = Mesh::from_loose(&cuboid([0.0; 3], edges)).unwrap();
        let inset = plate.inset(0.5).ok();
        let found = sample_thin(&plate, inset.as_deref(), 1.0, 0.5, Thin::Watertight).unwrap();
        let points = all_points(&found);
        let layer = edges[0] * edges[1];
        let off = (points.len() as f64 - layer).abs();
        assert!(
            off < 0.5 + 0.01 * layer,
            "{number}: {} of {layer}",
            points.len()
        );
        let weight = found.excess + plate.volume();
        assert!(
            (points.len() as f64 - weight).abs() < 0.5 + 0.01 * layer,
            "{number}: {weight}"
        );
        let far = farthest(edges, &points);
        assert!(far < 0.85, "{number}: {far}");
    }
}
