//! Flows from packings: the schemes against what is known, and what a packing changes.

mod airfoil;
mod couette;
mod cylinder;
mod drop;
mod finding;
mod hull;
mod page;
mod progress;
mod run;
mod speed;
mod start;
mod stream;
mod surface;
mod tank;
mod vortices;
mod wing;

use crate::arguments::Arguments;
use finding::Findings;
use run::Runs;

/// The cases, as they are asked for.
const CASES: &str = "taylor-green|couette|cylinder|airfoil|wing|drop|tank|hull|speed";

/// What to run.
#[derive(Debug)]
pub(crate) struct Settings {
    quick: bool,
    write: bool,
    case: Option<String>,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &[CASES, "--quick", "--write"];

    /// The small forms of all cases.
    pub(crate) fn quick() -> Self {
        Self {
            quick: true,
            write: false,
            case: None,
        }
    }

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        let settings = Self {
            quick: arguments.has("--quick"),
            write: arguments.has("--write"),
            case: arguments.text(CASES),
        };
        if settings.write && (settings.case.is_some() || settings.quick) {
            return Err("--write needs every case in full: leave all else out".to_owned());
        }
        Ok(settings)
    }
}

/// Runs the cases that are asked for. What was run before by the same code is not run again. Fails where a bar is missed that
/// has no reason.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let runs = Runs::open()?;
    let mut all = Vec::new();
    let mut missed = Vec::new();
    for case in CASES.split('|') {
        // Seconds are no matter of a quick look.
        let is_asked = match &settings.case {
            Some(asked) => asked == case,
            None => !settings.quick || case != "speed",
        };
        if !is_asked {
            continue;
        }
        let found = match case {
            "taylor-green" => vortices::find(&runs, settings.quick)?,
            "couette" => couette::find(&runs, settings.quick)?,
            "cylinder" => cylinder::find(&runs, settings.quick)?,
            "airfoil" => airfoil::find(&runs, settings.quick)?,
            "wing" => wing::find(&runs, settings.quick)?,
            "drop" => drop::find(&runs, settings.quick)?,
            "tank" => tank::find(&runs, settings.quick)?,
            "hull" => hull::find(&runs, settings.quick)?,
            // Seconds are this machine's, and are not kept.
            _ => speed::find()?,
        };
        print!("{}", page::tables(&found));
        let without_reason = |row: &&finding::Row| !row.holds() && row.reason.is_empty();
        missed.extend((found.rows.iter().filter(without_reason)).map(|row| row.what.clone()));
        all.push((case, found));
    }
    if settings.write {
        page::write(&all)?;
    }
    if missed.is_empty() {
        Ok(())
    } else {
        Err(format!("missed: {}", missed.join("; ")))
    }
}

/// A case's name with what it has found.
type Found = (&'static str, Findings);
