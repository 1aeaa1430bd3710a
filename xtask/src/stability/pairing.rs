//! Which kernels let particles settle in pairs, with and without repulsion.

use std::fmt::Write as _;

use rayon::prelude::*;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::point;
use sphpack_pairs::Repulsion;

use super::Section;
use super::heat::{Panel, svg};
use super::ink::PAIRED;
use crate::random_start::RandomStart;

/// Edge of the periodic square, in ∆s; it holds its square of particles.
const EDGE: usize = 20;

/// h/∆s in twentieths: from, to, by.
const TWENTIETHS: [usize; 3] = [14, 50, 1];
const HURRIED: [usize; 3] = [24, 40, 16];

/// Random starts of each.
const STARTS: u64 = 3;

/// Evaluations after which it is looked at, and what counts as settled.
const PATIENCE: usize = 400;
const SETTLED: f64 = 1e-4;

/// Who is nearer than this, in ∆s, is a pair.
const PAIR: f64 = 0.5;

/// What particles settle to with this kernel, at every h/∆s.
struct Row {
    kernel: KernelKind,
    is_repelled: bool,
    settled: Vec<Settled>,
}

/// The part of the particles that is in pairs, and the distance of the closest two, in ∆s.
#[derive(Debug, Clone, Copy)]
struct Settled {
    paired: f64,
    closest: f64,
}

/// The maps and their table.
pub(super) fn section(is_quick: bool) -> Result<Section, String> {
    let [from, to, by] = if is_quick { HURRIED } else { TWENTIETHS };
    let starts = if is_quick { 1 } else { STARTS };
    let hs: Vec<f64> = (from..=to)
        .step_by(by)
        .map(|twentieths| twentieths as f64 / 20.0)
        .collect();
    let rows: Vec<Row> = ([false, true].iter())
        .flat_map(|&is_repelled| KernelKind::ALL.map(|kernel| (kernel, is_repelled)))
        .map(|(kernel, is_repelled)| Row {
            kernel,
            is_repelled,
            settled: (hs.par_iter())
                .map(|&h| {
                    let all = (0..starts).map(|start| settled(kernel, h, is_repelled, start));
                    let none = Settled {
                        paired: 0.0,
                        closest: f64::INFINITY,
                    };
                    all.fold(none, |sum, one| Settled {
                        paired: sum.paired + one.paired / starts as f64,
                        closest: sum.closest.min(one.closest),
                    })
                })
                .collect(),
        })
        .collect();
    let mut text = format!(
        "## Pairing\n\n\
         {} particles at random places of a periodic square settle by L-BFGS ({PATIENCE} evaluations at most); {STARTS} starts each. The table\n\
         has the ranges of h/∆s in steps of 0.05 at which not one has another nearer than ∆s/2 in the end, in any start, the largest part\n\
         of them that has, and the closest two of all. A kernel with a negative lobe in its Fourier transform pulls close pairs together where\n\
         h is large (Dehnen & Aly 2012): the splines; the Wendland kernels have none. Repulsion is 001's, C = {}, as balanced has it in its\n\
         first stage.\n\n\
         ![Particles in pairs](stability-pairing.svg)\n\n\
         | kernel | repulsion | no pairs at h/∆s | most in pairs | at h/∆s | closest pair / ∆s | at h/∆s |\n|---|---|---|---|---|---|---|\n",
        EDGE * EDGE,
        Repulsion::STRENGTH,
    );
    for row in &rows {
        let worst = |of: &dyn Fn(&Settled) -> f64| {
            (row.settled.iter().zip(&hs))
                .map(|(settled, &h)| (of(settled), h))
                .fold(
                    (f64::NEG_INFINITY, f64::NAN),
                    |a, b| if b.0 > a.0 { b } else { a },
                )
        };
        let most = worst(&|settled| settled.paired);
        let closest = worst(&|settled| -settled.closest);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.3} | {:.2} |",
            row.kernel,
            if row.is_repelled { "on" } else { "off" },
            super::safe::ranges(&hs, |i| row.settled[i].paired <= 0.0),
            if most.0 > 0.0 {
                format!("{:.1} % | {:.2}", 100.0 * most.0, most.1)
            } else {
                "none | –".to_owned()
            },
            -closest.0,
            closest.1,
        );
    }
    text.push('\n');
    let panels: Vec<Panel> = [false, true]
        .into_iter()
        .map(|is_repelled| Panel {
            title: if is_repelled {
                "with repulsion".to_owned()
            } else {
                "without repulsion".to_owned()
            },
            rows: (rows.iter())
                .filter(|row| row.is_repelled == is_repelled)
                .map(|row| {
                    let paired = row.settled.iter().map(|settled| settled.paired);
                    (row.kernel.name().to_owned(), paired.collect())
                })
                .collect(),
            marked: Vec::new(),
        })
        .collect();
    let picture = svg(
        "Pairs after settling from random places, in the plane",
        &hs,
        &panels,
        &PAIRED,
    );
    Ok(Section {
        text,
        pictures: vec![("stability-pairing.svg", picture)],
    })
}

/// How random particles settle.
fn settled(kernel: KernelKind, h: f64, is_repelled: bool, start: u64) -> Settled {
    let start = RandomStart {
        kernel,
        h_over_spacing: h,
        edge: EDGE,
        repulsion: if is_repelled {
            Repulsion::new(1.0, Repulsion::STRENGTH)
        } else {
            Repulsion::none()
        },
        settled: SETTLED,
        patience: PATIENCE,
        seed: start,
    };
    let (domain, particles) = start.run::<2>();
    let places = &particles.position;
    let nearest: Vec<f64> = (0..places.len())
        .map(|i| {
            let others = (places.iter().enumerate()).filter(|(j, _)| *j != i);
            others
                .map(|(_, place)| point::norm(domain.difference(*place, places[i])))
                .fold(f64::INFINITY, f64::min)
        })
        .collect();
    let pairs = nearest.iter().filter(|r| **r < PAIR).count();
    Settled {
        paired: pairs as f64 / places.len() as f64,
        closest: nearest.iter().copied().fold(f64::INFINITY, f64::min),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The quintic pairs at large h/∆s, Wendland's kernel does not.
    #[test]
    fn splines_pair_and_wendlands_do_not() {
        assert!(settled(KernelKind::Quintic, 2.0, false, 0).paired > 0.5);
        assert!(settled(KernelKind::WendlandC4, 2.0, false, 0).paired <= 0.0);
    }
}
