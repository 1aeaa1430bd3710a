//! One particle alone against all together: why 001 finds its rectangular lattice unstable where moving a particle raises the energy.

use std::fmt::Write as _;

use rayon::prelude::*;
use sphpack_kernels::KernelKind;
use sphpack_packing::Lattice;
use sphpack_pairs::Repulsion;

use super::Section;
use super::evolution::{Evolution, cells};
use crate::chart::{Axis, Chart, Scale, Series};
use crate::crystal::Crystal;

/// The lattices of 001 fig. 7b.
const LATTICES: [Lattice; 2] = [Lattice::SimpleCubic, Lattice::Hcp];

/// h/∆s in hundredths, and which of them are in the table.
const HUNDREDTHS: [usize; 2] = [80, 150];
const IN_TABLE: usize = 10;

/// How far one particle is moved along each axis, in ∆s: 001's caption, and its text.
const MOVES: [f64; 2] = [0.25, 0.5];

/// About the edge of the periodic box in which it is, in ∆s.
const EDGE: f64 = 10.0;

struct Found {
    lattice: Lattice,
    h: f64,
    /// The least eigenvalue of one particle alone, and of any wave, over the greatest of all.
    alone: f64,
    together: f64,
    /// By how much the energy rises where one particle is moved, in p_b ∆s³.
    rises: [f64; 2],
}

/// The table and its picture.
///
/// # Errors
/// Where moving one particle lowers the energy.
pub(super) fn section(is_quick: bool) -> Result<Section, String> {
    let step = if is_quick { 35 } else { 1 };
    let cases: Vec<(Lattice, usize)> = (LATTICES.into_iter())
        .flat_map(|lattice| {
            (HUNDREDTHS[0]..=HUNDREDTHS[1])
                .step_by(step)
                .map(move |hundredths| (lattice, hundredths))
        })
        .collect();
    let found: Vec<Found> = (cases.par_iter())
        .map(|&(lattice, hundredths)| at(lattice, hundredths as f64 / 100.0))
        .collect::<Result<_, _>>()?;
    if let Some(lowered) =
        (found.iter()).find(|f| f.alone <= 0.0 || f.rises.iter().any(|r| *r <= 0.0))
    {
        return Err(format!(
            "moving one particle of {} at h/∆s = {} lowers the energy: docs/stability.md says that it never does",
            lowered.lattice, lowered.h
        ));
    }
    let is_in_table =
        |f: &&Found| is_quick || ((100.0 * f.h).round() as usize).is_multiple_of(IN_TABLE);
    let mut text = String::from(
        "## 001 fig. 7: one particle alone, and all together\n\n\
         Negi & Ramachandran (2021) find that in space the rectangular lattice does not come back after one particle was moved, and the\n\
         hexagonal one does; as a reason they give that moving a particle lowers the energy of the rectangular lattice. It does not: at every\n\
         h/∆s from 0.80 to 1.50, in steps of 0.01, the energy rises, for small moves (*alone*: the least eigenvalue of one particle while all\n\
         others stay) and for theirs (∆s/4 and ∆s/2 along each axis). What lowers it is a wave in which all take part (*together*: the\n\
         least eigenvalue of any wave), and pushing one particle is one way to begin it. The quintic kernel; eigenvalues over the greatest of\n\
         all waves. In the picture *one* is what is positive, *all* the size of what is negative; where no wave grows nothing is drawn.\n\n\
         ![Eigenvalues of one particle and of all](stability-alone.svg)\n\n\
         | lattice | h/∆s | alone | together | energy of a move by ∆s/4 / p_b ∆s³ | by ∆s/2 |\n|---|---|---|---|---|---|\n",
    );
    for f in found.iter().filter(is_in_table) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {:.2} | {:+.3} | {} | {:+.2e} | {:+.2e} |",
            f.lattice,
            f.h,
            f.alone,
            if super::sweep::is_stable(f.together) {
                "stable".to_owned()
            } else {
                format!("{:.1e}", f.together)
            },
            f.rises[0],
            f.rises[1],
        );
    }
    text.push('\n');
    Ok(Section {
        text,
        pictures: vec![("stability-alone.svg", chart(&found).svg())],
    })
}

fn at(lattice: Lattice, h: f64) -> Result<Found, String> {
    let kernel = KernelKind::Quintic;
    let crystal = Crystal::<3>::new(lattice, kernel, h);
    let extremes = crystal.extremes()?;
    let cells = cells::<3>(lattice, EDGE);
    let mut evolution = Evolution::new(lattice, kernel, h, cells, Repulsion::none());
    let rest = evolution.energy();
    let rises = MOVES.map(|by| {
        evolution.displace(|i| if i == 0 { [by; 3] } else { [0.0; 3] });
        evolution.energy() - rest
    });
    Ok(Found {
        lattice,
        h,
        alone: crystal.alone()?[0] / extremes.greatest,
        together: extremes.ratio(),
        rises,
    })
}

fn chart(found: &[Found]) -> Chart {
    let mut series = Vec::new();
    for lattice in LATTICES {
        let of = |f: &dyn Fn(&Found) -> f64| -> Vec<[f64; 2]> {
            (found.iter())
                .filter(|one| one.lattice == lattice)
                .map(|one| [one.h, f(one)])
                .collect()
        };
        series.push(Series {
            name: format!("{lattice}, one"),
            points: of(&|one| one.alone),
            joined: true,
        });
        series.push(Series {
            name: format!("{lattice}, all"),
            // What is stable is left out.
            points: of(&|one| {
                if super::sweep::is_stable(one.together) {
                    f64::NAN
                } else {
                    -one.together
                }
            }),
            joined: false,
        });
    }
    Chart {
        title: "One particle alone is held (positive), all together are not (negative)",
        axes: [
            Axis {
                title: "h/∆s",
                scale: Scale::Linear,
            },
            Axis {
                title: "size of the least eigenvalue over the greatest",
                scale: Scale::Logarithmic,
            },
        ],
        series,
    }
}
