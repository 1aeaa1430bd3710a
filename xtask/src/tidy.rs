//! House rules that no compiler knows.

use std::fs;
use std::path::{Path, PathBuf};

mod rings;

/// Which of our crates each crate may depend on. One direction only: see ARCHITECTURE.md.
const GRAPH: [(&str, &[&str]); 10] = [
    ("kernels", &[]),
    ("neighbors", &[]),
    ("pairs", &["kernels", "neighbors"]),
    ("geometry", &["neighbors"]),
    ("packing", &["kernels", "neighbors", "pairs", "geometry"]),
    ("separation", &["geometry", "neighbors"]),
    ("flow", &["kernels", "neighbors", "pairs"]),
    (
        "cli",
        &[
            "kernels",
            "neighbors",
            "pairs",
            "geometry",
            "packing",
            "separation",
        ],
    ),
    ("python", &["cli"]),
    (
        "xtask",
        &[
            "kernels",
            "neighbors",
            "pairs",
            "geometry",
            "packing",
            "separation",
            "flow",
            "cli",
        ],
    ),
];

/// A file longer than this holds two ideas.
const MOST_LINES: usize = 500;

/// Files that every project has.
const REQUIRED: [&str; 15] = [
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "LICENSE-MIT",
    "LICENSE-APACHE",
    "Cargo.lock",
    ".ci/run",
    "scenes/README.md",
    "docs/reproduction.md",
    "docs/balanced.md",
    "docs/methods.md",
    "docs/lattices.md",
    "docs/speed.md",
    "docs/pair-loop.md",
];

/// Checks the workspace at `root`.
pub(crate) fn run(root: &Path) -> Result<(), String> {
    let complaints = complaints(root);
    if complaints.is_empty() {
        eprintln!("tidy");
        Ok(())
    } else {
        Err(complaints.join("\n"))
    }
}

fn complaints(root: &Path) -> Vec<String> {
    let mut complaints = Vec::new();
    for name in REQUIRED {
        if !root.join(name).is_file() {
            complaints.push(format!("{name} is missing"));
        }
    }
    for (name, allowed) in GRAPH {
        match fs::read_to_string(root.join(name).join("Cargo.toml")) {
            Ok(text) => check_manifest(name, &text, allowed, &mut complaints),
            Err(error) => complaints.push(format!("{name}/Cargo.toml: {error}")),
        }
        let mut files = Vec::new();
        for path in sources(&root.join(name)) {
            match fs::read_to_string(&path) {
                Ok(text) => {
                    if let Ok(within) = path.strip_prefix(root.join(name).join("src")) {
                        files.push((within.display().to_string(), text.clone()));
                    }
                    let shown = path
                        .strip_prefix(root)
                        .unwrap_or(&path)
                        .display()
                        .to_string();
                    check_source(&shown, &text, &mut complaints);
                    check_single_places(&shown, &text, &mut complaints);
                }
                Err(error) => complaints.push(format!("{}: {error}", path.display())),
            }
        }
        for ring in rings::rings(&files) {
            complaints.push(format!(
                "{name}: files import each other in a ring: {}",
                ring.join(", ")
            ));
        }
    }
    complaints
}

fn check_manifest(name: &str, text: &str, allowed: &[&str], complaints: &mut Vec<String>) {
    let manifest: toml::Table = match text.parse() {
        Ok(manifest) => manifest,
        Err(error) => {
            complaints.push(format!("{name}/Cargo.toml: {error}"));
            return;
        }
    };
    let dependencies = manifest.get("dependencies").and_then(toml::Value::as_table);
    for package in dependencies.into_iter().flat_map(|table| table.keys()) {
        let ours = match package.as_str() {
            "sphpack" => "cli",
            other => other.strip_prefix("sphpack-").unwrap_or_default(),
        };
        if !ours.is_empty() && !allowed.contains(&ours) {
            complaints.push(format!(
                "{name} must not depend on {ours}: see ARCHITECTURE.md"
            ));
        }
    }
    let lints = manifest
        .get("lints")
        .and_then(|lints| lints.get("workspace"));
    if lints.and_then(toml::Value::as_bool) != Some(true) {
        complaints.push(format!("{name}/Cargo.toml lacks lints.workspace = true"));
    }
}

fn check_source(path: &str, text: &str, complaints: &mut Vec<String>) {
    let lines = text.lines().count();
    if lines > MOST_LINES {
        complaints.push(format!(
            "{path} has {lines} lines, more than {MOST_LINES}: split it"
        ));
    }
    let stem = Path::new(path)
        .file_stem()
        .and_then(|stem| stem.to_str())
        .unwrap_or_default();
    if ["utils", "util", "common", "helpers", "misc"].contains(&stem) {
        complaints.push(format!("{path}: name the module for what it holds"));
    }
    if !text.trim_start().starts_with("//!") {
        complaints.push(format!(
            "{path} does not begin by saying what it holds (//!)"
        ));
    }
    // Spelt in two parts, so that this file does not find itself.
    for (first, second, cure) in [
        ("FIX", "ME", "file an issue"),
        ("#[ign", "ore]", "mend the test or delete it"),
        (
            ".par_iter().s",
            "um::<f64>",
            "sum over blocks of fixed size",
        ),
    ] {
        if text.contains(&format!("{first}{second}")) {
            complaints.push(format!("{path} has {first}{second}: {cure}"));
        }
    }
}

/// What ARCHITECTURE.md promises to be in one place.
fn check_single_places(path: &str, text: &str, complaints: &mut Vec<String>) {
    // Spelt in two parts, so that this file does not find itself.
    let kernels = format!("value_and_slope::{}", '<');
    let may = path.starts_with("kernels/") || path == "pairs/src/walk.rs";
    if text.contains(&kernels) && !may {
        complaints.push(format!(
            "{path} takes kernels to pairs: that is pairs/src/walk.rs, and a term for it"
        ));
    }
    let parts = |line: &str| line.contains("2 =>") && line.contains("::<2>");
    if path.starts_with("cli/src/") && text.lines().any(parts) {
        complaints.push(format!(
            "{path} tells the plane from space: that is in_dimension! in cli/src/dimension.rs"
        ));
    }
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        let Ok(entries) = fs::read_dir(&folder) else {
            continue;
        };
        for path in entries.flatten().map(|entry| entry.path()) {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_workspace_is_tidy() {
        assert_eq!(complaints(&crate::workspace::root()), Vec::<String>::new());
    }

    #[test]
    fn offences_are_found() {
        let mut found = Vec::new();
        check_manifest(
            "kernels",
            "[dependencies]\nsphpack-packing = \"1\"",
            &[],
            &mut found,
        );
        assert_eq!(found.len(), 2, "{found:?}");
        found.clear();
        check_source("a/utils.rs", &"x\n".repeat(501), &mut found);
        assert_eq!(found.len(), 3, "{found:?}");
        found.clear();
        let kernels = format!("P::value_and_slope::{}f64, 0>(r, 1.0)", '<');
        check_single_places("packing/src/forces.rs", &kernels, &mut found);
        check_single_places("pairs/src/walk.rs", &kernels, &mut found);
        check_single_places(
            "cli/src/plan.rs",
            "    2 => planned::<2>(scene),",
            &mut found,
        );
        assert_eq!(found.len(), 2, "{found:?}");
    }
}
