//! How fast: the pair loop on this machine, the whole job, and how both grow.

mod job;
mod machine;
mod pair_loop;

use sphpack::scene::BandWidth;

use crate::bench::Bench;
use crate::selection::Selection;
use crate::shipped::load;
use crate::shown_table::ShownTable;
use crate::workspace::write;

/// A job with a bar: scene, ∆s, h/∆s, seconds, GiB, repeats, whether it is quick.
type Job = (
    &'static str,
    f64,
    f64,
    Option<f64>,
    Option<f64>,
    usize,
    bool,
);

const JOBS: [Job; 5] = [
    ("cylinder", 0.1, 1.0, Some(0.1), None, 5, true),
    ("cylinder", 0.05, 1.0, Some(0.3), None, 5, true),
    ("bunny", 0.02, 1.0, Some(15.0), Some(1.0), 2, false),
    ("bunny", 0.02, 1.2, None, None, 2, false),
    ("bunny", 0.005, 1.0, None, Some(8.0), 1, false),
];

/// Scenes that are packed finer and finer.
const FINER: [(&str, [f64; 3]); 2] = [
    ("sphere", [0.1, 0.05, 0.025]),
    ("bunny", [0.04, 0.02, 0.01]),
];

const GIB: f64 = (1_u64 << 30) as f64;

/// The tables.
pub(crate) fn run(selection: &Selection) -> Result<(), String> {
    job::build()?;
    let jobs = jobs(selection)?;
    let finer = finer(selection)?;
    let pairs = pair_loop::table()?;
    if selection.write {
        let text = format!(
            "# Speed\n\n\
             Release profile, two threads, method balanced with its defaults. Times are wall-clock seconds and depend on\n\
             the machine; regenerate with `cargo xtask speed --data DIR --write`, on a machine at rest. What was tried in\n\
             the pair loop is in [pair-loop.md](pair-loop.md), accuracy against time in [methods.md](methods.md).\n\n\
             ## The whole job\n\n\
             From the start of the process to the VTU file and the report.\n\n{jobs}\n\
             ## Finer and finer\n\n\
             `band = \"auto\"` moves what is near a surface, `\"full\"` everything. *growth* is the exponent of 1/∆s from the\n\
             row before: 2 goes with the surface, 3 with the box.\n\n{finer}\n\
             ## The pair loop against the machine\n\n{pairs}"
        );
        write("docs/speed.md", &text)?;
    }
    Ok(())
}

/// Whole jobs, each timed once until the code changes.
fn bench() -> Result<Bench, String> {
    Bench::open(&[file!(), "xtask/src/speed/job.rs"])
}

fn jobs(selection: &Selection) -> Result<String, String> {
    let bench = bench()?;
    let mut table = ShownTable::new(
        "| scene | ∆s | h/∆s | particles (solid) | seconds (bar) | of them geometry | peak memory, GiB (bar) | evaluations | L∞ |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (name, spacing, h, seconds, memory, repeats, quick) in JOBS {
        if !selection.wants(name, quick) {
            continue;
        }
        let Some(mut scene) = load(name, selection)? else {
            continue;
        };
        scene.spacing = spacing;
        scene.packing.h_over_spacing = Some(h);
        let run = job::run(&scene, repeats, &bench)?;
        let bar = |bar: Option<f64>| bar.map_or_else(String::new, |bar| format!(" (≤ {bar})"));
        table.push(&format!(
            "| {name} | {spacing} | {h} | {} ({}) | {:.3}{} | {:.0} % | {:.2}{} | {} | {:.2} % |\n",
            run.particles,
            run.solid,
            run.seconds,
            bar(seconds),
            100.0 * run.geometry_seconds / run.seconds,
            run.peak_memory_bytes / GIB,
            bar(memory),
            run.evaluations,
            100.0 * run.linf,
        ));
    }
    Ok(table.into_text())
}

fn finer(selection: &Selection) -> Result<String, String> {
    let bench = bench()?;
    let mut table = ShownTable::new(
        "| scene | band | ∆s | particles | seconds | growth | peak memory, GiB | growth | L∞ |\n|---|---|---|---|---|---|---|---|---|\n",
    );
    for (name, spacings) in FINER {
        if !selection.wants(name, name == "sphere") {
            continue;
        }
        for (band, word) in [(BandWidth::Auto, "auto"), (BandWidth::Full, "full")] {
            let mut before: Option<(f64, job::Run)> = None;
            for spacing in spacings {
                let Some(mut scene) = load(name, selection)? else {
                    continue;
                };
                scene.spacing = spacing;
                scene.packing.band = band;
                let run = job::run(&scene, 1, &bench)?;
                let growth = |of: fn(&job::Run) -> f64| {
                    before.map_or_else(String::new, |(coarser, before)| {
                        let exponent = (of(&run) / of(&before)).ln() / (coarser / spacing).ln();
                        format!("{exponent:.2}")
                    })
                };
                table.push(&format!(
                    "| {name} | {word} | {spacing} | {} | {:.2} | {} | {:.3} | {} | {:.3} % |\n",
                    run.particles,
                    run.seconds,
                    growth(|run| run.seconds),
                    run.peak_memory_bytes / GIB,
                    growth(|run| run.peak_memory_bytes),
                    100.0 * run.linf,
                ));
                before = Some((spacing, run));
            }
        }
    }
    Ok(table.into_text())
}
