//! The closing words of a packing.

use std::fmt::Write as _;

use sphpack_packing::Problem;

use super::duration::duration;
use super::plain_text::visible;
use crate::ReadBody;
use crate::auto::{AutoReport, Picked};
use crate::picture::grouped;
use crate::report::{BodyReport, Report};
use crate::run::Outcome;
use crate::solution::Packing;

/// A line for each stage.
pub(super) fn of(outcome: &Outcome, written: &[String]) -> String {
    let report = &outcome.report;
    let mut text = read(&outcome.read);
    let bodies = match &outcome.packing {
        Packing::Plane(solution) => bodies(&solution.problem),
        Packing::Space(solution) => bodies(&solution.problem),
    };
    for (number, body) in bodies.iter().enumerate() {
        let time = (number == 0).then(|| duration(report.seconds.geometry));
        line(
            &mut text,
            if number == 0 { "geometry" } else { "" },
            body,
            time,
        );
    }
    let counts = &report.particles;
    if let Some(auto) = &report.auto {
        text.push_str(&picked(&auto.picked));
    }
    line(
        &mut text,
        "seeding",
        &format!(
            "{} particles, and {} frozen ones around them",
            grouped(counts.total - counts.frozen),
            grouped(counts.frozen)
        ),
        Some(duration(report.seconds.seeding)),
    );
    if let Some(resolution) = &report.resolution {
        let words = format!(
            "spacings {} … {}, neighbours' differ by {:.1} %, at most {:.1} %; {:.1} times fewer than at the finest",
            short(resolution.finest),
            short(resolution.coarsest),
            100.0 * (resolution.growth_mean - 1.0),
            100.0 * (resolution.growth_max - 1.0),
            resolution.times_fewer
        );
        line(&mut text, "", &words, None);
    }
    line(
        &mut text,
        "settling",
        &format!(
            "{} evaluations, residual {:.1e}",
            grouped(report.force_evaluations),
            report.residual.max
        ),
        Some(duration(
            report.seconds.neighbors
                + report.seconds.forces
                + report.seconds.projection
                + report.seconds.minimiser,
        )),
    );
    let on_surface: usize = report.surface.iter().map(|surface| surface.count).sum();
    let target: usize = report
        .surface
        .iter()
        .map(|surface| surface.target_count)
        .sum();
    line(
        &mut text,
        "",
        &format!(
            "{} on the surface ({} fit), {} solid, {} fluid",
            grouped(on_surface),
            grouped(target),
            grouped(counts.solid),
            grouped(counts.fluid)
        ),
        None,
    );
    for words in report.bodies.iter().filter_map(wall) {
        line(&mut text, "", &words, None);
    }
    line(&mut text, "packed", &packed(report), None);
    if let Some(words) = unfinished(report) {
        line(&mut text, "unfinished", &words, None);
    }
    if let Some(words) = report.auto.as_ref().and_then(AutoReport::words) {
        line(&mut text, "accuracy", &words, None);
    }
    for (number, words) in audit(report).iter().enumerate() {
        line(
            &mut text,
            if number == 0 { "audit" } else { "" },
            words,
            None,
        );
    }
    line(
        &mut text,
        "wrote",
        &written.join(", "),
        Some(duration(report.seconds.output)),
    );
    text
}

/// A body's wall, where it has one: the particles of each layer.
fn wall(body: &BodyReport) -> Option<String> {
    let wall = body.wall.as_ref()?;
    let counts: Vec<String> = (wall.layers.iter())
        .map(|layer| grouped(layer.count))
        .collect();
    Some(format!(
        "{}: a wall of {} in layers",
        visible(&body.name),
        counts.join(" + ")
    ))
}

/// What a scene's text was read as, a line each.
pub(super) fn notes(notes: &[String]) -> String {
    let mut text = String::new();
    for (number, words) in notes.iter().enumerate() {
        let stage = if number == 0 { "scene" } else { "" };
        line(&mut text, stage, &visible(words), None);
    }
    text
}

/// What the method "auto" takes, a line each.
pub(super) fn picked(picked: &Picked) -> String {
    let mut text = String::new();
    for (number, words) in picked.words().iter().enumerate() {
        let stage = if number == 0 { "method" } else { "" };
        line(&mut text, stage, words, None);
    }
    text
}

/// A line for each body that comes from a file: its format, how much there is of it, its size.
pub(super) fn read(bodies: &[ReadBody]) -> String {
    let mut text = String::new();
    for (number, body) in bodies.iter().enumerate() {
        let parts = match body.format.dimension() {
            2 => "points",
            _ => "triangles",
        };
        let size: Vec<String> = body.size.iter().map(|&length| short(length)).collect();
        line(
            &mut text,
            if number == 0 { "read" } else { "" },
            &format!(
                "{}: {}, {} {parts}, {} scene units",
                body.name,
                body.format.description(),
                grouped(body.count),
                size.join(" × ")
            ),
            None,
        );
    }
    text
}

fn line(text: &mut String, stage: &str, words: &str, time: Option<String>) {
    let _ = match time {
        Some(time) => writeln!(text, "  {stage:10} {words:66} {time:>8}"),
        None => writeln!(text, "  {stage:10} {words}"),
    };
}

fn bodies<const D: usize>(problem: &Problem<D>) -> Vec<String> {
    let (measure, volume) = if D == 2 {
        ("perimeter", "area")
    } else {
        ("surface", "volume")
    };
    problem
        .bodies
        .iter()
        .map(|body| {
            let corners = match body.surface.features().corners.len() {
                _ if D == 3 => String::new(),
                0 => String::new(),
                1 => ", 1 corner".to_owned(),
                n => format!(", {} corners", grouped(n)),
            };
            format!(
                "{}: {measure} {}, {volume} {}{corners}",
                body.name,
                short(body.surface.measure()),
                short(body.surface.volume())
            )
        })
        .collect()
}

/// A number with three digits or so.
fn short(value: f64) -> String {
    if !(1e-3..1e5).contains(&value) {
        return format!("{value:.2e}");
    }
    let digits = (2.0 - value.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.digits$}")
}

/// A kernel that is farther off on a perfect lattice than this is said to be.
const BIAS: f64 = 0.001;

fn packed(report: &Report) -> String {
    let density = &report.density;
    let mut words = format!("density {:.4} … {:.4}", density.min, density.max);
    if (density.lattice - 1.0).abs() >= BIAS {
        let _ = write!(words, " (the lattice's own {:.4})", density.lattice);
    }
    let farthest = report
        .surface
        .iter()
        .map(|surface| surface.max_distance_over_spacing)
        .fold(0.0, f64::max);
    if report.surface.iter().any(|surface| surface.count > 0) {
        let _ = if farthest < 1e-9 {
            write!(words, ", every surface particle on its surface")
        } else {
            write!(
                words,
                ", every surface particle within {farthest:.0e} ∆s of its surface"
            )
        };
    }
    words
}

/// Passed with the figures, or what was found.
fn audit(report: &Report) -> Vec<String> {
    let audit = &report.audit;
    if audit.passed {
        return vec![format!(
            "passed: nothing outside, closest pair {:.3} ∆s, volumes within {:.2} %",
            audit.closest_pair_over_spacing,
            100.0 * audit.volume_error
        )];
    }
    let mut lines = vec!["FAILED; the files are written, and marked".to_owned()];
    lines.extend(audit.messages.iter().cloned());
    lines
}

/// Why a packing is not done, for those who want no more words.
pub(super) fn in_a_line(report: &Report) -> String {
    let inaccurate = (report.auto.as_ref()).and_then(|auto| auto.message.as_ref());
    match (
        unfinished(report),
        report.audit.messages.first(),
        inaccurate,
    ) {
        (Some(words), ..) => words,
        (None, Some(words), _) => {
            format!("not sound: {words}; the files are written, and marked")
        }
        (None, None, Some(words)) => {
            format!("not as accurate as asked: {words}; the files are written, and marked")
        }
        (None, None, None) => "done".to_owned(),
    }
}

fn unfinished(report: &Report) -> Option<String> {
    match report.stop_reason {
        "converged" => None,
        "interrupted" => Some("interrupted; the files hold what there was".to_owned()),
        "iteration-limit" => Some(format!(
            "not converged in {} iterations; raise packing.max_iterations or the tolerance",
            grouped(report.iterations)
        )),
        reason => Some(format!(
            "not converged ({reason}) after {} iterations; try another packing.h_over_spacing or lattice",
            grouped(report.iterations)
        )),
    }
}
