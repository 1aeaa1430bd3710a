//! Ways of running over the pairs that the pair loop does not go: half lists, tables, single precision.
//!
//! Γ and ∇Γ by the quintic kernel at h/∆s = 1.2 on one thread, without repulsion. Throughput is in directed pairs within
//! the support. The scalar ways run over ready lists of exact neighbours, those of vectors over the blocks of a
//! [`CellList`]. Before it is timed each way is compared with the pair loop, and the largest difference in Γ printed.

use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::{Level, Simd, dispatch, f32x4, f32x8, f32x16, prelude::*};
use sphpack_kernels::{Kernel, KernelKind, Quintic};
use sphpack_neighbors::{Block, Bounds, CellList, Domain, KdTree, LANES, Slot, point};
use sphpack_packing::Lattice;
use sphpack_packing::forces::Forces;
use sphpack_pairs::Repulsion;

/// h in ∆s.
const H: f64 = 1.2;

/// The support radius in ∆s.
const SUPPORT: f64 = 3.0 * H;

/// Entries of the table over r².
const ENTRIES: usize = 4096;

/// Γ and ∇Γ.
type Sum<const D: usize> = (f64, [f64; D]);

/// A shaken lattice in a box of the given side.
fn shaken<const D: usize>(side: f64) -> Vec<[f64; D]> {
    let bounds = Bounds::new([0.0; D], [side; D]);
    let mut positions = Lattice::auto(D, KernelKind::Quintic, H)
        .fill(bounds, 1.0)
        .sites();
    for (i, p) in positions.iter_mut().enumerate() {
        for (k, x) in p.iter_mut().enumerate() {
            *x += 0.1 * ((i * (2 * k + 3)) as f64).sin();
        }
    }
    positions
}

/// Every pair from both of its ends.
fn full<const D: usize>(x: &[[f64; D]], list: &[Vec<u32>], out: &mut [Sum<D>]) {
    let w = Quintic::<D>::new(H);
    for (i, near) in list.iter().enumerate() {
        let (mut gamma, mut gradient) = (w.value_at_origin(), [0.0; D]);
        for &j in near {
            let apart = point::sub(x[i], x[j as usize]);
            let r = point::norm(apart);
            gamma += w.value(r);
            gradient = point::add_scaled(gradient, w.slope(r) / r, apart);
        }
        out[i] = (gamma, gradient);
    }
}

/// Every pair once, for both of its ends.
fn half<const D: usize>(x: &[[f64; D]], list: &[Vec<u32>], out: &mut [Sum<D>]) {
    let w = Quintic::<D>::new(H);
    out.fill((w.value_at_origin(), [0.0; D]));
    for (i, near) in list.iter().enumerate() {
        let (mut gamma, mut gradient) = out[i];
        for &j in near.iter().filter(|&&j| j as usize > i) {
            let other = &mut out[j as usize];
            let apart = point::sub(x[i], x[j as usize]);
            let r = point::norm(apart);
            let (value, slope) = (w.value(r), w.slope(r) / r);
            gamma += value;
            gradient = point::add_scaled(gradient, slope, apart);
            other.0 += value;
            other.1 = point::add_scaled(other.1, -slope, apart);
        }
        out[i] = (gamma, gradient);
    }
}

/// W and W'/r at even steps of r², with what to add for a step.
fn table<const D: usize>() -> Vec<[f64; 4]> {
    let w = Quintic::<D>::new(H);
    let at = |entry: usize| {
        let r = (SUPPORT * SUPPORT * entry as f64 / ENTRIES as f64).sqrt();
        [w.value(r), w.slope(r) / r.max(1e-3)]
    };
    let entries = (0..=ENTRIES).map(|entry| {
        let ([value, slope], [next, further]) = (at(entry), at(entry + 1));
        [value, next - value, slope, further - slope]
    });
    entries.collect()
}

/// [`full`] by a table, without a root.
fn tabulated<const D: usize>(
    x: &[[f64; D]],
    list: &[Vec<u32>],
    table: &[[f64; 4]],
    out: &mut [Sum<D>],
) {
    let w = Quintic::<D>::new(H);
    let step = ENTRIES as f64 / (SUPPORT * SUPPORT);
    for (i, near) in list.iter().enumerate() {
        let (mut gamma, mut gradient) = (w.value_at_origin(), [0.0; D]);
        for &j in near {
            let apart = point::sub(x[i], x[j as usize]);
            let place = step * point::dot(apart, apart);
            let entry = (place as usize).min(ENTRIES);
            let part = place - entry as f64;
            let [value, rise, slope, bend] = table[entry];
            gamma += value + part * rise;
            gradient = point::add_scaled(gradient, slope + part * bend, apart);
        }
        out[i] = (gamma, gradient);
    }
}

/// The blocks of a cell list with differences, kernel and sums of a block in single precision: sixteen lanes.
fn single<const D: usize>(list: &CellList<D>, slots: &[Slot], level: Level, out: &mut [Sum<D>]) {
    list.blocks().for_each(out, |block, out| {
        dispatch!(level, simd => single_block(simd, slots, &block, out));
    });
}

#[inline(always)]
fn single_block<S: Simd, const D: usize>(
    simd: S,
    slots: &[Slot],
    block: &Block<'_>,
    out: &mut [Sum<D>],
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let zero = f32x16::splat(simd, 0.0);
            let origin = slots[block.first_slot];
            let last = block.len - 1;
            let mut x = [zero; D];
            for k in 0..D {
                let lanes: [f32; 16] = std::array::from_fn(|lane| {
                    let slot = block.first_slot + (lane % LANES).min(last);
                    (slots[slot][k] - origin[k]) as f32
                });
                x[k] = lanes.simd_into(simd);
            }
            let mut sums = Single {
                gamma: zero,
                gradient: [zero; D],
            };
            let part = |slot: u32, k: usize| {
                let slot = &slots[slot as usize];
                (slot[k] - if k < D { origin[k] } else { 0.0 }) as f32
            };
            let wide = |group: &[u32; 2], k: usize| {
                simd.combine_f32x8(
                    f32x8::splat(simd, part(group[0], k)),
                    f32x8::splat(simd, part(group[1], k)),
                )
            };
            let narrow = |group: &[u32; 4], k: usize| {
                let quarter = |slot: u32| f32x4::splat(simd, part(slot, k));
                simd.combine_f32x8(
                    simd.combine_f32x4(quarter(group[0]), quarter(group[1])),
                    simd.combine_f32x4(quarter(group[2]), quarter(group[3])),
                )
            };
            for are_targets in [true, false] {
                for shell in 0..4 {
                    for group in block.full(shell, are_targets) {
                        let mut at = [zero; D];
                        for k in 0..D {
                            at[k] = wide(group, k);
                        }
                        let weight = wide(group, 3);
                        match shell {
                            0 | 1 => sums.add::<0>(x, at, weight),
                            2 => sums.add::<1>(x, at, weight),
                            _ => sums.add::<2>(x, at, weight),
                        }
                    }
                }
                for group in block.split(are_targets) {
                    let mut at = [zero; D];
                    for k in 0..D {
                        at[k] = narrow(group, k);
                    }
                    sums.add::<2>(x, at, narrow(group, 3));
                }
            }
            let scale = Quintic::<D>::new(H).scale();
            let gamma: [f32; 16] = sums.gamma.into();
            let mut gradient = [[0.0_f32; 16]; D];
            for k in 0..D {
                gradient[k] = sums.gradient[k].into();
            }
            let both = |lanes: &[f32; 16], lane: usize| {
                scale * (f64::from(lanes[lane]) + f64::from(lanes[lane + LANES]))
            };
            for (lane, out) in out.iter_mut().enumerate() {
                out.0 = both(&gamma, lane);
                out.1 = std::array::from_fn(|k| both(&gradient[k], lane));
            }
        },
    );
}

/// The sums of eight targets over even and odd candidates.
struct Single<S: Simd, const D: usize> {
    gamma: f32x16<S>,
    gradient: [f32x16<S>; D],
}

impl<S: Simd, const D: usize> Single<S, D> {
    /// Adds candidates that are not nearer than piece `PIECE` of the spline begins.
    #[inline(always)]
    fn add<const PIECE: usize>(
        &mut self,
        x: [f32x16<S>; D],
        at: [f32x16<S>; D],
        weight: f32x16<S>,
    ) {
        let simd = weight.simd;
        let constant = |c: f32| f32x16::splat(simd, c);
        let mut apart = x;
        let mut square = constant(1e-12);
        for k in 0..D {
            apart[k] = x[k] - at[k];
            square = apart[k].mul_add(apart[k], square);
        }
        let inverse = constant(1.0) / square.sqrt();
        let q = square * inverse * constant((1.0 / H) as f32);
        let mut value = constant(0.0);
        let mut slope = constant(0.0);
        let pieces = [(3.0, 1.0), (2.0, -6.0), (1.0, 15.0)];
        for (end, factor) in pieces.into_iter().take(3 - PIECE) {
            let left = (constant(end) - q).max(constant(0.0));
            let fourth = left * left * left * left;
            value = (fourth * left).mul_add(constant(factor), value);
            slope = fourth.mul_add(constant(-5.0 * factor / H as f32), slope);
        }
        self.gamma = value.mul_add(weight, self.gamma);
        let scaled = slope * inverse * weight;
        for k in 0..D {
            self.gradient[k] = scaled.mul_add(apart[k], self.gradient[k]);
        }
    }
}

fn bench<const D: usize>(c: &mut Criterion, name: &str, side: f64) {
    let x = shaken::<D>(side);
    let volumes = vec![1.0; x.len()];
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread pool");
    let tree = KdTree::new(&x).expect("finite points");
    let near = |i: usize| {
        let found = tree.within(x[i], SUPPORT).into_iter();
        let mut near: Vec<u32> = found.map(|hit| hit.index as u32).collect();
        near.retain(|&j| j as usize != i);
        near
    };
    let lists: Vec<Vec<u32>> = (0..x.len()).map(near).collect();
    let pairs: usize = lists.iter().map(Vec::len).sum();

    let domain = Domain::new([0.0; D], [side; D]);
    let mut forces = Forces::new(&domain, KernelKind::Quintic, H, 0.3, Repulsion::none());
    forces.evaluate_plain(&x, &volumes, |_| true);
    let mut list = CellList::new(&domain, SUPPORT)
        .with_skin(0.3)
        .with_shells([1e-3, H, 2.0 * H]);
    list.update(&x);
    let mut slots = Vec::new();
    list.gather(&x, &volumes, 1.0, &mut slots);
    let (table, level) = (table::<D>(), Level::new());
    let mut out = vec![(0.0, [0.0; D]); x.len()];

    let mut group = c.benchmark_group(format!("ways, {name}, {} particles", x.len()));
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(3))
        .throughput(Throughput::Elements(pairs as u64));
    let off = |out: &[Sum<D>], particle: &dyn Fn(usize) -> usize| {
        let off = |slot: usize| (out[slot].0 / forces.gamma(particle(slot)) - 1.0).abs();
        (0..out.len()).map(off).fold(0.0, f64::max)
    };
    full(&x, &lists, &mut out);
    println!("full list, scalar: Γ off by {:.1e}", off(&out, &|i| i));
    group.bench_function("full list, scalar", |b| {
        b.iter(|| full(&x, &lists, &mut out));
    });
    half(&x, &lists, &mut out);
    println!("half list, scalar: Γ off by {:.1e}", off(&out, &|i| i));
    group.bench_function("half list, scalar", |b| {
        b.iter(|| half(&x, &lists, &mut out));
    });
    tabulated(&x, &lists, &table, &mut out);
    println!("table, scalar: Γ off by {:.1e}", off(&out, &|i| i));
    group.bench_function("table, scalar", |b| {
        b.iter(|| tabulated(&x, &lists, &table, &mut out));
    });
    pool.install(|| single(&list, &slots, level, &mut out));
    let particle = |slot: usize| list.target_particles()[slot] as usize;
    println!("single precision: Γ off by {:.1e}", off(&out, &particle));
    group.bench_function("blocks, single precision", |b| {
        pool.install(|| {
            b.iter(|| {
                list.gather(&x, &volumes, 1.0, &mut slots);
                single(&list, &slots, level, &mut out);
            });
        });
    });
    group.bench_function("blocks, the pair loop", |b| {
        pool.install(|| b.iter(|| forces.evaluate_plain(&x, &volumes, |_| true)));
    });
    group.finish();
}

fn all(c: &mut Criterion) {
    bench::<2>(c, "2-D", 100.0);
    bench::<3>(c, "3-D", 21.5);
}

criterion_group!(benches, all);
criterion_main!(benches);
