//! Every defect on small meshes, and what becomes of it.

use proptest::prelude::*;
use sphpack_neighbors::point;

use super::*;
use crate::mesh::tests::icosphere;
use crate::{Mesh, MeshError, Similarity, Surface};

fn soup_of(mesh: &Mesh) -> Soup {
    Soup::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).unwrap()
}

fn sphere(levels: usize) -> Soup {
    soup_of(&icosphere(levels))
}

/// A sphere of radius `r` about `c`.
pub(super) fn ball(levels: usize, r: f64, c: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let at = |p: [f64; 3]| point::add_scaled(c, r, p);
    sphere(levels).loose().iter().map(|t| t.map(at)).collect()
}

/// A box's twelve triangles, facing out.
pub(crate) fn cuboid(min: [f64; 3], max: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let corner = |k: usize| std::array::from_fn(|a| if k >> a & 1 == 1 { max[a] } else { min[a] });
    [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ]
    .iter()
    .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
    .map(|t| t.map(corner))
    .collect()
}

fn turned(triangles: &[[[f64; 3]; 3]]) -> Vec<[[f64; 3]; 3]> {
    triangles.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

fn joined(parts: &[&[[[f64; 3]; 3]]]) -> Soup {
    Soup::from_loose(&parts.concat()).unwrap()
}

fn kinds(report: &MeshReport) -> Vec<(DefectKind, usize)> {
    report.defects.iter().map(|d| (d.kind, d.count)).collect()
}

#[track_caller]
fn volume(soup: &Soup) -> f64 {
    soup.body().unwrap().mesh.volume()
}

#[test]
fn clean_meshes_stay_as_they_are() {
    let soup = sphere(3);
    let report = soup.check();
    assert!(report.is_clean() && report.defects.is_empty() && report.holes.is_empty());
    assert_eq!((report.triangles, report.vertices), (1280, 642));
    assert_eq!(report.shells.len(), 1);
    assert_eq!(report.shells[0].role, ShellRole::Body);
    let repaired = soup.repaired(HoleLimit::Small);
    assert!(repaired.done.is_empty() && repaired.soup == soup);
    let body = soup.body().unwrap();
    assert!(body.done.is_empty());
    assert_eq!(body.mesh.triangles(), icosphere(3).triangles());
}

#[test]
fn small_holes_are_closed_and_large_ones_told() {
    let clean = sphere(4);
    let whole = volume(&clean);
    let mut holed = clean.clone();
    let mut n = 0;
    holed.triangles.retain(|_| {
        n += 1;
        n % 256 != 100
    });
    let report = holed.check();
    assert_eq!(kinds(&report), [(DefectKind::OpenEdge, 60)]);
    assert_eq!(report.holes.len(), 20);
    assert_eq!(report.shells[0].role, ShellRole::Undecided);
    let body = holed.body().unwrap();
    assert!(matches!(
        body.done[..],
        [Repair::Filled {
            holes: 20,
            triangles: 20,
            ..
        }]
    ));
    assert!((body.mesh.volume() / whole - 1.0).abs() < 1e-12);
    // The polar cap, as large as the body's tenth across.
    let mut capless = clean.clone();
    capless
        .triangles
        .retain(|t| t.iter().any(|&v| clean.vertices[v as usize][2] < 0.9));
    let error = capless.body().unwrap_err().to_string();
    for part in ["not closed", "1 hole of", "across", "close the holes"] {
        assert!(error.contains(part), "{error}");
    }
    let closed = capless.repaired(HoleLimit::Across(1.0));
    assert!(closed.report.is_clean(), "{:?}", closed.report.defects);
    let part = closed.body().unwrap().mesh.volume() / whole;
    assert!((0.985..0.999).contains(&part), "{part}");
}

#[test]
fn two_holes_that_meet_in_a_vertex() {
    let clean = sphere(2);
    let mut holed = clean.clone();
    // Opposite triangles around vertex 0, and more holes than one at a rim.
    let around: Vec<usize> = (0..320)
        .filter(|&t| clean.triangles[t].contains(&0))
        .collect();
    let first = clean.triangles[around[0]];
    let far = around
        .iter()
        .copied()
        .find(|&t| {
            clean.triangles[t]
                .iter()
                .filter(|v| first.contains(v))
                .count()
                == 1
        })
        .unwrap();
    let mut t = 0;
    holed.triangles.retain(|_| {
        t += 1;
        t - 1 != around[0] && t - 1 != far
    });
    let repaired = holed.repaired(HoleLimit::Across(1.0));
    assert!(repaired.report.is_clean(), "{:?}", repaired.report.defects);
    assert_eq!(repaired.soup.triangles.len(), 320);
    assert!(matches!(
        repaired.done[..],
        [Repair::Filled {
            holes: 2,
            triangles: 2,
            ..
        }]
    ));
    assert!((volume(&repaired.soup) / volume(&clean) - 1.0).abs() < 1e-12);
}

#[test]
fn a_loop_too_long_to_search_gets_a_fan() {
    // A cone's base of 400 points.
    let n = 400;
    let mut vertices = vec![[0.0, 0.0, 1.0]];
    vertices.extend((0..n).map(|i| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
        [cos, sin, 0.0]
    }));
    let triangles = (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect();
    let open = Soup::new(vertices, triangles).unwrap();
    let closed = open.repaired(HoleLimit::Across(3.0));
    assert!(closed.report.is_clean());
    assert_eq!(closed.soup.vertices.len(), 402);
    let volume = closed.body().unwrap().mesh.volume();
    assert!((volume / (std::f64::consts::PI / 3.0) - 1.0).abs() < 1e-3);
}

#[test]
fn inside_out_and_cavities() {
    let (outer, inner) = (ball(2, 1.0, [0.0; 3]), ball(2, 0.5, [0.1, 0.0, 0.0]));
    let (v_outer, v_inner) = (volume(&joined(&[&outer])), volume(&joined(&[&inner])));
    let inverted = joined(&[&turned(&outer)]);
    assert_eq!(kinds(&inverted.check()), [(DefectKind::Inverted, 1)]);
    let body = inverted.body().unwrap();
    assert_eq!(body.done, [Repair::TurnedShells { shells: 1, of: 1 }]);
    assert!((body.mesh.volume() - v_outer).abs() < 1e-12);
    // A cavity faces inward.
    let hollow = joined(&[&outer, &turned(&inner)]);
    let report = hollow.check();
    assert!(report.is_clean());
    assert_eq!(report.shells[1].role, ShellRole::Cavity);
    assert_eq!(report.shells[1].inside, Some(0));
    assert!((volume(&hollow) - (v_outer - v_inner)).abs() < 1e-12);
    // All inverted it is still one.
    let both = joined(&[&turned(&outer), &inner]);
    let body = both.body().unwrap();
    assert_eq!(body.done, [Repair::TurnedShells { shells: 2, of: 2 }]);
    assert!((body.mesh.volume() - (v_outer - v_inner)).abs() < 1e-12);
    // A body within the cavity that faces inward.
    let core = ball(1, 0.2, [0.1, 0.0, 0.0]);
    let v_core = volume(&joined(&[&core]));
    let three = joined(&[&turned(&core), &outer, &turned(&inner)]);
    let body = three.body().unwrap();
    assert_eq!(body.done, [Repair::TurnedShells { shells: 1, of: 3 }]);
    assert!((body.mesh.volume() - (v_outer - v_inner + v_core)).abs() < 1e-12);
    // One of two bodies beside each other.
    let apart = joined(&[&outer, &turned(&ball(2, 1.0, [3.0, 0.0, 0.0]))]);
    assert!((volume(&apart) - 2.0 * v_outer).abs() < 1e-9);
}

#[test]
fn doubled_triangles_and_inner_walls() {
    let cube = cuboid([0.0; 3], [1.0; 3]);
    let twice = joined(&[&cube, &cube]);
    assert!(twice.check().defect(DefectKind::Duplicate).is_some());
    let body = twice.body().unwrap();
    assert_eq!(body.done, [Repair::DroppedDuplicates(12)]);
    assert!((body.mesh.volume() - 1.0).abs() < 1e-12);
    // Written with both sides.
    let both = joined(&[&cube, &turned(&cube)]);
    assert!((volume(&both) - 1.0).abs() < 1e-12);
    // A few triangles twice.
    let some = joined(&[&cube, &cube[3..6]]);
    assert_eq!(some.body().unwrap().done, [Repair::DroppedDuplicates(3)]);
    // Two cubes side by side, the wall between them there from both sides, in the same triangles.
    let mirrored: Vec<[[f64; 3]; 3]> = cube
        .iter()
        .map(|&[a, b, c]| [a, c, b].map(|p| [2.0 - p[0], p[1], p[2]]))
        .collect();
    let pair = joined(&[&cube, &mirrored]);
    assert!(pair.check().defect(DefectKind::NonManifold).is_some());
    let body = pair.body().unwrap();
    assert_eq!(body.done, [Repair::DroppedWalls(2)]);
    assert!((body.mesh.volume() - 2.0).abs() < 1e-12);
}

#[test]
fn degenerate_triangles_and_slivers() {
    let cube = cuboid([0.0; 3], [1.0; 3]);
    let mut more = cube.clone();
    more.push([[0.0; 3], [0.0; 3], [1.0; 3]]);
    let soup = Soup::from_loose(&more).unwrap();
    assert_eq!(kinds(&soup.check()), [(DefectKind::Degenerate, 1)]);
    assert!((volume(&soup) - 1.0).abs() < 1e-12);
    // A side split on one side only, the gap closed by a triangle without area.
    let mut split = cube.clone();
    let [a, b, c] = split.remove(0);
    let m = point::scale(point::add(a, b), 0.5);
    split.extend([[a, m, c], [m, b, c], [a, b, m]]);
    let soup = Soup::from_loose(&split).unwrap();
    assert_eq!(kinds(&soup.check()), [(DefectKind::Sliver, 1)]);
    assert!((volume(&soup) - 1.0).abs() < 1e-12);
    // The same with the gap open.
    split.pop();
    let soup = Soup::from_loose(&split).unwrap();
    assert_eq!(kinds(&soup.check()), [(DefectKind::OpenEdge, 3)]);
    let repaired = soup.repaired(HoleLimit::Across(1.1));
    assert!((repaired.body().unwrap().mesh.volume() - 1.0).abs() < 1e-12);
}

#[test]
fn what_cannot_be_oriented_is_refused() {
    // A Möbius strip of five triangles.
    let vertices = (0..5)
        .map(|i| {
            let a = f64::from(i) * 1.3;
            [a.cos(), a.sin(), 0.3 * f64::from(i * i % 3)]
        })
        .collect();
    let triangles = (0..5).map(|i| [i, (i + 1) % 5, (i + 2) % 5]).collect();
    let strip = Soup::new(vertices, triangles).unwrap();
    assert!(strip.body().is_err());
    assert!(Soup::new(vec![], vec![]).unwrap().body().is_err());
    let flat = Soup::from_loose(&[
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    ]);
    assert!(flat.unwrap().body().is_err());
    let far = Soup::from_loose(&[[[f64::NAN; 3], [1.0; 3], [0.0; 3]]]);
    assert!(matches!(
        far,
        Err(GeometryError::Mesh(MeshError::NotFinite { .. }))
    ));
}

#[test]
fn crossings_are_found_exactly() {
    let a = ball(2, 1.0, [0.0; 3]);
    let report = joined(&[&a, &ball(2, 1.0, [0.7, 0.1, 0.2])]).check();
    assert_eq!(kinds(&report), [(DefectKind::Overlap, 1)]);
    let report = joined(&[&a, &ball(2, 1.0, [2.3, 0.1, 0.2])]).check();
    assert!(report.is_clean());
    let report = joined(&[&a, &ball(2, 0.4, [0.2, 0.1, 0.2])]).check();
    assert_eq!(kinds(&report), [(DefectKind::Redundant, 1)]);
    // Boxes with common planes: overlapping, or only touching.
    let unit = cuboid([0.0; 3], [1.0; 3]);
    for (shift, touches) in [(0.5, true), (1.0, true), (1.5, false)] {
        let other = cuboid([shift, 0.2, 0.2], [shift + 1.0, 0.8, 1.0]);
        let report = joined(&[&unit, &other]).check();
        assert_eq!(!report.is_clean(), touches, "{shift}: {:?}", report.defects);
    }
    // A vertex of a sphere pushed through the other side.
    let mut bent = sphere(2);
    let v = bent.vertices[0];
    bent.vertices[0] = point::scale(v, -1.2);
    let report = bent.check();
    assert!(report.defect(DefectKind::SelfIntersection).is_some());
}

#[track_caller]
fn joins(parts: &[&[[[f64; 3]; 3]]], expected: f64, tolerance: f64) -> Mesh {
    let body = joined(parts).body().unwrap();
    assert!(
        body.done
            .iter()
            .any(|d| matches!(d, Repair::Joined { shells, .. } if *shells == parts.len())),
        "{:?}",
        body.done
    );
    let volume = body.mesh.volume();
    assert!(
        (volume - expected).abs() < tolerance,
        "{volume}, not {expected}"
    );
    body.mesh
}

#[test]
fn overlapping_shells_become_one() {
    let unit = cuboid([0.0; 3], [1.0; 3]);
    // Boxes: one sticks into the other, through it, through one triangle of a side only.
    let stick = cuboid([0.3, 0.2, 0.4], [1.5, 0.7, 0.8]);
    let mesh = joins(&[&unit, &stick], 1.0 + 0.5 * 0.5 * 0.4, 1e-12);
    assert!((mesh.measure() - (6.0 + 2.0 * 0.5 * 0.9)).abs() < 1e-9);
    joins(&[&stick, &unit], 1.1, 1e-12);
    let bar = cuboid([-1.0, 0.41, 0.42], [2.0, 0.61, 0.64]);
    joins(&[&unit, &bar], 1.0 + 2.0 * 0.2 * 0.22, 1e-12);
    let needle = cuboid([-1.0, 0.7, 0.1], [2.0, 0.8, 0.2]);
    joins(&[&unit, &needle], 1.0 + 2.0 * 0.01, 1e-12);
    // Three bars through one place, the sides of each their own: points where three triangles meet.
    let along = |k: usize, half: f64, end: f64| {
        let (mut a, mut b) = ([-half; 3], [half; 3]);
        (a[k], b[k]) = (-end, end + 0.1);
        cuboid(a, b)
    };
    let (l, m, n) = (along(0, 0.5, 2.0), along(1, 0.47, 2.2), along(2, 0.43, 2.1));
    let alone = 4.1 * 1.0 + 4.5 * 0.94_f64.powi(2) + 4.3 * 0.86_f64.powi(2);
    let [lm, mn, nl] = [0.94 * 0.94 * 1.0, 0.86 * 0.86 * 0.94, 0.86 * 0.86 * 1.0];
    let core = 0.86 * 0.86 * 0.94;
    joins(&[&l, &m, &n], alone - lm - mn - nl + core, 1e-9);
    // Spheres: what they have in common once.
    let (a, b) = (ball(3, 1.0, [0.0; 3]), ball(3, 1.0, [1.2, 0.1, 0.06]));
    let d: f64 = point::norm([1.2, 0.1, 0.06]);
    let lens = std::f64::consts::PI * (4.0 + d) * (2.0 - d).powi(2) / 12.0;
    let one = volume(&joined(&[&a]));
    let mesh = joins(&[&a, &b], 2.0 * one - lens, 0.02 * one);
    assert!(mesh.inside([0.6, 0.0, 0.0]) && !mesh.inside([0.6, 0.9, 0.0]));
    // Inverted first.
    let mended = joined(&[&turned(&a), &b]).body().unwrap();
    assert!((mended.mesh.volume() - mesh.volume()).abs() < 1e-12);
}

#[test]
fn touching_shells_become_one() {
    let unit = cuboid([0.0; 3], [1.0; 3]);
    // Common planes.
    joins(
        &[&unit, &cuboid([0.5, 0.0, 0.0], [1.5, 1.0, 1.0])],
        1.5,
        1e-4,
    );
    // A smaller box on a side.
    let body = joined(&[&unit, &cuboid([1.0, 0.2, 0.3], [2.0, 0.8, 0.9])])
        .body()
        .unwrap();
    assert_eq!(body.done, [Repair::DroppedFlush(1)]);
    assert!((body.mesh.volume() - 1.36).abs() < 1e-12);
    assert!((body.mesh.measure() - 8.4).abs() < 1e-12);
    // The same box again, its sides cut otherwise: the edges have four triangles, and nothing tells which go together.
    let same: Vec<[[f64; 3]; 3]> = unit
        .iter()
        .map(|&[a, b, c]| [a, c, b].map(|p| [1.0 - p[0], p[1], p[2]]))
        .collect();
    let error = joined(&[&unit, &same]).body().unwrap_err().to_string();
    assert!(
        error.contains("12 edges shared by more than two triangles"),
        "{error}"
    );
}

#[test]
fn a_shell_within_another_adds_nothing() {
    let (outer, inner) = (ball(2, 1.0, [0.0; 3]), ball(1, 0.4, [0.1, 0.2, 0.0]));
    joins(&[&outer, &inner], volume(&joined(&[&outer])), 1e-12);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn turning_gives_back_the_clean_mesh_in_any_position(
        flips in prop::collection::vec(any::<bool>(), 320),
        axis in [-1.0..1.0, -1.0..1.0, 0.1..1.0],
        degrees in 0.0..360.0,
        shift in [-3.0..3.0, -3.0..3.0, -3.0..3.0],
    ) {
        let place = Similarity::<3>::new(1.7, axis, degrees, shift).unwrap();
        let clean = soup_of(&icosphere(2).transformed(&place).unwrap());
        let mut flipped = clean.clone();
        for (t, &flip) in flipped.triangles.iter_mut().zip(&flips) {
            if flip {
                t.swap(1, 2);
            }
        }
        let repaired = flipped.repaired(HoleLimit::Small);
        prop_assert!(repaired.report.is_clean());
        let canonical = |soup: &Soup| {
            let mut all: Vec<[u32; 3]> = soup.triangles.iter().map(|&[a, b, c]| {
                [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap()
            }).collect();
            all.sort_unstable();
            all
        };
        prop_assert_eq!(canonical(&repaired.soup), canonical(&clean));
    }

    #[test]
    fn overlaps_are_found_in_any_position(
        axis in [-1.0..1.0, -1.0..1.0, 0.1..1.0],
        degrees in 0.0..360.0,
        gap in 0.001..0.5,
        overlaps in any::<bool>(),
    ) {
        let place = Similarity::<3>::new(1.0, axis, degrees, [0.3, -0.2, 5.0]).unwrap();
        let shift = if overlaps { 2.0 - gap } else { 2.0 + gap };
        // Boxes, so that the gap is known.
        let soup = joined(&[
            &cuboid([-1.0; 3], [1.0; 3]),
            &cuboid([shift - 1.0, -0.7, -0.6], [shift + 1.0, 0.5, 0.8]),
        ]);
        let moved = Soup::new(
            soup.vertices.iter().map(|&v| place.point(v)).collect(),
            soup.triangles.clone(),
        ).unwrap();
        let report = moved.check();
        prop_assert_eq!(report.defect(DefectKind::Overlap).is_some(), overlaps);
        prop_assert_eq!(report.is_clean(), !overlaps);
        let expected = 8.0 + 2.0 * 1.2 * 1.4 - if overlaps { gap * 1.2 * 1.4 } else { 0.0 };
        prop_assert!((moved.body().unwrap().mesh.volume() - expected).abs() < 1e-6);
    }
}
