//! The command run on a scene, watched from outside.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use super::case::Case;
use super::rows::{self, Row};

/// Processor time of a dry run.
const DRY_SECONDS: f64 = 10.0;

/// Processor time of the default method, on scenes of this size.
const DEFAULT_SECONDS: f64 = 20.0;

/// Of the other methods, at least.
const LEAST_SECONDS: f64 = 5.0;

/// The estimate of a dry run is right to about this factor.
const OVER_ESTIMATE: f64 = 3.0;

/// Clock ticks of `/proc` in a second, on every Linux.
const TICKS: f64 = 100.0;

/// How a process ended.
#[derive(Debug, Clone, Default)]
pub(super) struct Ending {
    /// `None`: by a signal.
    pub(super) code: Option<i32>,
    /// Of processor time.
    pub(super) seconds: f64,
    pub(super) bytes: u64,
    /// Killed here, for time or memory.
    pub(super) was_killed: bool,
    pub(super) output: String,
    pub(super) errors: String,
}

/// What came of a scene.
#[derive(Debug, Clone, Default)]
pub(super) struct Trial {
    pub(super) dry: Ending,
    pub(super) pack: Ending,
    /// What it was allowed.
    pub(super) limit_seconds: f64,
    /// Names of files that it left.
    pub(super) left: Vec<String>,
    pub(super) rows: Option<Result<Vec<Row>, String>>,
    pub(super) report: Option<Value>,
}

/// The most memory that a scene may take.
pub(super) const MOST_BYTES: u64 = 1 << 30;

/// Writes a scene that is placed, and its files, into a folder.
pub(super) fn write(case: &Case, folder: &Path, name: &str) -> Result<(), String> {
    let put = |path: PathBuf, bytes: &[u8]| {
        fs::write(&path, bytes).map_err(|error| format!("{}: {error}", path.display()))
    };
    for (k, body) in case.bodies.iter().enumerate() {
        if let (Some(bytes), Some(ending)) = (body.shape.file(), body.shape.ending()) {
            put(
                folder.join(format!("{}.{ending}", case.file_name(k))),
                &bytes,
            )?;
        }
    }
    put(folder.join(name), case.toml().as_bytes())
}

/// Runs a scene that is placed in a folder of its own.
pub(super) fn run(case: &Case, program: &Path, folder: &Path) -> Result<Trial, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(failed)?;
    }
    fs::create_dir_all(folder).map_err(failed)?;
    write(case, folder, "scene.toml")?;
    let common = ["pack", "scene.toml", "--threads", "1"];
    let dry = watched(
        Command::new(program).args(common).arg("--dry-run"),
        folder,
        DRY_SECONDS,
    )?;
    let limit_seconds = match case.method() {
        "balanced" => DEFAULT_SECONDS,
        _ => (OVER_ESTIMATE * estimate(&dry.output).unwrap_or(0.0)).max(LEAST_SECONDS),
    };
    let outputs = ["-o", "out.csv", "--report", "out.json", "--force"];
    let pack = watched(
        Command::new(program).args(common).args(outputs),
        folder,
        limit_seconds,
    )?;
    let text = |name: &str| fs::read_to_string(folder.join(name)).ok();
    let left = ["out.csv", "out.json", "scene.vtu"]
        .into_iter()
        .filter(|name| folder.join(name).exists())
        .map(str::to_owned)
        .collect();
    Ok(Trial {
        dry,
        pack,
        limit_seconds,
        left,
        rows: text("out.csv").map(|text| rows::read(&text)),
        report: text("out.json").and_then(|text| serde_json::from_str(&text).ok()),
    })
}

/// Runs a command, and ends it where it takes too long or too much.
fn watched(command: &mut Command, folder: &Path, most_seconds: f64) -> Result<Ending, String> {
    let [output, errors] = ["stdout.txt", "stderr.txt"].map(|name| folder.join(name));
    let create =
        |path: &PathBuf| File::create(path).map_err(|error| format!("{}: {error}", path.display()));
    let mut child = command
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(create(&output)?)
        .stderr(create(&errors)?)
        .spawn()
        .map_err(|error| format!("the command cannot be started: {error}"))?;
    let start = Instant::now();
    let mut ending = Ending::default();
    let mut pause = Duration::from_millis(1);
    let status: ExitStatus = loop {
        let process = PathBuf::from(format!("/proc/{}", child.id()));
        ending.bytes = ending.bytes.max(peak_bytes(&process));
        ending.seconds = ending.seconds.max(processor_seconds(&process));
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            break status;
        }
        // Other work on the machine may slow it down, not stop it.
        let is_late = ending.seconds > most_seconds
            || start.elapsed().as_secs_f64() > 6.0 * most_seconds + 20.0;
        if is_late || ending.bytes > MOST_BYTES {
            ending.was_killed = true;
            child.kill().map_err(|error| error.to_string())?;
            break child.wait().map_err(|error| error.to_string())?;
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(10));
    };
    ending.code = status.code();
    let text = |path: &PathBuf| {
        fs::read(path).map_or(String::new(), |bytes| {
            String::from_utf8_lossy(&bytes).into_owned()
        })
    };
    ending.output = text(&output);
    ending.errors = text(&errors);
    Ok(ending)
}

/// 0 where the system does not tell.
fn peak_bytes(process: &Path) -> u64 {
    let status = fs::read_to_string(process.join("status")).unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:"));
    let number = line.and_then(|line| line.split_whitespace().nth(1));
    number
        .and_then(|number| number.parse::<u64>().ok())
        .unwrap_or(0)
        * 1024
}

/// Processor time of a process, by its folder in /proc; 0 where the system does not tell.
pub(crate) fn processor_seconds(process: &Path) -> f64 {
    let text = fs::read_to_string(process.join("stat")).unwrap_or_default();
    // The name, in brackets, may hold anything.
    let fields: Vec<&str> = text
        .rsplit(')')
        .next()
        .unwrap_or_default()
        .split_whitespace()
        .collect();
    let ticks = |k: usize| {
        fields
            .get(k)
            .and_then(|field| field.parse::<f64>().ok())
            .unwrap_or(0.0)
    };
    (ticks(11) + ticks(12)) / TICKS
}

/// The seconds that a dry run speaks of.
fn estimate(output: &str) -> Option<f64> {
    let line = output
        .lines()
        .find(|line| line.trim_start().starts_with("time"))?;
    let mut words = line.split_whitespace().skip_while(|word| *word != "about");
    let number: f64 = words.nth(1)?.parse().ok()?;
    let unit = match words.next()? {
        "ms" => 1e-3,
        "s" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        _ => return None,
    };
    Some(number * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimates_are_read() {
        let text =
            "  memory     about 0.01 GiB of 3 GiB\n  time       about 45 ms for 80 evaluations";
        assert_eq!(estimate(text), Some(0.045));
        assert_eq!(estimate("  time  about 2 min for"), Some(120.0));
        assert_eq!(estimate("nothing"), None);
    }
}
