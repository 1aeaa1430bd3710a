//! Which method and settings to take when: picked from what was measured, by a rule.

use super::choices::{Choice, cheapest, choices};
use super::errors::Error;
use super::points::{DEFAULT, Factor};
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
For each error that may be asked for: of the settings that keep it on every scene those that go over the fewest pairs, as the\n\
geometric mean over the scenes of the pairs over the default's. In brackets are that mean and the largest error of the\n\
scenes. Beside it, the cheapest settings on each scene alone, with their pairs over the default's. Methods of papers, the finish\n\
*calm* and what has not come to rest are not advised. `method = \"auto\"` with `accuracy = …` in a scene picks by the same rule,\n\
from `cli/accuracy.toml`; `linf` is a part there, not per cent, as are `interpolation` and `derivative`.";

/// The table of goals.
pub(super) fn table(sheets: &[Sheet]) -> Table {
    let mut table = Table::new(&["error", "at most", "take in the plane", "take in space"]);
    (table.head).extend(sheets.iter().map(|sheet| sheet.place.scene.to_owned()));
    for (error, goals) in GOALS {
        let of_dimension = |dimension: usize| {
            let own: Vec<&Sheet> = (sheets.iter())
                .filter(|sheet| sheet.place.dimension == dimension)
                .collect();
            choices(&own, error)
        };
        let together = [2, 3].map(of_dimension);
        let alone: Vec<Vec<Choice>> = (sheets.iter())
            .map(|sheet| choices(&[sheet], error))
            .collect();
        for &goal in goals {
            let mut row = vec![error.title().to_owned(), short(goal)];
            row.extend(together.iter().map(|front| match cheapest(front, goal) {
                Some(choice) => said(choice),
                None => NOTHING.to_owned(),
            }));
            row.extend(alone.iter().map(|front| match cheapest(front, goal) {
                Some(Choice { name, cost, .. }) => format!("{name} ({cost:.2} ×)"),
                None => "–".to_owned(),
            }));
            table.rows.push(row);
        }
    }
    table
}

/// In a cell, where no settings keep a goal.
const NOTHING: &str = "nothing charted";

/// A choice in a cell.
fn said(choice: &Choice) -> String {
    let Choice {
        name, cost, error, ..
    } = choice;
    format!("{name} ({cost:.2} ×, {})", short(*error))
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
    use std::fs;

    use super::*;
    use crate::workspace::root;

    /// What the command picks is what docs/chart.md advises.
    #[test]
    fn the_page_and_the_shipped_table_agree() {
        let page = fs::read_to_string(root().join("docs/chart.md")).unwrap();
        let shipped = sphpack::auto::choices().unwrap();
        let cell = |dimension: usize, error: Error, goal: f64| {
            let front: Vec<Choice> = (shipped.iter())
                .filter(|line| line.dimension == dimension && line.measure.name() == error.key())
                .map(|line| Choice {
                    name: line.name.clone(),
                    settings: line.settings.clone(),
                    cost: line.cost,
                    error: error.unit() * line.accuracy,
                })
                .collect();
            cheapest(&front, goal).map_or_else(|| NOTHING.to_owned(), said)
        };
        for (error, goals) in GOALS {
            for &goal in goals {
                let row = format!(
                    "| {} | {} | {} | {} |",
                    error.title().replace('|', "\\|"),
                    short(goal),
                    cell(2, error, goal),
                    cell(3, error, goal)
                );
                assert!(page.contains(&row), "docs/chart.md lacks {row}");
            }
        }
    }

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
