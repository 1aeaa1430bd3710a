//! One evaluation of density and force: the block loop beside a plain scalar one.
//!
//! Throughput is in pairs, directed and within the support: skin, padding and a particle with itself do not count. The
//! scalar loop runs over ready lists of exact neighbours, of at most 20,000 particles.

use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rayon::prelude::*;
use sphpack_kernels::{Kernel, KernelKind, Quintic};
use sphpack_neighbors::{Bounds, Domain, KdTree, point};
use sphpack_packing::Lattice;
use sphpack_packing::forces::{Forces, Levelling};
use sphpack_pairs::Repulsion;

/// Particles that the scalar loop runs over.
const SCALAR: usize = 20_000;

/// What an evaluation does.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    Plain,
    Levelling,
    NewList,
}

/// A set of particles of unit spacing; the first are targets, the others frozen.
struct Set<const D: usize> {
    domain: Domain<D>,
    positions: Vec<[f64; D]>,
    targets: usize,
}

impl<const D: usize> Set<D> {
    /// A shaken lattice in a box of the given side; particles nearer than `frozen` to its faces are frozen.
    fn new(side: f64, frozen: f64) -> Self {
        let bounds = Bounds::new([0.0; D], [side; D]);
        let mut positions = Lattice::auto(D, KernelKind::Quintic, 1.2)
            .fill(bounds, 1.0)
            .sites();
        for (i, p) in positions.iter_mut().enumerate() {
            for (k, x) in p.iter_mut().enumerate() {
                *x += 0.1 * ((i * (2 * k + 3)) as f64).sin();
            }
        }
        let inner = bounds.grown(-frozen);
        let is_frozen = |p: &[f64; D]| frozen > 0.0 && !inner.contains(*p);
        positions.sort_by_key(is_frozen);
        Self {
            domain: Domain::new(bounds.min, bounds.max),
            targets: positions.partition_point(|p| !is_frozen(p)),
            positions,
        }
    }
}

fn bench<const D: usize>(c: &mut Criterion, name: &str, set: &Set<D>, h: f64) {
    let positions = &set.positions;
    let volumes = vec![1.0; positions.len()];
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread pool");
    let mut forces = Forces::new(
        &set.domain,
        KernelKind::Quintic,
        h,
        0.3,
        Repulsion::new(1.0, Repulsion::STRENGTH),
    );
    let mut evaluate = |way: Way| {
        if way == Way::NewList {
            forces.targets_changed();
        }
        forces.levelling = Levelling::new(if way == Way::Levelling { 10.0 } else { 0.0 }, 1.0);
        forces.evaluate_plain(positions, &volumes, |i| i < set.targets);
    };
    evaluate(Way::NewList);
    let mut group = c.benchmark_group(format!("{name}, {} targets, h/∆s {h}", set.targets));
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(3));

    let tree = KdTree::new(positions).expect("finite points");
    let neighbors = |i: usize| tree.within(positions[i], 3.0 * h).into_iter();
    let list: Vec<Vec<usize>> = (0..SCALAR.min(set.targets))
        .map(|i| {
            neighbors(i)
                .map(|hit| hit.index)
                .filter(|&j| j != i)
                .collect()
        })
        .collect();
    let some: usize = list.iter().map(Vec::len).sum();
    group.throughput(Throughput::Elements(some as u64));
    group.bench_function("scalar", |b| {
        let w = Quintic::<D>::new(h);
        b.iter(|| {
            let mut total = 0.0;
            for (i, near) in list.iter().enumerate() {
                let (mut gamma, mut gradient) = (w.value_at_origin(), [0.0; D]);
                for &j in near {
                    let d = point::sub(positions[i], positions[j]);
                    let r = point::norm(d);
                    gamma += volumes[j] * w.value(r);
                    gradient = point::add_scaled(gradient, volumes[j] * w.slope(r) / r, d);
                }
                total += gamma + gradient[0];
            }
            total
        });
    });

    let pairs: usize = (0..set.targets)
        .into_par_iter()
        .map(|i| neighbors(i).len() - 1)
        .sum();
    group.throughput(Throughput::Elements(pairs as u64));
    group.bench_function("blocks, one thread", |b| {
        pool.install(|| b.iter(|| evaluate(Way::Plain)));
    });
    group.bench_function("blocks, one thread, levelling", |b| {
        pool.install(|| b.iter(|| evaluate(Way::Levelling)));
    });
    group.bench_function("blocks, one thread, new list", |b| {
        pool.install(|| b.iter(|| evaluate(Way::NewList)));
    });
    group.bench_function("blocks, all threads", |b| b.iter(|| evaluate(Way::Plain)));
    group.finish();
}

fn all(c: &mut Criterion) {
    bench(
        c,
        "2-D, small and mostly frozen",
        &Set::<2>::new(57.0, 8.5),
        1.2,
    );
    let flat = Set::<2>::new(100.0, 0.0);
    bench(c, "2-D", &flat, 1.2);
    bench(c, "2-D", &flat, 1.0);
    let solid = Set::<3>::new(21.5, 0.0);
    bench(c, "3-D", &solid, 1.2);
    bench(c, "3-D", &solid, 1.0);
    bench(c, "3-D, beyond the caches", &Set::<3>::new(109.0, 0.0), 1.2);
}

criterion_group!(benches, all);
criterion_main!(benches);
