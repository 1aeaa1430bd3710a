//! Slopes over ∆s, and curves over h/∆s, of rows that other figures have too.

use sphpack::scene::Method;
use sphpack_kernels::KernelKind;

use super::{h_at, row};
use crate::reproduction::measure::Measure;
use crate::reproduction::row::{Row, Taken};
use crate::reproduction::setup::Setup;

/// h/∆s of the curves, at this ∆s.
const CURVED_AT: f64 = 0.05;
const CURVE: [f64; 11] = [1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0];

/// The spacings of 001 fig. 13.
const SPACINGS: [f64; 3] = [0.1, 0.05, 0.02];

pub(super) fn slopes(all: &mut Vec<Row>) {
    interpolation(all);
    starfish(all);
    over_h(all);
}

/// How errors fall with ∆s, by the h/∆s of 001 §4.1: the rows of fig. 13 once more.
fn interpolation(all: &mut Vec<Row>) {
    for method in [Method::Hybrid, Method::Standard, Method::Balanced] {
        let [first, others @ ..] = SPACINGS.map(|spacing| {
            let h = h_at(spacing);
            let patience = if spacing < 0.05 { 5000 } else { 100_000 };
            Setup::of("cylinder", spacing, method)
                .at(h)
                .judged(h)
                .within(patience)
        });
        for measure in [
            Measure::FunctionAsPrinted,
            Measure::DerivativeAsPrinted,
            Measure::FunctionAtParticles,
            Measure::DerivativeAtParticles,
        ] {
            both(all, row("fig13", first, measure), &others);
        }
    }
}

/// How the density's variation changes with ∆s, of which the paper prints three numbers and no law.
fn starfish(all: &mut Vec<Row>) {
    for method in [Method::Hybrid, Method::Balanced] {
        let [first, others @ ..] = [0.1, 0.075, 0.05].map(|spacing| {
            let setup = Setup::of("starfish", spacing, method);
            if method == Method::Hybrid {
                setup.at(1.2)
            } else {
                setup
            }
        });
        both(
            all,
            row("fig17", first, Measure::Variation).quick(),
            &others,
        );
    }
}

/// The slope, and its error.
fn both(all: &mut Vec<Row>, row: Row, others: &[Setup]) {
    for taken in [
        Taken::Slope(others.to_vec()),
        Taken::SlopeError(others.to_vec()),
    ] {
        all.push(Row {
            taken,
            ..row.clone()
        });
    }
}

/// Errors off the sites over the lattice's own, against h/∆s.
fn over_h(all: &mut Vec<Row>) {
    for kernel in [KernelKind::Quintic, KernelKind::WendlandC2] {
        let [first, others @ ..] = CURVE.map(|h| {
            let setup = Setup::of("cylinder", CURVED_AT, Method::Balanced).by(kernel);
            setup.at(h).judged(h).within(2000)
        });
        for measure in [Measure::FunctionOffSites, Measure::DerivativeOffSites] {
            all.push(Row {
                taken: Taken::Greatest(others.to_vec()),
                ..row("sec4.1", first, measure).claims("no number")
            });
        }
    }
}
