//! Kinds of random bodies, each body packed once and judged by its own formula.

use std::fmt::Write as _;
use std::path::Path;

use sphpack::{Options, Scene, run as pack};
use sphpack_packing::Silent;

use super::drawn::Drawn;
use super::row::{CLOSEST, LINF, Row};
use super::{boxes, contacts, giants, thin, turned};

/// Bodies of one kind.
#[derive(Clone, Copy)]
pub(super) struct DrawnKind {
    pub(super) name: &'static str,
    count: usize,
    /// In the short form: those in space take seconds each.
    quick: usize,
    /// By number, the same ones for everybody.
    draw: fn(u64) -> Box<dyn Drawn>,
}

/// All of them.
pub(super) const KINDS: [DrawnKind; 6] = [
    DrawnKind {
        name: "walls",
        count: 200,
        quick: 6,
        draw: boxes::wall,
    },
    DrawnKind {
        name: "periodic cells",
        count: 300,
        quick: 6,
        draw: boxes::cell,
    },
    DrawnKind {
        name: "thin",
        count: 200,
        quick: 6,
        draw: thin::draw,
    },
    DrawnKind {
        name: "contacts",
        count: 120,
        quick: 4,
        draw: contacts::draw,
    },
    DrawnKind {
        name: "turned parts",
        count: 60,
        quick: 2,
        draw: turned::draw,
    },
    DrawnKind {
        name: "giants",
        count: 200,
        quick: 6,
        draw: giants::draw,
    },
];

/// Packs and judges bodies of a kind.
pub(super) fn row(kind: DrawnKind, folder: &Path, is_quick: bool) -> Result<Row, String> {
    let mut row = Row::new(kind.name);
    let count = if is_quick { kind.quick } else { kind.count };
    for number in 0..count as u64 {
        judge((kind.draw)(number).as_ref(), number, folder, &mut row)?;
    }
    Ok(row)
}

fn judge(drawn: &dyn Drawn, number: u64, folder: &Path, row: &mut Row) -> Result<(), String> {
    row.scenes += 1;
    let text = drawn.text(folder, number)?;
    let path = folder.join(format!("{}-{number}.toml", row.name.replace(' ', "-")));
    std::fs::write(&path, &text).map_err(|error| format!("{}: {error}", path.display()))?;
    let scene = Scene::parse(&text, &path).map_err(|error| error.to_string())?;
    let outcome = match pack(&scene, &Options::default(), &mut Silent) {
        Ok(outcome) => outcome,
        Err(error) => {
            row.refused += 1;
            eprintln!("{} {number}: refused: {error}", row.name);
            return Ok(());
        }
    };
    let report = &outcome.report;
    if !(report.converged && report.audit.passed) {
        row.said += 1;
        eprintln!(
            "{} {number}: {}: {:?}",
            row.name, report.stop_reason, report.audit.messages
        );
        return Ok(());
    }
    let faults = drawn.faults(&outcome);
    let closest = report.closest_pair_over_spacing;
    let is_even = report.density.linf <= LINF && closest >= CLOSEST;
    row.right += usize::from(faults.is_empty());
    row.even += usize::from(is_even);
    if !is_even {
        eprintln!(
            "{} {number}: L∞ {:.2e}, closest pair {closest:.3}",
            row.name, report.density.linf
        );
    }
    row.worst[1] = row.worst[1].max(report.density.linf);
    row.worst[2] = row.worst[2].min(closest);
    if !faults.is_empty() {
        let mut words = format!("{} {number}:", row.name);
        for fault in faults {
            let _ = write!(words, " {fault};");
        }
        row.wrong.push(words);
    }
    Ok(())
}
