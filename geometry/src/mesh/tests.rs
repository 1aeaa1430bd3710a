//! Meshes against brute force and against the shapes they stand for.

use std::collections::HashMap;

use proptest::prelude::*;
use sphpack_neighbors::point;

use super::*;
use crate::surface::{Feature, Surface};
use crate::{Ball, Cuboid, InsetError, ParameterError};

/// A sphere of radius 1: an icosahedron with every triangle cut in four, `levels` times.
pub(crate) fn icosphere(levels: usize) -> Mesh {
    let g = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    for (a, b) in [(1.0, g), (1.0, -g), (-1.0, g), (-1.0, -g)] {
        vertices.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    // Faces: triples of vertices at the edge length 2.
    let near =
        |i: usize, j: usize, v: &[[f64; 3]]| (point::distance(v[i], v[j]) - 2.0).abs() < 1e-9;
    let mut triangles = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if near(i, j, &vertices) && near(j, k, &vertices) && near(i, k, &vertices) {
                    let n = point::cross(
                        point::sub(vertices[j], vertices[i]),
                        point::sub(vertices[k], vertices[i]),
                    );
                    let out = point::dot(n, vertices[i]) > 0.0;
                    triangles.push(if out {
                        [i as u32, j as u32, k as u32]
                    } else {
                        [i as u32, k as u32, j as u32]
                    });
                }
            }
        }
    }
    for v in &mut vertices {
        *v = point::unit(*v).unwrap();
    }
    for _ in 0..levels {
        let mut middle: HashMap<(u32, u32), u32> = HashMap::new();
        let mut finer = Vec::new();
        for t in triangles {
            let m: [u32; 3] = std::array::from_fn(|k| {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                *middle.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    vertices.push(
                        point::unit(point::add(vertices[a as usize], vertices[b as usize]))
                            .unwrap(),
                    );
                    vertices.len() as u32 - 1
                })
            });
            finer.extend([
                [t[0], m[0], m[2]],
                [m[0], t[1], m[1]],
                [m[2], m[1], t[2]],
                m,
            ]);
        }
        triangles = finer;
    }
    Mesh::new(vertices, triangles).unwrap()
}

fn cube_parts(n: usize) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    // Six faces of n × n squares on [−1, 1]³, welded.
    let mut loose = Vec::new();
    let step = 2.0 / n as f64;
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            for i in 0..n {
                for j in 0..n {
                    let at = |a: usize, b: usize| {
                        let mut p = [0.0; 3];
                        p[axis] = side;
                        p[(axis + 1) % 3] = step * a as f64 - 1.0;
                        p[(axis + 2) % 3] = step * b as f64 - 1.0;
                        p
                    };
                    let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                    if side > 0.0 {
                        loose.extend([[a, b, c], [a, c, d]]);
                    } else {
                        loose.extend([[a, c, b], [a, d, c]]);
                    }
                }
            }
        }
    }
    weld::exact(&loose)
}

fn cube(n: usize) -> Mesh {
    let (vertices, triangles) = cube_parts(n);
    Mesh::new(vertices, triangles).unwrap()
}

/// An L-shaped prism: convex and reflex edges.
fn bracket() -> Mesh {
    let outline = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let flat: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    let mut vertices: Vec<[f64; 3]> = outline.iter().map(|p| [p[0], p[1], 0.0]).collect();
    vertices.extend(outline.iter().map(|p| [p[0], p[1], 1.0]));
    let mut triangles = Vec::new();
    for t in flat {
        let [a, b, c] = t.map(|i| i as u32);
        triangles.extend([[a, c, b], [a + 6, b + 6, c + 6]]);
    }
    for i in 0..6 {
        let j = (i + 1) % 6;
        triangles.extend([[i, j, j + 6], [i, j + 6, i + 6]]);
    }
    Mesh::new(vertices, triangles).unwrap()
}

/// Sides of what is turned.
const FACETS: usize = 64;

/// A profile of radius and height, turned about z.
fn turned(profile: &[[f64; 2]]) -> Mesh {
    let count = profile.len() as u32;
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for n in 0..FACETS as u32 {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(n) / FACETS as f64).sin_cos();
        for (k, &[radius, high]) in (0..).zip(profile) {
            vertices.push([radius * cos, radius * sin, high]);
            let at = |n: u32, k: u32| n % FACETS as u32 * count + k % count;
            let [a, b, c, d] = [at(n, k), at(n + 1, k), at(n + 1, k + 1), at(n, k + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::new(vertices, triangles).unwrap()
}

/// A pipe of inner radius 0.4 and this wall, with a flange at its foot.
pub(crate) fn flanged(wall: f64) -> Mesh {
    let (bore, rim, thick, high) = (0.4, 0.9, 0.2, 1.0);
    let outer = bore + wall;
    turned(&[
        [bore, 0.0],
        [rim, 0.0],
        [rim, thick],
        [outer, thick],
        [outer, high],
        [bore, high],
    ])
}

fn ascii(mesh: &Mesh, upper: bool) -> String {
    let mut text = String::from("solid a part\n");
    for t in mesh.triangles() {
        text.push_str(" facet normal 0 0 0\n  outer loop\n");
        for &v in t {
            let [x, y, z] = mesh.vertices()[v as usize];
            text.push_str(&format!("   vertex {x:e} {y} {z}\n"));
        }
        text.push_str("  endloop\n endfacet\n");
    }
    text.push_str("endsolid a part\n");
    if upper { text.to_uppercase() } else { text }
}

fn binary(mesh: &Mesh, title: &[u8]) -> Vec<u8> {
    let mut bytes = title.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    for t in mesh.triangles() {
        bytes.extend([0; 12]);
        for &v in t {
            for x in mesh.vertices()[v as usize] {
                bytes.extend((x as f32).to_le_bytes());
            }
        }
        bytes.extend([0; 2]);
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn rays_agree_with_the_analytic_shapes(p in [-1.2..1.2, -1.2..1.2, -1.2..1.2], grid in [0..9_i32, 0..9, 0..9]) {
        let (sphere, ball) = (icosphere(3), Ball::new([0.0; 3], 1.0).unwrap());
        let (mesh, box_) = (cube(3), Cuboid::new([-1.0; 3], [1.0; 3]).unwrap());
        // Points of a grid see edges and vertices edge on, along +x.
        let on_grid = grid.map(|i| f64::from(i - 4) / 3.0);
        for q in [p, on_grid] {
            let away = ball.closest(q).distance;
            if away.abs() > 0.01 {
                prop_assert_eq!(sphere.inside(q), away < 0.0);
                prop_assert_eq!(sphere.closest(q).distance < 0.0, away < 0.0);
                prop_assert!((sphere.closest(q).distance - away).abs() < 0.01);
            }
            let exact = box_.closest(q);
            let hit = mesh.closest(q);
            prop_assert!((hit.distance.abs() - exact.distance.abs()).abs() < 1e-12);
            if exact.distance.abs() > 1e-9 {
                prop_assert_eq!(mesh.inside(q), exact.distance < 0.0);
                prop_assert_eq!(hit.distance < 0.0, exact.distance < 0.0);
                if exact.distance > 0.0 {
                    prop_assert_eq!(hit.feature, exact.feature, "{:?} {:?}", q, hit);
                    prop_assert!(point::distance(hit.normal, exact.normal) < 1e-9);
                }
            }
        }
    }

    #[test]
    fn closest_is_closest_with_the_right_sign(p in [-0.5..2.5, -0.5..2.5, -0.5..1.5]) {
        let mesh = bracket();
        let hit = mesh.closest(p);
        let brute = mesh.corners.iter()
            .map(|t| point::distance(p, triangle::place(t, triangle::nearest(t, p).0)))
            .fold(f64::INFINITY, f64::min);
        prop_assert!((hit.distance.abs() - brute).abs() < 1e-14);
        let flat = (p[0] > 0.0 && p[1] > 0.0) && ((p[0] < 2.0 && p[1] < 1.0) || (p[0] < 1.0 && p[1] < 2.0));
        let inside = flat && p[2] > 0.0 && p[2] < 1.0;
        if brute > 1e-9 {
            prop_assert_eq!(mesh.inside(p), inside);
            prop_assert_eq!(hit.distance < 0.0, inside);
        }
        // No sample of a triangle is nearer than its nearest point.
        for t in &mesh.corners {
            let best = point::distance(p, triangle::place(t, triangle::nearest(t, p).0));
            for (u, v) in [(0.1, 0.2), (0.5, 0.5), (0.0, 0.3), (0.7, 0.0), (0.33, 0.33), (0.2, 0.8)] {
                prop_assert!(point::distance(p, triangle::place(t, [1.0 - u - v, u, v])) > best - 1e-12);
            }
        }
        prop_assert!(mesh.closest_within(p, brute + 1e-9).is_some() && mesh.closest_within(p, brute - 1e-9).is_none());
    }

    #[test]
    fn contents_follow_a_similarity(
        axis in [0.1..1.0, -1.0..1.0, -1.0..1.0], degrees in -360.0..360.0, scale in 0.1..10.0, shift in [-9.0..9.0, -9.0..9.0, -9.0..9.0],
    ) {
        let mesh = bracket();
        let moved = mesh.transformed(&Similarity::<3>::new(scale, axis, degrees, shift).unwrap()).unwrap();
        prop_assert!((moved.measure() / mesh.measure() / scale.powi(2) - 1.0).abs() < 1e-12);
        prop_assert!((moved.volume() / 3.0 / scale.powi(3) - 1.0).abs() < 1e-12);
        prop_assert_eq!(moved.features().corners.len(), 12);
        prop_assert_eq!(moved.features().edges.len(), 18);
    }

    #[test]
    fn damaged_files_are_errors_not_panics(cut in 0..700_usize, at in 0..700_usize, byte in 0..=255_u8) {
        let mesh = cube(1);
        let mut bytes = binary(&mesh, b"a part");
        bytes.truncate(bytes.len() - cut.min(bytes.len()));
        if let Some(b) = bytes.get_mut(at) { *b = byte; }
        let result = Mesh::from_stl_bytes(bytes);
        if cut > 0 { prop_assert!(result.is_err()); }
        let mut text = ascii(&mesh, false).into_bytes();
        let i = at % text.len();
        text[i] = byte;
        let _ = Mesh::from_stl_bytes(text);
    }
}

#[test]
fn spheres_and_cubes() {
    let sphere = icosphere(4);
    assert!((sphere.measure() / (4.0 * std::f64::consts::PI) - 1.0).abs() < 3e-3);
    assert!(sphere.features().corners.is_empty() && sphere.features().edges.is_empty());
    // Interpolated normals are nearly radial.
    let hit = sphere.closest([0.3, 0.5, 1.1]);
    assert!(point::distance(hit.normal, point::unit(hit.point).unwrap()) < 1e-3);
    assert_eq!(hit.feature, Feature::Smooth);
    let cube = cube(4);
    assert!((cube.volume() - 8.0).abs() < 1e-12 && (cube.measure() - 24.0).abs() < 1e-12);
    let features = cube.features();
    assert_eq!((features.corners.len(), features.edges.len()), (8, 12));
    assert!(features.edges.iter().all(|e| e.len() == 5));
}

#[test]
fn insets() {
    let cube = cube(3);
    let (inset, exact) = (
        cube.inset(0.1).unwrap(),
        Cuboid::new([-0.9; 3], [0.9; 3]).unwrap(),
    );
    assert!(
        (inset.measure() / exact.measure() - 1.0).abs() < 1e-9,
        "{}",
        inset.measure()
    );
    assert!((inset.volume() / exact.volume() - 1.0).abs() < 1e-9);
    assert_eq!(inset.features().corners.len(), 8);
    assert_eq!(inset.features().edges.len(), 12);
    for p in [
        [1.5, 1.4, 1.3],
        [1.5, 0.2, 1.1],
        [0.3, 0.2, 1.5],
        [0.85, 0.2, 0.1],
        [0.95, 0.96, 0.1],
    ] {
        let (a, b) = (inset.closest(p), exact.closest(p));
        assert!(
            (a.distance - b.distance).abs() < 1e-8 && point::distance(a.point, b.point) < 1e-8,
            "{p:?} {a:?} {b:?}"
        );
        assert!(
            b.distance < 0.0 || a.feature == b.feature,
            "{p:?} {a:?} {b:?}"
        );
    }
    let sphere = icosphere(4).inset(0.05).unwrap();
    let exact = Ball::new([0.0; 3], 0.95).unwrap();
    assert!(
        (sphere.measure() / exact.measure() - 1.0).abs() < 1e-2,
        "{}",
        sphere.measure()
    );
    assert!((sphere.volume() / exact.volume() - 1.0).abs() < 1e-2);
    let hit = sphere.closest([0.3, 0.4, 0.9]);
    assert!((hit.distance - exact.closest([0.3, 0.4, 0.9]).distance).abs() < 3e-3);
    // The bracket's reflex edge is rounded, its convex ones stay sharp.
    let mesh = bracket();
    let inset = mesh.inset(0.1).unwrap();
    let hit = inset.closest([1.0, 1.0, 0.5]);
    assert!(
        (hit.distance - 0.1).abs() < 1e-9 && hit.feature == Feature::Smooth,
        "{hit:?}"
    );
    let flat = 3.0 - 0.1 * 8.0 + 0.01 * (5.0 - std::f64::consts::FRAC_PI_4);
    assert!(
        (inset.volume() / (flat * 0.8) - 1.0).abs() < 2e-3,
        "{} {}",
        inset.volume(),
        flat * 0.8
    );
    assert!(matches!(
        mesh.inset(0.5),
        Err(GeometryError::Inset(InsetError::Vanished { .. }))
    ));
}

#[test]
fn signs_at_sharp_tips() {
    // A needle: the tip's faces' mean, not any one of them, tells outside.
    let mesh = Mesh::new(
        vec![
            [0.0, 0.0, 9.0],
            [0.2, 0.0, 0.0],
            [-0.1, 0.17, 0.0],
            [-0.1, -0.17, 0.0],
        ],
        vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]],
    )
    .unwrap();
    for i in 0..200 {
        let angle = f64::from(i) * 0.1;
        let p = [0.01 * angle.cos(), 0.01 * angle.sin(), 9.0 + 1e-3];
        let hit = mesh.closest(p);
        assert!(
            hit.distance > 0.0 && hit.feature == Feature::Corner,
            "{hit:?}"
        );
        assert!(!mesh.inside(p));
    }
}

#[test]
fn bad_meshes_are_refused() {
    let (vertices, triangles) = cube_parts(2);
    let mut open = triangles.clone();
    open.pop();
    assert!(matches!(
        Mesh::new(vertices.clone(), open),
        Err(GeometryError::Mesh(MeshError::Open {
            open_edges: 3,
            non_manifold: 0,
            ..
        }))
    ));
    let mut turned = triangles.clone();
    turned[0].swap(0, 1);
    assert!(matches!(
        Mesh::new(vertices.clone(), turned),
        Err(GeometryError::Mesh(MeshError::InconsistentFacing {
            edges: 3,
            ..
        }))
    ));
    let mut twice = triangles.clone();
    twice.extend(triangles.clone());
    assert!(matches!(
        Mesh::new(vertices.clone(), twice),
        Err(GeometryError::Mesh(MeshError::Open { open_edges: 0, .. }))
    ));
    let mut far = triangles.clone();
    far[3][1] = 999;
    assert!(matches!(
        Mesh::new(vertices.clone(), far),
        Err(GeometryError::Mesh(MeshError::BadIndex {
            triangle: 3,
            vertex: 999,
            ..
        }))
    ));
    let mut odd = vertices.clone();
    odd[5][1] = f64::NAN;
    assert!(matches!(
        Mesh::new(odd, triangles.clone()),
        Err(GeometryError::Mesh(MeshError::NotFinite { index: 5, .. }))
    ));
    assert!(matches!(
        Mesh::new(vec![], vec![]),
        Err(GeometryError::Mesh(MeshError::NoVolume { .. }))
    ));
    let flat = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert!(matches!(
        Mesh::new(flat, vec![[0, 1, 2], [0, 2, 1]]),
        Err(GeometryError::Mesh(MeshError::NoVolume { .. }))
    ));
    // Inside out is turned.
    let inside_out = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    assert!((Mesh::new(vertices, inside_out).unwrap().volume() - 8.0).abs() < 1e-12);
    assert!(matches!(
        cube(1).scaled(0.0),
        Err(GeometryError::Parameter(ParameterError::OutOfRange { .. }))
    ));
}

#[test]
fn stl_files() {
    let mesh = icosphere(1);
    let bad = |bytes: Vec<u8>| Mesh::from_stl_bytes(bytes).unwrap_err().to_string();
    for bytes in [
        binary(&mesh, b"a part"),
        binary(&mesh, b"solid that is binary"),
        ascii(&mesh, false).into_bytes(),
        ascii(&mesh, true).into_bytes(),
    ] {
        let read = Mesh::from_stl_bytes(bytes).unwrap();
        assert_eq!(read.vertices().len(), 42);
        assert!((read.volume() / mesh.volume() - 1.0).abs() < 1e-6);
    }
    // Two solids, 5 apart.
    let other = mesh
        .transformed(&Similarity::translation([5.0, 0.0, 0.0]).unwrap())
        .unwrap();
    let both =
        Mesh::from_stl_bytes((ascii(&mesh, false) + &ascii(&other, false)).into_bytes()).unwrap();
    assert!((both.volume() / mesh.volume() - 2.0).abs() < 1e-6);
    // Loose by less than the tolerance is welded; by more it is open.
    let (vertices, triangles) = cube_parts(2);
    for (gap, closed) in [(1e-7, true), (1e-4, false)] {
        let loose: Vec<[[f64; 3]; 3]> = triangles
            .iter()
            .enumerate()
            .map(|(i, t)| t.map(|v| vertices[v as usize].map(|x| x + gap * (i as f64 * 0.7).sin())))
            .collect();
        assert_eq!(Mesh::from_loose(&loose).is_ok(), closed);
    }
    assert!(bad(vec![]).contains("empty"));
    assert!(bad(b"hello".to_vec()).contains("no STL"));
    assert!(bad(b"solid x\nendsolid x\n".to_vec()).contains("no triangles"));
    assert!(bad(b"solid x\nfacet normal 0 0 0\n".to_vec()).contains("endsolid"));
    assert!(bad(b"solid x\nfacet nonsense\nendsolid x\n".to_vec()).contains("solid 1"));
    let mut lying = binary(&mesh, b"a part");
    // A count that was never filled in.
    lying[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(Mesh::from_stl_bytes(&lying).is_ok());
    lying[80..84].copy_from_slice(&0x7fff_ffff_u32.to_le_bytes());
    assert!(bad(lying.clone()).contains("STL"));
    lying[80..84].copy_from_slice(&3_u32.to_le_bytes());
    assert!(bad(lying).contains("promises 3 triangles"));
    let mut short = binary(&mesh, b"a part");
    short.truncate(500);
    assert!(bad(short).contains("promises 80 triangles"));
    let mut odd = binary(&mesh, b"a part");
    odd[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(matches!(
        Mesh::from_stl_bytes(odd),
        Err(GeometryError::Mesh(MeshError::NotFinite { index: 0, .. }))
    ));
    let missing = Mesh::read_stl("no/such/file.stl").unwrap_err();
    assert!(
        missing.to_string().starts_with("no/such/file.stl: "),
        "{missing}"
    );
}
