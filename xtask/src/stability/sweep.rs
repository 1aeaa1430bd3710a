//! Every lattice, kernel and h/∆s: the least eigenvalue over the greatest.

use rayon::prelude::*;
use sphpack_kernels::KernelKind;
use sphpack_packing::Lattice;

use crate::crystal::{UNSTABLE, softest};

/// h/∆s in hundredths: from, to, by. In a hurry only some.
const HUNDREDTHS: [usize; 3] = [70, 250, 1];
const HURRIED: [usize; 3] = [80, 180, 20];

/// Least eigenvalues over greatest, of one kernel and lattice at every h/∆s.
pub(super) struct Strip {
    pub(super) kernel: KernelKind,
    pub(super) lattice: Lattice,
    pub(super) ratios: Vec<f64>,
}

/// All strips, in the order of the kernels, then of the lattices.
pub(super) struct Sweep {
    pub(super) h_over_spacing: Vec<f64>,
    pub(super) strips: Vec<Strip>,
}

impl Sweep {
    pub(super) fn run(is_quick: bool) -> Result<Self, String> {
        let [from, to, by] = if is_quick { HURRIED } else { HUNDREDTHS };
        let hs: Vec<f64> = (from..=to)
            .step_by(by)
            .map(|hundredths| hundredths as f64 / 100.0)
            .collect();
        let pairs: Vec<(KernelKind, Lattice)> = KernelKind::ALL
            .into_iter()
            .flat_map(|kernel| Lattice::ALL.map(|lattice| (kernel, lattice)))
            .collect();
        let cases: Vec<(KernelKind, Lattice, f64)> = pairs
            .iter()
            .flat_map(|&(kernel, lattice)| hs.iter().map(move |&h| (kernel, lattice, h)))
            .collect();
        let ratios: Vec<f64> = cases
            .par_iter()
            .map(|&(kernel, lattice, h)| softest(lattice, kernel, h))
            .collect::<Result<_, _>>()?;
        let strips = (pairs.iter().zip(ratios.chunks(hs.len())))
            .map(|(&(kernel, lattice), ratios)| Strip {
                kernel,
                lattice,
                ratios: ratios.to_vec(),
            })
            .collect();
        Ok(Self {
            h_over_spacing: hs,
            strips,
        })
    }

    /// The strips of one kernel.
    pub(super) fn of(&self, kernel: KernelKind) -> impl Iterator<Item = &Strip> {
        (self.strips.iter()).filter(move |strip| strip.kernel == kernel)
    }

    /// The ratio of a kernel and lattice at the h/∆s of this number.
    pub(super) fn at(&self, kernel: KernelKind, lattice: Lattice, number: usize) -> f64 {
        (self.of(kernel))
            .find(|strip| strip.lattice == lattice)
            .map_or(f64::NAN, |strip| strip.ratios[number])
    }
}

/// Whether a lattice of this least eigenvalue over the greatest stays.
pub(super) fn is_stable(ratio: f64) -> bool {
    ratio > UNSTABLE
}
