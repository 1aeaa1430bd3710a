//! What paper 000's agitators do to a lattice and to a packing (its figs. 7b, 13 and 14b).

use serde::{Deserialize, Serialize};
use sphpack::Outcome;
use sphpack::scene::{AgitatorsAre, Method as Named};
use sphpack_kernels::KernelKind;
use sphpack_packing::{Agitated, Agitators, Lattice, Method, Packed};

use crate::bench::Bench;
use crate::chart::{Axis, Chart, Scale, Series};
use crate::reproduction::{REVOLUTION, Stirred};
use crate::selection::Selection;
use crate::shipped::load;
use crate::shown_table::ShownTable;
use crate::workspace::write;

pub(crate) const ABOUT: &str = "
![Error of the density after an agitator in a lattice has become free](agitators.svg)

000's figs. 7b and 14b: an agitator in the middle of a lattice runs for half a revolution, then it is a free particle;
20 × 20 particles in a periodic box with a tenth of the damping, and 4 × 4 × 4 among frozen ones. The number density
gradient (ND) alone and with the repulsion (RF); errors against 1, half a revolution and 5 and 25 revolutions after the
start. As the paper has it, in the plane the hexagonal arrangement comes back and repulsion makes the square one find
another; it does so with an agitator at rest as well, only later, as that lattice does not hold itself. Elsewhere in the
plane an agitator at rest leaves the lattice as it was: it is the going round that stirs. In space neither lattice stays
where it was, agitator or not; the paper's hexagonal one ends no better than the cubic one.
";

const LATTICES: &str = "\
| lattice | forces | agitator | L∞ at the start | largest while it runs | after 1/2 | 5 | 25 revolutions |
|---|---|---|---|---|---|---|---|
";

const PACKINGS: &str = "\
| scene | ∆s | agitators | L∞ | total variation | body's volume off | on the surface / N_s | closest pair / ∆s | iterations | |
|---|---|---|---|---|---|---|---|---|---|
";

const ABOUT_PACKINGS: &str = "
The same in packings: agitators that turn, that stay at rest, and none; the starfish stands for the \"arbitrary shape\" of
000's fig. 13, whose curve is not given, at the paper's three spacings. Eq. 17 asks that the error change little within a
revolution, and what it falls by in one is a third of what is left, by the damping of eq. 19: so the method ends at a few
thousandths, whatever more iterations would bring. Within that, what agitators do makes little difference: the surface
has its share from the start, and turning agitators take longer.
";

/// Scenes and spacings.
const SCENES: [(&str, f64); 6] = [
    ("cylinder", 0.1),
    ("square", 0.05),
    ("starfish", 0.1),
    ("starfish", 0.075),
    ("starfish", 0.05),
    ("naca0015", 0.02),
];

/// Both tables; the chart where the page is written.
pub(crate) fn tables(selection: &Selection) -> Result<String, String> {
    let bench = Bench::open(&[file!(), "xtask/src/reproduction/trials/stirred.rs"])?;
    let mut lattices = ShownTable::new(LATTICES);
    let mut curves = Vec::new();
    if selection.only.is_none() {
        for lattice in [Lattice::Hexagonal, Lattice::Square] {
            stirred::<2>(lattice, &bench, &mut lattices, &mut curves)?;
        }
        for lattice in [Lattice::Hcp, Lattice::SimpleCubic] {
            stirred::<3>(lattice, &bench, &mut lattices, &mut Vec::new())?;
        }
    }
    if selection.write {
        let chart = Chart {
            title: "A lattice after an agitator: 20 × 20 particles",
            axes: [
                Axis {
                    title: "iterations; the agitator runs for the first 1,000",
                    scale: Scale::Linear,
                },
                Axis {
                    title: "greatest error of the density, %",
                    scale: Scale::Logarithmic,
                },
            ],
            series: curves,
        };
        write("docs/agitators.svg", &chart.svg())?;
    }
    let mut packings = ShownTable::new(PACKINGS);
    for (name, spacing) in SCENES {
        if !selection.wants(name, name == "cylinder") {
            continue;
        }
        for (words, agitators) in [
            ("turning", AgitatorsAre::Turning),
            ("resting", AgitatorsAre::Resting),
            ("none", AgitatorsAre::None),
        ] {
            let Some(mut scene) = load(name, selection)? else {
                continue;
            };
            scene.spacing = spacing;
            scene.packing.method = Named::Agitated;
            scene.packing.agitated.agitators = agitators;
            scene.quality.kernel = Some(KernelKind::Quintic);
            scene.quality.h_over_spacing = Some(1.2);
            let figures = bench.packed(&scene, figures)?;
            packings.push(&format!("| {name} | {spacing} | {words} | {figures} |\n"));
        }
    }
    Ok(format!(
        "{}{ABOUT_PACKINGS}\n{}",
        lattices.into_text(),
        packings.into_text()
    ))
}

/// A packing's row, from L∞ on.
fn figures(outcome: &Outcome) -> String {
    let report = &outcome.report;
    format!(
        "{:.2} % | {:.2} % | {:+.2} % | {} / {} | {:.2} | {} | {}",
        100.0 * report.density.linf,
        100.0 * report.density.total_variation,
        100.0 * (report.bodies[0].volume / report.bodies[0].volume_true - 1.0),
        report.surface[0].count,
        report.surface[0].target_count,
        report.closest_pair_over_spacing,
        report.iterations,
        report.stop_reason,
    )
}

/// A lattice with each of the paper's forces and each agitator.
fn stirred<const D: usize>(
    lattice: Lattice,
    bench: &Bench,
    table: &mut ShownTable,
    curves: &mut Vec<Series>,
) -> Result<(), String>
where
    Agitated: Method<D>,
{
    for (forces, is_repelled) in [("ND", false), ("ND + RF", true)] {
        for (words, agitators) in [
            ("turning", Agitators::Turning),
            ("resting", Agitators::Resting),
        ] {
            let trial = Stirred {
                lattice,
                is_repelled,
                agitators,
                revolutions: 25,
            };
            let course = bench.once(&format!("{trial:?}"), || {
                trial.packed().map(|packed: Packed<D>| Course::of(&packed))
            })?;
            let [half, five, all] = course.after;
            table.push(&format!(
                "| {lattice} | {forces} | {words} | {:.3} % | {:.3} % | {half:.3} % | {five:.3} % | {all:.3} % |\n",
                course.start, course.while_it_runs,
            ));
            if agitators == Agitators::Turning {
                curves.push(Series {
                    name: format!("{lattice}, {forces}"),
                    points: course.points,
                    joined: true,
                });
            }
        }
    }
    Ok(())
}

/// Errors in per cent.
#[derive(Debug, Serialize, Deserialize)]
struct Course {
    start: f64,
    /// The largest.
    while_it_runs: f64,
    /// After half a revolution, five, and all.
    after: [f64; 3],
    /// Every thousandth iteration with its error.
    points: Vec<[f64; 2]>,
}

impl Course {
    fn of<const D: usize>(packed: &Packed<D>) -> Self {
        let at = |iteration: usize| {
            (packed.history.iter())
                .find(|sample| sample.evaluation >= iteration)
                .map_or(f64::NAN, |sample| 100.0 * sample.linf)
        };
        Self {
            start: 100.0 * (packed.problem.perfect_gamma() - 1.0).abs(),
            while_it_runs: (packed.history.iter())
                .filter(|sample| sample.evaluation <= REVOLUTION / 2)
                .fold(0.0, |most: f64, sample| most.max(100.0 * sample.linf)),
            after: [REVOLUTION / 2, 5 * REVOLUTION, 25 * REVOLUTION].map(at),
            points: (packed.history.iter())
                .filter(|sample| sample.evaluation % 1000 == 0)
                .map(|sample| [sample.evaluation as f64, 100.0 * sample.linf])
                .collect(),
        }
    }
}
