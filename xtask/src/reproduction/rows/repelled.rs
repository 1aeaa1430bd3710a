//! 001 fig. 5 and 000 fig. 4: the repulsion.

use super::row;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::trials::Repelled;

/// α of the figure, and the one that the paper packs with.
const ALPHA: [f64; 2] = [1.0, 0.95];

/// What differs by rounding alone.
const ROUNDING: f64 = 1e-12;

pub(super) fn repelled(all: &mut Vec<Row>) {
    for alpha in ALPHA {
        let of = |measure| row("fig5", Repelled { alpha }, measure).quick();
        all.extend([
            of(Measure::Begins)
                .claims("only nearer than ∆s")
                .at_most(1.0),
            of(Measure::ForceTogether)
                .claims("constant below ∆s/2")
                .at_most(1.0),
            of(Measure::LargestForce),
            of(Measure::Pulls).claims("no attraction").at_most(0.0),
            of(Measure::OffPrinted).claims("eq. 16").at_most(ROUNDING),
            of(Measure::LennardJonesOverOurs)
                .claims("Lennard-Jones's rises faster")
                .at_least(1.0),
        ]);
    }
    // The preprint's force has another form, and what it shows of it is the same.
    let first = |measure| row("fig4", Repelled { alpha: ALPHA[0] }, measure).of("000");
    all.extend([
        first(Measure::Pulls)
            .claims("no attraction")
            .at_most(0.0)
            .quick(),
        first(Measure::LennardJonesOverOurs)
            .claims("Lennard-Jones's rises faster")
            .at_least(1.0)
            .quick(),
    ]);
}
