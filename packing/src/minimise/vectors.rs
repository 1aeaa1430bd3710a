//! Sums and combinations of long vectors, one entry per mobile particle.

use rayon::prelude::*;
use sphpack_neighbors::point;

/// Entries per task, and the fixed block of a sum.
const BLOCK: usize = 4096;

/// Σ a·b in blocks of fixed size: the same bits for any number of threads.
pub(crate) fn dot<const D: usize>(a: &[[f64; D]], b: &[[f64; D]]) -> f64 {
    let of = |(a, b): (&[[f64; D]], &[[f64; D]])| -> f64 {
        let mut sum = 0.0;
        for (&x, &y) in a.iter().zip(b) {
            sum += point::dot(x, y);
        }
        sum
    };
    if a.len() <= BLOCK {
        return of((a, b));
    }
    let partial: Vec<f64> = a
        .par_chunks(BLOCK)
        .zip(b.par_chunks(BLOCK))
        .map(of)
        .collect();
    partial.iter().sum()
}

/// a ← a + s b.
pub(crate) fn add_scaled<const D: usize>(a: &mut [[f64; D]], s: f64, b: &[[f64; D]]) {
    a.par_iter_mut()
        .zip(b)
        .with_min_len(BLOCK)
        .for_each(|(a, &b)| *a = point::add_scaled(*a, s, b));
}

/// a ← s a.
pub(crate) fn scale<const D: usize>(a: &mut [[f64; D]], s: f64) {
    a.par_iter_mut()
        .with_min_len(BLOCK)
        .for_each(|a| *a = point::scale(*a, s));
}

/// The largest length; NaN where one is.
pub(crate) fn longest<const D: usize>(a: &[[f64; D]]) -> f64 {
    crate::forces::largest(a.len(), |i| point::norm_squared(a[i])).sqrt()
}
