//! Random bodies, each packed once and judged by what its own formula says.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use sphpack::{Options, Outcome, Scene, run as pack};
use sphpack_packing::Silent;

use super::{CLOSEST, LINF, Row, boxes, contacts, thin, turned};

/// Bodies of each kind in the short form.
const QUICK: usize = 10;

/// A fluid particle is in a solid where it is deeper than this, in ∆s.
pub(super) const DEEP: f64 = 0.12;

/// Pairs nearer than this, in ∆s, are wrong.
pub(super) const COINCIDENT: f64 = 0.5;

/// A scene that was drawn, and its judge.
pub(super) trait Drawn {
    /// The scene; a body that is a file is written into the folder, with the number in its name.
    fn text(&self, folder: &Path, number: u64) -> Result<String, String>;

    /// What is wrong with a packing that says it is right.
    fn faults(&self, outcome: &Outcome) -> Vec<String>;
}

/// Bodies of one kind.
#[derive(Clone, Copy)]
pub(super) struct DrawnKind {
    pub(super) name: &'static str,
    pub(super) count: usize,
    /// By number, the same ones for everybody.
    draw: fn(u64) -> Box<dyn Drawn>,
}

/// All of them.
pub(super) const KINDS: [DrawnKind; 5] = [
    DrawnKind {
        name: "walls",
        count: 200,
        draw: boxes::wall,
    },
    DrawnKind {
        name: "periodic cells",
        count: 300,
        draw: boxes::cell,
    },
    DrawnKind {
        name: "thin",
        count: 200,
        draw: thin::draw,
    },
    DrawnKind {
        name: "contacts",
        count: 120,
        draw: contacts::draw,
    },
    DrawnKind {
        name: "turned parts",
        count: 60,
        draw: turned::draw,
    },
];

/// Packs and judges bodies of a kind.
pub(super) fn row(kind: DrawnKind, folder: &Path, is_quick: bool) -> Result<Row, String> {
    let mut row = Row::new(kind.name);
    let count = if is_quick { QUICK } else { kind.count };
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

/// Whether a body holds a place and all that is as far as `far` around it, in sixty directions.
pub(super) fn is_deep(
    dimension: usize,
    far: f64,
    p: [f64; 3],
    holds: impl Fn([f64; 3]) -> bool,
) -> bool {
    holds(p)
        && (0..60).all(|n| {
            let angle = TAU * f64::from(n) * 0.618_034;
            let high = if dimension == 2 {
                0.0
            } else {
                f64::from(n) / 29.5 - 1.0
            };
            let flat = (1.0 - high * high).sqrt();
            holds([
                p[0] + far * flat * angle.cos(),
                p[1] + far * flat * angle.sin(),
                p[2] + far * high,
            ])
        })
}
