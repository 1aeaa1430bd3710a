//! One evaluation of density and force: the block loop beside a plain scalar one over the same pairs.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use sphpack_kernels::{Kernel, KernelKind, Quintic};
use sphpack_neighbors::{Bounds, Domain, KdTree, point};
use sphpack_packing::Lattice;
use sphpack_packing::forces::Forces;
use sphpack_packing::repulsion::{Repulsion, STRENGTH};

fn lattice<const D: usize>(cells: f64) -> (Domain<D>, Vec<[f64; D]>) {
    let bounds = Bounds::new([0.0; D], [cells; D]);
    (
        Domain::new(bounds.min, bounds.max),
        Lattice::auto(D).fill(bounds, 1.0).sites(),
    )
}

fn bench<const D: usize>(c: &mut Criterion, name: &str, cells: f64) {
    let (domain, positions) = lattice::<D>(cells);
    let volumes = vec![1.0; positions.len()];
    let h = 1.2;
    let tree = KdTree::new(&positions).expect("finite points");
    let neighbors: Vec<Vec<usize>> = positions
        .iter()
        .map(|&p| {
            tree.within(p, 3.0 * h)
                .into_iter()
                .map(|hit| hit.index)
                .collect()
        })
        .collect();
    let pairs: usize = neighbors.iter().map(Vec::len).sum();

    let mut group = c.benchmark_group(name);
    group.sample_size(10);
    group.throughput(Throughput::Elements(pairs as u64));
    group.bench_function("scalar", |b| {
        let w = Quintic::<D>::new(h);
        b.iter(|| {
            let mut total = 0.0;
            for (i, near) in neighbors.iter().enumerate() {
                let (mut gamma, mut gradient) = (0.0, [0.0; D]);
                for &j in near {
                    let d = point::sub(positions[i], positions[j]);
                    let r = point::norm(d);
                    gamma += volumes[j] * w.value(r);
                    if r > 0.0 {
                        gradient = point::add_scaled(gradient, volumes[j] * w.slope(r) / r, d);
                    }
                }
                total += gamma + gradient[0];
            }
            total
        });
    });
    let mut forces = Forces::new(
        &domain,
        KernelKind::Quintic,
        h,
        0.3,
        Repulsion::new(1.0, STRENGTH),
    );
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread pool");
    group.bench_function("blocks, one thread", |b| {
        pool.install(|| b.iter(|| forces.evaluate_plain(&positions, &volumes, |_| true)));
    });
    group.bench_function("blocks, one thread, new list", |b| {
        pool.install(|| {
            b.iter(|| {
                forces.targets_changed();
                forces.evaluate_plain(&positions, &volumes, |_| true);
            });
        });
    });
    group.bench_function("blocks, all threads", |b| {
        b.iter(|| forces.evaluate_plain(&positions, &volumes, |_| true));
    });
    group.finish();
}

fn all(c: &mut Criterion) {
    bench::<2>(c, "force 2-D, 10⁴ particles", 100.0);
    bench::<3>(c, "force 3-D, 2.7·10⁴ particles", 30.0);
}

criterion_group!(benches, all);
criterion_main!(benches);
