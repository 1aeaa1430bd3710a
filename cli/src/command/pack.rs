//! `sphpack pack`.

use std::io::Write;
use std::path::Path;
use std::time::Instant;

use sphpack_packing::StopReason;
use sphpack_packing::pace::Pace;
use sphpack_packing::problem::size;

use super::arguments::PackArguments;
use super::duration::duration;
use super::keeping::Keeping;
use super::plain_text::visible;
use super::progress::Watcher;
use super::results::Results;
use super::{interrupt, memory_guard, say, say_aside, summary, threads};
use crate::Error;
use crate::error::{DONE, INTERRUPTED, NOT_CONVERGED};
use crate::opened::{Opened, opened};
use crate::plan::{available_bytes, planned_of};
use crate::run::{Options, Outcome, run_opened};
use crate::scene::{Method, Scene};

/// The margin around a body without a scene, in ∆s.
const MARGIN_OVER_SPACING: f64 = 8.0;

/// What a scene is called in messages that comes from there.
const STANDARD_INPUT: &str = "standard input";

pub(super) fn run(arguments: &PackArguments) -> Result<u8, Error> {
    let begin = Instant::now();
    let scene = scene(arguments)?;
    let opened = opened(&scene)?;
    let notes = summary::notes(&scene.notes);
    // Its settings picked: a checkpoint is of these.
    let scene = opened.scene.clone();
    let results = Results::new(arguments, &scene, opened.dimension)?;
    threads::start(arguments.threads)?;
    if arguments.dry_run {
        return dry_run(opened, &results, &notes, arguments.quiet);
    }
    if !arguments.quiet {
        let _ = write!(std::io::stderr(), "{notes}");
    }
    if let Some(picked) = opened.picked.as_ref().filter(|_| !arguments.quiet) {
        // A step like those that follow, no message: a refusal is one message.
        let _ = write!(std::io::stderr(), "{}", summary::picked(picked));
    }
    let keeping = Keeping::new(arguments, &scene, &results.first)?;
    interrupt::watch(arguments.quiet)?;
    memory_guard::watch(available_bytes());
    let mut watcher = Watcher::new(arguments.quiet, keeping);
    let outcome = run_opened(opened, &Options::default(), &mut watcher);
    let keeping = watcher.end();
    // Methods that move nothing have something to write too.
    interrupt::has_begun();
    let mut outcome = outcome?;
    if !arguments.quiet {
        for body in &outcome.report.bodies {
            warn(&body.name, &body.repairs);
        }
        for words in &outcome.report.warnings {
            let _ = writeln!(std::io::stderr(), "sphpack: warning: {words}");
        }
    }
    let written = results.write(&scene, &mut outcome, arguments.force, begin)?;
    if !arguments.quiet {
        let closing = format!("{notes}{}", summary::of(&outcome, &written));
        match results.to_output {
            true => say_aside(&closing),
            false => say(&closing)?,
        }
    }
    keeping.end(stop_reason(&outcome) == StopReason::Interrupted);
    let status = match stop_reason(&outcome) {
        StopReason::Converged if outcome.report.audit.passed && is_accurate(&outcome) => DONE,
        StopReason::Interrupted => INTERRUPTED,
        _ => NOT_CONVERGED,
    };
    if arguments.quiet && status != DONE {
        let _ = writeln!(
            std::io::stderr(),
            "sphpack: {}",
            summary::in_a_line(&outcome.report)
        );
    }
    Ok(status)
}

/// Says on standard error what was mended.
fn warn(body: &str, repairs: &[String]) {
    for words in repairs {
        let _ = writeln!(
            std::io::stderr(),
            "{}",
            visible(&format!("sphpack: warning: body \"{body}\": {words}"))
        );
    }
}

/// Whether nothing else was asked for.
fn is_accurate(outcome: &Outcome) -> bool {
    (outcome.report.auto.as_ref()).is_none_or(|auto| auto.reached != Some(false))
}

fn stop_reason(outcome: &Outcome) -> StopReason {
    match &outcome.packing {
        crate::Packing::Plane(solution) => solution.packed.stop_reason,
        crate::Packing::Space(solution) => solution.packed.stop_reason,
    }
}

/// The scene asked for: a file, or a body with a few words.
fn scene(arguments: &PackArguments) -> Result<Scene, Error> {
    let input = &arguments.input;
    let is_piped = input == Path::new("-");
    let is_scene = is_piped
        || input.extension().is_some_and(|ending| {
            ending.eq_ignore_ascii_case("toml") || ending.eq_ignore_ascii_case("json")
        });
    let mut scene = if is_scene {
        for (name, is_given, key) in [
            ("--spacing", arguments.spacing.is_some(), "spacing"),
            ("--margin", arguments.margin.is_some(), "domain.margin"),
            ("--scale", arguments.scale.is_some(), "a body's scale"),
            ("--units", arguments.units.is_some(), "a body's units"),
        ] {
            if is_given {
                return Err(Error::Usage(format!(
                    "{name} is for a body without a scene; {} is a scene, set {key} in it",
                    if is_piped {
                        STANDARD_INPUT.into()
                    } else {
                        input.display().to_string()
                    }
                )));
            }
        }
        if !is_piped {
            Scene::read(input)?
        } else if arguments.output.is_empty() && !arguments.dry_run {
            return Err(Error::Usage(
                "a scene from standard input has no name that its particles could have; name their file: -o OUT.vtu".into(),
            ));
        } else {
            Scene::read_from(std::io::stdin().lock(), STANDARD_INPUT)?
        }
    } else {
        let Some(spacing) = arguments.spacing else {
            // A missing file is a nearer fault than a missing spacing.
            crate::body_format(input)?;
            return Err(Error::Usage(format!(
                "{} is a body; say how fine to pack it: --spacing LENGTH",
                input.display()
            )));
        };
        positive("--spacing", spacing)?;
        let margin = arguments.margin.unwrap_or(MARGIN_OVER_SPACING * spacing);
        positive("--margin", margin)?;
        let mut scene = Scene::of_body(input, spacing, margin);
        if let Some(scale) = arguments.scale {
            positive("--scale", scale)?;
            scene.body[0].scale = scale;
        }
        if let Some(unit) = arguments.units {
            let body = &mut scene.body[0];
            body.scale = unit.metres;
            scene.notes.push(unit.note(&body.name));
        }
        scene
    };
    if let Some(name) = &arguments.method {
        scene.packing.method = (name.parse::<Method>())
            .map_err(|unknown| Error::Usage(format!("--method: {unknown}")))?;
    }
    if let Some(seed) = arguments.seed {
        scene.packing.seed = seed;
    }
    Ok(scene)
}

fn positive(name: &str, value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::Usage(format!(
        "{name} is {value}; it must be a positive, finite number"
    )))
}

fn dry_run(opened: Opened, results: &Results, notes: &str, is_quiet: bool) -> Result<u8, Error> {
    let (has_copy, are_held) = results.copies_and_holds();
    let plan = planned_of(opened, available_bytes())?.with_files(has_copy, are_held);
    if !is_quiet {
        for (body, repairs) in &plan.repairs {
            warn(body, repairs);
        }
        for words in &plan.cut {
            let _ = writeln!(std::io::stderr(), "sphpack: warning: {words}");
        }
    }
    let estimate = plan.estimate;
    let evaluations = plan.evaluations;
    let pace = Pace::measured(&estimate);
    let each = estimate.seconds_of_one(pace);
    let work = estimate.seconds(pace, evaluations);
    let seconds = plan.building_seconds + work / rayon::current_num_threads() as f64;
    let read = summary::read(&plan.read);
    let fewer = plan.times_fewer.map_or_else(String::new, |times| {
        format!("             {times:.1} times fewer than at the finest spacing everywhere\n")
    });
    let picked = (plan.picked.as_ref()).map_or_else(String::new, summary::picked);
    say(&format!(
        "{notes}{read}{picked}  particles  {} in the {}-D box, about {} frozen around it\n{fewer}  neighbors  about {:.0} for each particle\n  memory     about {} of {} that are free\n  time       about {} on {} threads, {evaluations} evaluations of what moves among it, each about {}; to a factor of two\nnothing was written (--dry-run)\n",
        crate::picture::grouped(estimate.particles as usize),
        plan.dimension,
        crate::picture::grouped(estimate.frozen as usize),
        estimate.neighbors,
        size(estimate.memory_bytes),
        size(plan.allowed_bytes),
        duration(seconds),
        rayon::current_num_threads(),
        duration(each / rayon::current_num_threads() as f64),
    ))?;
    Ok(DONE)
}
