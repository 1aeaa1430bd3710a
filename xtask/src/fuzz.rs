//! Damaged files for the readers of bodies, for as long as one likes.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

use sphpack_geometry::{BodyFormat, Sketch, Soup};

use crate::arguments::Arguments;
use crate::mangle::Mangler;
use crate::workspace::root;

/// An input of a few hundred bytes must not take longer.
const MOST_TIME: Duration = Duration::from_secs(2);

/// Nor may the whole process ask for more, the stacks and heaps of its threads included.
const MOST_MEBIBYTES: u64 = 1024;

/// Inputs from one seed. Seeds follow from the block's number, so that threads can share a format.
const BLOCK: usize = 4096;

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
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--inputs N", "--seed N", "--only FORMAT"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            inputs: arguments.whole("--inputs")?.unwrap_or(1_000_000),
            seed: arguments.whole("--seed")?.unwrap_or(0),
            only: arguments.text("--only"),
        })
    }
}

/// What a reader did with its inputs.
#[derive(Debug, Default)]
struct Tally {
    bodies: usize,
    slowest: Duration,
}

/// Damages the corpus of each format; fails at the first input on which a reader panics, takes too long or too much
/// memory, and keeps it.
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
        let tally = Readings::new(settings, format, &files).all()?;
        println!(
            "{name}: {} inputs, {} of them bodies, {:.0} inputs/s, the slowest {:.1} ms, peak memory {} MiB",
            settings.inputs,
            tally.bodies,
            settings.inputs as f64 / start.elapsed().as_secs_f64(),
            1e3 * tally.slowest.as_secs_f64(),
            mebibytes("VmHWM")
        );
    }
    if found {
        Ok(())
    } else {
        Err("--only needs one of stl, obj, ply, csv, dat, svg".to_owned())
    }
}

/// All inputs of one reader, in blocks that are the same whatever the number of threads.
struct Readings<'a> {
    settings: &'a Settings,
    format: BodyFormat,
    files: &'a [Vec<u8>],
    next_block: AtomicUsize,
    /// A reader has failed, or all is read: nobody goes on.
    is_over: AtomicBool,
}

impl<'a> Readings<'a> {
    fn new(settings: &'a Settings, format: BodyFormat, files: &'a [Vec<u8>]) -> Self {
        Self {
            settings,
            format,
            files,
            next_block: AtomicUsize::new(0),
            is_over: AtomicBool::new(false),
        }
    }

    /// The inputs of a block, in their order.
    fn inputs(&self, block: usize) -> impl Iterator<Item = Vec<u8>> {
        let mut mangler = Mangler::new(self.settings.seed, block as u64);
        let count = BLOCK.min(self.settings.inputs - block * BLOCK);
        (0..count).map(move |_| mangler.mangled(self.files))
    }

    /// Reads on threads of their own, and looks whether every input comes to an end.
    fn all(&self) -> Result<Tally, String> {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let places: Vec<AtomicUsize> = (0..threads).map(|_| AtomicUsize::new(0)).collect();
        std::thread::scope(|scope| {
            let workers: Vec<_> = places
                .iter()
                .map(|at| scope.spawn(|| self.work(at)))
                .collect();
            self.watch(&places, || workers.iter().all(|w| w.is_finished()));
            let mut whole = Tally::default();
            for worker in workers {
                let tally = worker.join().unwrap_or_else(|_| {
                    Err("a reader's thread panicked outside any reader".to_owned())
                })?;
                whole.bodies += tally.bodies;
                whole.slowest = whole.slowest.max(tally.slowest);
            }
            Ok(whole)
        })
    }

    /// Ends the process where an input hangs: its thread cannot be stopped.
    fn watch(&self, places: &[AtomicUsize], is_done: impl Fn() -> bool) {
        let mut seen: Vec<_> = places.iter().map(|_| (0, Instant::now())).collect();
        while !is_done() {
            std::thread::sleep(Duration::from_millis(20));
            for (place, (number, since)) in places.iter().zip(&mut seen) {
                let now = place.load(Relaxed);
                if now != *number {
                    (*number, *since) = (now, Instant::now());
                } else if since.elapsed() > 5 * MOST_TIME && now > 0 {
                    let input = self.inputs((now - 1) / BLOCK).nth((now - 1) % BLOCK);
                    eprintln!("{}", self.keep("hangs", &input.unwrap_or_default()));
                    std::process::exit(1);
                }
            }
        }
    }

    /// Reads block after block; `at` holds the number of the input that is being read, counted from 1.
    fn work(&self, at: &AtomicUsize) -> Result<Tally, String> {
        // Alone in a pool, the readers' parallel loops run here instead of waking other threads.
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .use_current_thread()
            .build()
            .map_err(|error| format!("no thread for the readers: {error}"))?;
        let result = pool.install(|| {
            let mut tally = Tally::default();
            while !self.is_over.load(Relaxed) {
                let block = self.next_block.fetch_add(1, Relaxed);
                if block * BLOCK >= self.settings.inputs {
                    break;
                }
                for (number, input) in self.inputs(block).enumerate() {
                    at.store(block * BLOCK + number + 1, Relaxed);
                    self.read(&input, &mut tally)?;
                }
                // Address space counts too: memory that is asked for and never used.
                if mebibytes("VmPeak") > MOST_MEBIBYTES {
                    return Err(format!(
                        "the reader of {} takes more than {MOST_MEBIBYTES} MiB in block {block} of seed {} or beside it",
                        self.format.description(),
                        self.settings.seed
                    ));
                }
            }
            Ok(tally)
        });
        if result.is_err() {
            self.is_over.store(true, Relaxed);
        }
        at.store(0, Relaxed);
        result
    }

    fn read(&self, input: &[u8], tally: &mut Tally) -> Result<(), String> {
        let start = Instant::now();
        let result = catch_unwind(AssertUnwindSafe(|| is_body(self.format, input)));
        let time = start.elapsed();
        match result {
            Err(_) => return Err(self.keep("panics", input)),
            Ok(_) if time > MOST_TIME => return Err(self.keep("takes too long", input)),
            Ok(is_body) => tally.bodies += usize::from(is_body),
        }
        tally.slowest = tally.slowest.max(time);
        Ok(())
    }

    /// Writes the input where it can be looked at, and says so.
    fn keep(&self, fault: &str, input: &[u8]) -> String {
        let path = root()
            .join("target")
            .join(format!("fuzz.{}", self.format.extension()));
        let kept = match fs::write(&path, input) {
            Ok(()) => path.display().to_string(),
            Err(error) => format!("lost, {}: {error}", path.display()),
        };
        format!(
            "the reader of {} {fault}; the input is {kept}: add it to geometry/corpus when mended",
            self.format.description()
        )
    }
}

/// Reads the input in its format, and in that which it looks like.
fn is_body(format: BodyFormat, input: &[u8]) -> bool {
    let build = |format: BodyFormat| match format.dimension() {
        3 => Soup::from_bytes(format, input)
            .and_then(|soup| soup.body())
            .is_ok(),
        _ => Sketch::from_bytes(format, input)
            .and_then(|sketch| sketch.body())
            .is_ok(),
    };
    if let Ok(other) = BodyFormat::detect(input, format.extension())
        && other != format
    {
        build(other);
    }
    build(format)
}

/// A quantity of this process, where the system tells; 0 where it does not.
fn mebibytes(name: &str) -> u64 {
    fs::read_to_string("/proc/self/status")
        .ok()
        .and_then(|status| {
            let line = status
                .lines()
                .find(|line| line.split(':').next() == Some(name))?;
            line.split_whitespace().nth(1)?.parse::<u64>().ok()
        })
        .unwrap_or(0)
        / 1024
}
