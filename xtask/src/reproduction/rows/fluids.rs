//! 002 figs. 11 and 13: a round patch of fluid, and a hull's section afloat.

use sphpack::scene::Method;

use super::row;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::setup::Setup;

/// Iterations that 002 §IV names for its tanks; it names none here.
const MOST: usize = 20_000;

pub(super) fn fluids(all: &mut Vec<Row>) {
    for (figure, scene, spacing, quick) in [
        ("fig11", "drop", 0.04, true),
        ("fig11", "drop", 0.02, false),
        ("fig13", "hull", 0.04, true),
        ("fig13", "hull", 0.02, false),
    ] {
        let of = |method| Setup::of(scene, spacing, method).within(MOST);
        let (packed, balanced) = (of(Method::Ppa), of(Method::Balanced));
        // What the paper holds against a grid is that it moves: the force on its particles before they do.
        let grid = packed.within(0);
        let mut rows = vec![
            row(figure, packed, Measure::ResidualRms)
                .under(grid)
                .claims("a grid resettles, packed fluid stays")
                .at_least(1.0),
            row(figure, balanced, Measure::ResidualRms)
                .under(grid)
                .claims("a grid resettles, packed fluid stays")
                .at_least(1.0),
        ];
        for setup in [packed, balanced] {
            rows.extend(
                [Measure::ResidualRms, Measure::Linf, Measure::Iterations]
                    .map(|m| row(figure, setup, m)),
            );
        }
        rows.push(row(figure, grid, Measure::ResidualRms));
        rows.push(row(figure, grid, Measure::Linf));
        all.extend((rows.into_iter()).map(|row| {
            let row = row.of("002");
            if quick { row.quick() } else { row }
        }));
    }
}
