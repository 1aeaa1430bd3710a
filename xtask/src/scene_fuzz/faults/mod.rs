//! The command under faults that an ordinary process can meet, and a judge of what is left on the disk.

mod desk;
mod inputs;
mod limits;
mod midway;
mod places;
mod table;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::build;
use super::random::Random;
use crate::arguments::Arguments;
use crate::marks;
use desk::{Desk, Reference};
use table::Row;

/// What to run.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    pub(crate) runs: usize,
    pub(crate) seed: u64,
    /// Faults whose names hold this.
    pub(crate) only: Option<String>,
    /// The command, where it is not to be built.
    pub(crate) program: Option<PathBuf>,
    pub(crate) write: bool,
}

impl Settings {
    pub(crate) fn new(runs: usize) -> Self {
        Self {
            runs,
            seed: 0,
            only: None,
            program: None,
            write: false,
        }
    }

    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &[
        "--runs N",
        "--seed N",
        "--only FAULT",
        "--program FILE",
        "--write",
    ];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            runs: arguments.whole("--runs")?.unwrap_or(500),
            seed: arguments.whole("--seed")?.unwrap_or(0),
            only: arguments.text("--only"),
            program: arguments.path("--program"),
            write: arguments.has("--write"),
        })
    }
}

/// What came of a run that did nothing wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// Everything is written.
    Done,
    /// Before anything was computed.
    Refused,
    /// With what was computed kept, as far as the fault leaves room for it.
    Failed,
    /// Killed, and done by the next run.
    Killed,
    /// The fault cannot be made here.
    Skipped(&'static str),
}

/// Runs the command under one fault; an error is what it did wrong.
type Try = fn(&Desk<'_>, &mut Random) -> Result<Outcome, String>;

const FAULTS: [(&str, Try); 24] = [
    (
        "folder missing, a file, or full of nothing",
        places::no_folder,
    ),
    ("folder read-only", places::read_only),
    ("a folder in an output's place", places::folder_in_place),
    (
        "names: control characters, not UTF-8, very long",
        places::names,
    ),
    ("output full, or nobody reads", places::standard_output),
    (
        "a folder comes into an output's place",
        midway::folder_comes,
    ),
    ("the output folder goes away", midway::folder_goes),
    (
        "the output folder becomes read-only",
        midway::becomes_read_only,
    ),
    ("killed", midway::killed),
    ("stopped by Ctrl-C", midway::stopped),
    ("disk full", limits::disk_full),
    ("files limited", limits::file_size),
    ("address space limited", limits::address_space),
    (
        "address space limited, measuring",
        limits::address_space_of_others,
    ),
    ("data limited", limits::data),
    ("threads limited", limits::threads),
    ("open files limited", limits::open_files),
    ("processor time limited", limits::processor_time),
    ("too many threads asked for", limits::many_threads),
    ("scene is no file", inputs::no_file),
    ("scene without end, or not readable", inputs::no_end),
    ("scene of a million bodies", inputs::million),
    ("NPZ that grows or lies", inputs::bomb),
    ("scene goes away or changes", inputs::changes),
];

/// Runs the command under faults; fails where it does anything wrong.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let program = match &settings.program {
        Some(program) => std::path::absolute(program).map_err(|error| error.to_string())?,
        None => build()?,
    };
    let scratch = std::env::temp_dir().join(format!("sphpack-faults-{}", std::process::id()));
    let result = work(settings, &program, &scratch);
    let _ = fs::remove_dir_all(&scratch);
    let rows = result?;
    let table = table::table(settings.seed, &rows);
    print!("{table}");
    let wrong: Vec<&String> = rows.iter().flat_map(|row| &row.wrong).collect();
    wrong.iter().for_each(|words| println!("{words}"));
    if settings.write {
        marks::write("faults", &table)?;
    }
    match wrong.len() {
        0 => Ok(()),
        count => Err(format!("{count} runs under faults were not right")),
    }
}

fn work(settings: &Settings, program: &Path, scratch: &Path) -> Result<Vec<Row>, String> {
    let faults: Vec<(&'static str, Try)> = FAULTS
        .into_iter()
        .filter(|(name, _)| {
            let only = settings.only.as_deref();
            only.is_none_or(|part| name.contains(part))
        })
        .collect();
    if faults.is_empty() {
        return Err("--only is in no fault's name".into());
    }
    let references = Reference::all(program, scratch)?;
    let mut rows: Vec<Row> = faults.iter().map(|(name, _)| Row::new(name)).collect();
    let mut told = Instant::now();
    for number in 0..settings.runs {
        if told.elapsed() > Duration::from_secs(5) {
            told = Instant::now();
            eprintln!("run {number} of {}", settings.runs);
        }
        let random = &mut Random::new(settings.seed, number as u64);
        let place = number % faults.len();
        let reference = &references[random.below(references.len())];
        let desk = Desk::new(program, scratch, reference)?;
        let row = &mut rows[place];
        match faults[place].1(&desk, random) {
            Ok(outcome) => row.count(outcome),
            Err(words) => row
                .wrong
                .push(format!("run {number}, {}: {words}", faults[place].0)),
        }
        desk.clear();
    }
    Ok(rows)
}
