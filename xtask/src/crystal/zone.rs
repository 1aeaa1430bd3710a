//! The extremes of all waves of a lattice.

use sphpack_kernels::KernelKind;
use sphpack_neighbors::point;
use sphpack_packing::Lattice;

use super::Crystal;

/// Wave vectors that are looked at, spread evenly over the Brillouin zone, and others near its middle.
const WAVES: usize = 1000;
const LONG_WAVES: usize = 250;

/// How near: where long waves bend the lattice as a whole.
const LONG: f64 = 0.1;

/// From so many of them the way goes downhill: the lowest need not lie beside the lowest seen.
const TRIED: usize = 5;

/// The last steps of the search are this part of the first.
const LAST: f64 = 1e-2;

/// The least and the greatest eigenvalue of a lattice, and their wave vectors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extremes<const D: usize> {
    pub(crate) least: f64,
    pub(crate) softest: [f64; D],
    pub(crate) greatest: f64,
}

impl<const D: usize> Extremes<D> {
    /// The least eigenvalue over the greatest.
    pub(crate) fn ratio(&self) -> f64 {
        self.least / self.greatest
    }
}

/// The least eigenvalue of the dynamical matrix of a background pressure over the greatest, of all waves that a perfect
/// lattice may carry. Negative beyond rounding (10⁻¹²): some collective motion lowers the energy, and the lattice does not stay.
///
/// # Errors
/// Where an eigenvalue is not found.
pub(crate) fn softest(lattice: Lattice, kernel: KernelKind, h: f64) -> Result<f64, String> {
    if lattice.dimension() == 2 {
        Ok(Crystal::<2>::new(lattice, kernel, h).extremes()?.ratio())
    } else {
        Ok(Crystal::<3>::new(lattice, kernel, h).extremes()?.ratio())
    }
}

impl<const D: usize> Crystal<D> {
    /// The extremes over the whole Brillouin zone: the best of many waves, then downhill from there. Long waves are soft because they
    /// are long; among them the one with the least of λ/k² is looked for.
    ///
    /// # Errors
    /// Where an eigenvalue is not found.
    pub(crate) fn extremes(&self) -> Result<Extremes<D>, String> {
        let least = |parts: [f64; D]| Ok(self.values(self.cell.wave(parts))?[0]);
        let over_square = |parts: [f64; D]| -> Result<f64, String> {
            let k = self.cell.wave(parts);
            Ok(self.values(k)?[0] / point::norm_squared(k))
        };
        let minus_greatest = |parts: [f64; D]| -> Result<f64, String> {
            let values = self.values(self.cell.wave(parts))?;
            Ok(-values[values.len() - 1])
        };
        let (mut high, mut long) = ([(f64::INFINITY, [0.0; D]); 2]).into();
        let mut seen = Vec::with_capacity(WAVES);
        for parts in (0..WAVES).map(spread) {
            let values = self.values(self.cell.wave(parts))?;
            seen.push((values[0], parts));
            high = lower(high, (-values[values.len() - 1], parts));
        }
        for parts in (0..LONG_WAVES).map(spread) {
            let parts = parts.map(|part| LONG * part);
            long = lower(long, (over_square(parts)?, parts));
        }
        let apart = |waves: usize| 0.5 * (waves as f64).powf(-1.0 / D as f64);
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut low = seen[0];
        for begin in seen.into_iter().take(TRIED) {
            low = lower(low, descend(begin, apart(WAVES), least)?);
        }
        let high = descend(high, apart(WAVES), minus_greatest)?;
        let long = descend(long, LONG * apart(LONG_WAVES), over_square)?;
        let low = lower(low, (least(long.1)?, long.1));
        Ok(Extremes {
            least: low.0,
            softest: self.cell.wave(low.1),
            greatest: -high.0,
        })
    }
}

/// A Kronecker sequence of the generalised golden ratio. Half of the zone: k and −k have the same eigenvalues.
fn spread<const D: usize>(wave: usize) -> [f64; D] {
    let golden: f64 = if D == 2 {
        1.324_717_957_244_746
    } else {
        1.220_744_084_605_759_5
    };
    std::array::from_fn(|axis| {
        let part = ((wave + 1) as f64 / golden.powi(axis as i32 + 1)).fract();
        if axis == 0 { 0.5 * part } else { part - 0.5 }
    })
}

/// Whichever is lower.
fn lower<const D: usize>(a: (f64, [f64; D]), b: (f64, [f64; D])) -> (f64, [f64; D]) {
    if b.0 < a.0 { b } else { a }
}

/// Downhill along the axes, by ever shorter steps.
fn descend<const D: usize>(
    from: (f64, [f64; D]),
    mut step: f64,
    f: impl Fn([f64; D]) -> Result<f64, String>,
) -> Result<(f64, [f64; D]), String> {
    let (mut best, last) = (from, LAST * step);
    while step > last {
        let before = best.0;
        for axis in 0..D {
            for sign in [-1.0, 1.0] {
                let mut next = best.1;
                next[axis] += sign * step;
                let value = f(next)?;
                if value < best.0 {
                    best = (value, next);
                }
            }
        }
        if best.0 >= before {
            step *= 0.5;
        }
    }
    Ok(best)
}
