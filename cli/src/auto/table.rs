//! The table that is shipped: what settings come to on the scenes that were charted, and what they cost.

use serde::Deserialize;

use crate::Error;
use crate::scene::AccuracyMeasure;

/// Written by `cargo xtask chart --write`. It is no source: results that are kept until sources change stay.
const TEXT: &str = include_str!("../../accuracy.toml");

/// A line of the table.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// 2 or 3.
    pub dimension: usize,
    /// What of a packing it is about.
    pub measure: AccuracyMeasure,
    /// The worst of the charted scenes.
    pub accuracy: f64,
    /// Pairs that its sums go over, over those of the default, the geometric mean of the scenes.
    pub cost: f64,
    /// Its name in docs/chart.md.
    pub name: String,
    /// Keys of `[packing]` that differ from the default's.
    pub settings: toml::Table,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    choices: Vec<Choice>,
}

/// The table, of every dimension and measure the cheapest first.
///
/// # Errors
/// [`Error::System`] where the program was built with a damaged one.
pub fn choices() -> Result<Vec<Choice>, Error> {
    let table: Table = toml::from_str(TEXT).map_err(|error| {
        Error::System(format!(
            "the program's own table of accuracies is damaged: {error}"
        ))
    })?;
    Ok(table.choices)
}

/// The lines of a dimension and a measure.
pub(super) fn front(dimension: usize, measure: AccuracyMeasure) -> Result<Vec<Choice>, Error> {
    let mut all = choices()?;
    all.retain(|choice| choice.dimension == dimension && choice.measure == measure);
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_of_the_table_is_a_front_the_cheapest_first() {
        let all = choices().unwrap();
        for dimension in [2, 3] {
            for measure in AccuracyMeasure::ALL {
                let own: Vec<&Choice> = (all.iter())
                    .filter(|choice| choice.dimension == dimension && choice.measure == measure)
                    .collect();
                assert!(!own.is_empty(), "{dimension}-D, {measure}");
                for pair in own.windows(2) {
                    assert!(pair[0].cost < pair[1].cost, "{pair:?}");
                    assert!(pair[0].accuracy > pair[1].accuracy, "{pair:?}");
                }
                assert!(own.iter().all(|c| c.cost > 0.0 && c.accuracy > 0.0));
            }
        }
    }
}
