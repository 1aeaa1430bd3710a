//! Density and gradient of particles of one size, and of sizes graded 50 : 1, with the same number of neighbours.
//!
//! Throughput is in pairs, directed and within the target's own support: what skin, padding and larger neighbours add to the
//! list does not count.

use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::Level;
use sphpack_kernels::{Kernel, Quintic};
use sphpack_neighbors::{Bounds, CellList, Domain, point};
use sphpack_pairs::{Density, Gathered, Gradient, shells, walk};

/// h over the spacing, and the kernel's support over h.
const ETA: f64 = 1.2;
const SUPPORT: f64 = 3.0;

/// Particles with a spacing each.
struct Set<const D: usize> {
    positions: Vec<[f64; D]>,
    spacing: Vec<f64>,
}

impl<const D: usize> Set<D> {
    /// Layers along the first axis, each as thick as its spacing, which grows from 1 by `growth` per layer up to `ratio`,
    /// across a square of `side`; shaken by a tenth.
    fn layers(growth: f64, ratio: f64, layers: usize, side: f64) -> Self {
        let (mut positions, mut spacing) = (Vec::new(), Vec::new());
        let (mut x, mut s) = (0.0, 1.0_f64);
        for layer in 0..layers {
            let across = (side / s).round() as usize;
            let step = side / across as f64;
            for i in 0..across.pow(D as u32 - 1) {
                positions.push(std::array::from_fn(|k| {
                    let shake = 0.1 * s * ((i * (2 * k + 3) + 7 * layer) as f64).sin();
                    if k == 0 {
                        return x + 0.5 * s + shake;
                    }
                    let index = i / across.pow(k as u32 - 1) % across;
                    (index as f64 + 0.5) * step + shake
                }));
                spacing.push(s);
            }
            x += s;
            s = (s * growth).min(ratio);
        }
        Self { positions, spacing }
    }
}

fn bench<const D: usize>(c: &mut Criterion, name: &str, set: &Set<D>) {
    let positions = &set.positions;
    let size: Vec<f64> = set.spacing.iter().map(|s| ETA * s).collect();
    let volume: Vec<f64> = set.spacing.iter().map(|s| s.powi(D as i32)).collect();
    let support: Vec<f64> = size.iter().map(|h| SUPPORT * h).collect();
    let bounds = Bounds::of(positions);
    let domain = Domain::new(bounds.min, bounds.max);
    let is_uniform = size.iter().all(|&h| h == size[0]);
    let kernel = Quintic::<D>::new(size[0]);
    let mut list = if is_uniform {
        CellList::new(&domain, support[0])
            .with_skin(0.3)
            .with_shells(shells(kernel, 0.0))
    } else {
        let parts = shells(Quintic::<D>::new(1.0), 0.0).map(|r| r / SUPPORT);
        CellList::new(&domain, 0.0)
            .with_skin(0.3 / (ETA * SUPPORT))
            .with_shells(parts)
    };
    let update = |list: &mut CellList<D>| {
        if is_uniform {
            list.update(positions);
        } else {
            list.update_each(positions, &support, |_| true);
        }
    };
    update(&mut list);
    let pairs: usize = (0..positions.len())
        .map(|i| {
            let near = |&(j, shift): &(usize, [f64; D])| {
                let apart = point::sub(positions[i], point::add(positions[j], shift));
                point::norm_squared(apart) <= support[i] * support[i]
            };
            list.neighbors(i).filter(near).count()
        })
        .sum();
    println!(
        "{name}: {} particles, {:.1} neighbours each, {:.2} lanes per pair",
        positions.len(),
        pairs as f64 / positions.len() as f64,
        list.blocks().lane_pairs() as f64 / pairs as f64
    );
    let mut gathered = Gathered::default();
    let mut out = vec![Default::default(); positions.len()];
    let level = Level::new();
    let mut evaluate = |list: &CellList<D>| {
        if is_uniform {
            gathered.gather(list, positions, &volume, kernel.smoothing_length());
        } else {
            gathered.gather_each(list, positions, &volume, &size);
        }
        let terms = (Density, Gradient);
        walk(level, kernel, &terms, list.blocks(), &gathered, &mut out);
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread pool");
    let mut group = c.benchmark_group(name);
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(3))
        .throughput(Throughput::Elements(pairs as u64));
    group.bench_function("sums", |b| pool.install(|| b.iter(|| evaluate(&list))));
    group.bench_function("sums, new list", |b| {
        pool.install(|| {
            b.iter(|| {
                list.invalidate();
                update(&mut list);
                evaluate(&list);
            });
        });
    });
    group.finish();
}

fn all(c: &mut Criterion) {
    bench(c, "2-D, one size", &Set::<2>::layers(1.0, 1.0, 115, 115.0));
    bench(c, "2-D, 50 : 1", &Set::<2>::layers(1.03, 50.0, 150, 400.0));
    bench(c, "3-D, one size", &Set::<3>::layers(1.0, 1.0, 45, 45.0));
    bench(c, "3-D, 50 : 1", &Set::<3>::layers(1.08, 50.0, 60, 110.0));
}

criterion_group!(benches, all);
criterion_main!(benches);
