//! Everything that a change must pass, in the order of what fails soonest.

use std::process::Command;
use std::time::Instant;

use crate::scene_fuzz::{self, faults, files, kills};
use crate::selection::Selection;
use crate::workspace::root;
use crate::{balanced, bodies, reproduce, tidy};

/// Random scenes, the same ones each time; `cargo xtask fuzz --scenes 5000` is the long form.
const RANDOM_SCENES: usize = 50;

/// Runs of random scenes that are killed; `cargo xtask kills` does 200.
const KILLS: usize = 20;

/// Runs under faults, twice each; `cargo xtask faults` does 500.
const FAULTS: usize = 48;

/// Damaged scene files; `cargo xtask fuzz --scene-files 100000` is the long form.
const SCENE_FILES: usize = 1000;

/// Runs every check; the first that fails ends it.
pub(crate) fn run() -> Result<(), String> {
    tidy::run(&root())?;
    cargo(&["fmt", "--all", "--check"], &[])?;
    cargo(
        &[
            "clippy",
            "--workspace",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ],
        &[],
    )?;
    cargo(
        &["doc", "--workspace", "--no-deps"],
        &[("RUSTDOCFLAGS", "-D warnings")],
    )?;
    deny()?;
    // The README's test command.
    cargo(&["test", "--workspace"], &[])?;
    let quick = Selection {
        quick: true,
        ..Selection::default()
    };
    reproduce::run(&quick)?;
    balanced::run(&quick)?;
    bodies::run(&bodies::Settings::quick())?;
    scene_fuzz::run(&scene_fuzz::Settings::new(RANDOM_SCENES))?;
    kills::run(&kills::Settings::new(KILLS))?;
    faults::run(&faults::Settings::new(FAULTS))?;
    files::run(&files::Settings::new(SCENE_FILES))
}

/// Licences, versions and sources of what the project builds on, where cargo-deny is installed; advisories too where their
/// list is there.
fn deny() -> Result<(), String> {
    let is_installed = Command::new("cargo-deny").arg("--version").output();
    if !is_installed.is_ok_and(|answer| answer.status.success()) {
        eprintln!("── cargo deny is not installed: left out");
        return Ok(());
    }
    cargo(
        &["deny", "--offline", "check", "licenses", "bans", "sources"],
        &[],
    )?;
    if cargo(&["deny", "fetch", "db"], &[]).is_err() {
        eprintln!("── the list of advisories cannot be had: left out");
        return Ok(());
    }
    cargo(&["deny", "check", "advisories"], &[])
}

fn cargo(arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), String> {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let line = format!("cargo {}", arguments.join(" "));
    eprintln!("── {line}");
    let start = Instant::now();
    let status = Command::new(program)
        .args(arguments)
        .envs(environment.iter().copied())
        .current_dir(root())
        .status()
        .map_err(|error| format!("{line} cannot be started: {error}"))?;
    eprintln!("── {:.0} s", start.elapsed().as_secs_f64());
    if status.success() {
        Ok(())
    } else {
        Err(format!("{line} failed"))
    }
}
