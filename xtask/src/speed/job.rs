//! The whole job, from the start of the process to its files, in the release profile.

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use serde::{Deserialize, Serialize};
use sphpack::Scene;

use crate::bench::Bench;
use crate::workspace::root;

/// What one run took and gave.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Run {
    /// From the start of the process to its end.
    pub(super) seconds: f64,
    /// Those of them for reading, distances, insets and samples.
    pub(super) geometry_seconds: f64,
    pub(super) peak_memory_bytes: f64,
    pub(super) particles: f64,
    pub(super) solid: f64,
    pub(super) evaluations: f64,
    pub(super) linf: f64,
}

/// Builds the command as its users have it.
pub(super) fn build() -> Result<(), String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .args(["build", "--quiet", "--release", "-p", "sphpack"])
        .current_dir(root())
        .status()
        .map_err(|error| format!("cargo: {error}"))?;
    if status.success() {
        Ok(())
    } else {
        Err("the release build failed".to_owned())
    }
}

/// Packs a scene in a process of its own, to a VTU file, on two threads; of `repeats` the quickest.
pub(super) fn run(scene: &Scene, repeats: usize, bench: &Bench) -> Result<Run, String> {
    let text = toml::to_string(scene).map_err(|error| error.to_string())?;
    bench.once(&format!("{repeats} × {text}"), || {
        timed(scene, &text, repeats)
    })
}

fn timed(scene: &Scene, text: &str, repeats: usize) -> Result<Run, String> {
    let folder = root().join("target/speed");
    let at = |error: std::io::Error| format!("{}: {error}", folder.display());
    fs::create_dir_all(&folder).map_err(at)?;
    let path = |ending: &str| -> PathBuf { folder.join(format!("{}.{ending}", scene.name)) };
    fs::write(path("toml"), text).map_err(at)?;
    let program = root()
        .join("target/release/sphpack")
        .with_extension(std::env::consts::EXE_EXTENSION);
    let mut best: Option<Run> = None;
    for _ in 0..repeats {
        let start = Instant::now();
        let status = Command::new(&program)
            .args(["pack", "--quiet", "--force", "--threads", "2"])
            .arg(path("toml"))
            .arg("-o")
            .arg(path("vtu"))
            .arg("--report")
            .arg(path("json"))
            .status()
            .map_err(|error| format!("{}: {error}", program.display()))?;
        let seconds = start.elapsed().as_secs_f64();
        if !status.success() {
            return Err(format!("{} ended with {status}", path("toml").display()));
        }
        let found = read(&path("json"), seconds)?;
        if best.is_none_or(|best| seconds < best.seconds) {
            best = Some(found);
        }
    }
    // Large runs leave gigabytes.
    fs::remove_file(path("vtu")).map_err(at)?;
    best.ok_or_else(|| "nothing was run".to_owned())
}

fn read(path: &std::path::Path, seconds: f64) -> Result<Run, String> {
    let said = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let text = fs::read_to_string(path).map_err(|error| said(&error))?;
    let report: serde_json::Value = serde_json::from_str(&text).map_err(|error| said(&error))?;
    let number = |pointer: &str| {
        report
            .pointer(pointer)
            .and_then(serde_json::Value::as_f64)
            .ok_or_else(|| said(&format!("no number at {pointer}")))
    };
    Ok(Run {
        seconds,
        geometry_seconds: number("/seconds/geometry")?,
        peak_memory_bytes: number("/peak_memory_bytes")?,
        particles: number("/particles/total")?,
        solid: number("/particles/solid")?,
        evaluations: number("/force_evaluations")?,
        linf: number("/density/linf")?,
    })
}
