//! What levelling buys, and what it costs.

use sphpack::Outcome;

use crate::bench::Bench;
use crate::selection::Selection;
use crate::shipped::load;
use crate::shown_table::ShownTable;

const HEAD: &str = "\
| scene | ∆s | κ | L∞ | 99 % within | residual of free max, rms | closest pair / ∆s | evaluations | seconds |
|---|---|---|---|---|---|---|---|---|
";

/// Scenes, their spacings, and whether they are quick.
const SCENES: [(&str, f64, bool); 4] = [
    ("starfish", 0.05, true),
    ("zigzag", 0.05, false),
    ("naca0015", 0.02, false),
    ("sphere", 0.1, false),
];

/// From none to as much as a patient user wants.
const STIFFNESS: [f64; 6] = [0.0, 3.0, 10.0, 30.0, 100.0, 300.0];

/// The table of stiffness κ against density and residual.
pub(crate) fn table(selection: &Selection) -> Result<String, String> {
    let bench = Bench::open(&[file!()])?;
    let mut table = ShownTable::new(HEAD);
    for (name, spacing, quick) in SCENES {
        if !selection.wants(name, quick) {
            continue;
        }
        for stiffness in STIFFNESS {
            let Some(mut scene) = load(name, selection)? else {
                continue;
            };
            scene.spacing = spacing;
            scene.packing.levelling = Some(stiffness);
            scene.packing.max_iterations = 2000;
            let figures = bench.packed(&scene, figures)?;
            table.push(&format!(
                "| {name} | {spacing} | {stiffness} | {figures} |\n"
            ));
        }
    }
    Ok(table.into_text())
}

/// A row's figures, from L∞ on.
fn figures(outcome: &Outcome) -> String {
    let report = &outcome.report;
    format!(
        "{:.3} % | {:.3} % | {:.1e}, {:.1e} | {:.3} | {} | {:.2}",
        100.0 * report.density.linf,
        100.0 * outcome.table.error_of_most(0.99),
        report.residual.max,
        report.residual.rms,
        report.closest_pair_over_spacing,
        report.force_evaluations,
        report.seconds.total,
    )
}
