//! Runs of random scenes that are killed again and again, and gone on with.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

use serde_json::Value;

use super::random::Random;
use super::{build, generate, trial};
use crate::arguments::Arguments;
use crate::marks;

/// What to run.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    pub(crate) kills: usize,
    pub(crate) seed: u64,
    /// The command, where it is not to be built.
    pub(crate) program: Option<PathBuf>,
    pub(crate) write: bool,
}

impl Settings {
    pub(crate) fn new(kills: usize) -> Self {
        Self {
            kills,
            seed: 0,
            program: None,
            write: false,
        }
    }

    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--runs N", "--seed N", "--program FILE", "--write"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            kills: arguments.whole("--runs")?.unwrap_or(200),
            seed: arguments.whole("--seed")?.unwrap_or(0),
            program: arguments.path("--program"),
            write: arguments.has("--write"),
        })
    }
}

/// Methods that come to their particles step by step; the last is for the plane only.
const METHODS: [&str; 8] = [
    "balanced",
    "hybrid",
    "coupled",
    "agitated",
    "ppa",
    "relaxation",
    "complex",
    "standard",
];

/// A scene that takes longer is left out.
const LONGEST: Duration = Duration::from_secs(25);

/// Kills of one scene, at most.
const MOST_KILLS: usize = 5;

/// A leftover is not touched before it is as old as this.
const OLD: Duration = Duration::from_secs(120);

/// What came of the scenes of one method.
#[derive(Debug, Default)]
struct Row {
    scenes: usize,
    kills: usize,
    /// Runs that went on from a checkpoint.
    resumed: usize,
    /// Hidden files that kills left and later runs cleaned.
    leftovers: usize,
    faults: Vec<String>,
}

/// Kills and resumes runs; fails where any comes to something else than a run that was never killed.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let program = match &settings.program {
        Some(program) => std::path::absolute(program).map_err(|error| error.to_string())?,
        None => build()?,
    };
    let scratch = std::env::temp_dir().join(format!("sphpack-kills-{}", std::process::id()));
    let result = work(settings, &program, &scratch);
    let _ = fs::remove_dir_all(&scratch);
    let rows = result?;
    let table = format!("| seed {} {}", settings.seed, table(&rows));
    print!("{table}");
    if settings.write {
        marks::write("kills", &table)?;
    }
    let faults: Vec<&String> = rows.values().flat_map(|row| &row.faults).collect();
    faults.iter().for_each(|fault| println!("{fault}"));
    match faults.len() {
        0 => Ok(()),
        count => Err(format!("{count} runs did not come to the same")),
    }
}

fn work(
    settings: &Settings,
    program: &Path,
    scratch: &Path,
) -> Result<BTreeMap<&'static str, Row>, String> {
    let mut rows: BTreeMap<&'static str, Row> = BTreeMap::new();
    let mut told = Instant::now();
    for number in 0.. {
        let kills: usize = rows.values().map(|row| row.kills).sum();
        if kills >= settings.kills {
            break;
        }
        if told.elapsed() > Duration::from_secs(5) {
            told = Instant::now();
            eprintln!("scene {number}, {kills} of {} kills", settings.kills);
        }
        let random = &mut Random::new(!settings.seed, number);
        let mut case = generate::case(settings.seed, number).placed();
        let method = METHODS[number as usize % if case.dimension == 2 { 8 } else { 7 }];
        if method == "ppa" {
            case = case.emptied();
        }
        let folder = scratch.join("scene");
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        trial::write(&case, &folder, "scene.toml")?;
        let bench = Bench {
            program,
            folder: &folder,
            method,
        };
        let Some((whole, seconds)) = bench.never_killed()? else {
            continue;
        };
        let row = rows.entry(method).or_default();
        row.scenes += 1;
        if let Err(fault) = bench.killed(&whole, seconds, random, row) {
            row.faults
                .push(format!("scene {number}, {method}: {fault}"));
        }
    }
    Ok(rows)
}

/// A scene in a folder of its own.
struct Bench<'a> {
    program: &'a Path,
    folder: &'a Path,
    method: &'static str,
}

/// What a run that ended has left.
#[derive(Debug, PartialEq)]
struct Whole {
    status: Option<i32>,
    rows: Vec<u8>,
    report: Value,
}

impl Bench<'_> {
    fn command(&self, more: &[&str]) -> Command {
        let mut command = Command::new(self.program);
        command
            .args(["pack", "scene.toml", "--method", self.method])
            .args(["--threads", "1", "-o", "out.csv", "--report", "out.json"])
            .args(more)
            .current_dir(self.folder)
            .stdin(Stdio::null())
            .stdout(Stdio::null());
        command
    }

    fn whole(&self, status: Option<i32>) -> Result<Whole, String> {
        let read = |name: &str| {
            fs::read(self.folder.join(name)).map_err(|error| format!("{name}: {error}"))
        };
        let mut report: Value =
            serde_json::from_slice(&read("out.json")?).map_err(|error| error.to_string())?;
        forget_times(&mut report);
        let rows = read("out.csv")?;
        for name in ["out.csv", "out.json"] {
            let _ = fs::remove_file(self.folder.join(name));
        }
        Ok(Whole {
            status,
            rows,
            report,
        })
    }

    /// `None` for a scene that takes too long, or is refused.
    fn never_killed(&self) -> Result<Option<(Whole, f64)>, String> {
        let begin = Instant::now();
        let status = ended(self.command(&[]).stderr(Stdio::null()), LONGEST)?;
        let seconds = begin.elapsed().as_secs_f64();
        match status {
            Some(Some(code)) if [0, 3].contains(&code) => {
                Ok(Some((self.whole(Some(code))?, seconds)))
            }
            _ => Ok(None),
        }
    }

    /// Kills it a few times and lets it end; `seconds` is what it takes.
    fn killed(
        &self,
        whole: &Whole,
        seconds: f64,
        random: &mut Random,
        row: &mut Row,
    ) -> Result<(), String> {
        let every = match random.below(3) {
            0 => 0.0,
            _ => seconds * random.between(0.0, 0.1),
        };
        let most = random.whole(1, MOST_KILLS);
        for kill in 0.. {
            let is_last = kill >= most;
            row.leftovers += self.age()?;
            // A checkpoint after every evaluation takes a slow disk minutes: not where nobody kills any more.
            let every = if is_last { 0.1 * seconds } else { every }.to_string();
            let mut arguments = vec!["--checkpoint-every", &every];
            if self.folder.join("out.checkpoint").exists() {
                arguments.push("--resume");
                row.resumed += 1;
            }
            if self.folder.join("out.csv").exists() || self.folder.join("out.json").exists() {
                arguments.push("--force");
            }
            let wait = if is_last {
                LONGEST * 4
            } else {
                Duration::from_secs_f64(seconds * random.between(0.0, 0.8))
            };
            let errors = self.folder.join("stderr.txt");
            let to = File::create(&errors).map_err(|error| error.to_string())?;
            let Some(status) = ended(self.command(&arguments).stderr(to), wait)? else {
                if is_last {
                    return Err("it did not end".into());
                }
                row.kills += 1;
                continue;
            };
            if ![Some(0), Some(3)].contains(&status) {
                let words = fs::read_to_string(&errors).unwrap_or_default();
                return Err(format!("exit status {status:?}: {words}"));
            }
            let now = self.whole(status)?;
            if now.rows != whole.rows {
                return Err(format!("other particles after {kill} kills"));
            }
            if now != *whole {
                return Err(format!("another report after {kill} kills"));
            }
            break;
        }
        let mut left = self.hidden()?;
        left.extend(
            (self.names()?)
                .into_iter()
                .filter(|name| name.ends_with(".checkpoint")),
        );
        if left.is_empty() {
            Ok(())
        } else {
            Err(format!("left behind: {}", left.join(", ")))
        }
    }

    /// Makes leftovers look old; how many there are.
    fn age(&self) -> Result<usize, String> {
        let hidden = self.hidden()?;
        for name in &hidden {
            let file = File::options().append(true).open(self.folder.join(name));
            file.and_then(|file| file.set_modified(SystemTime::now() - OLD))
                .map_err(|error| format!("{name}: {error}"))?;
        }
        Ok(hidden.len())
    }

    fn names(&self) -> Result<Vec<String>, String> {
        let entries = fs::read_dir(self.folder).map_err(|error| error.to_string())?;
        Ok(entries
            .flatten()
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect())
    }

    fn hidden(&self) -> Result<Vec<String>, String> {
        let mut names = self.names()?;
        names.retain(|name| name.starts_with('.'));
        Ok(names)
    }
}

/// How a command ends; `None` where it was killed after `most`.
fn ended(command: &mut Command, most: Duration) -> Result<Option<Option<i32>>, String> {
    let mut child = command
        .spawn()
        .map_err(|error| format!("the command cannot be started: {error}"))?;
    let begin = Instant::now();
    loop {
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            return Ok(Some(status.code()));
        }
        let left = most.saturating_sub(begin.elapsed());
        if left.is_zero() {
            // It may have ended in between: then its end counts.
            child.kill().map_err(|error| error.to_string())?;
            let status = child.wait().map_err(|error| error.to_string())?;
            return Ok(status.code().map(Some));
        }
        std::thread::sleep(left.min(Duration::from_millis(2)));
    }
}

/// Removes from a report what is different in every run.
fn forget_times(report: &mut Value) {
    match report {
        Value::Object(object) => {
            object.retain(|name, _| name != "seconds" && name != "peak_memory_bytes");
            object.values_mut().for_each(forget_times);
        }
        Value::Array(list) => list.iter_mut().for_each(forget_times),
        _ => {}
    }
}

fn table(rows: &BTreeMap<&'static str, Row>) -> String {
    let mut text =
        "| scenes | kills | resumed | leftovers cleaned | not the same |\n|---|---|---|---|---|---|\n"
            .to_owned();
    let mut line = |name: &str, counts: [usize; 5]| {
        let cells = counts.map(|count| count.to_string()).join(" | ");
        text += &format!("| {name} | {cells} |\n");
    };
    let counts = |row: &Row| {
        let faults = row.faults.len();
        [row.scenes, row.kills, row.resumed, row.leftovers, faults]
    };
    let mut sum = [0; 5];
    for (name, row) in rows {
        line(name, counts(row));
        for (sum, count) in sum.iter_mut().zip(counts(row)) {
            *sum += count;
        }
    }
    line("all", sum);
    text
}
