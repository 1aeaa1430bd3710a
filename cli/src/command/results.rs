//! What a packing is written to: files, all or none, and standard output.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use sphpack_neighbors::point;

use super::arguments::PackArguments;
use super::plain_text::visible;
use super::{outputs, unless_closed};
use crate::Error;
use crate::files::{AtomicFiles, Owners, PARTICLE_FORMATS, Part, ParticleFormat, put, write_csv};
use crate::picture::{PictureFormat, Subject, draw};
use crate::report::peak_memory_bytes;
use crate::run::Outcome;
use crate::scene::Scene;
use crate::table::Table;

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

/// A file of particles.
struct ParticleFile {
    path: PathBuf,
    format: ParticleFormat,
    /// Which particles.
    part: Part,
}

/// What stands for standard output where a file is asked for.
const STANDARD_OUTPUT: &str = "-";

/// What will be written.
pub(super) struct Results {
    particles: Vec<ParticleFile>,
    /// Whether particles go to standard output too, as CSV.
    pub(super) to_output: bool,
    picture: Option<(PathBuf, PictureFormat)>,
    report: Option<PathBuf>,
    /// The first file of particles; where there is none, what it would be called.
    pub(super) first: PathBuf,
}

impl Results {
    /// What was asked for, if it can be written.
    pub(super) fn new(
        arguments: &PackArguments,
        scene: &Scene,
        dimension: usize,
    ) -> Result<Self, Error> {
        let (output, mut names): (Vec<PathBuf>, Vec<PathBuf>) =
            (arguments.output.iter().cloned()).partition(|path| path == Path::new(STANDARD_OUTPUT));
        if output.len() > 1 {
            let twice = "standard output is asked for twice; write -o - once";
            return Err(Error::Usage(twice.into()));
        }
        let to_output = !output.is_empty();
        for path in names
            .iter()
            .chain(&arguments.picture)
            .chain(&arguments.report)
        {
            outputs::check_name(path)?;
        }
        if names.is_empty() && !to_output {
            names.push(PathBuf::from(format!("{}.vtu", scene.name)));
        }
        let owners = Owners::of_scene(scene);
        let mut particles = Vec::new();
        for name in &names {
            let format = ParticleFormat::of(name)?;
            format.refuse_unsuited(name, scene)?;
            let parts = owners.files(name)?.into_iter();
            particles.extend(parts.map(|(path, part)| ParticleFile { path, format, part }));
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
        let unnamed = || PathBuf::from(format!("{}.csv", scene.name));
        let first = (particles.first()).map_or_else(unnamed, |file| file.path.clone());
        let files = Self {
            particles,
            to_output,
            picture,
            report,
            first,
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

    /// What planning memory asks: whether rows are copied, and whether files are held as they are read again.
    pub(super) fn copies_and_holds(&self) -> (bool, bool) {
        let particles = || self.particles.iter();
        let has_parts = particles().any(|file| file.part != Part::All);
        let are_held = particles().any(|file| !file.format.is_read_by_column());
        (self.picture.is_some() || has_parts, are_held)
    }

    fn paths(&self) -> Vec<PathBuf> {
        let particles = self.particles.iter();
        let particles = particles.flat_map(|file| {
            [Some(file.path.clone()), file.format.beside(&file.path)]
                .into_iter()
                .flatten()
        });
        let picture = self.picture.iter().map(|(path, _)| path.clone());
        particles
            .chain(picture)
            .chain(self.report.clone())
            .collect()
    }

    /// Writes them all, and says which and with how many particles. Standard output comes last, when all files have their names.
    pub(super) fn write(
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
        let format = self
            .particles
            .first()
            .map_or(ParticleFormat::Csv, |file| file.format);
        let rescued = |error: Error| {
            let elsewhere = (error.is_all_lost()).then(|| rescue(&rows, &self.first, format));
            match elsewhere.flatten() {
                Some(elsewhere) => error.with_kept(&[elsewhere], &[]),
                None => error,
            }
        };
        for ParticleFile { path, format, part } in &self.particles {
            let put = put(&mut files, *format, part, &rows, path).map_err(&rescued)?;
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
        if self.to_output {
            let mut to = BufWriter::new(std::io::stdout().lock());
            let done = write_csv(&rows, &mut to).and_then(|()| to.flush());
            done.or_else(unless_closed)?;
        }
        Ok(written)
    }
}
