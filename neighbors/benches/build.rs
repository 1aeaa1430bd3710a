//! Building a neighbour list, and a kd-tree, over a cubic lattice of 27,000 points.

use criterion::{Criterion, criterion_group, criterion_main};
use sphpack_neighbors::{CellList, Domain, KdTree};

fn all(c: &mut Criterion) {
    let n = 30;
    let points: Vec<[f64; 3]> = (0..n * n * n)
        .map(|i| {
            [
                (i / n / n) as f64 + 0.5,
                (i / n % n) as f64 + 0.5,
                (i % n) as f64 + 0.5,
            ]
        })
        .collect();
    let domain = Domain::new([0.0; 3], [n as f64; 3]);
    let mut list = CellList::new(&domain, 3.0).with_skin(0.3);
    c.bench_function("cell list, support 3", |b| {
        b.iter(|| {
            list.invalidate();
            list.update(&points)
        });
    });
    c.bench_function("cell list, nothing moved", |b| {
        b.iter(|| list.update(&points));
    });
    c.bench_function("kd-tree", |b| b.iter(|| KdTree::new(&points)));
}

criterion_group!(benches, all);
criterion_main!(benches);
