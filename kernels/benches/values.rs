//! Value and slope of every kernel, one pair at a time.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use sphpack_kernels::{Kernel, KernelKind, WithKernel};

struct Sweep;

impl WithKernel<3> for Sweep {
    type Output = f64;

    fn call<K: Kernel<3>>(self, kernel: K) -> f64 {
        (0..1000)
            .map(|i| {
                let (value, slope) =
                    kernel.value_and_slope_over_r(black_box(1e-6 * f64::from(i * i)));
                value + slope
            })
            .sum()
    }
}

fn all(c: &mut Criterion) {
    for kind in KernelKind::ALL {
        c.bench_function(&format!("1000 pairs, {kind}"), |b| {
            b.iter(|| kind.with::<3, _>(0.3, Sweep));
        });
    }
}

criterion_group!(benches, all);
criterion_main!(benches);
