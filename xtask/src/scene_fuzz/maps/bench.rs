//! Runs the scenes of maps, two at a time, and keeps what came of each: a run that is stopped goes on where it was.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

use super::super::case::Case;
use super::super::truth::Truth;
use super::super::{in_parallel, judge, trial};
use super::outcome::{Cell, Outcome};
use super::panel::Map;
use crate::kept::Kept;
use crate::workspace::root;

/// A method whose maps are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Method {
    pub(super) name: &'static str,
    /// The longest body that it is asked for, in ∆s.
    pub(super) longest: f64,
}

/// The default first.
pub(super) const METHODS: [Method; 3] = [
    Method {
        name: "balanced",
        longest: f64::INFINITY,
    },
    Method {
        name: "hybrid",
        longest: 40.0,
    },
    Method {
        name: "complex",
        longest: 40.0,
    },
];

/// What judges, beside what packs.
const JUDGE: [&str; 10] = [
    "airfoil.rs",
    "case.rs",
    "kernel.rs",
    "rows.rs",
    "shape.rs",
    "trial.rs",
    "judge",
    "truth",
    "maps/outcome.rs",
    "maps/bench.rs",
];

/// Exit status of what was interrupted: no result.
const INTERRUPTED: i32 = 130;

/// A cell of a panel, by the places of its values.
pub(super) type Place = [usize; 2];

/// Where scenes are run.
pub(super) struct Bench {
    program: PathBuf,
    scratch: PathBuf,
    kept: Kept,
    /// Tells a program that was given from others.
    version: String,
}

impl Bench {
    /// With a program that is built from the sources here, or one that `is_given`.
    pub(super) fn open(program: PathBuf, is_given: bool) -> Result<Self, String> {
        let fail = |error: std::io::Error| format!("{}: {error}", program.display());
        let version = if is_given {
            let about = fs::metadata(&program).map_err(fail)?;
            let time = about.modified().map_err(fail)?;
            format!("{} {time:?}", about.len())
        } else {
            String::new()
        };
        let own = JUDGE.map(|name| format!("xtask/src/scene_fuzz/{name}"));
        Ok(Self {
            kept: Kept::open(&folder("kept"), &own.each_ref().map(String::as_str))?,
            scratch: std::env::temp_dir().join(format!("sphpack-maps-{}", std::process::id())),
            program,
            version,
        })
    }

    /// The cells of a panel in rows, the first y first; `None` where a method is not asked for so large a body.
    pub(super) fn panel(
        &self,
        map: &Map,
        number: usize,
        method: Method,
    ) -> Result<Vec<Vec<Option<Cell>>>, String> {
        let panel = &map.panels[number];
        let [columns, rows] = [panel.x.count(), panel.y.count()];
        let places: Vec<Place> = (0..rows)
            .flat_map(|y| (0..columns).map(move |x| [x, y]))
            .collect();
        let (start, done) = (Instant::now(), AtomicUsize::new(0));
        let told = Mutex::new(start);
        let cells = in_parallel(places.len(), |job, worker| {
            let cell = self.cell(map, number, places[job], method, worker);
            let count = done.fetch_add(1, Relaxed) + 1;
            if let Ok(mut told) = told.lock()
                && told.elapsed() > Duration::from_secs(10)
            {
                *told = Instant::now();
                eprintln!(
                    "{} {number}, {}: {count} of {}, {:.0} s",
                    map.name,
                    method.name,
                    places.len(),
                    start.elapsed().as_secs_f64()
                );
            }
            cell
        })?;
        let mut cells = cells.into_iter();
        Ok((0..rows)
            .map(|_| cells.by_ref().take(columns).collect())
            .collect())
    }

    /// A cell, tried in the folder of a worker.
    pub(super) fn cell(
        &self,
        map: &Map,
        number: usize,
        place: Place,
        method: Method,
        worker: usize,
    ) -> Result<Option<Cell>, String> {
        let panel = &map.panels[number];
        let mut case = (panel.case)(panel.x.value(place[0]), panel.y.value(place[1]));
        case.method = (method != METHODS[0]).then_some(method.name);
        if longest(&case) > method.longest {
            return Ok(None);
        }
        let case = case.placed();
        let of = self.key(&case);
        if let Some(cell) = self.kept.known(&of) {
            return Ok(Some(cell));
        }
        let own = self.scratch.join(format!("worker{worker}"));
        let trial = trial::run(&case, &self.program, &own)?;
        if trial.pack.code == Some(INTERRUPTED) {
            return Err("interrupted".to_owned());
        }
        let cell = Cell::of(&trial, &judge::judge(&case, &trial));
        if cell.outcome == Outcome::Fails {
            keep(case, &file_name(map, number, method, place))?;
        }
        self.kept.keep(&of, &cell)?;
        Ok(Some(cell))
    }

    /// All that a result depends on, beside the code.
    fn key(&self, case: &Case) -> String {
        let mut key = format!("{}\n{}", self.version, case.toml());
        for body in &case.bodies {
            if let Some(bytes) = body.shape.file() {
                key.push_str(&String::from_utf8_lossy(&bytes));
            }
            // What is judged by is no part of the scene.
            if let Some(meant) = &body.meant {
                key.push_str(&format!("{meant:?}"));
            }
        }
        key
    }

    /// Takes what scenes have left.
    pub(super) fn clear(&self) {
        let _ = fs::remove_dir_all(&self.scratch);
    }
}

/// The name of a scene that fails, without its ending.
pub(super) fn file_name(map: &Map, number: usize, method: Method, [x, y]: Place) -> String {
    format!("{}-{number}-{}-{x}-{y}", map.name, method.name)
}

/// A folder of what maps leave.
pub(super) fn folder(name: &str) -> PathBuf {
    root().join("target/maps").join(name)
}

/// Writes a scene that fails where it can be run again.
fn keep(mut case: Case, name: &str) -> Result<(), String> {
    let folder: &Path = &folder("failures");
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    case.prefix = format!("{name}-");
    trial::write(&case, folder, &format!("{name}.toml"))
}

/// How long the longest body is, in ∆s.
fn longest(case: &Case) -> f64 {
    let truth = Truth::new(case);
    let lengths = truth.bodies.iter().flat_map(|body| {
        let [min, max] = body.bounds();
        (0..3).map(move |k| max[k] - min[k])
    });
    lengths.fold(0.0, f64::max)
}
