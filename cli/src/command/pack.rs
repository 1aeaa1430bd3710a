//! `sphpack pack`.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use sphpack_neighbors::point;
use sphpack_packing::StopReason;
use sphpack_packing::pace::Pace;
use sphpack_packing::problem::size;

use super::arguments::PackArguments;
use super::duration::duration;
use super::keeping::Keeping;
use super::plain_text::visible;
use super::progress::Watcher;
use super::{interrupt, memory_guard, outputs, say, summary, threads};
use crate::Error;
use crate::error::{DONE, INTERRUPTED, NOT_CONVERGED};
use crate::files::{AtomicFiles, PARTICLE_FORMATS, ParticleFormat, put};
use crate::opened::{Opened, opened};
use crate::picture::{PictureFormat, Subject, draw};
use crate::plan::{available_bytes, planned_of};
use crate::report::peak_memory_bytes;
use crate::run::{Options, Outcome, run_opened};
use crate::scene::{Method, Scene};
use crate::table::Table;

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
    let files = Files::new(arguments, &scene, opened.dimension)?;
    threads::start(arguments.threads)?;
    if arguments.dry_run {
        return dry_run(opened, &files, &notes, arguments.quiet);
    }
    if !arguments.quiet {
        let _ = write!(std::io::stderr(), "{notes}");
    }
    if let Some(picked) = opened.picked.as_ref().filter(|_| !arguments.quiet) {
        // A step like those that follow, no message: a refusal is one message.
        let _ = write!(std::io::stderr(), "{}", summary::picked(picked));
    }
    let keeping = Keeping::new(arguments, &scene, &files.particles[0].0)?;
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
    let written = files.write(&scene, &mut outcome, arguments.force, begin)?;
    if !arguments.quiet {
        say(&format!("{notes}{}", summary::of(&outcome, &written)))?;
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

fn dry_run(opened: Opened, files: &Files, notes: &str, is_quiet: bool) -> Result<u8, Error> {
    let are_held = (files.particles.iter()).any(|(_, format)| !format.is_read_by_column());
    let plan = planned_of(opened, available_bytes())?.with_files(files.picture.is_some(), are_held);
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

/// Writes particles into the system's folder for temporary files, where their own takes none: they may have taken hours. In a format
/// that holds all of them: another may be why they could not be written.
fn rescue(rows: &Table, path: &Path, format: ParticleFormat) -> Option<PathBuf> {
    let stem = path.file_stem()?.to_string_lossy();
    let known = PARTICLE_FORMATS.into_iter();
    let (format, ending) =
        (known.clone().find(|(own, _)| *own == format)).or_else(|| known.clone().next())?;
    let name = format!("{stem}.rescued-{}.{ending}", std::process::id());
    let elsewhere = std::env::temp_dir().join(name);
    let mut files = AtomicFiles::new(false);
    (files.write(&elsewhere, |to| format.write(rows, to))).ok()?;
    files.finish().ok()?;
    Some(elsewhere)
}

/// The files that will be written.
struct Files {
    particles: Vec<(PathBuf, ParticleFormat)>,
    picture: Option<(PathBuf, PictureFormat)>,
    report: Option<PathBuf>,
}

impl Files {
    /// What was asked for, if it can be written.
    fn new(arguments: &PackArguments, scene: &Scene, dimension: usize) -> Result<Self, Error> {
        let mut names = arguments.output.clone();
        for path in names
            .iter()
            .chain(&arguments.picture)
            .chain(&arguments.report)
        {
            outputs::check_name(path)?;
        }
        if names.is_empty() {
            names.push(PathBuf::from(format!("{}.vtu", scene.name)));
        }
        let particles = names
            .into_iter()
            .map(|path| ParticleFormat::of(&path).map(|format| (path, format)))
            .collect::<Result<Vec<_>, _>>()?;
        for (path, format) in &particles {
            format.refuse_unsuited(path, scene)?;
        }
        let picture = match &arguments.picture {
            Some(path) => Some((path.clone(), PictureFormat::of(path, Some(dimension))?)),
            None => None,
        };
        let report = arguments.report.clone();
        if let Some(path) = &report {
            let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
            if ending.as_deref() != Some("json") {
                return Err(Error::input(path, "the report is JSON; name it .json"));
            }
        }
        if let Some(path) = &arguments.checkpoint {
            outputs::check_name(path)?;
            if path.extension().is_none_or(|ending| ending != "checkpoint") {
                let message = "a checkpoint is no particle file; name it .checkpoint";
                return Err(Error::input(path, message));
            }
        }
        let files = Self {
            particles,
            picture,
            report,
        };
        if !arguments.dry_run {
            let mut inputs = vec![arguments.input.clone()];
            inputs.extend(scene.files().map(|file| scene.resolve(file)));
            let paths = files.paths();
            outputs::check(&paths.iter().collect::<Vec<_>>(), &inputs, arguments.force)?;
            if let Some(path) = &arguments.checkpoint {
                outputs::check(&[path], &inputs, true)?;
            }
        }
        Ok(files)
    }

    fn paths(&self) -> Vec<PathBuf> {
        let particles = self.particles.iter();
        let particles = particles.flat_map(|(path, format)| {
            [Some(path.clone()), format.beside(path)]
                .into_iter()
                .flatten()
        });
        let picture = self.picture.iter().map(|(path, _)| path.clone());
        particles
            .chain(picture)
            .chain(self.report.clone())
            .collect()
    }

    /// Writes them all, and says which and with how many particles.
    fn write(
        &self,
        scene: &Scene,
        outcome: &mut Outcome,
        may_replace: bool,
        begin: Instant,
    ) -> Result<Vec<String>, Error> {
        let writing = Instant::now();
        let mut files = AtomicFiles::new(may_replace);
        let shown = |path: &Path| visible(&path.display().to_string());
        let mut written = Vec::new();
        // A picture shows what files leave out.
        let table = if self.picture.is_some() {
            outcome.table.clone()
        } else {
            std::mem::take(&mut outcome.table)
        };
        let rows = outcome.included(table, scene);
        outcome.packing.forget_columns();
        let (first, first_format) = &self.particles[0];
        let rescued = |error: Error| {
            let elsewhere = (error.is_all_lost()).then(|| rescue(&rows, first, *first_format));
            match elsewhere.flatten() {
                Some(elsewhere) => error.with_kept(&[elsewhere], &[]),
                None => error,
            }
        };
        for (path, format) in &self.particles {
            let put = put(&mut files, *format, &rows, path).map_err(&rescued)?;
            let remark = if put.is_compared {
                ""
            } else {
                ", not read again for want of memory"
            };
            written.push(format!(
                "{} ({} particles and {} frozen ones{remark})",
                shown(path),
                crate::picture::grouped(put.particles - put.frozen),
                crate::picture::grouped(put.frozen)
            ));
            written.extend(format.beside(path).map(|beside| shown(&beside)));
        }
        if let Some((path, format)) = &self.picture {
            let report = &outcome.report;
            let corner =
                |values: &Option<Vec<f64>>| point::of_slice(values.as_deref().unwrap_or(&[]));
            let subject = Subject {
                name: &scene.name,
                table: &outcome.table,
                loops: &outcome.loops,
                domain: [
                    corner(&report.scene.domain.min),
                    corner(&report.scene.domain.max),
                ],
                spacing: report.spacing,
                is_unfinished: !(report.converged && report.audit.passed),
            };
            (files.write(path, |to| draw(&subject, *format, to))).map_err(&rescued)?;
            written.push(shown(path));
        }
        let report = &mut outcome.report;
        report.seconds.output = writing.elapsed().as_secs_f64();
        report.seconds.total = begin.elapsed().as_secs_f64();
        report.peak_memory_bytes = peak_memory_bytes();
        if let Some(path) = &self.report {
            let json = report.to_json();
            (files.write(path, |to| to.write_all(json.as_bytes()))).map_err(&rescued)?;
            written.push(shown(path));
        }
        files.finish().map_err(&rescued)?;
        Ok(written)
    }
}
