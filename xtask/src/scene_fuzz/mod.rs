//! Random scenes for the command, and a judge that shares nothing with it.

mod airfoil;
mod case;
pub(crate) mod estimates;
pub(crate) mod faults;
pub(crate) mod files;
mod garble;
mod generate;
mod judge;
mod kernel;
pub(crate) mod kills;
pub(crate) mod maps;
mod meshes;
pub(crate) mod random;
mod rows;
mod shape;
mod shrink;
mod table;
mod trial;
mod truth;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

use crate::arguments::Arguments;
use crate::workspace::root;
use case::Case;
use judge::Judgement;
use table::Outcome;
pub(crate) use trial::processor_seconds;

/// Scenes at a time.
const MOST_WORKERS: usize = 2;

/// Scenes of each class of failures that are shrunk.
const SHRUNK: usize = 1;

/// Packings that one shrinking may take, and one of a scene that is slow.
const MOST_TRIALS: [usize; 2] = [40, 6];

/// What to run.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    pub(crate) scenes: usize,
    pub(crate) seed: u64,
    /// The one scene to run, and to show.
    pub(crate) only: Option<usize>,
    /// The command, where it is not to be built.
    pub(crate) program: Option<PathBuf>,
    pub(crate) write: bool,
}

impl Settings {
    pub(crate) fn new(scenes: usize) -> Self {
        Self {
            scenes,
            seed: 0,
            only: None,
            program: None,
            write: false,
        }
    }

    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &[
        "--scenes N",
        "--seed N",
        "--number N",
        "--program FILE",
        "--write",
    ];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            scenes: arguments.whole("--scenes")?.unwrap_or(500),
            seed: arguments.whole("--seed")?.unwrap_or(0),
            only: arguments.whole("--number")?,
            program: arguments.path("--program"),
            write: arguments.has("--write"),
        })
    }
}

/// Packs random scenes and judges them; fails where any of them is not right.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let program = match &settings.program {
        Some(program) => std::path::absolute(program).map_err(|error| error.to_string())?,
        None => build()?,
    };
    let folder = root().join("target/fuzz");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let bench = Bench {
        seed: settings.seed,
        program,
        scratch: std::env::temp_dir().join(format!("sphpack-fuzz-{}", std::process::id())),
    };
    let result = bench.work(settings, &folder);
    // What is left of it is of no use to anybody.
    let _ = fs::remove_dir_all(&bench.scratch);
    result
}

/// Builds the command; it is beside this program.
pub(crate) fn build() -> Result<PathBuf, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        // Both, so that their common dependencies are built with the features that they have already.
        .args([
            "build",
            "--quiet",
            "--package",
            "sphpack",
            "--package",
            "xtask",
        ])
        .current_dir(root())
        .status()
        .map_err(|error| format!("cargo build cannot be started: {error}"))?;
    if !status.success() {
        return Err("cargo build --package sphpack failed".to_owned());
    }
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let program = own.with_file_name(format!("sphpack{}", std::env::consts::EXE_SUFFIX));
    if program.is_file() {
        Ok(program)
    } else {
        Err(format!("{} is not there", program.display()))
    }
}

/// Where scenes are tried.
#[derive(Debug)]
struct Bench {
    seed: u64,
    program: PathBuf,
    scratch: PathBuf,
}

impl Bench {
    /// Tries a scene that is not placed.
    fn try_out(&self, case: &Case, worker: usize) -> Result<(trial::Trial, Judgement), String> {
        let placed = case.placed();
        let folder = self.scratch.join(format!("worker{worker}"));
        let trial = trial::run(&placed, &self.program, &folder)?;
        let judgement = judge::judge(&placed, &trial);
        Ok((trial, judgement))
    }

    fn work(&self, settings: &Settings, folder: &Path) -> Result<(), String> {
        if let Some(number) = settings.only {
            return self.show(number, folder);
        }
        let outcomes = self.outcomes(settings.scenes)?;
        let mut table = table::table(settings.seed, &outcomes);
        println!("{table}");
        let picked = picked(&outcomes);
        if picked.is_empty() {
            table.push_str("\nNo failures.\n");
        }
        self.keep(&picked, folder)?;
        if settings.write {
            table::write(&table)?;
        }
        if picked.is_empty() {
            Ok(())
        } else {
            let failed = outcomes.iter().filter(|o| o.failed()).count();
            Err(format!(
                "{failed} of {} scenes are not right; the smallest of each class are in {}",
                outcomes.len(),
                folder.display()
            ))
        }
    }

    /// One scene in full.
    fn show(&self, number: usize, folder: &Path) -> Result<(), String> {
        let case = generate::case(self.seed, number as u64);
        println!("{}", case.placed().toml());
        let (trial, judgement) = self.try_out(&case, 0)?;
        println!(
            "{}{}{}\n{judgement:#?}",
            trial.dry.output, trial.pack.output, trial.pack.errors
        );
        let faults = judgement.faults().iter();
        let picked: Vec<_> = faults.map(|fault| (number, fault.class.clone())).collect();
        self.keep(&picked, folder)?;
        if picked.is_empty() {
            Ok(())
        } else {
            Err(format!("scene {number} is not right"))
        }
    }

    /// Shrinks failures, and writes and shows each where it can be looked at.
    fn keep(&self, picked: &[(usize, String)], folder: &Path) -> Result<(), String> {
        let done = in_parallel(picked.len(), |place, worker| {
            let (number, class) = &picked[place];
            eprintln!("shrinking scene {number}, {class}");
            let name = format!("{number}-{}", slug(class));
            let mut kept = self.shrunk(*number, class, worker).placed();
            kept.prefix = format!("{name}-");
            let path = folder.join(format!("{name}.toml"));
            trial::write(&kept, folder, &format!("{name}.toml"))?;
            let short: String = kept.toml().chars().take(3000).collect();
            println!("── {class}, scene {number}: {}\n{short}", path.display());
            Ok(())
        });
        done.map(|_| ())
    }

    /// All scenes in their order, tried by a few workers.
    fn outcomes(&self, count: usize) -> Result<Vec<Outcome>, String> {
        let bar = Mutex::new((Instant::now(), 0));
        let start = Instant::now();
        in_parallel(count, |number, worker| {
            let case = generate::case(self.seed, number as u64);
            let begin = Instant::now();
            let (trial, judgement) = self.try_out(&case, worker)?;
            let outcome = Outcome {
                number,
                method: case.method(),
                seconds: trial.pack.seconds,
                wall_seconds: begin.elapsed().as_secs_f64(),
                bytes: trial.pack.bytes,
                judgement,
            };
            if let Ok(mut bar) = bar.lock() {
                bar.1 += usize::from(outcome.failed());
                if bar.0.elapsed() > Duration::from_secs(3) || number + 1 == count {
                    bar.0 = Instant::now();
                    eprintln!(
                        "scene {} of {count}, {} not right, {:.0} s",
                        number + 1,
                        bar.1,
                        start.elapsed().as_secs_f64()
                    );
                }
            }
            Ok(outcome)
        })
    }

    /// The smallest scene found that fails alike.
    fn shrunk(&self, number: usize, class: &str, worker: usize) -> Case {
        let case = generate::case(self.seed, number as u64);
        let is_slow = class.starts_with("too slow") || class.ends_with("hangs");
        let most = MOST_TRIALS[usize::from(is_slow)];
        // The method belongs to the class, unless it does not matter.
        let plain = class.split(" (").next().unwrap_or_default();
        shrink::shrink(&case, most, |next| {
            let Ok((_, judgement)) = self.try_out(next, worker) else {
                return false;
            };
            judgement.faults().iter().any(|fault| {
                fault.class == class || (next.method.is_none() && fault.class == plain)
            })
        })
    }
}

/// The failures to be shrunk: the first few of each class.
fn picked(outcomes: &[Outcome]) -> Vec<(usize, String)> {
    let mut picked: Vec<(usize, String)> = Vec::new();
    for outcome in outcomes {
        for fault in outcome.judgement.faults() {
            if picked.iter().filter(|(_, c)| *c == fault.class).count() < SHRUNK {
                picked.push((outcome.number, fault.class.clone()));
            }
        }
    }
    picked
}

/// A class as part of a file's name.
fn slug(class: &str) -> String {
    let letters = class
        .chars()
        .map(|c| if c.is_alphanumeric() { c } else { '-' });
    letters
        .collect::<String>()
        .trim_matches('-')
        .replace("--", "-")
}

/// Results of numbered jobs, in their order.
fn in_parallel<T: Send>(
    count: usize,
    job: impl Fn(usize, usize) -> Result<T, String> + Sync,
) -> Result<Vec<T>, String> {
    let workers = std::thread::available_parallelism()
        .map_or(1, usize::from)
        .min(MOST_WORKERS);
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let (next, done, job) = (&next, &done, &job);
            scope.spawn(move || {
                loop {
                    let number = next.fetch_add(1, Relaxed);
                    if number >= count {
                        break;
                    }
                    let result = job(number, worker);
                    if let Ok(mut done) = done.lock() {
                        done.push((number, result));
                    }
                }
            });
        }
    });
    let mut done = done
        .into_inner()
        .map_err(|_| "a worker panicked".to_owned())?;
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, result)| result).collect()
}
