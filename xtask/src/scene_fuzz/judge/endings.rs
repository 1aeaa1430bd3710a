//! Whether the command ended as it should, with the files and words that belong to that.

use super::super::case::{Case, Role, Sides};
use super::super::trial::{MOST_BYTES, Trial};
use super::super::truth::Truth;
use super::{Fault, Faults, Verdict};

/// Words that no message for people may hold.
const BAD_WORDS: [&str; 6] = [
    "NaN",
    "panicked",
    "recursion",
    "RUST_BACKTRACE",
    "unwrap",
    "overflow",
];

/// What a message can name besides a body.
const KEYS: [&str; 16] = [
    "spacing",
    "domain",
    "margin",
    "periodic",
    "axis",
    "kernel",
    "lattice",
    "method",
    "finish",
    "precedence",
    "surface",
    "role",
    "fluid",
    "packing",
    "quality",
    "include",
];

pub(super) fn judge(
    case: &Case,
    truth: &Truth,
    trial: &Trial,
    faults: &mut Faults,
    notes: &mut Vec<Fault>,
) -> Verdict {
    let pack = &trial.pack;
    let mut reported = trial
        .report
        .as_ref()
        .and_then(|report| report.get("peak_memory_bytes")?.as_u64())
        .unwrap_or(0);
    reported = reported.max(pack.bytes).max(trial.dry.bytes);
    if reported > MOST_BYTES {
        faults.add("too much memory", format!("{} MiB", reported >> 20));
    }
    if trial.dry.was_killed && trial.dry.bytes <= MOST_BYTES {
        faults.add("dry run hangs", format!("{:.1} s", trial.dry.seconds));
    }
    if pack.was_killed && reported <= MOST_BYTES {
        faults.add(
            "too slow",
            format!("{:.1} s of {:.1} s", pack.seconds, trial.limit_seconds),
        );
    }
    for ending in [&trial.dry, pack] {
        let died = !ending.was_killed && !matches!(ending.code, Some(0..=3));
        if died || ending.errors.contains("panicked") {
            let code = ending
                .code
                .map_or("a signal".to_owned(), |code| code.to_string());
            faults.add(
                "panic",
                format!("ended by {code}: {}", ending.errors.trim()),
            );
        }
    }
    let same = match (trial.dry.code, pack.code) {
        (Some(0), Some(2)) => {
            faults.add("dry run said yes", pack.errors.trim().to_owned());
            false
        }
        (Some(2), Some(0 | 3)) => {
            faults.add("dry run said no", trial.dry.errors.trim().to_owned());
            false
        }
        _ => true,
    };
    match pack.code {
        Some(0) => {
            files_are_there(trial, faults);
            consistent(trial, true, faults);
            Verdict::Right
        }
        Some(1) => {
            if !pack.errors.contains("memory") {
                faults.add("exit 1", pack.errors.trim().to_owned());
            }
            Verdict::Refused(reason(case, &pack.errors))
        }
        Some(2) => {
            refusal(case, trial, faults);
            if same && is_plain(case, truth) {
                notes.push(Fault {
                    class: "refused needlessly".to_owned(),
                    detail: pack.errors.trim().to_owned(),
                });
            }
            Verdict::Refused(reason(case, &pack.errors))
        }
        Some(3) => {
            files_are_there(trial, faults);
            consistent(trial, false, faults);
            let said = format!("{}{}", pack.output, pack.errors).to_lowercase();
            let reasons = ["not ", "limit", "stagnat", "audit", "unfinished"];
            if !reasons.iter().any(|word| said.contains(word)) {
                faults.add("exit 3 without a word", said);
            }
            Verdict::NotSettled
        }
        _ => Verdict::NotSettled,
    }
}

fn files_are_there(trial: &Trial, faults: &mut Faults) {
    for name in ["out.csv", "out.json"] {
        if !trial.left.iter().any(|left| left == name) {
            faults.add("file missing", name.to_owned());
        }
    }
    if let Some(Err(message)) = &trial.rows {
        faults.add("particle file unreadable", message.clone());
    }
    if trial.report.is_none() {
        faults.add("report unreadable", String::new());
    }
}

/// Exit 0 says settled, sound and as accurate as asked, exit 3 that one of them is not so.
fn consistent(trial: &Trial, is_done: bool, faults: &mut Faults) {
    let Some(report) = &trial.report else {
        return;
    };
    let converged = report.get("converged").and_then(serde_json::Value::as_bool);
    let audit = report
        .get("audit")
        .and_then(|audit| audit.get("passed")?.as_bool());
    let reached = report
        .get("auto")
        .and_then(|auto| auto.get("reached")?.as_bool());
    let says_done = converged == Some(true) && audit != Some(false) && reached != Some(false);
    if says_done != is_done {
        faults.add(
            "report and exit status disagree",
            format!(
                "exit {:?}, converged {converged:?}, audit passed {audit:?}, accuracy reached {reached:?}",
                trial.pack.code
            ),
        );
    }
}

/// A refusal leaves no file, says one thing, names what it is about, and the dry run agrees.
fn refusal(case: &Case, trial: &Trial, faults: &mut Faults) {
    let errors = trial.pack.errors.trim();
    if !trial.left.is_empty() {
        faults.add("refused and wrote", trial.left.join(", "));
    }
    if errors.is_empty() {
        faults.add("refused without a word", String::new());
    }
    let messages = errors
        .lines()
        .filter(|line| line.starts_with("sphpack:") && !line.contains("warning:"))
        .count();
    if messages > 1 {
        faults.add("refused in several messages", errors.to_owned());
    }
    let names = case.bodies.iter().enumerate().any(|(k, body)| {
        errors.contains(&format!("\"{}\"", body.name)) || errors.contains(&case.file_name(k))
    });
    if !errors.is_empty() && !names && !KEYS.iter().any(|key| errors.contains(key)) {
        faults.add("refusal names nothing", errors.to_owned());
    }
    if let Some(word) = BAD_WORDS.iter().find(|word| errors.contains(**word)) {
        faults.add("refusal in odd words", format!("{word}: {errors}"));
    }
}

/// The message without names and numbers, so that like ones can be counted.
fn reason(case: &Case, errors: &str) -> String {
    let mut text = errors
        .lines()
        // Warnings are no reasons, nor are the first words of progress, nor what is taken before.
        .filter(|line| !line.contains("warning:") && !line.trim_end().ends_with('…'))
        .filter(|line| !line.trim_start().starts_with("method "))
        .collect::<Vec<_>>()
        .join(" ");
    for (k, body) in case.bodies.iter().enumerate() {
        text = text.replace(&format!("\"{}\"", body.name), "…");
        text = text.replace(&case.file_name(k), "FILE");
    }
    for word in ["sphpack:", "error:", "scene.toml:"] {
        text = text.replace(word, "");
    }
    let mut words = Vec::new();
    for word in text.split_whitespace() {
        let has_digit = word.chars().any(|c| c.is_ascii_digit());
        let word = if has_digit { "#" } else { word };
        if words.last() != Some(&word) || word != "#" {
            words.push(word);
        }
    }
    words.truncate(16);
    words.join(" ")
}

/// Whether nothing at all is wrong with a scene: one fat body away from the walls, all settings the default ones.
fn is_plain(case: &Case, truth: &Truth) -> bool {
    let [body] = case.bodies.as_slice() else {
        return false;
    };
    let is_default = case.method.is_none()
        && case.kernel.is_none()
        && case.h_over_spacing.is_none()
        && case.packing.is_empty()
        && case.quality.is_none()
        && body.role == Role::Solid
        && body.inset() <= 0.5
        && !case.periodic.contains(&true);
    if !is_default {
        return false;
    }
    let spacing = case.spacing;
    let [min, max] = truth.bodies[0].bounds();
    let axes = 0..case.dimension;
    let is_free = match &case.sides {
        Sides::Margin(margin) => *margin >= 3.0 * spacing,
        Sides::Corners(low, high) => axes
            .clone()
            .all(|k| (min[k] - low[k]).min(high[k] - max[k]) >= 3.0 * spacing),
    };
    let size = axes.clone().map(|k| max[k] - min[k]).fold(0.0, f64::max);
    // As fat as a ball of two thirds of its size is at least somewhere: its middle is deep.
    let steps = 24;
    let deepest = (0..steps_of(steps, case.dimension))
        .map(|i| {
            let p = std::array::from_fn(|k| {
                let cell = i / steps_of(steps, k) % steps;
                min[k] + (max[k] - min[k]) * (cell as f64 + 0.5) / steps as f64
            });
            -truth.bodies[0].distance(p)
        })
        .fold(0.0, f64::max);
    is_free && size >= 4.0 * spacing && deepest >= 0.3 * size && has_blunt_corners(case)
}

fn steps_of(steps: usize, dimension: usize) -> usize {
    steps.pow(dimension as u32)
}

/// Shapes without spikes.
fn has_blunt_corners(case: &Case) -> bool {
    use super::super::shape::Shape;
    case.bodies.iter().all(|body| {
        !matches!(
            body.shape,
            Shape::Starfish { .. }
                | Shape::Zigzag { .. }
                | Shape::Naca { .. }
                | Shape::Airfoil { .. }
        )
    })
}
