//! Everything that a change must pass, in the order of what fails soonest.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use crate::scene_fuzz::{self, faults, files, kills, maps};
use crate::selection::Selection;
use crate::workspace::root;
use crate::{
    balanced, bodies, flow, front, guide, python, reproduction, stability, steady, tidy, variable,
    view,
};

/// Random scenes, the same ones each time; `cargo xtask fuzz --scenes 5000` is the long form.
const RANDOM_SCENES: usize = 50;

/// Runs of random scenes that are killed; `cargo xtask kills` does 200.
const KILLS: usize = 10;

/// Runs under faults, twice each; `cargo xtask faults` does 500.
const FAULTS: usize = 48;

/// Damaged scene files; `cargo xtask fuzz --scene-files 100000` is the long form.
const SCENE_FILES: usize = 1000;

/// A check and its name.
type Check = (&'static str, fn() -> Result<(), String>);

const CHECKS: [Check; 21] = [
    ("house rules", || tidy::run(&root())),
    ("format", || cargo(&["fmt", "--all", "--check"], &[])),
    ("clippy", clippy),
    ("documentation", || {
        let strict = [("RUSTDOCFLAGS", "-D warnings")];
        cargo(&["doc", "--workspace", "--no-deps"], &strict)
    }),
    ("licences", deny),
    // The README's test command.
    ("tests", || cargo(&["test", "--workspace"], &[])),
    ("examples", examples),
    ("packages", package),
    ("python", || python::run(python::Settings::quick())),
    // After the package that it uses.
    ("guide", || guide::run(&guide::Settings::default())),
    ("pages", || view::run(&view::Settings::quick())),
    ("reproduction", || {
        reproduction::run(&reproduction::Settings::quick())
    }),
    ("stability", || {
        stability::run(&stability::Settings::quick())?;
        maps::run(&maps::Settings::quick())?;
        steady::run(&steady::Settings::quick())
    }),
    ("balanced", || balanced::run(&quick())),
    ("flow", || flow::run(&flow::Settings::quick())),
    ("chart", || front::run(&front::Settings::quick())),
    ("variable", || variable::run(&quick())),
    ("bodies", || bodies::run(&bodies::Settings::quick())),
    ("random scenes", || {
        scene_fuzz::run(&scene_fuzz::Settings::new(RANDOM_SCENES))
    }),
    ("kills and faults", || {
        kills::run(&kills::Settings::new(KILLS))?;
        faults::run(&faults::Settings::new(FAULTS))
    }),
    ("damaged scenes", || {
        files::run(&files::Settings::new(SCENE_FILES))
    }),
];

/// Runs every check; the first that fails ends it. Says at the end what each has taken.
pub(crate) fn run() -> Result<(), String> {
    let mut seconds = String::new();
    for (name, check) in CHECKS {
        let start = Instant::now();
        check()?;
        // Writing to a string cannot fail.
        let _ = writeln!(seconds, "{:7.1} s  {name}", start.elapsed().as_secs_f64());
    }
    eprint!("── all checks passed\n{seconds}");
    Ok(())
}

fn quick() -> Selection {
    Selection {
        quick: true,
        ..Selection::default()
    }
}

fn clippy() -> Result<(), String> {
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
    )
}

/// What would be published is complete: every file that is included, licences too.
fn package() -> Result<(), String> {
    cargo(
        &[
            "package",
            "--workspace",
            "--exclude",
            "xtask",
            "--exclude",
            "sphpack-python",
            "--no-verify",
            "--allow-dirty",
            "--offline",
        ],
        &[],
    )
}

/// Runs every example with what it takes when asked for nothing. The tests have built them, beside this program; `cargo run`
/// would build the libraries below them anew, with the features that one crate alone asks for.
fn examples() -> Result<(), String> {
    cargo(&["build", "--workspace", "--examples"], &[])?;
    let own = std::env::current_exe().map_err(|error| format!("this program: {error}"))?;
    let built = own.with_file_name("examples");
    for room in ["kernels", "neighbors", "pairs", "geometry", "separation"] {
        for example in example_names(&root().join(room).join("examples"))? {
            eprintln!("── the example {example} of {room}");
            let program = built
                .join(&example)
                .with_extension(std::env::consts::EXE_EXTENSION);
            let said = Command::new(&program)
                .output()
                .map_err(|error| format!("{}: {error}", program.display()))?;
            if !said.status.success() {
                let words = String::from_utf8_lossy(&said.stderr);
                return Err(format!("the example {example} of {room} failed: {words}"));
            }
            if said.stdout.is_empty() {
                return Err(format!("the example {example} of {room} says nothing"));
            }
        }
    }
    Ok(())
}

/// The programs in a folder, by name.
fn example_names(folder: &Path) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut names: Vec<String> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "rs"))
        .filter_map(|path| path.file_stem()?.to_str().map(str::to_owned))
        .collect();
    names.sort_unstable();
    if names.is_empty() {
        return Err(format!("{} has no examples", folder.display()));
    }
    Ok(names)
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
