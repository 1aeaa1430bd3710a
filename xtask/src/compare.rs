//! Every method on every scene, judged alike.

use std::fmt::Write as _;
use std::fs;
use std::time::Instant;

use sphpack::scene::METHODS;
use sphpack::{Options, Report, run as pack};
use sphpack_kernels::KernelKind;
use sphpack_packing::Silent;

use crate::reproduce::{Settings, load};
use crate::root;

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

/// Packs every scene by every method that works in its dimension.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let mut table = HEAD.to_owned();
    print!("{HEAD}");
    for (name, spacing, dimension, quick) in SCENES {
        if !settings.wants(name, quick) {
            continue;
        }
        for info in METHODS
            .iter()
            .filter(|info| info.is_available && info.dimensions.contains(&dimension))
        {
            let Some(mut scene) = load(name, settings)? else {
                continue;
            };
            scene.spacing = spacing;
            scene.packing.method = info.method;
            scene.quality.kernel = Some(KernelKind::Quintic);
            scene.quality.h_over_spacing = Some(1.2);
            let start = Instant::now();
            let outcome = pack(&scene, &Options::default(), &mut Silent)
                .map_err(|error| error.to_string())?;
            let line = line(
                name,
                info.name,
                &outcome.report,
                start.elapsed().as_secs_f64(),
            );
            print!("{line}");
            table.push_str(&line);
        }
    }
    if settings.write {
        let path = root().join("docs/methods.md");
        let text = format!(
            "# Every method on every scene\n\n\
             Each method with its defaults, its own kernel and h/∆s among them; all judged by the quintic kernel at\n\
             h/∆s = 1.2{}. Regenerate with `cargo xtask compare --write`. Times are wall-clock seconds and depend on\n\
             the machine.\n\n{table}",
            if settings.quick {
                " (the quick scenes only)"
            } else {
                ""
            }
        );
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

fn line(scene: &str, method: &str, report: &Report, seconds: f64) -> String {
    let off = report
        .bodies
        .iter()
        .map(|body| body.volume / body.volume_true - 1.0)
        .fold(
            0.0,
            |most: f64, off| if off.abs() > most.abs() { off } else { most },
        );
    let sum = |f: fn(&sphpack::SurfaceReport) -> usize| report.surface.iter().map(f).sum::<usize>();
    let mut line = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        line,
        "| {scene} | {} | {method} | {:.2} % | {:.2} % | {:.1e}, {:.1e} | {:+.2} % | {} / {} | {:.2} | {} | {seconds:.2} | {} |",
        report.spacing,
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
    line
}
