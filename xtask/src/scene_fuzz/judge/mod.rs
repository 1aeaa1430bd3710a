//! Whether what came of a scene is right.

mod bodies;
mod box_sides;
mod closest;
mod endings;
mod sums;
#[cfg(test)]
mod tests;

use super::case::{Case, Role, Sides};
use super::rows::Row;
use super::trial::Trial;
use super::truth::Truth;

/// What is wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    /// A few words that similar faults share.
    pub(super) class: String,
    pub(super) detail: String,
}

/// What is to be said about a scene.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Verdict {
    /// Exit 0, and as it should be.
    Right,
    /// Exit 2, for this reason.
    Refused(String),
    /// Exit 3, and said so.
    NotSettled,
    /// At least one fault.
    Failed(Vec<Fault>),
}

/// A verdict, and what is worth a line of its own without being a failure.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Judgement {
    pub(super) verdict: Verdict,
    pub(super) notes: Vec<Fault>,
}

/// Collects faults; those of published methods bear the method's name.
#[derive(Debug)]
struct Faults {
    method: &'static str,
    all: Vec<Fault>,
}

impl Faults {
    fn add(&mut self, class: &str, detail: String) {
        let class = if self.method == "balanced" {
            class.to_owned()
        } else {
            format!("{class} ({})", self.method)
        };
        // The first of a class is enough.
        if self.all.iter().all(|fault| fault.class != class) {
            self.all.push(Fault { class, detail });
        }
    }
}

/// What the particles are judged by.
struct Scene<'a> {
    case: &'a Case,
    truth: &'a Truth,
    rows: &'a [Row],
    report: &'a serde_json::Value,
    /// The box.
    min: [f64; 3],
    max: [f64; 3],
}

impl Scene<'_> {
    fn axes(&self) -> std::ops::Range<usize> {
        0..self.case.dimension
    }

    /// ∆s of a particle: its own, or that of all, which a refinement may make another than the scene's.
    fn spacing(&self, row: &Row) -> f64 {
        let of_all = || self.figure(&["spacing"]);
        (row.spacing.or_else(of_all)).unwrap_or(self.case.spacing)
    }

    /// The greatest of all.
    fn coarsest(&self) -> f64 {
        let spacings = self.rows.iter().map(|row| self.spacing(row));
        spacings.fold(self.case.spacing, f64::max)
    }

    /// Whether particles may differ in size: those of the rows do, or the report tells of many sizes. All that a small container
    /// holds may be its wall, of the finest, and a box without surfaces is of the coarsest all over.
    fn is_graded(&self) -> bool {
        let first = self.rows.first().and_then(|row| row.spacing);
        let is_told = self.figure(&["resolution", "ratio"]).is_some();
        is_told || self.rows.iter().any(|row| row.spacing != first)
    }

    fn volume(&self) -> f64 {
        self.axes().map(|k| self.max[k] - self.min[k]).product()
    }

    /// A figure of the report.
    fn figure(&self, path: &[&str]) -> Option<f64> {
        let value = path
            .iter()
            .try_fold(self.report, |value, key| value.get(key))?;
        value.as_f64()
    }

    /// Whether some particles that were packed are not in the rows.
    fn leaves_out(&self) -> bool {
        !self.case.fill
            || ["free", "boundary", "fixed"]
                .iter()
                .any(|kind| !self.case.includes(kind))
            || self.case.bodies.iter().any(|body| body.role != Role::Solid)
    }

    /// The particles and their images within some reach of the box, with the number of each.
    fn with_images(&self, reach: f64) -> Vec<(usize, [f64; 3])> {
        let mut all: Vec<(usize, [f64; 3])> = self
            .rows
            .iter()
            .enumerate()
            .map(|(i, row)| (i, row.at))
            .collect();
        for axis in self.axes().filter(|&k| self.case.periodic[k]) {
            let length = self.max[axis] - self.min[axis];
            let turns = (reach / length).ceil() as i32;
            let own = all.len();
            for turn in (-turns..=turns).filter(|turn| *turn != 0) {
                for i in 0..own {
                    let (number, mut p) = all[i];
                    p[axis] += f64::from(turn) * length;
                    if p[axis] > self.min[axis] - reach && p[axis] < self.max[axis] + reach {
                        all.push((number, p));
                    }
                }
            }
        }
        all
    }
}

/// The box: the scene's own, or where it asks for a margin the one that the report says it became.
fn corners(case: &Case, report: &serde_json::Value) -> Option<[[f64; 3]; 2]> {
    let padded = |values: &[f64]| std::array::from_fn(|k| values.get(k).copied().unwrap_or(0.0));
    match &case.sides {
        Sides::Corners(min, max) => Some([padded(min), padded(max)]),
        Sides::Margin(_) => {
            let domain = report.get("scene")?.get("domain")?;
            let corner = |key: &str| {
                let list = domain.get(key)?.as_array()?;
                Some(padded(
                    &list.iter().filter_map(|x| x.as_f64()).collect::<Vec<_>>(),
                ))
            };
            Some([corner("min")?, corner("max")?])
        }
    }
}

/// Judges a scene that is placed.
pub(super) fn judge(case: &Case, trial: &Trial) -> Judgement {
    let mut faults = Faults {
        method: case.method(),
        all: Vec::new(),
    };
    let mut notes = Vec::new();
    let truth = Truth::new(case);
    let mut verdict = endings::judge(case, &truth, trial, &mut faults, &mut notes);
    let sound = trial.pack.code == Some(0);
    if let (true, Some(Ok(rows)), Some(report)) = (
        sound || trial.pack.code == Some(3),
        &trial.rows,
        &trial.report,
    ) {
        match corners(case, report) {
            None => faults.add("report lacks the box", String::new()),
            Some([min, max]) => {
                let scene = Scene {
                    case,
                    truth: &truth,
                    rows,
                    report,
                    min,
                    max,
                };
                if sound {
                    particles(&scene, &mut faults, &mut notes);
                } else {
                    let mut others = Faults {
                        method: case.method(),
                        all: Vec::new(),
                    };
                    box_sides::judge(&scene, &mut others);
                    notes.extend(others.all.into_iter().map(|fault| Fault {
                        class: format!("{}, exit 3", fault.class),
                        ..fault
                    }));
                }
            }
        }
    }
    if !faults.all.is_empty() {
        verdict = Verdict::Failed(faults.all);
    }
    Judgement { verdict, notes }
}

/// Everything about particles that are said to be right.
fn particles(scene: &Scene<'_>, faults: &mut Faults, notes: &mut Vec<Fault>) {
    box_sides::judge(scene, faults);
    // The others would only say it again, at length.
    let is_lost = faults.all.iter().any(|fault| {
        ["not finite", "outside"]
            .iter()
            .any(|word| fault.class.starts_with(word))
    });
    closest::judge(scene, faults);
    sums::volume(scene, faults, notes);
    bodies::judge(scene, faults);
    if !is_lost {
        sums::fields(scene, faults);
    }
}
