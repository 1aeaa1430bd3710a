//! Bodies in space: 001 figs. 19 to 21, 000 figs. 15 and 18, 004 fig. 17.

use sphpack::scene::Method;

use super::row;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::setup::Setup;
use crate::shipped::iterations_together;

pub(super) fn in_space(all: &mut Vec<Row>) {
    let ellipsoid = |method| Setup::of("ellipsoid", 0.1, method);
    let hybrid = ellipsoid(Method::Hybrid).at(1.2);
    let close = |setup| {
        row("fig19", setup, Measure::Linf)
            .claims("very close to 1")
            .at_most(0.04)
    };
    all.push(close(hybrid).quick());
    all.push(close(ellipsoid(Method::Balanced)).quick());
    let at = |method| {
        let setup = ellipsoid(method).at(1.0).judged(1.0);
        setup.within(iterations_together(method, 2000))
    };
    for measure in [Measure::FunctionAsPrinted, Measure::DerivativeAsPrinted] {
        let ratio = row("fig20", at(Method::Hybrid), measure).under(at(Method::Coupled));
        all.push(ratio.claims("lower than the coupled method").at_least(1.0));
    }
    bunny(all);
    sphere(all);
}

/// ∆s of the papers' rabbits, and one at which every published method is done within minutes.
const RABBITS: [f64; 2] = [0.02, 0.05];

/// 001 fig. 21, 000 fig. 18, and 004 fig. 17, which judges by the kernel's gradients at the surface.
fn bunny(all: &mut Vec<Row>) {
    for spacing in RABBITS {
        let of = |method| Setup::of("bunny", spacing, method).at(1.2);
        let is_long = spacing == RABBITS[0];
        let long = |row: Row| if is_long { row.fine() } else { row };
        let on = |figure, setup| row(figure, setup, Measure::OffSurface).at_most(0.05);
        all.push(long(on("fig21", of(Method::Hybrid))));
        all.push(on("fig21", of(Method::Balanced)));
        all.push(long(on("fig18", of(Method::Agitated)).of("000")));
        all.push(on("fig18", of(Method::Balanced)).of("000"));
        let of = |method| Setup::of("bunny", spacing, method).within(RELAXED);
        let ratio = row("fig17", of(Method::Complex), Measure::FluidResidual)
            .under(of(Method::Relaxation))
            .claims("a good zero-order consistency at the interface")
            .at_least(1.0);
        all.push(long(ratio.of("004")));
        for method in [Method::Complex, Method::Relaxation, Method::Balanced] {
            let beside = row("fig17", of(method), Measure::FluidResidual).of("004");
            // The default method is done in seconds.
            all.push(match method {
                Method::Balanced => beside,
                _ => long(beside),
            });
        }
    }
}

/// Iterations of 004's relaxations in space.
const RELAXED: usize = 1000;

/// 000 fig. 15.
fn sphere(all: &mut Vec<Row>) {
    for method in [Method::Clipped, Method::Agitated, Method::Balanced] {
        let setup = Setup::of("sphere", 0.1, method).judged(1.2).within(20_000);
        let beside = row("fig15", setup, Measure::Linf).of("000");
        all.push(match method {
            Method::Agitated => beside,
            _ => beside.quick(),
        });
    }
}
