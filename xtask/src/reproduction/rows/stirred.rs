//! 000 figs. 7b and 14: lattices after an agitator, and in space among frozen particles.

use sphpack_packing::{Agitators, Lattice};

use super::row;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::trials::{Stirred, Walled};

/// Revolutions after which it is looked at, and those in a hurry. The papers' axes are not readable: their curves end between these.
const LONG: usize = 25;
const SHORT: usize = 5;

/// What is left of the largest error, where the text says that it converges; and where that it does not. The paper shows
/// curves and no number.
const LITTLE: f64 = 0.25;
const MOST: f64 = 0.5;

/// Who ends so near to a site, in ∆s, has come back.
const BACK: f64 = 0.02;

/// Iterations of fig. 14a: as of fig. 7a, and in a hurry.
const ITERATIONS: usize = 15_000;
const FEW_ITERATIONS: usize = 2000;

pub(super) fn stirred(all: &mut Vec<Row>) {
    plane(all);
    space(all);
}

/// Fig. 7b.
fn plane(all: &mut Vec<Row>) {
    let of = |lattice, is_repelled, revolutions| Stirred {
        lattice,
        is_repelled,
        agitators: Agitators::Turning,
        revolutions,
    };
    for lattice in [Lattice::Hexagonal, Lattice::Square] {
        for is_repelled in [false, true] {
            let trial = of(lattice, is_repelled, LONG);
            all.push(row("fig7b", trial, Measure::DensityLeft).of("000"));
            let left = row("fig7b", trial, Measure::DensityLeftOverStirred).of("000");
            all.push(if lattice == Lattice::Square && is_repelled {
                left.claims(
                    "with repulsion the rectangular one attains an intermediate arrangement",
                )
                .at_least(MOST)
            } else {
                left.claims("all others converge alike").at_most(LITTLE)
            });
        }
    }
    // In a hurry: by then the square one with repulsion has not fallen, and the hexagonal one has begun to.
    let [square, hexagonal] = [Lattice::Square, Lattice::Hexagonal].map(|l| of(l, true, SHORT));
    all.push(
        row("fig7b", hexagonal, Measure::DensityLeft)
            .under(square)
            .of("000")
            .claims("hexagonal arrangements are more stable")
            .at_least(1.0)
            .quick(),
    );
}

/// Fig. 14.
fn space(all: &mut Vec<Row>) {
    let until = |lattice, is_repelled, iterations| Walled {
        lattice,
        h_over_spacing: 1.2,
        is_repelled,
        by: 0.25,
        iterations,
    };
    let moved = |lattice, is_repelled| until(lattice, is_repelled, ITERATIONS);
    all.push(
        row(
            "fig14a",
            until(Lattice::Hcp, true, FEW_ITERATIONS),
            Measure::FromSite,
        )
        .of("000")
        .claims("the hexagonal one is stable in space as well")
        .at_most(BACK)
        .quick(),
    );
    for is_repelled in [false, true] {
        let [cubic, packed] = [Lattice::SimpleCubic, Lattice::Hcp].map(|l| moved(l, is_repelled));
        let cubic_stays = row("fig14a", cubic, Measure::FromSite).of("000");
        all.push(if is_repelled {
            cubic_stays
        } else {
            cubic_stays
                .claims("the rectangular one does not come back to its place")
                .at_least(BACK)
        });
        all.push(
            row("fig14a", packed, Measure::FromSite)
                .of("000")
                .claims("the hexagonal one is stable in space as well")
                .at_most(BACK),
        );
        for trial in [cubic, packed] {
            all.push(row("fig14a", trial, Measure::DensityLeft).of("000"));
        }
    }
    all.push(
        row(
            "fig14a",
            moved(Lattice::SimpleCubic, true),
            Measure::DensityLeft,
        )
        .under(moved(Lattice::SimpleCubic, false))
        .of("000")
        .claims("repulsion helps the rectangular one to a better configuration")
        .at_least(1.0),
    );
    let stirred = |lattice, is_repelled| Stirred {
        lattice,
        is_repelled,
        agitators: Agitators::Turning,
        revolutions: LONG,
    };
    for is_repelled in [false, true] {
        let [cubic, packed] = [Lattice::SimpleCubic, Lattice::Hcp].map(|l| stirred(l, is_repelled));
        all.push(
            row("fig14b", cubic, Measure::FromSite)
                .of("000")
                .claims("the rectangular one approaches another equilibrium")
                .at_least(BACK),
        );
        all.push(
            row("fig14b", packed, Measure::FromSite)
                .of("000")
                .claims("the hexagonal one is stable in space as well")
                .at_most(BACK),
        );
        all.push(row("fig14b", packed, Measure::DensityLeftOverStirred).of("000"));
        all.push(
            row("fig14b", packed, Measure::DensityLeft)
                .under(cubic)
                .of("000")
                .claims("where the density varies more than in the hexagonal one")
                .at_least(1.0),
        );
    }
}
