//! Queries per second: closest points near the surface, inside tests and even samples, on a sphere mesh and a starfish.
#![allow(
    missing_docs,
    reason = "criterion's macros make an undocumented public function"
)]

use std::f64::consts::{PI, TAU};
use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use sphpack_geometry::{Mesh, Outline, Soup, Surface};

/// A sphere of radius 1 of `rows` × 2 `rows` quadrilaterals, each two triangles.
fn sphere(rows: u32) -> Mesh {
    let columns = 2 * rows;
    let mut vertices = vec![[0.0, 0.0, 1.0]];
    for row in 1..rows {
        let (r, z) = (PI * f64::from(row) / f64::from(rows)).sin_cos();
        for column in 0..columns {
            let (sin, cos) = (TAU * f64::from(column) / f64::from(columns)).sin_cos();
            vertices.push([r * cos, r * sin, z]);
        }
    }
    vertices.push([0.0, 0.0, -1.0]);
    let last = vertices.len() as u32 - 1;
    let at = |row: u32, column: u32| 1 + (row - 1) * columns + column % columns;
    let mut triangles = Vec::new();
    for column in 0..columns {
        triangles.push([0, at(1, column), at(1, column + 1)]);
        triangles.push([last, at(rows - 1, column + 1), at(rows - 1, column)]);
        for row in 1..rows - 1 {
            let (a, b) = (at(row, column), at(row, column + 1));
            let (c, d) = (at(row + 1, column), at(row + 1, column + 1));
            triangles.extend([[a, c, d], [a, d, b]]);
        }
    }
    Mesh::new(vertices, triangles).expect("the sphere is closed")
}

/// Points spread over directions, at radii around 1.
fn points_3d(count: u32) -> Vec<[f64; 3]> {
    (0..count)
        .map(|i| {
            let z = 1.0 - f64::from(2 * i + 1) / f64::from(count);
            let r = (1.0 - z * z).sqrt();
            let (sin, cos) = (2.399_963 * f64::from(i)).sin_cos();
            [r * cos, r * sin, z].map(|x| x * (0.95 + 0.01 * f64::from(i % 11)))
        })
        .collect()
}

fn queries(c: &mut Criterion) {
    let mesh = sphere(194);
    let outline = Outline::starfish([0.0, 0.0], 0.5, 0.25, 5).expect("a good starfish");
    let solid = points_3d(10_000);
    let flat: Vec<[f64; 2]> = solid.iter().map(|p| [0.6 * p[0], 0.6 * p[1]]).collect();
    let mut group = c.benchmark_group("queries");
    group.throughput(Throughput::Elements(solid.len() as u64));
    group.sample_size(20);
    group.bench_function("mesh of 75k triangles, closest within 0.1", |b| {
        b.iter(|| {
            solid
                .iter()
                .filter(|&&p| mesh.closest_within(black_box(p), 0.1).is_some())
                .count()
        });
    });
    group.bench_function("mesh of 75k triangles, inside", |b| {
        b.iter(|| solid.iter().filter(|&&p| mesh.inside(black_box(p))).count());
    });
    group.bench_function("starfish, closest within 0.1", |b| {
        b.iter(|| {
            flat.iter()
                .filter(|&&p| outline.closest_within(black_box(p), 0.1).is_some())
                .count()
        });
    });
    group.bench_function("starfish, inside", |b| {
        b.iter(|| {
            flat.iter()
                .filter(|&&p| outline.inside(black_box(p)))
                .count()
        });
    });
    group.finish();
    let mut group = c.benchmark_group("building");
    group.sample_size(10);
    group.bench_function("mesh of 75k triangles", |b| {
        b.iter_batched(
            || (mesh.vertices().to_vec(), mesh.triangles().to_vec()),
            |(vertices, triangles)| Mesh::new(vertices, triangles),
            BatchSize::LargeInput,
        );
    });
    let large = sphere(500);
    let place = |v: u32| large.vertices()[v as usize];
    let loose: Vec<[[f64; 3]; 3]> = large.triangles().iter().map(|t| t.map(place)).collect();
    group.bench_function("1M loose triangles, welded, checked and built", |b| {
        b.iter(|| Soup::from_loose(&loose).and_then(|soup| soup.body()));
    });
    drop(loose);
    group.bench_function("starfish inset", |b| b.iter(|| outline.inset(0.025)));
    // Sides much shorter than they are moved.
    group.bench_function("starfish inset by its arms' width", |b| {
        b.iter(|| outline.inset(0.17));
    });
    let teeth = Outline::zigzag(1.0, 1.0, 0.5, 10_000).expect("a good zigzag");
    group.bench_function("10,000 teeth inset by 500 of them", |b| {
        b.iter(|| teeth.inset(0.05));
    });
    group.finish();
    let mut group = c.benchmark_group("sampling");
    group.throughput(Throughput::Elements(2300));
    group.sample_size(10);
    let inset = mesh.inset(0.05).expect("a smaller sphere");
    group.bench_function("mesh of 75k triangles, 2300 points", |b| {
        b.iter(|| mesh.sample(2300));
    });
    group.bench_function("its inset, 2300 points", |b| b.iter(|| inset.sample(2300)));
    group.bench_function("starfish, 2300 points", |b| b.iter(|| outline.sample(2300)));
    group.finish();
}

criterion_group!(benches, queries);
criterion_main!(benches);
