//! Level sets against formulas, and their meshes against the check of meshes.

use std::f64::consts::{PI, TAU};

use proptest::prelude::*;
use sphpack_neighbors::point;

use super::*;
use crate::{Ball, Cuboid, Mesh, Outline, Soup, Torus};

fn ball<const D: usize>(center: [f64; D], radius: f64) -> Arc<dyn Surface<D>> {
    Arc::new(Ball::new(center, radius).unwrap())
}

fn set<const D: usize>(surface: Arc<dyn Surface<D>>, cell: f64) -> LevelSet<D> {
    LevelSet::of(surface, cell).unwrap()
}

/// The mesh, which must be clean.
#[track_caller]
fn clean(set: &LevelSet<3>) -> Mesh {
    let mesh = set.mesh().unwrap().unwrap();
    let soup = Soup::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).unwrap();
    let report = soup.check();
    assert!(report.is_clean(), "{:?}", report.defects);
    mesh
}

/// The volume of what two balls of radii `r` and `s` at distance `d` have in common.
fn lens(r: f64, s: f64, d: f64) -> f64 {
    PI * (r + s - d).powi(2) * (d * d + 2.0 * d * (r + s) - 3.0 * (r - s).powi(2)) / (12.0 * d)
}

/// The greatest error of the values within a cell of a sphere of radius 1, and of the normals.
fn errors<const D: usize>(cell: f64) -> (f64, f64) {
    let level = set(ball([0.1; D], 1.0), cell);
    let (mut off, mut lean) = (0.0_f64, 0.0_f64);
    for n in 0..4000 {
        let n = f64::from(n) + 0.5;
        let part = [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|a| (a * n) % 1.0 - 0.5);
        let Some(out) = point::unit(std::array::from_fn::<f64, D, _>(|k| part[k])) else {
            continue;
        };
        let height = (2.0 * ((0.754_877 * n) % 1.0) - 1.0) * cell;
        let p = point::add_scaled([0.1; D], 1.0 + height, out);
        off = off.max((level.value(p) - height).abs());
        lean = lean.max(point::distance(level.normal(p).unwrap(), out));
    }
    (off, lean)
}

#[test]
fn a_spheres_distance_is_right_to_second_order() {
    fn check<const D: usize>() {
        let found = [0.1, 0.05, 0.025].map(errors::<D>);
        for (k, (off, lean)) in found.into_iter().enumerate() {
            let cell = 0.1 / f64::from(1 << k);
            let bound = (D - 1) as f64 * cell * cell / 8.0;
            // The nearest node to the middle bends most.
            assert!(off <= bound / (1.0 - 4.0 * cell), "{cell}: {off}, {bound}");
            assert!(off > 0.5 * bound, "{cell}: {off}, {bound}");
            assert!(lean < 4.0 * cell * cell, "{cell}: {lean}");
        }
        for pair in found.windows(2) {
            assert!((3.4..4.6).contains(&(pair[0].0 / pair[1].0)), "{found:?}");
        }
    }
    check::<2>();
    check::<3>();
}

#[test]
fn far_away_only_the_sign_is_known_and_memory_follows_the_surface() {
    let level = set(ball([0.0; 3], 1.0), 0.02);
    assert_eq!(level.value([0.1, 0.2, 0.3]), -level.band());
    assert_eq!(level.value([7.0, 0.2, 0.3]), level.band());
    assert_eq!(level.value([0.0, -1e30, f64::MAX]), level.band());
    assert!(level.inside([0.0; 3]) && !level.inside([0.0, 1.01, 0.0]));
    assert!(level.normal([0.0; 3]).is_none() && level.value([f64::NAN; 3]).is_nan());
    let per_cell = |cell: f64| {
        let bytes = set(ball([0.0; 3], 1.0), cell).bytes();
        bytes as f64 * cell * cell / (4.0 * PI)
    };
    let found = [0.02, 0.01].map(per_cell);
    assert!(
        found.iter().all(|&b| (100.0..180.0).contains(&b)),
        "{found:?}"
    );
}

#[test]
fn what_cannot_be() {
    for cell in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300, 1e-5] {
        let error = LevelSet::of(ball([0.0; 3], 1.0), cell).unwrap_err();
        assert!(error.to_string().contains("cell"), "{error}");
    }
    let (a, b) = (set(ball([0.0; 2], 1.0), 0.1), set(ball([0.0; 2], 1.0), 0.2));
    assert!(a.union(&b).is_err());
    // Too small for any node to be in it.
    let dot = set(ball([0.0; 3], 0.01), 1.0);
    assert!(dot.is_empty() && dot.mesh().unwrap().is_none());
}

#[test]
fn meshes_of_smooth_bodies_converge() {
    let torus = Torus::new([0.0; 3], [1.0, 2.0, 3.0], 1.0, 0.4).unwrap();
    let bodies: [(Arc<dyn Surface<3>>, &str, f64); 2] = [
        (ball([0.2, 0.1, 0.0], 1.0), "ball", 1.0),
        (Arc::new(torus), "torus", 0.4),
    ];
    for (body, name, radius) in bodies {
        let found = [0.2, 0.1, 0.05].map(|cell| {
            let mesh = clean(&set(Arc::clone(&body), cell));
            let features = mesh.features();
            // Where a cell turns the surface by less than the angle of a sharp edge.
            let is_smooth = features.corners.is_empty() && features.edges.is_empty();
            assert!(is_smooth || cell > 0.3 * radius, "{name} {cell}");
            // The mesh moved inward, as particles use it.
            let depth = 0.1 * radius;
            let (inset, exact) = (mesh.inset(depth).unwrap(), body.inset(depth).unwrap());
            let off = inset.volume() / exact.volume() - 1.0;
            assert!(
                off.abs() < 0.02 + 2.0 * cell * cell / radius,
                "{name} {cell}: inset {off}"
            );
            let furthest = (mesh.vertices().iter())
                .map(|&v| body.closest(v).distance.abs())
                .fold(0.0, f64::max);
            (
                mesh.volume() / body.volume() - 1.0,
                furthest,
                mesh.triangles().len(),
            )
        });
        eprintln!("{name}: {found:?}");
        for (k, (volume, furthest, _)) in found.into_iter().enumerate() {
            let cell: f64 = 0.2 / f64::from(1 << k);
            assert!(
                volume.abs() < 0.25 * cell * cell / radius,
                "{name} {cell}: {volume}"
            );
            assert!(
                furthest < 0.4 * cell * cell / radius,
                "{name} {cell}: {furthest}"
            );
        }
    }
}

#[test]
fn boxes_keep_their_edges() {
    let cube = Arc::new(Cuboid::new([0.0; 3], [1.0, 0.8, 0.9]).unwrap());
    let mesh = clean(&set(cube.clone(), 0.07));
    assert!(
        (mesh.volume() / 0.72 - 1.0).abs() < 1e-9,
        "{}",
        mesh.volume()
    );
    assert_eq!(mesh.features().corners.len(), 8);
    // And where two bodies meet: a corner cut out.
    let other = Arc::new(Cuboid::new([0.42, 0.31, 0.53], [2.0; 3]).unwrap());
    let left = clean(&set(cube, 0.07).minus(&set(other, 0.07)).unwrap());
    let exact = 0.72 - 0.58 * 0.49 * 0.37;
    assert!(
        (left.volume() / exact - 1.0).abs() < 1e-6,
        "{}",
        left.volume()
    );
}

#[test]
fn two_balls() {
    let exact = lens(1.0, 0.8, 1.1);
    let [a, b] = [4.0 / 3.0 * PI, 4.0 / 3.0 * PI * 0.512];
    let found = [0.1, 0.05].map(|cell| {
        let (first, second) = (
            set(ball([0.0; 3], 1.0), cell),
            set(ball([0.9, 0.5, 0.4_f64.sqrt() * 0.614], 0.8), cell),
        );
        let d = point::norm([0.9, 0.5, 0.4_f64.sqrt() * 0.614]);
        let exact = lens(1.0, 0.8, d);
        let both = clean(&first.intersection(&second).unwrap()).volume();
        let whole = clean(&first.union(&second).unwrap()).volume();
        let left = clean(&first.minus(&second).unwrap());
        // What particles are packed on: the surface two cells inside. A ball less two cells, without one of two more.
        let depth = 2.0 * cell;
        let (r, s) = (1.0 - depth, 0.8 + depth);
        let cap = |r: f64, s: f64| TAU * r * (r - (d * d + r * r - s * s) / (2.0 * d));
        let area = 2.0 * TAU * r * r - cap(r, s) + cap(s, r);
        let volume = 2.0 / 3.0 * TAU * r.powi(3) - lens(r, s, d);
        let inset = left.inset(depth).unwrap();
        let off = [inset.measure() / area - 1.0, inset.volume() / volume - 1.0];
        assert!(off.iter().all(|x| x.abs() < 0.02), "inset {off:?}");
        let left = left.volume();
        [both / exact, whole / (a + b - exact), left / (a - exact)].map(|x| x - 1.0)
    });
    eprintln!("balls: {found:?}, lens {exact}");
    for (found, cell) in found.into_iter().zip([0.1, 0.05]) {
        assert!(found.iter().all(|x| x.abs() < cell * cell), "{found:?}");
    }
}

#[test]
fn disjoint_bodies_and_holes() {
    let cell = 0.1;
    let (a, b) = (
        set(ball([0.0; 3], 1.0), cell),
        set(ball([3.0, 0.0, 0.0], 0.5), cell),
    );
    let volume = |set: &LevelSet<3>| clean(set).volume();
    assert!(a.intersection(&b).unwrap().is_empty());
    assert_eq!(volume(&a.minus(&b).unwrap()), volume(&a));
    let apart = (volume(&a.union(&b).unwrap()) - volume(&a) - volume(&b)).abs();
    assert!(apart < 1e-12, "{apart}");
    // Within: a cavity.
    let core = set(ball([0.1, 0.0, 0.0], 0.5), cell);
    let hollow = volume(&a) - volume(&core) - volume(&a.minus(&core).unwrap());
    assert!(hollow.abs() < 1e-12, "{hollow}");
    assert!(core.minus(&a).unwrap().is_empty());
    assert_eq!(volume(&a.union(&core).unwrap()), volume(&a));
}

/// Any value at any node: the worst that a grid can hold.
#[derive(Debug)]
struct Noise {
    seed: u64,
    cell: f64,
}

impl Field<3> for Noise {
    fn at(&self, p: [f64; 3]) -> (f64, [f64; 3]) {
        let mut state = self.seed;
        let mut next = |x: u64| {
            state = (state ^ x).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            state ^= state >> 29;
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let node = p.map(|x| (x / self.cell).floor() as i64 as u64);
        for i in node {
            next(i);
        }
        let value = next(7) * self.cell;
        let normal = point::unit([next(1), next(2), next(3)]).unwrap_or([1.0, 0.0, 0.0]);
        let edge = p.iter().fold(0.0_f64, |a, x| a.max(x.abs())) - 4.0 * self.cell;
        if edge > 0.0 {
            (edge, normal)
        } else {
            (value, normal)
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn noise_gives_closed_meshes_too(seed in any::<u64>()) {
        let noise = Arc::new(Noise { seed, cell: 0.3 });
        let bounds = Bounds::new([-1.2; 3], [1.2; 3]);
        let level = LevelSet::of_field(noise, 0.3, &bounds, |_| 0.0).unwrap();
        prop_assume!(!level.is_empty());
        let mesh = level.mesh().unwrap().unwrap();
        let soup = Soup::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).unwrap();
        let report = soup.check();
        let shape = [
            crate::DefectKind::OpenEdge,
            crate::DefectKind::NonManifold,
            crate::DefectKind::Inconsistent,
            crate::DefectKind::SelfIntersection,
            crate::DefectKind::Overlap,
            crate::DefectKind::Contact,
            crate::DefectKind::Duplicate,
        ];
        prop_assert!(shape.iter().all(|&kind| report.defect(kind).is_none()), "{:?}", report.defects);
    }

    #[test]
    fn booleans_hold_what_they_should(
        x in [-0.5..1.5, -0.5..1.5, -0.5..1.5],
        r in 0.4..1.0,
        p in [-1.0..2.0, -1.0..2.0, -1.0..2.0],
        cell in 0.06..0.2,
    ) {
        let (a, b) = (set(ball([0.0; 3], 0.7), cell), set(ball(x, r), cell));
        let union = a.union(&b).unwrap();
        let both = a.intersection(&b).unwrap();
        let left = a.minus(&b).unwrap();
        let (va, vb) = (a.value(p), b.value(p));
        // Interpolation keeps the order, but the lesser of two at each node is not the lesser of both between.
        prop_assert!(union.value(p) <= va.min(vb) + 1e-12 && both.value(p) >= va.max(vb) - 1e-12);
        prop_assert!(!a.inside(p) || union.inside(p));
        prop_assert!(!both.inside(p) || (a.inside(p) && b.inside(p)));
        prop_assert!(left.value(p) >= va.max(-vb) - 1e-12);
        // Where each was made of its own level set there is nothing of both.
        prop_assert!(left.intersection(&b).unwrap().is_empty());
        prop_assert!(a.minus(&a).unwrap().is_empty());
        let volume = |set: &LevelSet<3>| set.mesh().map(|mesh| mesh.map_or(0.0, |m| m.volume()));
        let parts = volume(&a).unwrap() + volume(&b).unwrap();
        // A lens thinner than a cell is no body of the grid, and is then missing in the one sum only.
        if let (Ok(union), Ok(both)) = (volume(&union), volume(&both)) {
            prop_assert!((union + both - parts).abs() < 1.5 * cell * cell, "{} {} {}", union, both, parts);
        }
    }

    #[test]
    fn the_plane_too(
        x in [-1.0..1.0, -1.0..1.0],
        p in [-1.0..2.0, -1.0..2.0],
        cell in 0.02..0.1,
    ) {
        let square = Outline::polygon(&[[0.0, 0.0], [1.0, 0.1], [0.9, 1.0], [0.1, 0.8]]).unwrap();
        let (a, b) = (set(Arc::new(square.clone()), cell), set(ball(x, 0.6), cell));
        let exact = square.closest(p).distance;
        if exact.abs() < a.band() - 2.0 * cell {
            prop_assert!((a.value(p) - exact).abs() < cell, "{} {}", a.value(p), exact);
        } else {
            prop_assert!(a.value(p) * exact > 0.0);
        }
        let union = a.union(&b).unwrap().value(p);
        prop_assert!(union <= a.value(p).min(b.value(p)) + 1e-12);
        prop_assert!(a.minus(&b).unwrap().intersection(&b).unwrap().is_empty());
    }
}

#[test]
fn within_a_window_all_is_as_without_one() {
    let ring = || Arc::new(Torus::new([0.1, 0.0, 0.05], [0.2, 0.1, 1.0], 1.0, 0.4).unwrap());
    let window = Bounds::new([-0.3, 0.2, -0.5], [2.0, 0.9, 0.2]);
    let (whole, part) = (
        set(ring(), 0.05),
        LevelSet::within(ring(), 0.05, &window).unwrap(),
    );
    assert!(part.bytes() < whole.bytes() / 2);
    let inner = window.grown(-part.band() - part.cell());
    let box_of_it = Cuboid::new(window.min, window.max).unwrap();
    let mut surface = 0;
    for n in 0..20_000 {
        let n = f64::from(n) + 0.5;
        let part_of = [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|a| (a * n) % 1.0);
        let p = std::array::from_fn(|k| -1.7 + 3.5 * part_of[k]);
        let value = part.value(p);
        if inner.contains(p) {
            assert_eq!(value.to_bits(), whole.value(p).to_bits(), "{p:?}");
            surface += usize::from(value.abs() < part.band());
        } else if box_of_it.closest(p).distance > part.cell() {
            assert!(value > 0.0, "{p:?}");
        }
    }
    assert!(surface > 30, "{surface}");
    // A whole body in the window is the same, and one beside it is none.
    let around = Bounds::new([-3.0; 3], [3.0; 3]);
    assert_eq!(
        LevelSet::within(ring(), 0.05, &around).unwrap().bytes(),
        whole.bytes()
    );
    let beside = Bounds::new([2.0; 3], [3.0; 3]);
    assert!(LevelSet::within(ring(), 0.05, &beside).unwrap().is_empty());
    assert!(
        LevelSet::within(ring(), 0.05, &beside)
            .unwrap()
            .mesh()
            .unwrap()
            .is_none()
    );
}

/// A planet costs what the window holds of it, and its ground is where the formula says.
#[test]
fn a_bodys_size_beyond_the_window_costs_nothing() {
    let window = Bounds::new([-2.0; 3], [2.0; 3]);
    let ground =
        |radius: f64| LevelSet::within(ball([0.0, 0.0, -radius], radius), 0.25, &window).unwrap();
    let small = ground(30.0);
    for radius in [1e3, 1e6] {
        let large = ground(radius);
        assert!(
            large.bytes() < 2 * small.bytes(),
            "{radius}: {}",
            large.bytes()
        );
        let mesh = clean(&large);
        let exact = 32.0 - 16.0 * (4.0 / 3.0) / radius;
        assert!(
            (mesh.volume() - exact).abs() < 1e-3,
            "{radius}: {}",
            mesh.volume()
        );
    }
}
