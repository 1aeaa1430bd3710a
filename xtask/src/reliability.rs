//! All that docs/reliability.md says, measured anew: the long forms of what every change must pass in short.

use crate::scene_fuzz::{self, estimates, faults, files, kills};

/// Runs them all, one after the other, for they are judged by time too; each writes its table. What fails does not keep
/// the others from running.
pub(crate) fn run() -> Result<(), String> {
    let scenes = scene_fuzz::Settings {
        seed: 1,
        write: true,
        ..scene_fuzz::Settings::new(5000)
    };
    let kills = kills::Settings {
        write: true,
        ..kills::Settings::new(200)
    };
    let faults = faults::Settings {
        write: true,
        ..faults::Settings::new(500)
    };
    let files = files::Settings {
        write: true,
        ..files::Settings::new(100_000)
    };
    let estimates = estimates::Settings {
        write: true,
        ..estimates::Settings::default()
    };
    let runs: [Result<(), String>; 5] = [
        scene_fuzz::run(&scenes),
        kills::run(&kills),
        faults::run(&faults),
        files::run(&files),
        estimates::run(&estimates),
    ];
    let failed: Vec<String> = runs.into_iter().filter_map(Result::err).collect();
    if failed.is_empty() {
        Ok(())
    } else {
        Err(failed.join("\n"))
    }
}
