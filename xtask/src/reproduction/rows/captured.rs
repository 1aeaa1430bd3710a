//! 001 fig. 8: the interval between captures.

use super::row;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::trials::Captured;

/// The paper's choice, and where it finds that more changes little.
const CHOSEN: usize = 50;
const ENOUGH: usize = 20;

/// "Little", of a root mean square: by no more than this factor.
const LITTLE: f64 = 1.5;

pub(super) fn captured(all: &mut Vec<Row>) {
    for every in [5, 10, ENOUGH, CHOSEN, 100, 200] {
        let trial = Captured { every };
        for measure in [Measure::ResidualRms, Measure::Residual, Measure::Iterations] {
            let beside = row("fig8", trial, measure);
            let is_quick = every == ENOUGH || every == CHOSEN;
            all.push(if is_quick { beside.quick() } else { beside });
        }
    }
    for every in [CHOSEN, 100] {
        let ratio = row("fig8", Captured { every }, Measure::ResidualRms)
            .under(Captured { every: ENOUGH })
            .claims("from 20 on it changes little")
            .at_most(LITTLE);
        all.push(if every == CHOSEN {
            ratio.quick()
        } else {
            ratio
        });
    }
}
