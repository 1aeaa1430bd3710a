//! What the machine can do at best: a roofline for the pair loop.

use std::time::{Duration, Instant};

use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use rayon::prelude::*;

/// Chains of multiply-adds that run side by side: more than latency times issue on today's cores.
const CHAINS: usize = 16;

/// Multiply-adds per chain and call.
const LENGTH: usize = 2_000_000;

/// Repeats, of which the quickest counts.
const REPEATS: usize = 7;

/// Repeats go on for as long as this.
const LONG_ENOUGH: Duration = Duration::from_millis(500);

/// Doubles in each of the three arrays of the triad, beyond any cache.
const TRIAD: usize = 1 << 25;

/// Multiply-adds on doubles, as operations (two each) per second, on so many threads.
pub(super) fn peak(threads: usize) -> Result<f64, String> {
    let level = Level::new();
    let operations = (2 * 8 * CHAINS * LENGTH * threads) as f64;
    let seconds = quickest(threads, || {
        let sum: f64 = (0..threads)
            .into_par_iter()
            .with_max_len(1)
            .map(|_| dispatch!(level, simd => chains(simd)))
            .collect::<Vec<f64>>()
            .iter()
            .sum();
        assert!(sum.is_finite(), "the chains converge");
    })?;
    Ok(operations / seconds)
}

#[inline(always)]
fn chains<S: Simd>(simd: S) -> f64 {
    simd.vectorize(
        #[inline(always)]
        || {
            let factor = f64x8::splat(simd, std::hint::black_box(0.5));
            let summand = f64x8::splat(simd, std::hint::black_box(1.0));
            let mut chain = [summand; CHAINS];
            for _ in 0..LENGTH {
                for c in 0..CHAINS {
                    chain[c] = chain[c].mul_add(factor, summand);
                }
            }
            let mut sum = 0.0;
            for c in 0..CHAINS {
                let lanes: [f64; 8] = chain[c].into();
                sum += lanes[0];
            }
            sum
        },
    )
}

/// Bytes per second of a = b + s c over large arrays, on so many threads: two reads and a write a term.
pub(super) fn bandwidth(threads: usize) -> Result<f64, String> {
    let (b, c) = (vec![1.0_f64; TRIAD], vec![2.0_f64; TRIAD]);
    let mut a = vec![0.0_f64; TRIAD];
    let piece = TRIAD / (4 * threads);
    let seconds = quickest(threads, || {
        let s = std::hint::black_box(3.0);
        (a.par_chunks_mut(piece)
            .zip(b.par_chunks(piece))
            .zip(c.par_chunks(piece)))
        .for_each(|((a, b), c)| {
            for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                *a = b + s * c;
            }
        });
        std::hint::black_box(&a);
    })?;
    Ok((3 * 8 * TRIAD) as f64 / seconds)
}

/// Seconds of the quickest of some repeats, on so many threads. Short work is repeated for half a second: on two threads
/// a millisecond is easily disturbed.
pub(super) fn quickest(threads: usize, mut work: impl FnMut() + Send) -> Result<f64, String> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| error.to_string())?;
    Ok(pool.install(|| {
        let begin = Instant::now();
        let mut least = f64::INFINITY;
        for repeat in 0.. {
            if repeat >= REPEATS && begin.elapsed() > LONG_ENOUGH {
                break;
            }
            let start = Instant::now();
            work();
            least = least.min(start.elapsed().as_secs_f64());
        }
        least
    }))
}
