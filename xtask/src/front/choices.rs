//! Settings worth taking: those that nothing beats in price and in one error at once, over all scenes of a dimension.

use sphpack::scene::Finish;

use super::errors::Error;
use super::figures::Figures;
use super::pareto::front;
use super::points::{DEFAULT, Factor, Point};
use super::sheet::Sheet;

/// What settings come to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Choice {
    pub(super) name: String,
    /// Keys of `[packing]` that differ from the default's.
    pub(super) settings: toml::Table,
    /// Pairs over the default's, the geometric mean of the scenes.
    pub(super) cost: f64,
    /// The largest of the scenes, in the unit of [`Error::title`].
    pub(super) error: f64,
}

/// The front, the cheapest first; empty where there are no scenes. A scene of which the error was not measured, as there are too
/// many particles, takes no part.
pub(super) fn choices(sheets: &[&Sheet], error: Error) -> Vec<Choice> {
    let is_measured =
        |sheet: &&&Sheet| (sheet.rivals()).any(|(_, figures, _)| error.of(figures).is_some());
    let sheets: Vec<&Sheet> = sheets.iter().filter(is_measured).copied().collect();
    let Some((first, others)) = sheets.split_first() else {
        return Vec::new();
    };
    let all: Vec<Choice> = (first.rivals())
        .filter_map(|(point, ..)| {
            let mut choice = of(first, point, error)?;
            for sheet in others {
                let there = of(sheet, point, error)?;
                choice.cost *= there.cost;
                choice.error = choice.error.max(there.error);
            }
            choice.cost = nearest(choice.cost.powf(1.0 / sheets.len() as f64));
            choice.error = upward(choice.error);
            Some(choice)
        })
        .collect();
    let places: Vec<[f64; 2]> = all.iter().map(|one| [one.cost, one.error]).collect();
    front(&places).into_iter().map(|i| all[i].clone()).collect()
}

/// The cheapest of a front that keeps a goal.
pub(super) fn cheapest(front: &[Choice], goal: f64) -> Option<&Choice> {
    front.iter().find(|choice| choice.error <= goal)
}

/// What a point's settings come to on one scene; `None` where they are not to be taken.
fn of(sheet: &Sheet, point: &Point, error: Error) -> Option<Choice> {
    let (default_point, default) =
        (sheet.measured.iter()).find(|(point, _)| point.name == DEFAULT)?;
    let (own, figures, is_candidate) = (sheet.rivals()).find(|(own, ..)| own.name == point.name)?;
    (is_candidate && may_be_taken(own, figures)).then_some(())?;
    Some(Choice {
        name: own.name.clone(),
        settings: differing(own, default_point)?,
        cost: figures.pairs / default.pairs,
        error: error.of(figures)?,
    })
}

/// A published method fails audits where its paper's algorithm does; the finish "calm" is for some thousand particles; and
/// what has not come to rest is not done.
fn may_be_taken(point: &Point, figures: &Figures) -> bool {
    may_be_asked(point) && figures.stop_reason == "converged"
}

/// Whether a packing of the point could be taken, as far as that is known before it is packed.
pub(super) fn may_be_asked(point: &Point) -> bool {
    let packing = &point.scene.packing;
    let is_ours = !packing.method.info().is_published && packing.finish != Finish::Calm;
    is_ours && point.factor != Factor::Spacing
}

/// Keys of `[packing]` whose values differ.
fn differing(point: &Point, from: &Point) -> Option<toml::Table> {
    let [own, usual] = [point, from].map(|point| toml::Table::try_from(&point.scene.packing).ok());
    let usual = usual?;
    Some(
        own?.into_iter()
            .filter(|(key, value)| usual.get(key) != Some(value))
            .collect(),
    )
}

/// Three digits, the last of them rounded.
fn nearest(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}

/// Three digits, no less than the number.
fn upward(x: f64) -> f64 {
    let rounded = nearest(x);
    if rounded >= x {
        return rounded;
    }
    let digit = 10.0_f64.powf(x.abs().log10().floor() - 2.0);
    nearest(rounded + digit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_not_rounded_down() {
        for (x, three) in [
            (0.0, 0.0),
            (1.0, 1.0),
            (1.001, 1.01),
            (1.23456e-5, 1.24e-5),
            (0.999_1, 1.0),
            (0.0208, 0.0208),
        ] {
            assert_eq!(upward(x), three, "{x}");
        }
    }
}
