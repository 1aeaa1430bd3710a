//! Whether a packing is as accurate as it was to be.

use serde::Serialize;
use sphpack_neighbors::words;
use sphpack_packing::Kind;

use super::pick::{Picked, number};
use crate::scene::{AccuracyMeasure, Scene};
use crate::solution::Solution;

/// The content of report.json's `auto`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AutoReport {
    /// What was picked.
    #[serde(flatten)]
    pub picked: Picked,
    /// What came of the measure that was asked for; `None` where none was, or it cannot be measured.
    pub measured: Option<f64>,
    /// Whether that is no more than was asked for; `None` where nothing was.
    pub reached: Option<bool>,
    /// Where the measure is worst; empty where that is nowhere.
    pub worst_at: Vec<f64>,
    /// Where it was not reached: how far it is off and where, the likely cause and the cure.
    pub message: Option<String>,
}

/// A figure, and where it is worst.
type Found<const D: usize> = (f64, Option<[f64; D]>);

impl AutoReport {
    /// Measures a packing of these settings.
    pub(crate) fn of<const D: usize>(
        picked: Picked,
        scene: &Scene,
        solution: &Solution<D>,
    ) -> Self {
        let mut report = Self {
            picked,
            measured: None,
            reached: None,
            worst_at: Vec::new(),
            message: None,
        };
        let (Some(measure), Some(asked)) = (report.picked.measure, report.picked.asked) else {
            return report;
        };
        let Some((measured, at)) = measured(measure, scene, solution) else {
            report.reached = Some(false);
            report.message = Some(format!(
                "{measure} cannot be measured: every place is within the kernel's reach of a periodic side; use a larger box, or linf or residual"
            ));
            return report;
        };
        report.measured = Some(measured);
        report.worst_at = at.map_or_else(Vec::new, |p| p.to_vec());
        // A figure that is no number is not reached.
        report.reached = Some(measured <= asked);
        if report.reached == Some(false) {
            let place = at.map_or_else(String::new, |p| {
                format!(
                    ", worst at {}",
                    words::place(&p, solution.problem.spacing())
                )
            });
            report.message = Some(format!(
                "{measure} is {measured:.2e}, more than the {} asked for{place}: {}",
                number(asked),
                report.picked.cure(measure)
            ));
        }
        report
    }

    /// A line for a person: the figure beside what was asked for, or what is wrong.
    pub fn words(&self) -> Option<String> {
        let (measure, asked) = (self.picked.measure?, self.picked.asked?);
        Some(match (&self.message, self.measured) {
            (None, Some(measured)) => {
                format!(
                    "reached: {measure} {measured:.2e}, {} asked for",
                    number(asked)
                )
            }
            (Some(message), _) => format!("NOT reached: {message}"),
            (None, None) => return None,
        })
    }
}

fn measured<const D: usize>(
    measure: AccuracyMeasure,
    scene: &Scene,
    solution: &Solution<D>,
) -> Option<Found<D>> {
    let Solution {
        packed,
        fields,
        quality,
        ..
    } = solution;
    let particles = &packed.particles;
    let worst = |is_asked: &dyn Fn(Kind) -> bool, figure: &dyn Fn(usize) -> f64| {
        let all = (0..particles.len()).filter(|&i| is_asked(particles.kind[i]));
        let worst = all.max_by(|&a, &b| figure(a).total_cmp(&figure(b)));
        worst.map(|i| particles.position[i])
    };
    let interpolation = || {
        let (kernel, h_over_spacing) = scene.judge();
        packed.interpolation(kernel, h_over_spacing)
    };
    match measure {
        AccuracyMeasure::Linf => {
            let off = |i: usize| (fields.gamma[i] - 1.0).abs();
            let at = worst(&|kind| kind != Kind::Frozen, &off);
            Some((quality.density.linf, at))
        }
        AccuracyMeasure::Residual => {
            let at = worst(&|kind| kind == Kind::Free, &|i| fields.residual(i));
            Some((quality.residual.max, at))
        }
        AccuracyMeasure::Interpolation => {
            interpolation().map(|of| (of.function.over_lattice - 1.0, Some(of.function.worst_at)))
        }
        AccuracyMeasure::Derivative => interpolation().map(|of| {
            (
                of.derivative.over_lattice - 1.0,
                Some(of.derivative.worst_at),
            )
        }),
    }
}

impl Picked {
    /// Why it is most likely not reached, and what helps.
    fn cure(&self, measure: AccuracyMeasure) -> String {
        let is_too_fine = self.asked.is_some_and(|asked| self.charted > asked);
        match &self.finer {
            _ if !self.kept.is_empty() => format!(
                "the scene's own {} is the likely cause, which the table is without; leave it out",
                self.kept.join(", ")
            ),
            _ if is_too_fine => format!(
                "no charted settings promise less than {}; ask for that, or use a smaller spacing if the place is thin, narrow or sharp",
                number(self.charted)
            ),
            Some((accuracy, name)) => format!(
                "the place is thinner, narrower or sharper than those charted, most likely; ask for accuracy = {{ {measure} = {} }}, which takes {name}, or use a smaller spacing",
                number(*accuracy)
            ),
            None => "the place is thinner, narrower or sharper than those charted, most likely; use a smaller spacing or a plainer body, no charted settings are more accurate".to_owned(),
        }
    }
}
