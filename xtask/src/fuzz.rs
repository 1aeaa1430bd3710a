//! Damaged files for the readers of bodies, for as long as one likes.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use sphpack_geometry::{BodyFormat, Outline, Soup};

use crate::mangle::Mangler;
use crate::root;

/// An input of a few hundred bytes must not take longer.
const MOST_TIME: Duration = Duration::from_secs(2);

/// What to run.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    /// For each reader.
    inputs: usize,
    seed: u64,
    /// The one format to damage, by its ending.
    only: Option<String>,
}

impl Settings {
    pub(crate) fn parse(arguments: &[String]) -> Result<Self, String> {
        let mut settings = Self {
            inputs: 1_000_000,
            seed: 0,
            only: None,
        };
        let mut arguments = arguments.iter();
        while let Some(name) = arguments.next() {
            let value = arguments.next().ok_or(format!("{name} needs a value"))?;
            let wrong = |_| format!("{name} is {value}; it must be a whole number");
            match name.as_str() {
                "--inputs" => settings.inputs = value.parse().map_err(wrong)?,
                "--seed" => settings.seed = value.parse().map_err(wrong)?,
                "--only" => settings.only = Some(value.clone()),
                other => return Err(format!("fuzz does not know {other}; see cargo xtask help")),
            }
        }
        Ok(settings)
    }
}

/// What a reader did with its inputs.
#[derive(Debug, Default)]
struct Tally {
    bodies: usize,
    slowest: Duration,
}

/// Damages the corpus of each format; fails at the first input on which a reader panics or takes too long, and keeps it.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    // A panic is reported once, with its input.
    std::panic::set_hook(Box::new(|_| {}));
    let mut found = false;
    for format in BodyFormat::ALL {
        let (name, folder) = match format {
            BodyFormat::Airfoil => ("dat", "airfoil"),
            other => (other.extension(), other.extension()),
        };
        if settings.only.as_ref().is_some_and(|only| only != name) {
            continue;
        }
        found = true;
        let folder = root().join("geometry/corpus").join(folder);
        let mut paths: Vec<PathBuf> = fs::read_dir(&folder)
            .map_err(|error| format!("{}: {error}", folder.display()))?
            .flatten()
            .map(|entry| entry.path())
            .collect();
        paths.sort();
        let files: Vec<Vec<u8>> = paths.iter().flat_map(fs::read).collect();
        let start = Instant::now();
        let tally = watched(settings, format, &files)?;
        println!(
            "{name}: {} inputs, {} of them bodies, {:.0} inputs/s, the slowest {:.1} ms, peak memory {} MiB",
            settings.inputs,
            tally.bodies,
            settings.inputs as f64 / start.elapsed().as_secs_f64(),
            1e3 * tally.slowest.as_secs_f64(),
            peak_mebibytes()
        );
    }
    if found {
        Ok(())
    } else {
        Err("--only needs one of stl, obj, ply, csv, dat, svg".to_owned())
    }
}

/// The input that is being read, and since when.
type Current = Mutex<Option<(Instant, Vec<u8>)>>;

/// Reads on a thread of its own, and looks whether it comes to an end.
fn watched(settings: &Settings, format: BodyFormat, files: &[Vec<u8>]) -> Result<Tally, String> {
    let current = Current::default();
    std::thread::scope(|scope| {
        let worker = scope.spawn(|| read_all(settings, format, files, &current));
        while !worker.is_finished() {
            std::thread::sleep(Duration::from_millis(50));
            let hung = lock(&current)
                .as_ref()
                .filter(|(since, _)| since.elapsed() > 5 * MOST_TIME)
                .map(|(_, input)| keep(format, "hangs", input));
            if let Some(message) = hung {
                // The thread cannot be stopped.
                eprintln!("{message}");
                std::process::exit(1);
            }
        }
        worker
            .join()
            .unwrap_or_else(|_| Err("the readers' thread panicked outside any reader".to_owned()))
    })
}

fn lock(current: &Current) -> std::sync::MutexGuard<'_, Option<(Instant, Vec<u8>)>> {
    current
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
}

fn read_all(
    settings: &Settings,
    format: BodyFormat,
    files: &[Vec<u8>],
    current: &Current,
) -> Result<Tally, String> {
    let mut mangler = Mangler::new(settings.seed);
    let mut tally = Tally::default();
    for _ in 0..settings.inputs {
        let input = mangler.mangled(files);
        let start = Instant::now();
        *lock(current) = Some((start, input.clone()));
        let result = catch_unwind(AssertUnwindSafe(|| is_body(format, &input)));
        let time = start.elapsed();
        *lock(current) = None;
        match result {
            Err(_) => return Err(keep(format, "panics", &input)),
            Ok(_) if time > MOST_TIME => return Err(keep(format, "takes too long", &input)),
            Ok(is_body) => tally.bodies += usize::from(is_body),
        }
        tally.slowest = tally.slowest.max(time);
    }
    Ok(tally)
}

/// Reads the input in its format, and in that which it looks like.
fn is_body(format: BodyFormat, input: &[u8]) -> bool {
    let build = |format: BodyFormat| match format.dimension() {
        3 => Soup::from_bytes(format, input)
            .and_then(|soup| soup.body())
            .is_ok(),
        _ => Outline::from_bytes(format, input).is_ok(),
    };
    if let Ok(other) = BodyFormat::detect(input, format.extension())
        && other != format
    {
        build(other);
    }
    build(format)
}

/// Writes the input where it can be looked at, and says so.
fn keep(format: BodyFormat, fault: &str, input: &[u8]) -> String {
    let path = root()
        .join("target")
        .join(format!("fuzz.{}", format.extension()));
    let kept = match fs::write(&path, input) {
        Ok(()) => path.display().to_string(),
        Err(error) => format!("lost, {}: {error}", path.display()),
    };
    format!(
        "the reader of {} {fault}; the input is {kept}: add it to geometry/corpus when mended",
        format.description()
    )
}

/// The most memory that this process has had, where the system tells.
fn peak_mebibytes() -> u64 {
    fs::read_to_string("/proc/self/status")
        .ok()
        .and_then(|status| {
            let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
            line.split_whitespace().nth(1)?.parse::<u64>().ok()
        })
        .unwrap_or(0)
        / 1024
}
