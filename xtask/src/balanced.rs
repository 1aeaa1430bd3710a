//! The balanced method against its bars, scene by scene.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};
use sphpack::scene::{Finish, Masses};
use sphpack::{Outcome, Scene};
use sphpack_packing::Kind;

use crate::balanced_rows::{ROWS, Row};
use crate::bench::Bench;
use crate::dial;
use crate::selection::Selection;
use crate::shipped::load;
use crate::shown_table::ShownTable;
use crate::workspace::write;

const HEAD: &str = "\
| scene | ∆s | finish | evaluations (bar) | L∞ (bar) | prototype | total variation | 99 % within | worst sits | \
residual of free max, rms | on the surface / N_s | spacing CV | closest pair / ∆s | volume off | seconds | |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
";

/// Packs every row; what was measured before by the same code is not packed again. Fails where one misses a bar.
pub(crate) fn run(selection: &Selection) -> Result<(), String> {
    let bench = Bench::open(&[file!()])?;
    let mut table = ShownTable::new(HEAD);
    let mut missed = Vec::new();
    for row in ROWS
        .iter()
        .filter(|row| selection.wants(row.scene, row.quick))
    {
        let line = match scene(row, selection)? {
            None => format!("{} | | | | no data | | | | | | | | | |\n", head(row)),
            Some(scene) => {
                let figures = bench.packed(&scene, Figures::of)?;
                let misses = figures.misses(row);
                if !misses.is_empty() {
                    missed.push(format!(
                        "{} {}: {}",
                        row.scene,
                        row.spacing,
                        misses.join(", ")
                    ));
                }
                figures.line(row, &misses)
            }
        };
        table.push(&line);
    }
    let dial = dial::table(selection)?;
    if selection.write {
        let table = table.into_text();
        let text = format!(
            "# The balanced method and its bars\n\n\
             Quintic kernel, h/∆s = 1.2, defaults, no tuning per shape{}. Regenerate with\n\
             `cargo xtask balanced --data DIR --write`, where DIR holds `bunny.stl`. Rows of at most 350 evaluations\n\
             are run with a tolerance that is out of reach, to see what patience brings. The prototype is a sketch of\n\
             the method that came before this implementation. Times are wall-clock seconds from scene to figures and\n\
             depend on the machine.\n\n{table}\n\
             ## Finishes\n\n\
             *both* makes the largest |Γ − Γ₀| and h|∇Γ| small at once, *calm* the latter alone, by the equations\n\
             themselves; their L∞ is from Γ₀, the lattice's own, and their bars are 0.05 % and 6·10⁻⁴, and 0.2 % and\n\
             10⁻⁶, with no pair nearer than 0.85 ∆s. An evaluation of *both* is a sum over the pairs; a step takes 82 in the plane.\n\
             Round bodies in space stop above the bars: steps of conjugate gradients flatten out there, and\n\
             factors of the equations are too dear.\n\n\
             ## Levelling\n\n\
             An even finish ends under the pressure p = p_b (1 + κ (Γ − Γ₀)), `levelling` = κ in a scene. Moves of a\n\
             hundredth of ∆s make the density even; what they leave is a residual of the background pressure. An\n\
             evaluation takes two passes over the pairs then, one without. 10 is the default (less where\n\
             h/∆s is below 1.2), 200 where masses are corrected; a consistent finish has none.\n\n{dial}",
            if selection.quick {
                " (the quick rows only)"
            } else {
                ""
            }
        );
        write("docs/balanced.md", &text)?;
    }
    if missed.is_empty() {
        Ok(())
    } else {
        Err(format!("missed: {}", missed.join("; ")))
    }
}

/// A row's scene; `None` where its body's file is not there.
fn scene(row: &Row, selection: &Selection) -> Result<Option<Scene>, String> {
    let Some(mut scene) = load(row.scene, selection)? else {
        return Ok(None);
    };
    scene.spacing = row.spacing;
    scene.packing.finish = row.finish;
    if row.corrected {
        scene.packing.masses = Masses::Corrected;
    }
    if row.patient {
        scene.packing.residual_tolerance = Some(1e-9);
        scene.packing.max_iterations = row.evaluations;
    } else {
        scene.packing.max_iterations = row.evaluations.max(600);
    }
    Ok(Some(scene))
}

/// What is judged of a packing.
#[derive(Debug, Serialize, Deserialize)]
struct Figures {
    evaluations: usize,
    linf: f64,
    total_variation: f64,
    most: f64,
    worst: String,
    residual: [f64; 2],
    surface: [usize; 2],
    cv: f64,
    closest: f64,
    /// Largest of all bodies' errors, in parts of the body and in particles.
    volume_off: [f64; 2],
    seconds: f64,
    converged: bool,
    /// Of corrected masses.
    spread: Option<f64>,
}

impl Figures {
    fn of(outcome: &Outcome) -> Self {
        let report = &outcome.report;
        let table = &outcome.table;
        let worst = (0..table.len())
            .filter(|&i| table.kind[i] != Kind::Frozen)
            .max_by(|&a, &b| {
                let error = |i: usize| (table.gamma[i] - 1.0).abs();
                error(a).total_cmp(&error(b))
            });
        let worst = worst.map_or_else(String::new, |i| {
            let place = &table.position[i][..table.dimension];
            let place: Vec<String> = place.iter().map(|x| format!("{x:.2}")).collect();
            format!("{} at ({})", table.kind[i].name(), place.join(", "))
        });
        let particle = report.spacing.powi(report.dimension as i32);
        let mut volume_off = [0.0_f64; 2];
        for body in &report.bodies {
            let off = (body.volume - body.volume_true).abs();
            volume_off[0] = volume_off[0].max(off / body.volume_true);
            volume_off[1] = volume_off[1].max(off / particle);
        }
        let sum =
            |f: fn(&sphpack_packing::SurfaceQuality) -> usize| report.surface.iter().map(f).sum();
        Self {
            evaluations: report.force_evaluations,
            linf: match report.scene.packing.finish {
                Finish::Even | Finish::Consistent => report.density.linf,
                // What the lattice itself is off by is not theirs.
                Finish::Calm | Finish::Both => report.density.linf_lattice,
            },
            total_variation: report.density.total_variation,
            most: table.error_of_most(0.99),
            worst,
            residual: [report.residual.max, report.residual.rms],
            surface: [sum(|s| s.count), sum(|s| s.target_count)],
            cv: report
                .surface
                .iter()
                .map(|s| s.spacing_cv)
                .fold(0.0, f64::max),
            closest: report.closest_pair_over_spacing,
            volume_off,
            seconds: report.seconds.total,
            converged: report.converged,
            spread: report.mass_correction.map(|correction| correction.spread),
        }
    }

    fn misses(&self, row: &Row) -> Vec<String> {
        let mut misses = Vec::new();
        let mut need = |holds: bool, what: &str| {
            if !holds {
                misses.push(what.to_owned());
            }
        };
        need(
            row.patient || self.converged || row.rms_bar.is_some(),
            "not converged",
        );
        need(
            self.evaluations <= row.evaluations + 3 || row.rms_bar.is_some(),
            "evaluations",
        );
        need(self.linf <= row.linf_bar, "L∞");
        need(row.most_bar.is_none_or(|bar| self.most <= bar), "99 %");
        need(
            row.variation_bar
                .is_none_or(|bar| self.total_variation <= bar),
            "total variation",
        );
        need(
            row.residual_bar.is_none_or(|bar| self.residual[0] <= bar),
            "residual",
        );
        need(
            row.rms_bar.is_none_or(|bar| self.residual[1] <= bar),
            "residual rms",
        );
        let [count, target] = self.surface;
        let allowed = (0.01 * target as f64).max(1.0);
        need(
            (count as f64 - target as f64).abs() <= allowed,
            "surface count",
        );
        need(self.cv <= row.cv_bar(), "spacing CV");
        need(self.closest >= row.closest_bar(), "closest pair");
        need(
            self.spread.is_none_or(|spread| spread <= 0.02 + 1e-9),
            "mass spread",
        );
        need(
            self.volume_off[0] <= 0.003 || self.volume_off[1] <= 0.5,
            "volume",
        );
        misses
    }

    fn line(&self, row: &Row, misses: &[String]) -> String {
        let mut verdict = if misses.is_empty() {
            "pass".to_owned()
        } else {
            format!("**{}**", misses.join(", "))
        };
        if let Some(spread) = self.spread {
            let _ = write!(verdict, " (masses within ±{:.1} %)", 100.0 * spread);
        }
        let mut line = head(row);
        let percent = |x: f64| format!("{:.3} %", 100.0 * x);
        // Writing to a string cannot fail.
        let _ = writeln!(
            line,
            " | {} ({}) | {} ({}) | {} | {} | {} | {} | {:.1e}, {:.1e} | {} / {} | {:.1} % | {:.3} | {:.1e} | {:.2} | {verdict} |",
            self.evaluations,
            row.evaluations,
            percent(self.linf),
            percent(row.linf_bar),
            row.prototype,
            percent(self.total_variation),
            percent(self.most),
            self.worst,
            self.residual[0],
            self.residual[1],
            self.surface[0],
            self.surface[1],
            100.0 * self.cv,
            self.closest,
            self.volume_off[0],
            self.seconds,
        );
        line
    }
}

fn head(row: &Row) -> String {
    format!("| {} | {} | {}", row.scene, row.spacing, row.finish_name())
}
