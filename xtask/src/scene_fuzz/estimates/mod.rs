//! What a dry run says of memory and time, beside what packings take.

mod family;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use sphpack::{Scene, plan};
use sphpack_packing::pace::Pace;

use super::{build, trial};
use crate::arguments::Arguments;
use crate::marks;
use family::Job;

/// What an estimate of memory may be, over the peak, where that is above [`WEIGHED_BYTES`].
const MEMORY: [f64; 2] = [0.7, 1.3];
const WEIGHED_BYTES: f64 = 64.0 * MEBIBYTE;

/// How many times longer than estimated a run may take, where it takes longer than [`WEIGHED_SECONDS`]; and the default
/// method.
const TIME: f64 = 3.0;
const DEFAULT_TIME: f64 = 2.0;
const WEIGHED_SECONDS: f64 = 1.0;

const MEBIBYTE: f64 = 1_048_576.0;

/// What hangs is ended.
const MOST_SECONDS: f64 = 200.0;

/// What to run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Settings {
    pub(crate) write: bool,
    pub(crate) quick: bool,
    /// The command, where it is not to be built.
    pub(crate) program: Option<PathBuf>,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--quick", "--program FILE", "--write"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            write: arguments.has("--write"),
            quick: arguments.has("--quick"),
            program: arguments.path("--program"),
        })
    }
}

/// What was said, and what it took.
#[derive(Debug, Clone, Copy)]
struct Pair {
    said: f64,
    took: f64,
}

impl Pair {
    fn ratio(self) -> f64 {
        self.said / self.took
    }

    /// Both in some unit, and the ratio.
    fn cells(pair: Option<Self>, unit: f64, digits: usize) -> String {
        pair.map_or("  |  | ".to_owned(), |pair| {
            format!(
                "{:.digits$} | {:.digits$} | {:.2}",
                pair.said / unit,
                pair.took / unit,
                pair.ratio()
            )
        })
    }
}

/// What came of a scene.
#[derive(Debug)]
struct Row {
    job: Job,
    particles: f64,
    /// Bytes.
    memory: Pair,
    /// Core-seconds of an evaluation, and of the whole run, where it was not stopped.
    evaluation: Option<Pair>,
    whole: Option<Pair>,
}

impl Row {
    /// What is wrong with the estimates.
    fn faults(&self) -> Vec<String> {
        let name = format!(
            "{} in {}-D, {}",
            self.job.method, self.job.dimension, self.job.about
        );
        let mut faults = Vec::new();
        let ratio = self.memory.ratio();
        if self.memory.took > WEIGHED_BYTES && !(MEMORY[0]..=MEMORY[1]).contains(&ratio) {
            faults.push(format!("{name}: {ratio:.2} of the peak memory"));
        }
        let most = match self.job.method {
            "balanced" => DEFAULT_TIME,
            _ => TIME,
        };
        for (what, pair) in [("evaluation", self.evaluation), ("run", self.whole)] {
            let late = pair.filter(|pair| pair.took > most * pair.said);
            if late.is_some() && self.whole.is_none_or(|whole| whole.took > WEIGHED_SECONDS) {
                let times = late.map_or(0.0, |pair| 1.0 / pair.ratio());
                faults.push(format!("{name}: {times:.1} times the estimate of a {what}"));
            }
        }
        faults
    }

    fn line(&self) -> String {
        format!(
            "| {} | {} | {} | {} | {} | {} | {} |",
            self.job.method,
            self.job.dimension,
            self.job.about,
            self.particles,
            Pair::cells(Some(self.memory), MEBIBYTE, 0),
            Pair::cells(self.evaluation, 1e-3, 2),
            Pair::cells(self.whole, 1.0, 2),
        )
    }
}

const HEAD: &str = "| method | D | scene | particles | memory, MiB | peak | ratio | evaluation, ms | took | ratio | run, s | took | ratio |\n\
                    |---|---|---|---|---|---|---|---|---|---|---|---|---|";

/// Packs the family, one scene after the other; fails where an estimate is too far off.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let program = match &settings.program {
        Some(program) => std::path::absolute(program).map_err(|error| error.to_string())?,
        None => build()?,
    };
    let scratch = std::env::temp_dir().join(format!("sphpack-estimates-{}", std::process::id()));
    let result = rows(settings, &program, &scratch);
    let _ = fs::remove_dir_all(&scratch);
    let rows = result?;
    let lines: Vec<String> = rows.iter().map(Row::line).collect();
    if settings.write {
        marks::write("estimates", &format!("{HEAD}\n{}", lines.join("\n")))?;
    }
    let faults: Vec<String> = rows.iter().flat_map(Row::faults).collect();
    faults.iter().for_each(|fault| println!("{fault}"));
    match faults.len() {
        0 => Ok(()),
        count => Err(format!("{count} estimates were too far off")),
    }
}

fn rows(settings: &Settings, program: &Path, scratch: &Path) -> Result<Vec<Row>, String> {
    fs::create_dir_all(scratch).map_err(|error| format!("{}: {error}", scratch.display()))?;
    println!("{HEAD}");
    let mut rows = Vec::new();
    for job in family::jobs() {
        if settings.quick && !job.is_quick {
            continue;
        }
        let row = row(job, program, scratch)?;
        println!("{}", row.line());
        rows.push(row);
    }
    Ok(rows)
}

fn row(job: Job, program: &Path, scratch: &Path) -> Result<Row, String> {
    let scene = Scene::parse(&job.text, scratch.join("scene.toml")).map_err(|e| e.to_string())?;
    let plan = plan(&scene, None).map_err(|error| error.to_string())?;
    fs::write(scratch.join("scene.toml"), &job.text).map_err(|error| error.to_string())?;
    // Others may be at work on the machine: its pace is that of this minute.
    let estimate = plan.estimate;
    let before = Pace::measured(&estimate);
    let seconds = packed(program, scratch, job.stopped_after)?;
    let pace = before.mean(Pace::measured(&estimate));
    let text = fs::read_to_string(scratch.join("out.json"))
        .map_err(|error| format!("{} left no report: {error}", job.method))?;
    let report: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    let number = |pointer: &str| {
        report
            .pointer(pointer)
            .and_then(Value::as_f64)
            .unwrap_or(0.0)
    };
    let settling: f64 = ["neighbors", "forces", "projection", "minimiser"]
        .iter()
        .map(|part| number(&format!("/seconds/{part}")))
        .sum();
    // What evaluations of the whole those of its parts come to.
    let evaluations = number("/force_evaluations")
        / match job.method {
            "relaxation" => 1.0 + scene.body.len() as f64,
            "complex" => 4.0,
            _ => 1.0,
        };
    let is_moved = estimate.seconds_per_evaluation > 0.0 && evaluations > 1.0;
    let is_whole = job.stopped_after.is_none();
    Ok(Row {
        particles: number("/particles/total"),
        memory: Pair {
            said: estimate.memory_bytes,
            took: number("/peak_memory_bytes"),
        },
        evaluation: (is_whole && is_moved && job.method != "coupled").then(|| Pair {
            said: estimate.seconds_of_one(pace),
            took: settling / number("/seconds/total") * seconds / evaluations,
        }),
        whole: is_whole.then(|| Pair {
            said: plan.building_seconds
                + estimate.seconds(pace, scene.typical_evaluations(plan.dimension)),
            took: seconds,
        }),
        job,
    })
}

/// Packs the scene in a folder; the processor time that it takes.
fn packed(program: &Path, folder: &Path, stopped_after: Option<f64>) -> Result<f64, String> {
    let errors = folder.join("stderr.txt");
    let mut child = Command::new(program)
        .args(["pack", "scene.toml", "--threads", "1", "--quiet", "--force"])
        .args(["-o", "out.vtu", "--report", "out.json"])
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(File::create(&errors).map_err(|error| error.to_string())?)
        .spawn()
        .map_err(|error| format!("the command cannot be started: {error}"))?;
    let process = PathBuf::from(format!("/proc/{}", child.id()));
    let (begin, mut seconds, mut is_stopped) = (Instant::now(), 0.0_f64, false);
    let status = loop {
        seconds = seconds.max(trial::processor_seconds(&process));
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            break status;
        }
        if !is_stopped && stopped_after.is_some_and(|most| seconds > most) {
            is_stopped = true;
            let told = Command::new("kill")
                .args(["-INT", &child.id().to_string()])
                .status();
            told.map_err(|error| format!("kill: {error}"))?;
        }
        if seconds > MOST_SECONDS || begin.elapsed().as_secs_f64() > 6.0 * MOST_SECONDS {
            child.kill().map_err(|error| error.to_string())?;
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    // Not settled, or stopped: as asked for.
    if matches!(status.code(), Some(0 | 3 | 130)) {
        return Ok(seconds);
    }
    let said = fs::read_to_string(&errors).unwrap_or_default();
    Err(format!("a scene ended with {status}: {said}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(memory: [f64; 2], whole: [f64; 2]) -> Row {
        let pair = |[said, took]: [f64; 2]| Pair { said, took };
        Row {
            job: family::jobs().swap_remove(0),
            particles: 1.0,
            memory: pair(memory.map(|mebibytes| mebibytes * MEBIBYTE)),
            evaluation: None,
            whole: Some(pair(whole)),
        }
    }

    #[test]
    fn what_is_far_off_is_a_fault() {
        assert!(row([100.0, 100.0], [5.0, 5.0]).faults().is_empty());
        assert_eq!(row([60.0, 100.0], [5.0, 5.0]).faults().len(), 1);
        assert_eq!(row([140.0, 100.0], [5.0, 5.0]).faults().len(), 1);
        assert_eq!(row([100.0, 100.0], [5.0, 11.0]).faults().len(), 1);
        // Little memory, little time.
        assert!(row([20.0, 60.0], [0.1, 0.9]).faults().is_empty());
    }
}
