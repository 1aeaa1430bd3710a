//! Lattices in a box of frozen particles: the wave that would grow may be too long to fit.

use std::fmt::Write as _;

use faer::{Mat, Side};
use rayon::prelude::*;
use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{Odometer, point};
use sphpack_packing::Lattice;

use super::Section;
use crate::chart::{Axis, Chart, Scale, Series};
use crate::crystal::Crystal;

/// Lattices and h/∆s, the quintic kernel; how large the box grows, in ∆s.
const CASES: [(Lattice, f64, usize); 5] = [
    (Lattice::SimpleCubic, 1.2, 9),
    (Lattice::Hcp, 1.2, 9),
    (Lattice::Bcc, 1.3, 9),
    (Lattice::Square, 1.1, 24),
    (Lattice::Hexagonal, 1.3, 24),
];

/// The smallest box, and the largest one in a hurry.
const SMALLEST: usize = 2;
const HURRIED: usize = 3;

/// Box of 000 fig. 14, in ∆s.
const PUBLISHED: usize = 4;

/// Off the sites, so that none lies on a side of the box.
const OFF: f64 = 1e-3;

struct Found {
    lattice: Lattice,
    h: f64,
    /// The endless lattice's least eigenvalue over its greatest.
    endless: f64,
    /// Edge of the box and the least eigenvalue of what is free in it, over the endless lattice's greatest.
    boxes: Vec<(usize, f64)>,
}

/// The table and its picture.
pub(super) fn section(is_quick: bool) -> Result<Section, String> {
    let cases = if is_quick { &CASES[..2] } else { &CASES[..] };
    let found: Vec<Found> = (cases.iter())
        .map(|&(lattice, h, largest)| {
            let largest = if is_quick { HURRIED } else { largest };
            if lattice.dimension() == 2 {
                find::<2>(lattice, h, largest)
            } else {
                find::<3>(lattice, h, largest)
            }
        })
        .collect::<Result<_, _>>()?;
    let mut text = format!(
        "## 000 fig. 14: clamped boxes\n\n\
         The preprint looks at a box of {PUBLISHED} ∆s among frozen particles (its h/∆s is taken to be 1.2, that of its study in the plane), sees\n\
         the rectangular lattice leave its sites and the hexagonal one come back, and takes the latter for stable in space. Only waves that fit into it can grow there: the table has the\n\
         least eigenvalue of what is free in a cube (square) of the lattice, over the greatest of the endless lattice. The smallest unstable\n\
         box is what has room for a growing wave; below it the lattice stays, whatever it does in a large packing. The quintic kernel.\n\n\
         ![Least eigenvalue against the size of the box](stability-clamped.svg)\n\n\
         | lattice | h/∆s | box of {PUBLISHED} ∆s | smallest unstable box / ∆s | largest box tried / ∆s | there | endless |\n|---|---|---|---|---|---|---|\n"
    );
    for f in &found {
        let of = |edge: usize| {
            f.boxes
                .iter()
                .find(|(of, _)| *of == edge)
                .map(|found| found.1)
        };
        let smallest = (f.boxes.iter()).find(|(_, ratio)| !super::sweep::is_stable(*ratio));
        let last = f.boxes.last();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {:.1e} |",
            f.lattice,
            f.h,
            of(PUBLISHED).map_or("–".to_owned(), shown),
            smallest.map_or("none".to_owned(), |(edge, _)| edge.to_string()),
            last.map_or(0, |(edge, _)| *edge),
            last.map_or("–".to_owned(), |(_, ratio)| shown(*ratio)),
            f.endless,
        );
    }
    text.push('\n');
    Ok(Section {
        text,
        pictures: vec![("stability-clamped.svg", chart(&found).svg())],
    })
}

fn shown(ratio: f64) -> String {
    if super::sweep::is_stable(ratio) {
        format!("stays ({ratio:+.1e})")
    } else {
        format!("{ratio:.1e}")
    }
}

fn find<const D: usize>(lattice: Lattice, h: f64, largest: usize) -> Result<Found, String> {
    let kernel = KernelKind::Quintic;
    let extremes = Crystal::<D>::new(lattice, kernel, h).extremes()?;
    let boxes: Vec<(usize, f64)> = (SMALLEST..=largest)
        .into_par_iter()
        .map(|edge| {
            let matrix = kernel.with::<D, Clamped>(h, Clamped { lattice, edge });
            let values = matrix
                .self_adjoint_eigenvalues(Side::Lower)
                .map_err(|error| format!("eigenvalues of a box of {edge} ∆s: {error:?}"))?;
            let least = values.first().copied().unwrap_or(f64::NAN);
            Ok((edge, least / extremes.greatest))
        })
        .collect::<Result<_, String>>()?;
    Ok(Found {
        lattice,
        h,
        endless: extremes.ratio(),
        boxes,
    })
}

/// Asks a kernel for the second derivatives of the energy by what is free in a cube of a lattice.
struct Clamped {
    lattice: Lattice,
    edge: usize,
}

impl<const D: usize> WithKernel<D> for Clamped {
    type Output = Mat<f64>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Mat<f64> {
        let unit = self.lattice.unit_cell::<D>();
        let edges = unit.cell();
        let edge = self.edge as f64;
        let far = edges.map(|length| ((edge + kernel.support()) / length).ceil() as i64 + 1);
        let sites: Vec<[f64; D]> = Odometer::new(far.map(|n| -n), far.map(|n| n + 1))
            .flat_map(|n| {
                let shift: [f64; D] = std::array::from_fn(|axis| n[axis] as f64 * edges[axis]);
                unit.sites()
                    .into_iter()
                    .map(move |site| point::add(site, shift))
            })
            .collect();
        let (free, frozen): (Vec<_>, Vec<_>) =
            (sites.into_iter()).partition(|site| site.iter().all(|x| *x >= OFF && *x < edge + OFF));
        let mut matrix = Mat::<f64>::zeros(D * free.len(), D * free.len());
        for (i, &here) in free.iter().enumerate() {
            for (j, &there) in free.iter().chain(&frozen).enumerate() {
                let way = point::sub(there, here);
                if j == i || point::norm(way) >= kernel.support() {
                    continue;
                }
                let stiffness = kernel.hessian(way);
                for row in 0..D {
                    for column in 0..D {
                        let stiff = stiffness[row][column];
                        matrix[(D * i + row, D * i + column)] += stiff;
                        if j < free.len() {
                            matrix[(D * i + row, D * j + column)] -= stiff;
                        }
                    }
                }
            }
        }
        matrix
    }
}

fn chart(found: &[Found]) -> Chart {
    let series = (found.iter())
        .map(|f| Series {
            name: format!("{}, {}", f.lattice, f.h),
            points: (f.boxes.iter())
                .map(|(edge, ratio)| [*edge as f64, 1e3 * ratio])
                .collect(),
            joined: true,
        })
        .collect();
    Chart {
        title: "What is free in a box of frozen particles",
        axes: [
            Axis {
                title: "edge of the box / ∆s",
                scale: Scale::Linear,
            },
            Axis {
                title: "least eigenvalue over the greatest, × 1000",
                scale: Scale::Linear,
            },
        ],
        series,
    }
}
