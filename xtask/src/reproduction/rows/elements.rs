//! 004 fig. 8: an airfoil of three elements.

use super::row;
use crate::relaxed_airfoils::Way;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::trials::Elements;

/// A hole that is larger than the largest of a square lattice, 0.71 ∆s, by more than a tenth is a void. The paper shows a picture.
const VOID: f64 = 0.81;

pub(super) fn elements(all: &mut Vec<Row>) {
    let of = |way, measure| row("fig8", Elements { way }, measure).of("004");
    all.extend([
        of(Way::OwnGrids, Measure::LargestHole)
            .claims("without Booleans there are voids")
            .at_least(VOID),
        of(Way::Separate, Measure::LargestHole)
            .claims("Booleans eliminate voids near sharp structures")
            .at_most(VOID),
        of(Way::Complex, Measure::LargestHole)
            .claims("homogeneous even at sharp edges")
            .at_most(VOID),
    ]);
    for way in [Way::OwnGrids, Way::Separate, Way::Complex] {
        all.push(of(way, Measure::LeastGamma));
        all.push(of(way, Measure::FluidResidual));
    }
    for worse in [Way::OwnGrids, Way::Separate] {
        all.push(
            of(Way::Complex, Measure::FluidResidual)
                .under(Elements { way: worse })
                .claims("separate relaxation has high kernel gradients at the interface, complex has not")
                .at_least(1.0),
        );
    }
}
