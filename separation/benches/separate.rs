//! Separating a lattice of 40,000 points by a starfish: flood beside inside tests.

use criterion::{Criterion, criterion_group, criterion_main};
use sphpack_geometry::{Outline, Surface};
use sphpack_separation::{separate, separate_by_flood};

fn all(c: &mut Criterion) {
    let n = 200;
    let points: Vec<[f64; 2]> = (0..n * n)
        .map(|i| [(i / n) as f64 / 100.0 - 1.0, (i % n) as f64 / 100.0 - 1.0])
        .collect();
    let nobody = vec![None; points.len()];
    let star = Outline::starfish([0.0; 2], 0.5, 0.25, 5).expect("a sound starfish");
    let bodies: [&dyn Surface<2>; 1] = [&star];
    c.bench_function("flood", |b| {
        b.iter(|| separate_by_flood(&points, &nobody, &bodies, 0.02));
    });
    c.bench_function("inside tests", |b| {
        b.iter(|| separate(&points, &bodies));
    });
}

criterion_group!(benches, all);
criterion_main!(benches);
