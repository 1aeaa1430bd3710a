//! Packings by every kernel beside what that kernel leaves of particles that settle with no body in the way.

use rayon::prelude::*;
use sphpack_kernels::KernelKind;
use sphpack_packing::Lattice;
use sphpack_packing::forces::Forces;
use sphpack_pairs::Repulsion;

use super::{Figures, Section, parsed};
use crate::bench::Bench;
use crate::random_start::RandomStart;
use crate::shown_table::ShownTable;

/// This file measures.
pub(super) const SOURCE: &str = file!();

/// h/∆s in the plane and in space.
const PLANE: [f64; 11] = [1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0];
const SPACE: [f64; 6] = [1.0, 1.2, 1.4, 1.6, 1.8, 2.0];
const QUICK: f64 = 1.2;

/// Edge of the periodic box in ∆s, in the plane and in space.
const EDGE: [usize; 2] = [20, 10];

/// Random starts; the one in the middle counts. The evenest may be one that has become a crystal: with Wendland C4 at 1.2 one of three was,
/// on a processor that rounds otherwise.
const STARTS: u64 = 5;

/// Evaluations after which it is looked at, and what counts as settled.
const PATIENCE: usize = 1000;
const SETTLED: f64 = 1e-3;

/// A packing's error is at most so many of the floor's.
const TIMES: f64 = 2.0;

/// What is as near to that, as a part of it, may be on either side on another processor, so its verdict is not held to.
const NEAR: f64 = 0.1;

/// Bodies: a disc and a turned square of 9 ∆s, a ball of 6.
const BODIES: [(&str, usize, &str); 3] = [
    (
        "disc",
        2,
        "shape = { circle = { center = [0.0, 0.0], radius = 4.5 } }",
    ),
    (
        "square",
        2,
        "shape = { polygon = { points = [[-4.5, -4.5], [4.5, -4.5], [4.5, 4.5], [-4.5, 4.5]] } }\nrotate_degrees = 20.0",
    ),
    (
        "ball",
        3,
        "shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 3.0 } }",
    ),
];

const ABOUT: &str = "\
The floor: particles at random places of a periodic box, of 20 ∆s in the plane and 10 in space, settle by the energy of background pressure and
repulsion (L-BFGS, to a residual of 10⁻³), and what is then max |Γ − Γ₀|, Γ₀ of the lattice; the middle one of five starts. Beside it the same of packings, a disc and a
turned square of 9 ∆s and a ball of 6; the bar is twice the floor. The lattice's own bias, Γ₀ − 1, is no packing's: the report has errors against 1
(`density.linf`) and against Γ₀ (`density.linf_lattice`). Rows of another levelling than the kernel's own are for comparison: what it buys, and what it costs.

";

const HEAD: &str = "\
| body | kernel | h/∆s | levelling | Γ₀ − 1 | floor | max abs(Γ − Γ₀) | over the floor | max abs(Γ − 1) | closest pair / ∆s | evaluations | |
|---|---|---|---|---|---|---|---|---|---|---|---|
";

pub(super) fn section(bench: &Bench, is_quick: bool) -> Result<Section, String> {
    let mut table = ShownTable::new(HEAD);
    let mut rows = Vec::new();
    for (name, dimension, shape) in BODIES {
        let hs: &[f64] = if dimension == 2 { &PLANE } else { &SPACE };
        for kernel in KernelKind::ALL {
            for &h in hs {
                if is_quick && (h != QUICK || dimension == 3) {
                    continue;
                }
                let floor = bench.once(&format!("floor {dimension} {kernel} {h}"), || {
                    Ok(if dimension == 2 {
                        floor::<2>(kernel, h)
                    } else {
                        floor::<3>(kernel, h)
                    })
                })?;
                let mut scene = parsed(&format!(
                    "spacing = 1.0\n[domain]\nmargin = 8.0\n[[body]]\nname = \"{name}\"\n{shape}\n[packing]\nkernel = \"{kernel}\"\nh_over_spacing = {h:?}\n"
                ))?;
                let own = scene.packing.settling_in(dimension).levelling;
                let other = other_levelling(dimension, kernel, h).filter(|other| *other != own);
                for levelling in [Some(own), other].into_iter().flatten() {
                    if levelling != own {
                        scene.packing.levelling = Some(levelling);
                    }
                    let found = bench.packed(&scene, Figures::of)?;
                    let over = found.linf_lattice / floor;
                    let verdict = match (found.is_right, over <= TIMES) {
                        _ if levelling != own => "compared",
                        (true, true) => "holds",
                        (false, _) => "**not right**",
                        (true, false) => "**missed**",
                    };
                    let is_near = (over / TIMES - 1.0).abs() <= NEAR;
                    if levelling == own && !(found.is_right && is_near) {
                        rows.push((format!("{name} {kernel} {h}"), verdict == "holds"));
                    }
                    table.push(&format!(
                        "| {name} | {kernel} | {h} | {levelling:.0} | {:+.2} % | {:.2} % | {:.2} % | {over:.2} | {:.2} % | {:.2} | {} | {verdict} |\n",
                        100.0 * (Lattice::auto(dimension, kernel, h).gamma(kernel, h) - 1.0),
                        100.0 * floor,
                        100.0 * found.linf_lattice,
                        100.0 * found.linf,
                        found.closest_pair,
                        found.evaluations,
                    ));
                }
            }
        }
    }
    Ok(Section {
        text: format!("{ABOUT}{}", table.into_text()),
        rows,
    })
}

/// A levelling to compare with the kernel's own in space: what all had, of those that have more; a strong one, where a spline is short.
fn other_levelling(dimension: usize, kernel: KernelKind, h: f64) -> Option<f64> {
    match kernel {
        _ if dimension == 2 => None,
        KernelKind::Quintic | KernelKind::Cubic => (h <= QUICK).then_some(100.0),
        _ => Some(10.0),
    }
}

/// max |Γ − Γ₀| of the start in the middle.
fn floor<const D: usize>(kernel: KernelKind, h: f64) -> f64 {
    let mut all: Vec<f64> = (0..STARTS)
        .into_par_iter()
        .map(|start| settled::<D>(kernel, h, start))
        .collect();
    all.sort_unstable_by(f64::total_cmp);
    all[all.len() / 2]
}

/// max |Γ − Γ₀| of random particles once they have settled.
fn settled<const D: usize>(kernel: KernelKind, h: f64, start: u64) -> f64 {
    let start = RandomStart {
        kernel,
        h_over_spacing: h,
        edge: EDGE[D - 2],
        repulsion: Repulsion::new(1.0, Repulsion::STRENGTH),
        settled: SETTLED,
        patience: PATIENCE,
        seed: start,
    };
    let (domain, particles) = start.run::<D>();
    let mut forces = Forces::new(&domain, kernel, h, 0.0, Repulsion::none());
    forces.evaluate(&particles);
    let gamma = Lattice::auto(D, kernel, h).gamma(kernel, h);
    (0..particles.len())
        .map(|i| (forces.gamma(i) - gamma).abs())
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Random particles settle less evenly than a lattice, and more evenly than they began.
    #[test]
    fn what_settles_is_uneven_by_some_per_cent() {
        let floor = settled::<2>(KernelKind::WendlandC2, 1.3, 0);
        assert!((0.002..0.2).contains(&floor), "{floor}");
    }
}
