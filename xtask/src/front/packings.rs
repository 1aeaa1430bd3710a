//! The packings of the chart: each measured once, and kept until the code that packs or measures changes.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sphpack::Scene;

use super::figures::Ended;
use crate::kept::Kept;
use crate::scene_fuzz::processor_seconds;

/// Processor time that one packing may take. Not wall-clock time: what else the machine does must not decide what the chart shows.
const MOST_SECONDS: f64 = 120.0;

/// What a packing's figures depend on, beside what packs.
const OWN: [&str; 4] = [
    "xtask/src/front/figures.rs",
    "xtask/src/front/judges.rs",
    "xtask/src/front/one.rs",
    "xtask/src/front/pairs.rs",
];

/// Measured packings in a folder, each with its scene.
pub(super) struct Packings {
    kept: Kept,
}

impl Packings {
    pub(super) fn open(folder: &Path) -> Result<Self, String> {
        Kept::open(folder, &OWN).map(|kept| Self { kept })
    }

    /// What a scene's packing came to, if it is known.
    pub(super) fn known(&self, scene: &Scene) -> Option<Ended> {
        self.kept.known(&text(scene).ok()?)
    }

    /// What a scene's packing comes to; packs where that is not known.
    pub(super) fn measured(&self, scene: &Scene) -> Result<Ended, String> {
        if let Some(known) = self.known(scene) {
            return Ok(known);
        }
        let text = text(scene)?;
        let [file, result] = ["toml", "json"].map(|ending| self.kept.path(&text, ending));
        fs::write(&file, &text).map_err(|error| format!("{}: {error}", file.display()))?;
        if run(&file, &result)? {
            return (self.known(scene)).ok_or_else(|| format!("{} is damaged", result.display()));
        }
        let ended = Ended::LeftOut(format!(
            "it takes more than {MOST_SECONDS} s of processor time"
        ));
        self.kept.keep(&text, &ended)?;
        Ok(ended)
    }
}

fn text(scene: &Scene) -> Result<String, String> {
    toml::to_string(scene).map_err(|error| error.to_string())
}

/// Packs a scene's file in a process of its own; whether that ended in time.
fn run(file: &Path, result: &Path) -> Result<bool, String> {
    let own = std::env::current_exe().map_err(|error| format!("this program: {error}"))?;
    let mut child = Command::new(own)
        .args(["chart", "--one"])
        .arg(file)
        .stdin(Stdio::null())
        .spawn()
        .map_err(|error| format!("this program cannot be started: {error}"))?;
    let process = Path::new("/proc").join(child.id().to_string());
    let begin = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            return if status.success() && result.is_file() {
                Ok(true)
            } else {
                Err(format!("{} ended with {status}", file.display()))
            };
        }
        // Where the system does not tell processor time, patience ends all the same.
        let is_late = processor_seconds(&process) > MOST_SECONDS
            || begin.elapsed().as_secs_f64() > 6.0 * MOST_SECONDS;
        if is_late {
            child.kill().map_err(|error| error.to_string())?;
            child.wait().map_err(|error| error.to_string())?;
            return Ok(false);
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(20));
    }
}
