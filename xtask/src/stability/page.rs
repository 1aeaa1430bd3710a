//! The page's beginning: which lattices are safe with which kernel and h/∆s, and the pictures of their waves.

use std::fmt::Write as _;

use sphpack_kernels::KernelKind;
use sphpack_packing::Lattice;

use super::heat::{Panel, svg};
use super::ink::STABILITY;
use super::safe::ranges;
use super::sweep::{Sweep, is_stable};
use super::{Section, arrows, zones};

/// Title and first words, for who only wants to know what to take.
pub(super) fn beginning(sweep: &Sweep) -> String {
    let hs = &sweep.h_over_spacing;
    let mut text = String::from(
        "# Stability of lattices\n\n\
         **What is safe.** A packing starts from a lattice, and far from bodies it stays one, if the lattice is stable with the kernel and h/∆s\n\
         that pack. Where it is not, waves that carry particles off their sites grow from any disturbance; packings from such lattices take\n\
         more evaluations ([lattices.md](lattices.md)). `lattice = \"auto\"` takes the lattice of least energy; it is stable at\n\n\
         | kernel | in the plane, h/∆s | in space, h/∆s |\n|---|---|---|\n",
    );
    for kernel in KernelKind::ALL {
        let of = |dimension: usize| {
            ranges(hs, |i| {
                let taken = Lattice::auto(dimension, kernel, hs[i]);
                is_stable(sweep.at(kernel, taken, i))
            })
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {kernel} | {} | {} |", of(2), of(3));
    }
    let _ = write!(
        text,
        "\nLooked at was every h/∆s from {:.2} to {:.2} in steps of {:.2}. Pairs of particles are another matter: see [pairing](#pairing). Regenerate with\n\
         `cargo xtask stability lattice --write`.\n\n\
         Each lattice for itself (*stable*: no wave of the whole Brillouin zone lowers the energy):\n\n\
         | kernel |",
        hs[0],
        hs[hs.len() - 1],
        if hs.len() > 1 { hs[1] - hs[0] } else { 0.0 },
    );
    for lattice in Lattice::ALL {
        let _ = write!(text, " {lattice} |");
    }
    text.push_str("\n|---|---|---|---|---|---|---|\n");
    for kernel in KernelKind::ALL {
        let _ = write!(text, "| {kernel} |");
        for strip in sweep.of(kernel) {
            let _ = write!(text, " {} |", ranges(hs, |i| is_stable(strip.ratios[i])));
        }
        text.push('\n');
    }
    text.push('\n');
    text
}

/// The heat maps of all lattices.
pub(super) fn maps(sweep: &Sweep) -> Section {
    let hs = &sweep.h_over_spacing;
    let panels: Vec<Panel> = KernelKind::ALL
        .into_iter()
        .map(|kernel| Panel {
            title: kernel.name().to_owned(),
            rows: (sweep.of(kernel))
                .map(|strip| (strip.lattice.name().to_owned(), strip.ratios.clone()))
                .collect(),
            marked: (sweep.of(kernel).enumerate())
                .map(|(row, strip)| {
                    let is_taken = |h: &f64| {
                        Lattice::auto(strip.lattice.dimension(), kernel, *h) == strip.lattice
                    };
                    (row, hs.iter().map(is_taken).collect())
                })
                .collect(),
        })
        .collect();
    let picture = svg(
        "Stability of lattices; a black line: what lattice = \"auto\" takes",
        hs,
        &panels,
        &STABILITY,
    );
    Section {
        text: "## All lattices, kernels and h/∆s\n\n\
               The dynamical matrix of the background pressure (volumes equal, no repulsion: it begins at 0.95 ∆s, nearer than any site) is\n\
               D(k) = Σ_R (1 − cos k·R) H(R), H = (W″ − W′/r) e⊗e + (W′/r) I, for hcp with two sites in the cell; its eigenvalues are squares\n\
               of frequencies. Coloured is the least of the whole Brillouin zone over the greatest: it is negative where some wave grows, e-fold in\n\
               a time of 1/√−λ.\n\n\
               ![Least eigenvalue over the greatest](stability-lattices.svg)\n\n"
            .to_owned(),
        pictures: vec![("stability-lattices.svg", picture)],
    }
}

/// Brillouin zones, and unstable waves drawn.
pub(super) fn waves(is_quick: bool) -> Result<Section, String> {
    Ok(Section {
        text: "## Which waves\n\n\
               The least eigenvalue of each wave, over the greatest of all. Black: the Brillouin zone, in the plane; a ring: the wave that grows\n\
               fastest. In space the map is a cut through that wave.\n\n\
               ![Least eigenvalue over the Brillouin zone](stability-zones.svg)\n\n\
               The wave that grows fastest, as arrows on the sites (their length is arbitrary):\n\n\
               ![Unstable waves](stability-waves.svg)\n\n"
            .to_owned(),
        pictures: vec![
            ("stability-zones.svg", zones::svg(is_quick)?),
            ("stability-waves.svg", arrows::svg(is_quick)?),
        ],
    })
}
