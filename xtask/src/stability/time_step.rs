//! How long a time step the lattices bear, beside what their stiffest wave allows.

use std::fmt::Write as _;

use rayon::prelude::*;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::random::SplitMix64;
use sphpack_packing::Lattice;
use sphpack_pairs::Repulsion;

use super::Section;
use super::evolution::{Evolution, PUBLISHED, cells};
use super::sweep::is_stable;
use crate::crystal::{Crystal, softest};

/// About the edge of the periodic box, in ∆s.
const EDGE: f64 = 8.0;

/// h/∆s in hundredths, by which the one nearest to the default is looked for where the lattice that "auto" takes is stable.
const DEFAULT: usize = 120;
const FARTHEST: usize = 80;

/// Noise at the beginning, in ∆s; what has grown to the second in so many steps has blown up.
const NOISE: f64 = 1e-8;
const BLOWN_UP: f64 = 1e-5;
const STEPS: usize = 400;

/// Multiples of 001's step between which the largest is looked for, and how closely.
const MULTIPLES: [f64; 2] = [1.0, 64.0];
const CLOSE: f64 = 2e-3;

/// How far measured and bound may be apart.
const BAR: f64 = 0.02;

/// C_ζ of the damped methods.
const DAMPING: f64 = 0.2;

struct Found {
    kernel: KernelKind,
    lattice: Lattice,
    h: f64,
    /// The greatest eigenvalue, times ∆s²ρ/p_b.
    greatest: f64,
    /// Largest multiples without damping and with: the bound, that of the waves that fit into the box, and measured.
    largest: [[f64; 3]; 2],
}

/// The table.
///
/// # Errors
/// Where the time evolution bears another step than the eigenvalue allows.
pub(super) fn section(is_quick: bool) -> Result<Section, String> {
    let cases: Vec<(KernelKind, usize)> = if is_quick {
        vec![(KernelKind::Quintic, 2)]
    } else {
        (KernelKind::ALL.into_iter())
            .flat_map(|kernel| [2, 3].map(|dimension| (kernel, dimension)))
            .collect()
    };
    let found: Vec<Found> = (cases.par_iter())
        .map(|&(kernel, dimension)| {
            let (lattice, h) = resting(kernel, dimension)?;
            if dimension == 2 {
                find::<2>(kernel, lattice, h)
            } else {
                find::<3>(kernel, lattice, h)
            }
        })
        .collect::<Result<_, String>>()?;
    let mut text = format!(
        "## Time step\n\n\
         The largest step ∆t at which a lattice with noise of {NOISE:.0e} ∆s does not blow up within {STEPS} steps, as a multiple of 001\n\
         eq. 25 (∆t = {PUBLISHED} h for p_b = 1), by bisection; beside it the bound, of all waves and of those that fit into the periodic box\n\
         of about {EDGE} ∆s. Semi-implicit Euler bears ω² ∆t² ≤ 4, ω² the greatest eigenvalue, and with damping ζ, taken explicitly as the damped\n\
         methods take it, ω² ∆t² + 2 ζ ∆t ≤ 4 (ζ = {DAMPING}/∆s). Taken is the lattice that `lattice = \"auto\"` takes, at the h/∆s nearest to 1.2 at\n\
         which it is stable.\n\n\
         | kernel | dimension | lattice | h/∆s | ω² ρ∆s²/p_b | bound | in the box | measured | damped: bound | in the box | measured |\n|---|---|---|---|---|---|---|---|---|---|---|\n"
    );
    let mut missed = Vec::new();
    for f in &found {
        let [plain, damped] = f.largest;
        let line = format!(
            "| {} | {} | {} | {:.2} | {:.3} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} |",
            f.kernel,
            f.lattice.dimension(),
            f.lattice,
            f.h,
            f.greatest,
            plain[0],
            plain[1],
            plain[2],
            damped[0],
            damped[1],
            damped[2],
        );
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{line}");
        let is_off = |[_, in_box, measured]: [f64; 3]| (measured / in_box - 1.0).abs() > BAR;
        if f.largest.into_iter().any(is_off) {
            missed.push(line);
        }
    }
    if !missed.is_empty() {
        return Err(format!(
            "time steps that the eigenvalues do not give:\n{}",
            missed.join("\n")
        ));
    }
    text.push_str(
        "\nThese are lattices. Where particles are irregular, close pairs are stiffer: packings bear less, with repulsion less still. The method\n\
         hybrid takes a multiple as `hybrid.time_step` in a scene.\n\n",
    );
    Ok(Section {
        text,
        pictures: Vec::new(),
    })
}

/// The lattice that "auto" takes, at the h/∆s nearest to the default at which it is stable.
fn resting(kernel: KernelKind, dimension: usize) -> Result<(Lattice, f64), String> {
    for away in 0..=FARTHEST {
        for hundredths in [DEFAULT + away, DEFAULT.saturating_sub(away)] {
            let h = hundredths as f64 / 100.0;
            if h < 0.7 {
                continue;
            }
            let lattice = Lattice::auto(dimension, kernel, h);
            if is_stable(softest(lattice, kernel, h)?) {
                return Ok((lattice, h));
            }
        }
    }
    Err(format!(
        "no lattice of {dimension} dimensions rests with {kernel}"
    ))
}

fn find<const D: usize>(kernel: KernelKind, lattice: Lattice, h: f64) -> Result<Found, String> {
    let crystal = Crystal::<D>::new(lattice, kernel, h);
    let greatest = crystal.extremes()?.greatest;
    let in_box = (crystal
        .cell
        .waves_in(lattice, cells::<D>(lattice, EDGE))
        .into_iter())
    .map(|k| Ok(crystal.values(k)?.into_iter().fold(0.0, f64::max)))
    .collect::<Result<Vec<f64>, String>>()?
    .into_iter()
    .fold(0.0, f64::max);
    let largest = [0.0, DAMPING].map(|zeta| {
        let bound =
            |square: f64| ((zeta * zeta + 4.0 * square).sqrt() - zeta) / (square * PUBLISHED * h);
        let measured = measured::<D>(kernel, lattice, h, zeta);
        [bound(greatest), bound(in_box), measured]
    });
    Ok(Found {
        kernel,
        lattice,
        h,
        greatest,
        largest,
    })
}

/// The largest multiple of the published step that does not blow up.
fn measured<const D: usize>(kernel: KernelKind, lattice: Lattice, h: f64, zeta: f64) -> f64 {
    let cells = cells::<D>(lattice, EDGE);
    let mut evolution = Evolution::<D>::new(lattice, kernel, h, cells, Repulsion::none());
    let mut is_borne = |multiple: f64| {
        let mut random = SplitMix64::new(11);
        let noise: Vec<[f64; D]> = (evolution.sites.iter())
            .map(|_| std::array::from_fn(|_| NOISE * (2.0 * random.unit() - 1.0)))
            .collect();
        evolution.displace(|i| noise[i]);
        (0..STEPS).all(|_| {
            evolution.step(multiple * PUBLISHED * h, zeta);
            evolution.spread() < BLOWN_UP
        })
    };
    let [mut low, mut high] = MULTIPLES;
    while high / low > 1.0 + CLOSE {
        let middle = (low * high).sqrt();
        if is_borne(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
