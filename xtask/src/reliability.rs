//! All that docs/reliability.md says, measured anew: the long forms of what every change must pass in short.

use crate::scene_fuzz::{self, estimates, faults, files, kills};

/// Runs them all, one after the other, for they are judged by time too; each writes its table. What fails does not keep
/// the others from running.
pub(crate) fn run() -> Result<(), String> {
    let words =
        |line: &str| -> Vec<String> { line.split_whitespace().map(str::to_owned).collect() };
    let scenes = words("--scenes 5000 --seed 1 --write");
    let runs: [Result<(), String>; 5] = [
        scene_fuzz::Settings::parse(&scenes).and_then(|s| scene_fuzz::run(&s)),
        kills::Settings::parse(&words("--runs 200 --write")).and_then(|s| kills::run(&s)),
        faults::Settings::parse(&words("--runs 500 --write")).and_then(|s| faults::run(&s)),
        files::Settings::parse(&words("--scene-files 100000 --write")).and_then(|s| files::run(&s)),
        estimates::Settings::parse(&words("--write")).and_then(|s| estimates::run(&s)),
    ];
    let failed: Vec<String> = runs.into_iter().filter_map(Result::err).collect();
    if failed.is_empty() {
        Ok(())
    } else {
        Err(failed.join("\n"))
    }
}
