//! Python environments of the project's own, and commands that are said before they run.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The Python of an environment in a folder.
pub(crate) fn program_of(folder: &Path) -> PathBuf {
    folder.join(if cfg!(windows) {
        "Scripts/python.exe"
    } else {
        "bin/python"
    })
}

/// The Python of an environment with some packages; `None`, which is said, where they cannot be had.
pub(crate) fn environment(
    python: &Path,
    folder: &Path,
    packages: &[&str],
) -> Result<Option<PathBuf>, String> {
    let own = program_of(folder);
    if !own.exists() {
        said(Command::new(python).args(["-m", "venv"]).arg(folder))?;
    }
    let install = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
    ];
    if said(Command::new(&own).args(install).args(packages)).is_err() {
        eprintln!("── {} cannot be had: left out", packages.join(", "));
        return Ok(None);
    }
    Ok(Some(own))
}

/// Runs a command, saying which.
pub(crate) fn said(command: &mut Command) -> Result<(), String> {
    let words: Vec<_> = (command.get_args())
        .map(|word| word.to_string_lossy())
        .collect();
    let program = Path::new(command.get_program())
        .file_name()
        .unwrap_or_default();
    let line = format!("{} {}", program.to_string_lossy(), words.join(" "));
    eprintln!("── {line}");
    let status = command.status();
    let status = status.map_err(|error| format!("{line} cannot be started: {error}"))?;
    if status.success() {
        Ok(())
    } else {
        Err(format!("{line} failed"))
    }
}
