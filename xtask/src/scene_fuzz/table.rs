//! What came of all scenes, as a table.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::judge::{Fault, Judgement, Verdict};
use crate::marks;

/// What came of a scene.
#[derive(Debug, Clone)]
pub(super) struct Outcome {
    pub(super) number: usize,
    pub(super) method: &'static str,
    /// Of processor time.
    pub(super) seconds: f64,
    pub(super) wall_seconds: f64,
    pub(super) bytes: u64,
    pub(super) judgement: Judgement,
}

impl Judgement {
    pub(super) fn faults(&self) -> &[Fault] {
        match &self.verdict {
            Verdict::Failed(faults) => faults,
            _ => &[],
        }
    }
}

impl Outcome {
    pub(super) fn failed(&self) -> bool {
        matches!(self.judgement.verdict, Verdict::Failed(_))
    }
}

/// How many of each kind, and the numbers of the first.
#[derive(Default)]
struct Group {
    count: usize,
    first: Vec<usize>,
    detail: String,
}

fn group<'a>(groups: &mut BTreeMap<&'a str, Group>, name: &'a str, number: usize, detail: &str) {
    let group = groups.entry(name).or_default();
    group.count += 1;
    if group.first.len() < 8 {
        group.first.push(number);
    }
    if group.detail.is_empty() {
        group.detail = detail.chars().take(160).collect();
    }
}

fn lines(text: &mut String, title: &str, groups: &BTreeMap<&str, Group>) {
    if groups.is_empty() {
        return;
    }
    let _ = write!(text, "\n| {title} | scenes | numbers |\n|---|---|---|\n");
    let mut sorted: Vec<_> = groups.iter().collect();
    sorted.sort_by_key(|(_, group)| std::cmp::Reverse(group.count));
    for (name, group) in sorted {
        let numbers: Vec<String> = group.first.iter().map(ToString::to_string).collect();
        let more = if group.count > group.first.len() {
            ", …"
        } else {
            ""
        };
        let _ = writeln!(
            text,
            "| {} | {} | {}{more} |",
            name.replace('|', "/"),
            group.count,
            numbers.join(", ")
        );
    }
}

/// Whether a verdict is of a kind.
type Is<'a> = &'a dyn Fn(&Verdict) -> bool;

/// The table as Markdown.
pub(super) fn table(seed: u64, outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    let all = |is: Is<'_>| outcomes.iter().filter(|o| is(&o.judgement.verdict)).count();
    let default: Vec<&Outcome> = outcomes.iter().filter(|o| o.method == "balanced").collect();
    let _ = write!(
        text,
        "| seed {seed} | scenes | default method |\n|---|---|---|\n| all | {} | {} |\n",
        outcomes.len(),
        default.len()
    );
    let kinds: [(&str, Is<'_>); 4] = [
        ("right", &|v| *v == Verdict::Right),
        ("refused, with the reason", &|v| {
            matches!(v, Verdict::Refused(_))
        }),
        ("not settled, and said so", &|v| *v == Verdict::NotSettled),
        ("failed", &|v| matches!(v, Verdict::Failed(_))),
    ];
    for (name, is) in kinds {
        let own = default.iter().filter(|o| is(&o.judgement.verdict)).count();
        let _ = writeln!(text, "| {name} | {} | {own} |", all(is));
    }
    let (mut reasons, mut failures, mut notes) =
        (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    for outcome in outcomes {
        if let Verdict::Refused(reason) = &outcome.judgement.verdict {
            group(&mut reasons, reason, outcome.number, "");
        }
        for fault in outcome.judgement.faults() {
            group(&mut failures, &fault.class, outcome.number, &fault.detail);
        }
        for note in &outcome.judgement.notes {
            group(&mut notes, &note.class, outcome.number, &note.detail);
        }
    }
    lines(&mut text, "failures", &failures);
    for (name, group) in &failures {
        eprintln!("{name}: {}", group.detail);
    }
    lines(&mut text, "noted", &notes);
    lines(&mut text, "refused because", &reasons);
    if let Some(slowest) = default
        .iter()
        .max_by(|a, b| a.seconds.total_cmp(&b.seconds))
    {
        let _ = write!(
            text,
            "\nSlowest of the default method: scene {}, {:.1} s.",
            slowest.number, slowest.seconds
        );
    }
    if let Some(largest) = outcomes.iter().max_by_key(|o| o.bytes) {
        let _ = writeln!(
            text,
            " Most memory: scene {}, {} MiB.",
            largest.number,
            largest.bytes >> 20
        );
    }
    let wall: f64 = outcomes.iter().map(|o| o.wall_seconds).sum();
    eprintln!(
        "{:.2} s a scene, judging included",
        wall / outcomes.len().max(1) as f64
    );
    text
}

/// Puts the table into the page on reliability.
pub(super) fn write(table: &str) -> Result<(), String> {
    marks::write("scenes", table)
}
