//! Property tests on new cases: the suites draw the same ones every time, so that a change is judged by what it changes.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use crate::arguments::Arguments;
use crate::workspace::root;

/// How many times to draw, and from which seed on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Settings {
    rounds: u64,
    seed: u64,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--rounds N", "--seed N"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let seed = now.map_or(2, |now| now.as_secs());
        Ok(Self {
            rounds: arguments.whole("--rounds")?.unwrap_or(100),
            seed: arguments.whole("--seed")?.unwrap_or(seed),
        })
    }
}

/// Runs every property test once a seed; all rounds are run, and the seeds that found something are told.
pub(crate) fn run(settings: Settings) -> Result<(), String> {
    let mut names = Vec::new();
    collect(&root(), &mut names)?;
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut failed = Vec::new();
    for seed in (0..settings.rounds).map(|k| settings.seed.wrapping_add(k)) {
        eprintln!("── seed {seed}");
        let status = Command::new(&program)
            .args([
                "test",
                "--workspace",
                "--lib",
                "--bins",
                "--no-fail-fast",
                "--quiet",
                "--",
            ])
            .args(&names)
            .env("PROPTEST_RNG_SEED", seed.to_string())
            .current_dir(root())
            .status()
            .map_err(|error| format!("cargo test cannot be started: {error}"))?;
        if !status.success() {
            failed.push(seed.to_string());
        }
    }
    if failed.is_empty() {
        return Ok(());
    }
    Err(format!(
        "property tests fail with {}; PROPTEST_RNG_SEED=… cargo test shows one again",
        failed.join(", ")
    ))
}

/// The names of all property tests below a folder of sources.
fn collect(folder: &Path, names: &mut Vec<String>) -> Result<(), String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            if name != "target" && !name.starts_with('.') {
                collect(&path, names)?;
            }
        } else if name.ends_with(".rs") {
            let text = fs::read_to_string(&path).map_err(wrong)?;
            names.extend(property_tests(&text));
        }
    }
    Ok(())
}

/// The functions in a source's `proptest!` blocks, which end where a brace stands as far left as the block.
fn property_tests(text: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut end: Option<String> = None;
    for line in text.lines() {
        let indent = &line[..line.len() - line.trim_start().len()];
        match &end {
            None if line.trim() == "proptest! {" => end = Some(format!("{indent}}}")),
            Some(end_line) if line == end_line => end = None,
            Some(_) => {
                let name = line.trim_start().strip_prefix("fn ");
                names.extend(
                    name.and_then(|rest| rest.split('(').next())
                        .map(str::to_owned),
                );
            }
            None => {}
        }
    }
    names
}

#[cfg(test)]
mod tests {
    #[test]
    fn property_tests_are_found() {
        let text = "    fn no() {}\n    proptest! {\n        #[test]\n        fn one(a in 0..2) {\n        }\n    }\n    fn nor() {}\n";
        assert_eq!(super::property_tests(text), ["one"]);
    }
}
