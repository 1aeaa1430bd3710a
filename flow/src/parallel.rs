//! One number per particle from others, in parallel where there are many.

use rayon::prelude::*;

/// Fewer than these are done at once: handing work to another thread takes as long.
const SERIAL: usize = 4096;

/// Sets every entry to what `of` says of its place. The same bits for any number of threads.
pub(crate) fn each<T: Send>(out: &mut [T], of: impl Fn(usize) -> T + Sync) {
    if out.len() <= SERIAL {
        for (i, out) in out.iter_mut().enumerate() {
            *out = of(i);
        }
        return;
    }
    (out.par_iter_mut().enumerate())
        .with_min_len(SERIAL / 2)
        .for_each(|(i, out)| *out = of(i));
}

/// Fills rows of `stride` numbers, each by its place.
pub(crate) fn each_row(out: &mut [f64], stride: usize, fill: impl Fn(usize, &mut [f64]) + Sync) {
    if out.len() <= SERIAL * stride {
        for (i, row) in out.chunks_exact_mut(stride).enumerate() {
            fill(i, row);
        }
        return;
    }
    (out.par_chunks_exact_mut(stride).enumerate())
        .with_min_len(SERIAL / 2)
        .for_each(|(i, row)| fill(i, row));
}
