//! The Python package, built and tested where there is a Python; where there is none, that is said.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::arguments::Arguments;
use crate::environment::{environment, program_of, said};
use crate::workspace::root;

/// The oldest Python that the package is for.
const OLDEST: &str = "(3, 10)";

/// What the tests need beside the package.
const NEEDED: [&str; 2] = ["numpy>=1.23", "pytest>=7"];

/// What builds wheels.
const MATURIN: &str = "maturin>=1.9,<2";

/// How it is built and tried.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Settings {
    /// As users get it: a wheel, installed into an environment of its own, its command tried too.
    wheel: bool,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--wheel"];

    pub(crate) fn of(arguments: &Arguments) -> Self {
        Self {
            wheel: arguments.has("--wheel"),
        }
    }

    /// What a change must pass.
    pub(crate) fn quick() -> Self {
        Self::default()
    }
}

/// The package as [`run`] has left it.
#[derive(Debug)]
pub(crate) struct Built {
    /// An interpreter that has what it needs.
    pub(crate) python: PathBuf,
    /// The folder that it is imported from.
    pub(crate) site: PathBuf,
}

/// The package, where it is built.
pub(crate) fn built() -> Option<Built> {
    let home = home();
    let built = Built {
        python: program_of(&home.join("environment")),
        site: home.join("site"),
    };
    (built.python.is_file() && built.site.join("sphpack").is_dir()).then_some(built)
}

fn home() -> PathBuf {
    root().join("target/python")
}

/// Builds the package and runs its tests.
pub(crate) fn run(settings: Settings) -> Result<(), String> {
    let Some(python) = python() else {
        eprintln!("── there is no Python from 3.10 on: left out");
        return Ok(());
    };
    let home = home();
    let Some(python) = environment(&python, &home.join("environment"), &NEEDED)? else {
        return Ok(());
    };
    if settings.wheel {
        return wheel(&python, &home);
    }
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let built = [
        "build",
        "--package",
        "sphpack-python",
        "--features",
        "extension-module",
    ];
    said(Command::new(program).args(built).current_dir(root()))?;
    let site = home.join("site");
    let package = site.join("sphpack");
    copy(&root().join("python/sphpack"), &package)?;
    let (from, to) = library()?;
    fs::copy(&from, package.join(to)).map_err(|error| format!("{}: {error}", from.display()))?;
    test(&python, Some(&site))
}

/// A Python that is new enough.
fn python() -> Option<PathBuf> {
    let names = std::env::var_os("PYTHON").map_or_else(
        || vec!["python3".into(), "python".into()],
        |name| vec![PathBuf::from(name)],
    );
    let asked = format!("import sys; sys.exit(sys.version_info < {OLDEST})");
    names.into_iter().find(|name| {
        let answer = Command::new(name).args(["-c", &asked]).output();
        answer.is_ok_and(|answer| answer.status.success())
    })
}

/// The library that cargo has built, beside this program, and its name as a module.
fn library() -> Result<(PathBuf, &'static str), String> {
    let own = std::env::current_exe().map_err(|error| format!("this program: {error}"))?;
    let (name, module) = if cfg!(windows) {
        ("sphpack_native.dll", "_native.pyd")
    } else if cfg!(target_os = "macos") {
        ("libsphpack_native.dylib", "_native.abi3.so")
    } else {
        ("libsphpack_native.so", "_native.abi3.so")
    };
    Ok((own.with_file_name(name), module))
}

/// Copies a folder's files of Python, one folder deep.
fn copy(from: &Path, to: &Path) -> Result<(), String> {
    let fail = |error: std::io::Error| format!("{}: {error}", from.display());
    let _ = fs::remove_dir_all(to);
    fs::create_dir_all(to).map_err(fail)?;
    for entry in fs::read_dir(from).map_err(fail)?.flatten() {
        let is_ours = (entry.path().extension())
            .is_some_and(|ending| ["py", "pyi", "typed"].iter().any(|known| ending == *known));
        if is_ours {
            fs::copy(entry.path(), to.join(entry.file_name())).map_err(fail)?;
        }
    }
    Ok(())
}

/// Runs the tests, with the package in a folder or as it is installed.
fn test(python: &Path, site: Option<&Path>) -> Result<(), String> {
    let mut command = Command::new(python);
    command
        .args([
            "-m",
            "pytest",
            "--quiet",
            "-p",
            "no:cacheprovider",
            "python/tests",
        ])
        .current_dir(root())
        .env("PYTHONDONTWRITEBYTECODE", "1");
    if let Some(site) = site {
        command.env("PYTHONPATH", site);
    }
    said(&mut command)
}

/// The wheel as users get it.
fn wheel(python: &Path, home: &Path) -> Result<(), String> {
    if environment(python, &home.join("environment"), &[MATURIN])?.is_none() {
        return Ok(());
    }
    let wheels = home.join("wheels");
    let _ = fs::remove_dir_all(&wheels);
    let build = [
        "-m",
        "maturin",
        "build",
        "--release",
        "--manifest-path",
        "python/Cargo.toml",
        "--out",
    ];
    said(
        Command::new(python)
            .args(build)
            .arg(&wheels)
            .current_dir(root()),
    )?;
    let found = fs::read_dir(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
    let wheel = (found.flatten().map(|entry| entry.path()))
        .find(|path| path.extension().is_some_and(|ending| ending == "whl"))
        .ok_or_else(|| format!("{}: there is no wheel", wheels.display()))?;
    let clean = home.join("installed");
    let _ = fs::remove_dir_all(&clean);
    let name = wheel.display().to_string();
    let Some(own) = environment(python, &clean, &[&name, NEEDED[1]])? else {
        return Ok(());
    };
    test(&own, None)?;
    said(Command::new(own.with_file_name("sphpack")).arg("--version"))?;
    let bytes = fs::metadata(&wheel).map_or(0, |meta| meta.len());
    eprintln!("── {name}, {:.1} MiB", bytes as f64 / 1_048_576.0);
    Ok(())
}
