//! Which lattice to start from: what theory says of each, and what packings from it are like.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};
use sphpack::Outcome;
use sphpack_kernels::KernelKind;
use sphpack_packing::Lattice;

use crate::arguments::Arguments;
use crate::bench::Bench;
use crate::chart::{Axis, Chart, Scale, Series};
use crate::crystal::{UNSTABLE, softest};
use crate::selection::Selection;
use crate::shipped::load;
use crate::shown_table::ShownTable;
use crate::workspace::write;

const KERNELS: [KernelKind; 4] = [
    KernelKind::Quintic,
    KernelKind::Cubic,
    KernelKind::WendlandC2,
    KernelKind::WendlandC4,
];

const H_OVER_SPACING: [f64; 8] = [0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.5, 1.8];

/// Scenes that are packed in the plane and in space, with their spacings.
const SCENES: [[(&str, f64); 2]; 2] = [
    [("starfish", 0.05), ("zigzag", 0.05)],
    [("sphere", 0.1), ("cube", 0.1)],
];

/// Evaluations after which a packing that does not settle is judged as it is.
const PATIENCE: usize = 400;

/// The same for every h/∆s.
const LEVELLING: f64 = 10.0;

/// How a lattice did.
struct Trial {
    lattice: Lattice,
    /// min λ / max λ.
    softest: f64,
    /// max Γ − min Γ, the greater of the scenes'.
    variation: f64,
    /// The least distance of two particles over ∆s.
    closest: f64,
    evaluations: usize,
}

/// What is measured of one scene's packing.
#[derive(Debug, Serialize, Deserialize)]
struct Figures {
    variation: f64,
    closest: f64,
    evaluations: usize,
}

impl Figures {
    fn of(outcome: &Outcome) -> Self {
        let report = &outcome.report;
        Self {
            variation: report.density.total_variation,
            closest: report.closest_pair_over_spacing,
            evaluations: report.force_evaluations,
        }
    }
}

/// The arguments that it knows.
pub(crate) const KNOWN: &[&str] = &["--quick", "--write"];

/// The kernels and h/∆s to run, all scenes of each.
pub(crate) fn selection(arguments: &Arguments) -> Selection {
    Selection {
        quick: arguments.has("--quick"),
        write: arguments.has("--write"),
        ..Selection::default()
    }
}

/// Writes the table of both, and the chart of the lattices that "auto" takes.
pub(crate) fn run(selection: &Selection) -> Result<(), String> {
    let mut text = String::from(
        "# Lattices to start from\n\n\
         What a perfect lattice does under background pressure alone, and how packings that start from it end (method\n\
         balanced, levelling 10, 400 evaluations at most for each width of the band; the worse of two scenes: starfish and zig-zag in the plane, sphere and\n\
         turned cube in space). *stability* is the least eigenvalue of the dynamical matrix over the greatest; a\n\
         negative one means that the lattice would rather be something else. *variation* is max Γ − min Γ by the kernel\n\
         that packs, free of its bias. **Bold**: what `lattice = \"auto\"` takes, the lattice of least Γ, that is of least\n\
         energy. Regenerate with `cargo xtask lattices --write`.\n\n",
    );
    for dimension in [2, 3] {
        let (table, chart) = of_dimension(dimension, selection)?;
        let title = if dimension == 2 {
            "In the plane"
        } else {
            "In space"
        };
        let _ = write!(
            text,
            "## {title}\n\n![Variation of density against h/∆s](lattices-{dimension}d.svg)\n\n{table}\n"
        );
        if selection.write {
            write(&format!("docs/lattices-{dimension}d.svg"), &chart.svg())?;
        }
    }
    if selection.write {
        write("docs/lattices.md", &text)?;
    }
    Ok(())
}

fn of_dimension(dimension: usize, selection: &Selection) -> Result<(String, Chart), String> {
    let bench = Bench::open(&[file!()])?;
    let mut table = ShownTable::new(
        "| kernel | h/∆s | lattice | stability | variation | closest pair / ∆s | evaluations |\n|---|---|---|---|---|---|---|\n",
    );
    let mut series = Vec::new();
    for kernel in KERNELS {
        let mut points = Vec::new();
        for h in H_OVER_SPACING {
            if selection.quick && h != 1.2 {
                continue;
            }
            for lattice in Lattice::ALL
                .into_iter()
                .filter(|l| l.dimension() == dimension)
            {
                let trial = attempt(&bench, lattice, kernel, h, selection)?;
                let is_taken = Lattice::auto(dimension, kernel, h) == lattice;
                if is_taken {
                    points.push([h, 100.0 * trial.variation]);
                }
                table.push(&line(kernel, h, &trial, is_taken));
            }
        }
        series.push(Series {
            name: kernel.name().to_owned(),
            points,
            joined: true,
        });
    }
    let chart = Chart {
        title: if dimension == 2 {
            "Packings in the plane"
        } else {
            "Packings in space"
        },
        axes: [
            Axis {
                title: "h/∆s",
                scale: Scale::Linear,
            },
            Axis {
                title: "max Γ − min Γ, %",
                scale: Scale::Logarithmic,
            },
        ],
        series,
    };
    Ok((table.into_text(), chart))
}

fn attempt(
    bench: &Bench,
    lattice: Lattice,
    kernel: KernelKind,
    h: f64,
    selection: &Selection,
) -> Result<Trial, String> {
    let mut trial = Trial {
        lattice,
        softest: softest(lattice, kernel, h)?,
        variation: 0.0,
        closest: f64::INFINITY,
        evaluations: 0,
    };
    for (name, spacing) in SCENES[lattice.dimension() - 2] {
        let Some(mut scene) = load(name, selection)? else {
            continue;
        };
        scene.spacing = spacing;
        scene.packing.kernel = Some(kernel);
        scene.packing.h_over_spacing = Some(h);
        scene.packing.lattice = Some(lattice);
        scene.packing.max_iterations = PATIENCE;
        scene.packing.levelling = Some(LEVELLING);
        let figures = bench.packed(&scene, Figures::of)?;
        trial.variation = trial.variation.max(figures.variation);
        trial.closest = trial.closest.min(figures.closest);
        trial.evaluations = trial.evaluations.max(figures.evaluations);
    }
    Ok(trial)
}

fn line(kernel: KernelKind, h: f64, trial: &Trial, is_taken: bool) -> String {
    let name = trial.lattice.name();
    format!(
        "| {} | {h} | {} | {} | {:.2} % | {:.2} | {} |\n",
        kernel.name(),
        if is_taken {
            format!("**{name}**")
        } else {
            name.to_owned()
        },
        if trial.softest < UNSTABLE {
            format!("{:.1e}", trial.softest)
        } else {
            "stable".to_owned()
        },
        100.0 * trial.variation,
        trial.closest,
        trial.evaluations,
    )
}
