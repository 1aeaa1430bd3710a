//! One packing in a process of its own: its memory is its own, and it can be ended when it takes too long.

use std::fs;
use std::path::Path;
use std::time::Instant;

use sphpack::{Options, Outcome, Packing, Scene, Solution, run as pack};
use sphpack_packing::Silent;

use super::figures::{Ended, Figures};
use super::judges::{DENSITY, judges};
use super::pairs::pairs;
use crate::scene_fuzz::processor_seconds;

/// Short packings are repeated for so long: a few milliseconds are easily disturbed.
const LONG_ENOUGH: f64 = 1.0;

/// Repeats at most.
const REPEATS: usize = 5;

/// More particles are not asked how well they interpolate: that would take longer than the packing.
const MOST_THAT_INTERPOLATE: f64 = 40_000.0;

/// Packs the scene in a file, and writes what that came to into another.
pub(super) fn run(file: &Path, result: &Path) -> Result<(), String> {
    let fail = |error: std::io::Error| format!("{}: {error}", file.display());
    let text = fs::read_to_string(file).map_err(fail)?;
    let scene = Scene::parse(&text, file).map_err(|error| error.to_string())?;
    let ended = match measured(&scene) {
        Ok(figures) => Ended::Measured(Box::new(figures)),
        // What a scene may not ask for is no failure of the chart, whose page need not name the file either.
        Err(refusal) => {
            let named = format!("{}: ", file.display());
            let why = refusal.strip_prefix(&named).unwrap_or(&refusal);
            Ended::LeftOut(why.to_owned())
        }
    };
    let text = serde_json::to_string(&ended).map_err(|error| error.to_string())?;
    // A result is there whole or not at all.
    let unfinished = result.with_extension("part");
    fs::write(&unfinished, text + "\n")
        .and_then(|()| fs::rename(&unfinished, result))
        .map_err(|error| format!("{}: {error}", result.display()))
}

fn measured(scene: &Scene) -> Result<Figures, String> {
    let own = Path::new("/proc/self");
    let begin = Instant::now();
    let mut least: Option<[f64; 2]> = None;
    let mut first: Option<Outcome> = None;
    for repeat in 0..REPEATS {
        if repeat > 0 && begin.elapsed().as_secs_f64() > LONG_ENOUGH {
            break;
        }
        let (start, processor) = (Instant::now(), processor_seconds(own));
        let outcome = pack(scene, &Options::default(), &mut Silent);
        let outcome = outcome.map_err(|error| error.to_string())?;
        let took = [
            start.elapsed().as_secs_f64(),
            processor_seconds(own) - processor,
        ];
        if least.is_none_or(|least| took[0] < least[0]) {
            least = Some(took);
        }
        // Its memory is that of one packing.
        first.get_or_insert(outcome);
    }
    let (Some([seconds, processor_seconds]), Some(outcome)) = (least, first) else {
        return Err("nothing was packed".to_owned());
    };
    let figures = match &outcome.packing {
        Packing::Plane(solution) => figures(solution, &outcome),
        Packing::Space(solution) => figures(solution, &outcome),
    };
    Ok(Figures {
        seconds,
        processor_seconds,
        ..figures
    })
}

fn figures<const D: usize>(solution: &Solution<D>, outcome: &Outcome) -> Figures {
    let (packed, report) = (&solution.packed, &outcome.report);
    let by = |(kernel, h)| packed.quality_by(&packed.fields(kernel, h));
    let own = by(DENSITY);
    let judged = (judges(D).iter())
        .map(|&judge| by(judge).density.linf_lattice)
        .collect();
    let count = &report.particles;
    let particles = (count.total - count.frozen) as f64;
    let interpolation = Some(packed)
        .filter(|_| particles <= MOST_THAT_INTERPOLATE)
        .and_then(|packed| packed.interpolation(DENSITY.0, DENSITY.1));
    let finite = |value: f64| Some(value).filter(|value| value.is_finite());
    let (on, target) = (report.surface.iter()).fold((0, 0), |(on, target), surface| {
        (on + surface.count, target + surface.target_count)
    });
    Figures {
        particles,
        evaluations: report.force_evaluations as f64,
        pairs: pairs(solution, report),
        seconds: 0.0,
        processor_seconds: 0.0,
        peak_memory_bytes: report.peak_memory_bytes as f64,
        linf: own.density.linf,
        residual: own.residual.max,
        function: interpolation.and_then(|found| finite(found.function.over_lattice)),
        derivative: interpolation.and_then(|found| finite(found.derivative.over_lattice)),
        closest_pair: report.closest_pair_over_spacing,
        on_surface: on as f64 / target.max(1) as f64,
        stop_reason: report.stop_reason.to_owned(),
        judged,
    }
}
