//! 001 fig. 7 and 000 fig. 7a: a lattice with one particle off its site.

use sphpack_packing::Lattice;

use super::row;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::trials::Displaced;

/// Iterations of the paper, and those after which the plane's lattices are looked at in a hurry.
const LONG: usize = 15_000;
const SHORT: usize = 1500;

/// The papers have 20 particles along an edge; in space 8,000 of them would take an hour.
const EDGES: [f64; 2] = [20.0, 9.0];

/// h/∆s of 000 §3.1, and one at which the close-packed lattices of space are stable too (docs/lattices.md).
const H_OVER_SPACING: [f64; 2] = [1.2, 1.11];

/// What "performs well" and "converges" are taken to mean: the papers show curves and no number.
const WELL: f64 = 0.01;

/// Who ends so near to a site, in ∆s, has come back.
const BACK: f64 = 0.02;

/// A lattice that ends in a much larger difference of density than another: so many times.
const MUCH: f64 = 2.0;

pub(super) fn displaced(all: &mut Vec<Row>) {
    for is_repelled in [false, true] {
        for by in [0.25, 0.5] {
            let of = |lattice: Lattice, h_over_spacing, iterations| Displaced {
                lattice,
                edge: EDGES[lattice.dimension() - 2],
                h_over_spacing,
                is_repelled,
                by,
                iterations,
            };
            for lattice in [Lattice::Hexagonal, Lattice::Square] {
                for iterations in [SHORT, LONG] {
                    let trial = of(lattice, H_OVER_SPACING[0], iterations);
                    let rows = [
                        row("fig7", trial, Measure::DensityLeft)
                            .claims("in the plane all four do well")
                            .at_most(WELL),
                        if iterations == SHORT {
                            row("fig7", trial, Measure::FromSite)
                        } else {
                            row("fig7", trial, Measure::FromSite)
                                .claims("in the plane all four do well")
                                .at_most(BACK)
                        },
                    ];
                    let is_quick = iterations == SHORT;
                    all.extend(rows.map(|row| if is_quick { row.quick() } else { row }));
                    if by == 0.25 {
                        // 000 has a tenth of the damping, so more iterations.
                        let earlier = row("fig7", trial, Measure::DensityLeftOverStart)
                            .of("000")
                            .claims("all four converge alike")
                            .at_most(WELL);
                        all.push(if is_quick { earlier.quick() } else { earlier });
                    }
                }
            }
            for h in H_OVER_SPACING {
                let (cubic, packed) =
                    (of(Lattice::SimpleCubic, h, LONG), of(Lattice::Hcp, h, LONG));
                all.push(
                    row("fig7", packed, Measure::FromSite)
                        .claims("in space the hexagonal one is stable")
                        .at_most(BACK),
                );
                all.push(
                    row("fig7", cubic, Measure::FromSite)
                        .claims("in space the rectangular one is not")
                        .at_least(BACK),
                );
                all.push(row("fig7", packed, Measure::DensityLeft));
                all.push(row("fig7", cubic, Measure::DensityLeft));
                all.push(
                    row("fig7", packed, Measure::DensityLeft)
                        .under(cubic)
                        .claims("in space the rectangular one ends in much larger differences")
                        .at_least(MUCH),
                );
            }
        }
    }
}
