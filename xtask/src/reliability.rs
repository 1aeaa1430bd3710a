//! All that docs/reliability.md says, measured anew: the long forms of what every change must pass in short.

use crate::scene_fuzz::{self, estimates, faults, files, kills};

/// Random scenes, and the seed of the page.
const SCENES: usize = 5000;
const SEED: u64 = 1;

const KILLS: usize = 200;
const FAULTS: usize = 500;
const SCENE_FILES: usize = 100_000;

/// Runs them all, one after the other, for they are judged by time too; each writes its table. What fails does not keep
/// the others from running.
pub(crate) fn run() -> Result<(), String> {
    let scenes = scene_fuzz::Settings {
        seed: SEED,
        write: true,
        ..scene_fuzz::Settings::new(SCENES)
    };
    let kills = kills::Settings {
        write: true,
        ..kills::Settings::new(KILLS)
    };
    let faults = faults::Settings {
        write: true,
        ..faults::Settings::new(FAULTS)
    };
    let files = files::Settings {
        write: true,
        ..files::Settings::new(SCENE_FILES)
    };
    let estimates = estimates::Settings {
        write: true,
        ..estimates::Settings::default()
    };
    let failed: Vec<String> = [
        scene_fuzz::run(&scenes),
        kills::run(&kills),
        faults::run(&faults),
        files::run(&files),
        estimates::run(&estimates),
    ]
    .into_iter()
    .filter_map(Result::err)
    .collect();
    if failed.is_empty() {
        Ok(())
    } else {
        Err(failed.join("\n"))
    }
}
