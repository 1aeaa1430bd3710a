//! Which method and settings to take when: picked from what was measured, by a rule.

use super::errors::Error;
use super::figures::Figures;
use super::points::{DEFAULT, Factor, Point};
use super::sheet::Sheet;
use super::table::Table;

/// Errors that somebody may ask for, in the units of [`Error::title`].
const GOALS: [(Error, &[f64]); 4] = [
    (Error::Linf, &[1.0, 0.5, 0.2, 0.1, 0.05]),
    (Error::Residual, &[1e-2, 3e-3, 1e-3, 1e-4, 1e-5]),
    (Error::Function, &[1.0, 0.3, 0.1, 0.03]),
    (Error::Derivative, &[3.0, 1.0, 0.3, 0.1]),
];

/// The rule, in words.
pub(super) const RULE: &str = "\
For each error that may be asked for: of the settings that keep it on every scene those that take least time, as the\n\
geometric mean over the scenes of the time over the default's. In brackets are that mean and the largest error of the\n\
scenes. Beside it, the quickest settings on each scene alone, with their time over the default's.";

/// What a choice comes to.
#[derive(Debug, Clone, PartialEq)]
struct Choice {
    name: String,
    /// Of the default's time.
    times: f64,
    /// The largest of the scenes.
    error: f64,
}

/// The table of goals.
pub(super) fn table(sheets: &[Sheet]) -> Table {
    let mut table = Table::new(&["error", "at most", "take"]);
    (table.head).extend(sheets.iter().map(|sheet| sheet.place.scene.to_owned()));
    for (error, goals) in GOALS {
        for &goal in goals {
            let said = match all(sheets, error, goal) {
                Some(Choice { name, times, error }) => {
                    format!("{name} ({times:.2} ×, {})", short(error))
                }
                None => "nothing charted".to_owned(),
            };
            let mut row = vec![error.title().to_owned(), short(goal), said];
            row.extend(sheets.iter().map(|sheet| {
                match all(std::slice::from_ref(sheet), error, goal) {
                    Some(Choice { name, times, .. }) => format!("{name} ({times:.2} ×)"),
                    None => "–".to_owned(),
                }
            }));
            table.rows.push(row);
        }
    }
    table
}

/// The quickest settings that keep a goal on all of these scenes.
fn all(sheets: &[Sheet], error: Error, goal: f64) -> Option<Choice> {
    let (first, others) = sheets.split_first()?;
    (first.rivals())
        .filter_map(|(point, figures, is_candidate)| {
            let mut choice = judged(first, point, figures, is_candidate, error)?;
            for sheet in others {
                let (other, figures, is_candidate) = sheet
                    .rivals()
                    .find(|(other, ..)| other.name == point.name)?;
                let there = judged(sheet, other, figures, is_candidate, error)?;
                choice.times *= there.times;
                choice.error = choice.error.max(there.error);
            }
            choice.times = choice.times.powf(1.0 / sheets.len() as f64);
            Some(choice)
        })
        .filter(|choice| choice.error <= goal)
        .min_by(|a, b| a.times.total_cmp(&b.times))
}

fn judged(
    sheet: &Sheet,
    point: &Point,
    figures: &Figures,
    is_candidate: bool,
    error: Error,
) -> Option<Choice> {
    let default = sheet.default()?;
    let error = error.of(figures).filter(|_| is_candidate)?;
    Some(Choice {
        name: point.name.clone(),
        times: figures.seconds / default.seconds,
        error,
    })
}

/// A number in a cell.
pub(super) fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (0.01..1000.0).contains(&size) => {
            let text = format!("{value:.3}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        size if size >= 1000.0 => format!("{value:.0}"),
        _ => format!("{value:.1e}"),
    }
}

/// Where another method beats the default in evaluations and in the density at once: evaluations do not depend on the machine.
pub(super) fn beaten(sheets: &[Sheet]) -> Vec<String> {
    let mut all = Vec::new();
    for sheet in sheets {
        let Some(default) = sheet.default() else {
            continue;
        };
        for (point, figures, is_candidate) in sheet.rivals() {
            let is_method = point.factor == Factor::Method && point.name != DEFAULT;
            let is_better =
                figures.evaluations <= default.evaluations && figures.linf <= default.linf;
            if is_method && is_candidate && is_better {
                all.push(format!("{} by {}", sheet.place.scene, point.name));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (0.05, "0.05"),
            (1.0, "1"),
            (12.3456, "12.346"),
            (1e-5, "1.0e-5"),
            (40_001.0, "40001"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
