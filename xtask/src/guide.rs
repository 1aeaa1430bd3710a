//! The guide: every command in it is run, every key and column is in it, and where mdBook is, it becomes a site.

mod chapter;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::arguments::Arguments;
use crate::environment::said;
use crate::workspace::root;
use crate::{python, scene_fuzz};

/// What to run.
#[derive(Debug, Default)]
pub(crate) struct Settings {
    program: Option<PathBuf>,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--program FILE"];

    pub(crate) fn of(arguments: &Arguments) -> Self {
        Self {
            program: arguments.path("--program"),
        }
    }
}

/// Runs what the chapters say, in their order, each in a folder of its own.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let program = match &settings.program {
        Some(program) => std::path::absolute(program).map_err(|error| error.to_string())?,
        None => scene_fuzz::build()?,
    };
    let book = root().join("docs/guide");
    let chapters = chapters(&book.join("src"))?;
    let scratch = std::env::temp_dir().join(format!("sphpack-guide-{}", std::process::id()));
    let python = python::built();
    if python.is_none() {
        eprintln!("── the Python package is not built: what is in Python is left out");
    }
    let result = chapters.iter().try_for_each(|(name, text)| {
        eprintln!("── {name}");
        let folder = scratch.join(name);
        let fail = |error: std::io::Error| format!("{}: {error}", folder.display());
        fs::create_dir_all(&folder).map_err(fail)?;
        chapter::run(text, &folder, &program, python.as_ref())
            .map_err(|message| format!("docs/guide/src/{name}: {message}"))
    });
    let result = result.and_then(|()| complete(&chapters, &program, &scratch));
    // What is left of it is of no use to anybody.
    let _ = fs::remove_dir_all(&scratch);
    result?;
    site(&book)
}

/// The chapters' names and texts, as the summary lists them.
fn chapters(source: &Path) -> Result<Vec<(String, String)>, String> {
    let read = |name: &str| {
        let path = source.join(name);
        fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let listed = chapter::links(&read("SUMMARY.md")?);
    let fail = |error: std::io::Error| format!("{}: {error}", source.display());
    let there: BTreeSet<String> = (fs::read_dir(source).map_err(fail)?.flatten())
        .filter_map(|entry| entry.file_name().into_string().ok())
        .filter(|name| name.ends_with(".md") && name != "SUMMARY.md")
        .collect();
    if there != listed.iter().cloned().collect() {
        return Err(format!(
            "docs/guide/src/SUMMARY.md lists {listed:?}, and there are {there:?}"
        ));
    }
    let all: Vec<(String, String)> = (listed.into_iter())
        .map(|name| read(&name).map(|text| (name, text)))
        .collect::<Result<_, _>>()?;
    for (name, text) in &all {
        for link in chapter::links(text) {
            if !link.contains("://") && !there.contains(&link) {
                return Err(format!("docs/guide/src/{name}: {link} is not there"));
            }
        }
    }
    Ok(all)
}

/// Every key of a scene, every column and every figure must be told.
fn complete(chapters: &[(String, String)], program: &Path, folder: &Path) -> Result<(), String> {
    let text = |name: &str| {
        (chapters.iter().find(|chapter| chapter.0 == name)).map_or("", |(_, text)| text)
    };
    let answer = |words: &[&str]| {
        let answer = Command::new(program)
            .args(words)
            .current_dir(folder)
            .output()
            .map_err(|error| format!("{}: {error}", program.display()))?;
        let said = String::from_utf8_lossy(&answer.stdout).into_owned();
        answer
            .status
            .success()
            .then_some(said)
            .ok_or_else(|| format!("sphpack {} failed", words.join(" ")))
    };
    let keys = chapter::keys(&answer(&["init"])?);
    if keys.len() < 40 {
        return Err(format!("sphpack init has only the keys {keys:?}"));
    }
    told(text("keys.md"), "key", keys.iter().map(String::as_str))?;
    let body = folder.join("complete.csv");
    fs::write(&body, "0,0\n1,0\n1,1\n0,1\n").map_err(|error| error.to_string())?;
    answer(&[
        "pack",
        "complete.csv",
        "--spacing",
        "0.1",
        "-o",
        "out.csv",
        "--report",
        "out.json",
        "-q",
    ])?;
    let read = |name: &str| {
        let path = folder.join(name);
        fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let table = read("out.csv")?;
    let header = table.lines().next().unwrap_or_default();
    told(text("columns.md"), "column", header.split(','))?;
    let report: serde_json::Value =
        serde_json::from_str(&read("out.json")?).map_err(|error| error.to_string())?;
    let figures = report.as_object().ok_or("the report is no table")?;
    told(
        text("columns.md"),
        "figure",
        figures.keys().map(String::as_str),
    )
}

/// Refuses a page that lacks one of them.
fn told<'a>(page: &str, what: &str, names: impl Iterator<Item = &'a str>) -> Result<(), String> {
    let lacking: Vec<&str> = names
        .filter(|name| !page.contains(&format!("`{name}`")))
        .collect();
    if lacking.is_empty() {
        return Ok(());
    }
    Err(format!(
        "the guide does not tell of the {what} {}",
        lacking.join(", ")
    ))
}

/// As a site, where mdBook is.
fn site(book: &Path) -> Result<(), String> {
    let is_there = Command::new("mdbook").arg("--version").output();
    if !is_there.is_ok_and(|answer| answer.status.success()) {
        eprintln!("── mdBook is not installed: the site is left out");
        return Ok(());
    }
    said(Command::new("mdbook").arg("build").arg(book))
}
