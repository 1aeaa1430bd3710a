//! Every method on every scene, judged alike.

use serde::{Deserialize, Serialize};
use sphpack::Outcome;
use sphpack::scene::Method;
use sphpack_kernels::KernelKind;

use crate::arguments::Arguments;
use crate::bench::Bench;
use crate::chart::{Axis, Chart, Scale, Series};
use crate::figures;
use crate::sections::Section;
use crate::selection::Selection;
use crate::shipped::{iterations_together, load};
use crate::shown_table::ShownTable;
use crate::workspace::write;

const HEAD: &str = "\
| scene | ∆s | method | L∞ | total variation | residual of free max, rms | body's volume off | on the surface / N_s | \
closest pair / ∆s | evaluations | seconds | |
|---|---|---|---|---|---|---|---|---|---|---|---|
";

/// Scenes, spacings, dimensions, and whether they are quick.
const SCENES: [(&str, f64, usize, bool); 6] = [
    ("cylinder", 0.1, 2, true),
    ("square", 0.05, 2, false),
    ("starfish", 0.075, 2, false),
    ("zigzag", 0.05, 2, false),
    ("naca0015", 0.02, 2, false),
    ("ellipsoid", 0.1, 3, false),
];

/// Iterations in space, where a slow method would take an hour.
const PATIENCE_IN_SPACE: usize = 2000;

/// What to run.
#[derive(Debug)]
pub(crate) struct Settings {
    selection: Selection,
    /// The one method to print the rows of.
    method: Option<String>,
    /// One section alone.
    section: Option<Section>,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &[
        "--quick",
        "--only SCENE",
        "--method NAME",
        "--data DIR",
        "--write",
        "--accelerations",
        "--agitators",
        "--interface",
        "--gaps",
    ];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        let settings = Self {
            selection: Selection::of(arguments)?,
            method: arguments.text("--method"),
            section: (Section::ALL.into_iter()).find(|section| arguments.has(section.flag())),
        };
        if settings.selection.write && settings.method.is_some() {
            return Err("--write needs every row: leave --method out".to_owned());
        }
        Ok(settings)
    }
}

/// Packs every scene by every method that works in its dimension; what was measured before by the same code is not packed again.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let selection = &settings.selection;
    if let Some(section) = settings.section {
        return section.run(selection);
    }
    let bench = Bench::open(&[file!()])?;
    let mut table = ShownTable::new(HEAD);
    let mut clouds: Vec<Series> = Vec::new();
    for (name, spacing, dimension, quick) in SCENES {
        if !selection.wants(name, quick) {
            continue;
        }
        for (method, info) in (Method::ALL
            .map(|method| (method, method.info()))
            .into_iter())
        .filter(|(_, info)| info.dimensions.contains(&dimension))
        // Its walls are no particles of a body.
        .filter(|(method, _)| *method != Method::Ppa)
        .filter(|(_, info)| (settings.method.as_ref()).is_none_or(|only| only == info.name))
        {
            let Some(mut scene) = load(name, selection)? else {
                continue;
            };
            scene.spacing = spacing;
            scene.packing.method = method;
            let most = match dimension {
                2 => scene.packing.max_iterations,
                _ => PATIENCE_IN_SPACE,
            };
            scene.packing.max_iterations = iterations_together(method, most);
            scene.quality.kernel = Some(KernelKind::Quintic);
            scene.quality.h_over_spacing = Some(1.2);
            let figures = bench.packed(&scene, Figures::of)?;
            if method != Method::Clipped {
                let place = [figures.seconds, 100.0 * figures.linf];
                match clouds.iter_mut().find(|cloud| cloud.name == info.name) {
                    Some(cloud) => cloud.points.push(place),
                    None => clouds.push(Series {
                        name: info.name.to_owned(),
                        points: vec![place],
                        joined: false,
                    }),
                }
            }
            table.push(&format!(
                "| {name} | {spacing} | {} | {} |\n",
                info.name, figures.line
            ));
        }
    }
    if settings.method.is_some() {
        return Ok(());
    }
    let variation = figures::variation(selection)?;
    let tanks = figures::tanks(selection)?;
    let mut sections = Vec::new();
    for section in Section::ALL {
        sections.push(section.text(selection)?);
    }
    if selection.write {
        let table = table.into_text();
        let text = format!(
            "# Every method on every scene\n\n\
             Each method with its defaults, its own kernel and h/∆s among them; all judged by the quintic kernel at\n\
             h/∆s = 1.2{}. In space methods stop after 2,000 iterations. Regenerate with `cargo xtask compare --data DIR --write`. Times are wall-clock seconds and depend on\n\
             the machine.\n\n\
             ![Error of the density against time, every method on every scene](speed-accuracy.svg)\n\n{table}\n\
             ## Paper 001's comparison\n\n\
             The paper does not say by which h/∆s it judges, nor how deep its bodies are filled; here by the quintic\n\
             kernel at h/∆s = 1.0, over all particles and over those outside or within ∆s of the surface. Our standard\n\
             layers fill the body to its medial axis, where they collide: that is most of their variation on the\n\
             zig-zag. The coupled method starts from the paper's rectangular lattice; in\n\
             concave corners its first pass presses particles together, on the zig-zag up to one place.\n\n{variation}\n\
             ## Paper 002's tanks\n\n\
             β = 1, α = 5·10⁻³, CFL = 1, quintic kernel at h/∆s = 1.2; judged as packed. The largest residuals sit in\n\
             the acute corners, where two particles would end at one place: beside the paper, pairs nearer than 0.7 ∆s\n\
             repel each other, and residuals are counted without that.\n\n{tanks}\n\
             {}",
            if selection.quick {
                " (the quick scenes only)"
            } else {
                ""
            },
            sections.join("\n")
        );
        write("docs/methods.md", &text)?;
        write("docs/speed-accuracy.svg", &chart(clouds).svg())?;
    }
    Ok(())
}

/// Speed against accuracy: the better the farther down to the left.
fn chart(series: Vec<Series>) -> Chart {
    Chart {
        title: "Every method on every scene",
        axes: [
            Axis {
                title: "seconds",
                scale: Scale::Logarithmic,
            },
            Axis {
                title: "greatest error of the density, %",
                scale: Scale::Logarithmic,
            },
        ],
        series,
    }
}

/// What is shown of a packing.
#[derive(Debug, Serialize, Deserialize)]
struct Figures {
    /// From scene to figures.
    seconds: f64,
    linf: f64,
    /// Its row, from L∞ on.
    line: String,
}

impl Figures {
    fn of(outcome: &Outcome) -> Self {
        let report = &outcome.report;
        let off = report
            .bodies
            .iter()
            .map(|body| body.volume / body.volume_true - 1.0)
            .fold(
                0.0,
                |most: f64, off| if off.abs() > most.abs() { off } else { most },
            );
        let sum = |f: fn(&sphpack_packing::SurfaceQuality) -> usize| {
            report.surface.iter().map(f).sum::<usize>()
        };
        let seconds = report.seconds.total;
        let line = format!(
            "{:.2} % | {:.2} % | {:.1e}, {:.1e} | {:+.2} % | {} / {} | {:.2} | {} | {seconds:.2} | {}",
            100.0 * report.density.linf,
            100.0 * report.density.total_variation,
            report.residual.max,
            report.residual.rms,
            100.0 * off,
            sum(|s| s.count),
            sum(|s| s.target_count),
            report.closest_pair_over_spacing,
            report.force_evaluations,
            report.stop_reason,
        );
        Self {
            seconds,
            linf: report.density.linf,
            line,
        }
    }
}
