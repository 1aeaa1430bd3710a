//! Damaged scene files for the parser and the plan, in process, for as long as one likes.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

use sphpack::{BAD_INPUT, Error, Scene, plan};

use super::random::Random;
use super::{garble, generate, in_parallel};
use crate::arguments::Arguments;
use crate::marks;
use crate::workspace::root;

/// A scene of a few hundred bytes must not take longer to be read or planned, on a slow machine.
const MOST_TIME: Duration = Duration::from_secs(10);

/// What hangs ends the process.
const HANGS: Duration = Duration::from_secs(60);

/// What a plan may ask for.
const PLAN_BYTES: f64 = 64.0 * 1024.0 * 1024.0;

/// Nor may the process as a whole have more.
const MOST_MEBIBYTES: u64 = 1024;

/// Scenes of the generator that are damaged, beside those of the project.
const GENERATED: u64 = 300;

/// Files from one seed.
const BLOCK: usize = 256;

/// What to run.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    pub(crate) files: usize,
    pub(crate) seed: u64,
    pub(crate) write: bool,
}

impl Settings {
    pub(crate) fn new(files: usize) -> Self {
        Self {
            files,
            seed: 0,
            write: false,
        }
    }

    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--scene-files N", "--seed N", "--write"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            files: arguments.whole("--scene-files")?.unwrap_or(1000),
            seed: arguments.whole("--seed")?.unwrap_or(0),
            write: arguments.has("--write"),
        })
    }
}

/// What came of the files.
#[derive(Debug, Default, Clone, Copy)]
struct Tally {
    not_text: usize,
    /// Refused with line and column.
    with_line: usize,
    /// Refused by the name of what is wrong.
    with_name: usize,
    planned: usize,
    /// Right as text, but refused by the plan.
    not_planned: usize,
    slowest: Duration,
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.not_text += other.not_text;
        self.with_line += other.with_line;
        self.with_name += other.with_name;
        self.planned += other.planned;
        self.not_planned += other.not_planned;
        self.slowest = self.slowest.max(other.slowest);
    }
}

/// Damages scenes; fails where any makes the library panic, takes too long or too much, or is refused without a place.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let scenes = scenes(settings.seed)?;
    let scratch = std::env::temp_dir().join(format!("sphpack-files-{}", std::process::id()));
    fs::create_dir_all(&scratch).map_err(|error| format!("{}: {error}", scratch.display()))?;
    let hook = std::panic::take_hook();
    // A panic is reported once, with its file.
    std::panic::set_hook(Box::new(|_| {}));
    let result = work(settings, &scenes, &scratch);
    std::panic::set_hook(hook);
    let _ = fs::remove_dir_all(&scratch);
    let (tally, faults) = result?;
    let table = table(settings, &tally, faults.len());
    println!("{table}");
    faults.iter().for_each(|fault| println!("{fault}"));
    if settings.write {
        marks::write("scene files", &table)?;
    }
    match faults.len() {
        0 => Ok(()),
        count => Err(format!(
            "{count} scene files were not refused as they should be"
        )),
    }
}

/// When a worker began with a file, and which.
type Begun = (Instant, Vec<u8>);

/// Those of the project, the template, and some of the generator.
fn scenes(seed: u64) -> Result<Vec<String>, String> {
    let folder = root().join("scenes");
    let entries = fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    paths.sort();
    let mut scenes = vec![sphpack::scene::TEMPLATE.to_owned()];
    for path in paths {
        scenes.push(fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?);
    }
    scenes.extend((0..GENERATED).map(|number| generate::case(seed, number).placed().toml()));
    Ok(scenes)
}

fn work(
    settings: &Settings,
    scenes: &[String],
    scratch: &Path,
) -> Result<(Tally, Vec<String>), String> {
    let blocks = settings.files.div_ceil(BLOCK);
    // What is being read, and since when.
    let at: Vec<Mutex<Option<Begun>>> = (0..8).map(|_| Mutex::new(None)).collect();
    let done = AtomicUsize::new(0);
    let block = |number: usize, worker: usize| {
        let random = &mut Random::new(settings.seed, number as u64);
        let mut tally = Tally::default();
        let mut faults = Vec::new();
        for _ in 0..BLOCK.min(settings.files - number * BLOCK) {
            let bytes = garble::garbled(scenes, random);
            if let Ok(mut at) = at[worker].lock() {
                *at = Some((Instant::now(), bytes.clone()));
            }
            if let Err(fault) = read(&bytes, scratch, worker, &mut tally) {
                faults.push(keep(&fault, &bytes));
            }
        }
        if let Ok(mut at) = at[worker].lock() {
            *at = None;
        }
        done.fetch_add(1, Relaxed);
        if mebibytes() > MOST_MEBIBYTES {
            faults.push(format!(
                "more than {MOST_MEBIBYTES} MiB in block {number} or beside it"
            ));
        }
        Ok((tally, faults))
    };
    std::thread::scope(|scope| {
        let worker = scope.spawn(|| in_parallel(blocks, block));
        while !worker.is_finished() {
            std::thread::sleep(Duration::from_millis(20));
            for place in &at {
                if let Ok(place) = place.lock()
                    && let Some((since, bytes)) = &*place
                    && since.elapsed() > HANGS
                {
                    // Its thread cannot be stopped.
                    eprintln!("{}", keep("hangs", bytes));
                    std::process::exit(1);
                }
            }
        }
        let results = worker
            .join()
            .map_err(|_| "a worker panicked".to_owned())??;
        let mut whole = (Tally::default(), Vec::new());
        for (tally, faults) in results {
            whole.0.add(&tally);
            whole.1.extend(faults);
        }
        Ok(whole)
    })
}

/// Reads one file, and plans what can be read; an error is what went wrong.
fn read(bytes: &[u8], scratch: &Path, worker: usize, tally: &mut Tally) -> Result<(), String> {
    let begin = Instant::now();
    let result = catch_unwind(AssertUnwindSafe(|| match std::str::from_utf8(bytes) {
        // Body files that it names are those of the project.
        Ok(text) => Scene::parse(text, root().join("scenes/garbled.toml")),
        Err(_) => {
            let path = scratch.join(format!("{worker}.toml"));
            fs::write(&path, bytes).map_err(|e| Error::System(e.to_string()))?;
            Scene::read(path)
        }
    }));
    let scene = match result.map_err(|_| "panics")? {
        Ok(scene) => scene,
        Err(error) => {
            tally.slowest = tally.slowest.max(begin.elapsed());
            let words = error.to_string();
            match &error {
                Error::Scene { at: Some(_), .. } => tally.with_line += 1,
                Error::Input { .. } if words.contains("not text") => tally.not_text += 1,
                _ if names_something(&error) => tally.with_name += 1,
                _ => return Err(format!("is refused without a place ({words})")),
            }
            return if error.status() == BAD_INPUT {
                Ok(())
            } else {
                Err(format!(
                    "is refused with status {} ({words})",
                    error.status()
                ))
            };
        }
    };
    let planned = catch_unwind(AssertUnwindSafe(|| plan(&scene, Some(PLAN_BYTES))));
    let time = begin.elapsed();
    tally.slowest = tally.slowest.max(time);
    if time > MOST_TIME {
        return Err(format!("takes {:.1} s", time.as_secs_f64()));
    }
    match planned.map_err(|_| "panics when it is planned")? {
        Ok(_) => tally.planned += 1,
        Err(error) if names_something(&error) => tally.not_planned += 1,
        Err(error) => return Err(format!("is not planned, and nothing says where ({error})")),
    }
    Ok(())
}

/// Whether an error without a line says at least which body, key or file it is about.
fn names_something(error: &Error) -> bool {
    let words = error.to_string();
    let is_quoted = words.contains('"');
    let keys = [
        "spacing",
        "domain",
        "margin",
        "body",
        "bodies",
        "fluid",
        "packing",
        "quality",
        "output",
        "axis",
        "lattice",
        "method",
        "particles",
        "kernel",
        "surface",
        "container",
        "void",
    ];
    is_quoted || keys.iter().any(|key| words.contains(key))
}

/// Writes the file where it can be looked at, and says so.
fn keep(fault: &str, bytes: &[u8]) -> String {
    // By its content, so that several can be kept.
    let hash = bytes.iter().fold(0xcbf2_9ce4_8422_2325u64, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let path = root().join(format!("target/scene-{hash:016x}.toml"));
    match fs::write(&path, bytes) {
        Ok(()) => format!("{} {fault}", path.display()),
        Err(error) => format!("a file that is lost ({error}) {fault}"),
    }
}

fn table(settings: &Settings, tally: &Tally, faults: usize) -> String {
    let rows = [
        ("all", settings.files),
        ("refused with line and column", tally.with_line),
        ("refused by the name of what is wrong", tally.with_name),
        ("not text", tally.not_text),
        ("still right, and planned", tally.planned),
        ("still a scene, refused by the plan", tally.not_planned),
        ("not as it should be", faults),
    ];
    let mut text = format!("| seed {} | files |\n|---|---|\n", settings.seed);
    for (name, count) in rows {
        text += &format!("| {name} | {count} |\n");
    }
    let milliseconds = 1e3 * tally.slowest.as_secs_f64();
    let memory = mebibytes();
    text + &format!("\nThe slowest took {milliseconds:.0} ms; peak memory {memory} MiB.\n")
}

/// The most memory that this process has had; 0 where the system does not tell.
fn mebibytes() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let number = line.and_then(|line| line.split_whitespace().next());
    number
        .and_then(|number| number.parse::<u64>().ok())
        .unwrap_or(0)
        / 1024
}
