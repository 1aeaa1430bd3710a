//! Packs the scenes of paper 001 by its hybrid method and puts our figures beside the published ones.

use std::fmt::Write as _;
use std::fs;
use std::time::Instant;

use sphpack::scene::Method;
use sphpack::{Options, Report, run as pack};
use sphpack_packing::Silent;

use crate::rows::{Figure, ROWS, Row};
use crate::selection::Selection;
use crate::shipped::load;
use crate::workspace::root;

const HEAD: &str = "\
| scene | ∆s | h/∆s | ε | figure | paper 001 | bar | ours | L∞ | total variation | iterations | \
on the surface / N_s | particles | seconds | |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
";

/// Runs the rows; fails where one misses its bar.
pub(crate) fn run(selection: &Selection) -> Result<(), String> {
    let mut table = HEAD.to_owned();
    print!("{HEAD}");
    let mut missed = Vec::new();
    for row in ROWS
        .iter()
        .filter(|row| selection.wants(row.scene, row.quick))
    {
        let line = match run_row(row, selection)? {
            None => format!("{} | | | no data | | | | | | | | |\n", head(row)),
            Some((report, seconds)) => {
                let value = figure(row.figure, &report);
                let passes = value <= row.bar && report.converged;
                if !passes {
                    missed.push(format!(
                        "{} ∆s = {} ε = {:e}",
                        row.scene, row.spacing, row.tolerance
                    ));
                }
                line(row, &report, value, passes, seconds)
            }
        };
        print!("{line}");
        table.push_str(&line);
    }
    if selection.write {
        let path = root().join("docs/reproduction.md");
        let text = format!(
            "# Paper 001, published and ours\n\n\
             The hybrid method with its defaults, no tuning per shape{}. Regenerate with\n\
             `cargo xtask reproduce-paper --data DIR --write`, where DIR holds `bunny.stl`.\n\
             Densities are dimensionless, times are wall-clock seconds and depend on the machine.\n\n{table}",
            if selection.quick {
                " (the quick rows only)"
            } else {
                ""
            }
        );
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    if missed.is_empty() {
        Ok(())
    } else {
        Err(format!("missed: {}", missed.join("; ")))
    }
}

/// Packs one row; `None` where its body's file is not there.
fn run_row(row: &Row, selection: &Selection) -> Result<Option<(Report, f64)>, String> {
    let Some(mut scene) = load(row.scene, selection)? else {
        return Ok(None);
    };
    scene.packing.method = Method::Hybrid;
    // A body enlarged at the same ∆s is the body as it is at a smaller ∆s: densities have no unit.
    scene.spacing = row.spacing / row.enlarged;
    scene.packing.h_over_spacing = Some(row.h_over_spacing);
    scene.packing.velocity_tolerance = row.tolerance;
    // The bar is on the error, the published iterations stand beside ours.
    scene.packing.max_iterations = 100_000;
    let start = Instant::now();
    let outcome =
        pack(&scene, &Options::default(), &mut Silent).map_err(|error| error.to_string())?;
    Ok(Some((outcome.report, start.elapsed().as_secs_f64())))
}

fn figure(figure: Figure, report: &Report) -> f64 {
    match figure {
        Figure::TotalVariation => report.density.total_variation,
        Figure::Linf => report.density.linf,
        Figure::SurfaceDistance => report
            .surface
            .iter()
            .map(|surface| surface.max_distance_over_spacing)
            .fold(0.0, f64::max),
    }
}

fn head(row: &Row) -> String {
    let scene = if row.enlarged == 1.0 {
        row.scene.to_owned()
    } else {
        format!("{} × {}", row.scene, row.enlarged)
    };
    format!(
        "| {scene} | {} | {:.1} | {:.1e} | {} | {} | {}",
        row.spacing,
        row.h_over_spacing,
        row.tolerance,
        row.figure.name(),
        row.published,
        row.bar
    )
}

fn line(row: &Row, report: &Report, value: f64, passes: bool, seconds: f64) -> String {
    let mut line = head(row);
    let (count, target) = report
        .surface
        .iter()
        .fold((0, 0), |(count, target), surface| {
            (count + surface.count, target + surface.target_count)
        });
    let verdict = if passes { "pass" } else { "**FAIL**" };
    // Writing to a string cannot fail.
    let _ = writeln!(
        line,
        " | {value:.4} | {:.2} % | {:.2} % | {} | {count} / {target} | {} | {seconds:.1} | {verdict} |",
        100.0 * report.density.linf,
        100.0 * report.density.total_variation,
        report.iterations,
        report.particles.total - report.particles.frozen,
    );
    line
}
