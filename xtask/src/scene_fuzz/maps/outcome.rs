//! What comes of a scene of a map, and what tells it.

use serde::{Deserialize, Serialize};

use super::super::judge::{Judgement, Verdict};
use super::super::trial::Trial;

/// Of what passes: the largest deviation of the density, and the closest pair in ∆s.
pub(super) const EVEN: f64 = 0.01;
pub(super) const APART: f64 = 0.6 - ROUNDING;

/// Two particles that are to be just so far apart may be a little less.
const ROUNDING: f64 = 1e-6;

/// Of what is no failure, though exit status 0 says that all is right.
pub(super) const UNEVEN: f64 = 0.25;

/// How a scene ended, from the best to the worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Outcome {
    /// Exit status 0, right, even.
    Passes,
    /// Exit status 0, right, not even; or parts were left out, with a warning.
    Degraded,
    /// Exit status 2, before the work.
    Refused,
    /// Exit status 3: not settled or not sound, and said so.
    Said,
    /// Wrong, and not said.
    Fails,
}

impl Outcome {
    pub(super) const ALL: [Self; 5] = [
        Self::Passes,
        Self::Degraded,
        Self::Refused,
        Self::Said,
        Self::Fails,
    ];

    /// What it means.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Passes => "passes",
            Self::Degraded => "degraded",
            Self::Refused => "refused before the work",
            Self::Said => "exit 3, said",
            Self::Fails => "fails in silence",
        }
    }
}

/// What came of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Cell {
    pub(super) outcome: Outcome,
    /// Largest deviation of the density from its median, where there are particles.
    pub(super) linf: Option<f64>,
    /// In ∆s.
    pub(super) closest: Option<f64>,
    /// What was said, or is wrong.
    pub(super) why: String,
    /// Of processor time.
    pub(super) seconds: f64,
}

impl Cell {
    /// Of a scene that was tried and judged.
    pub(super) fn of(trial: &Trial, judgement: &Judgement) -> Self {
        let linf = unevenness(trial);
        let report = trial.report.as_ref();
        let closest = report.and_then(|report| report.get("closest_pair_over_spacing")?.as_f64());
        let (outcome, why) = match &judgement.verdict {
            Verdict::Failed(faults) => {
                let faults = faults.iter().map(|f| format!("{}: {}", f.class, f.detail));
                (Outcome::Fails, faults.collect::<Vec<_>>().join("; "))
            }
            Verdict::Refused(_) => (Outcome::Refused, said(trial)),
            Verdict::NotSettled => (Outcome::Said, said(trial)),
            Verdict::Right => of_right(linf, closest, &left_out(trial)),
        };
        Self {
            outcome,
            linf,
            closest,
            why,
            seconds: trial.pack.seconds,
        }
    }
}

/// How even what is right is.
fn of_right(linf: Option<f64>, closest: Option<f64>, left_out: &str) -> (Outcome, String) {
    let Some(linf) = linf.filter(|linf| linf.is_finite()) else {
        return (Outcome::Fails, "no particles, or no densities".to_owned());
    };
    // Without a pair within reach there is no distance.
    let closest = closest.unwrap_or(f64::INFINITY);
    if linf > UNEVEN {
        return (Outcome::Fails, format!("L∞ is {:.1} %", 100.0 * linf));
    }
    let mut reasons = Vec::new();
    if linf > EVEN {
        reasons.push(format!("L∞ is {:.1} %", 100.0 * linf));
    }
    if closest < APART {
        reasons.push(format!("a pair is {closest:.2} ∆s apart"));
    }
    if !left_out.is_empty() {
        reasons.push(left_out.to_owned());
    }
    if reasons.is_empty() {
        (Outcome::Passes, String::new())
    } else {
        (Outcome::Degraded, reasons.join("; "))
    }
}

/// The largest deviation of Γ from its median. The median is the lattice's, which for some kernels is not 1: that is no fault
/// of the packing.
fn unevenness(trial: &Trial) -> Option<f64> {
    let rows = trial.rows.as_ref()?.as_ref().ok()?;
    let own = rows.iter().filter(|row| !row.is_frozen());
    let mut gammas: Vec<f64> = own.map(|row| row.gamma).collect();
    gammas.sort_by(f64::total_cmp);
    let median = *gammas.get(gammas.len() / 2)?;
    let ends = [gammas[0], gammas[gammas.len() - 1]];
    let off = ends.map(|gamma| (gamma / median - 1.0).abs());
    Some(off[0].max(off[1]))
}

/// The first warning that some part gets no particles.
fn left_out(trial: &Trial) -> String {
    let warnings = (trial.report.as_ref()).and_then(|report| report.get("warnings")?.as_array());
    (warnings.into_iter().flatten())
        .filter_map(|warning| warning.as_str())
        .find(|warning| warning.contains("no particles"))
        .unwrap_or_default()
        .to_owned()
}

/// What the command said at its end: its message, what is not as it should be, and what its audit found.
fn said(trial: &Trial) -> String {
    let words = format!("{}\n{}", trial.pack.output, trial.pack.errors);
    let mut is_found = false;
    let mut all = Vec::new();
    for line in words.lines().filter(|line| !line.contains("warning:")) {
        if is_found || line.starts_with("sphpack:") || line.contains("not ") {
            all.push(line.trim());
        }
        is_found = line.contains("audit ") && line.contains("FAILED");
    }
    all.join(" ").chars().take(300).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_said_is_kept() {
        let mut trial = Trial::default();
        trial.pack.output =
            "  packed  density 1\n  audit   FAILED; marked\n   two are near\n  wrote".to_owned();
        trial.pack.errors = "sphpack: warning: thin\nsphpack: it is thin".to_owned();
        assert_eq!(said(&trial), "two are near sphpack: it is thin");
    }

    #[test]
    fn what_is_right_may_be_uneven() {
        let of = |linf, closest, left| of_right(linf, closest, left).0;
        assert_eq!(of(Some(0.009), Some(0.8), ""), Outcome::Passes);
        assert_eq!(of(Some(0.009), None, ""), Outcome::Passes);
        assert_eq!(of(Some(0.009), Some(0.55), ""), Outcome::Degraded);
        assert_eq!(of(Some(0.05), Some(0.8), ""), Outcome::Degraded);
        assert_eq!(of(Some(0.009), Some(0.8), "a part"), Outcome::Degraded);
        assert_eq!(of(Some(0.3), Some(0.8), ""), Outcome::Fails);
        assert_eq!(of(Some(f64::NAN), Some(0.8), ""), Outcome::Fails);
        assert_eq!(of(None, Some(0.8), ""), Outcome::Fails);
    }
}
