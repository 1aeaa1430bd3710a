//! The chart as the command takes it: the table from which `method = "auto"` picks.

use std::fmt::Write as _;

use super::choices::choices;
use super::errors::Error;
use super::judges;
use super::sheet::Sheet;

/// Where it is, in the folder of the workspace. Not among the sources: those tell whether what is charted has changed.
pub(super) const FILE: &str = "cli/accuracy.toml";

/// The table's text.
pub(super) fn text(sheets: &[Sheet]) -> String {
    let scenes = |dimension: usize| -> Vec<&str> {
        (sheets.iter())
            .filter(|sheet| sheet.place.dimension == dimension)
            .map(|sheet| sheet.place.scene)
            .collect()
    };
    let mut text = format!(
        "# What `method = \"auto\"` picks from. Written by `cargo xtask chart --write`; docs/chart.md has all that was charted.\n\
         # In the plane: {}; in space: {}; judged by the {} kernel.\n\
         # accuracy: the worst of these scenes. cost: pairs over those of the default, the geometric mean of the scenes.\n\
         # settings: keys of [packing] that differ from the default's. Each line costs more than the one before it of its\n\
         # measure, and is more accurate.\n\n\
         choices = [\n",
        scenes(2).join(", "),
        scenes(3).join(", "),
        judges::name(judges::DENSITY),
    );
    for dimension in [2, 3] {
        let own: Vec<&Sheet> = (sheets.iter())
            .filter(|sheet| sheet.place.dimension == dimension)
            .collect();
        for error in Error::ALL {
            for choice in choices(&own, error) {
                let settings: Vec<String> = (choice.settings.iter())
                    .map(|(key, value)| format!("{key} = {value}"))
                    .collect();
                // Writing to a string cannot fail.
                let _ = writeln!(
                    text,
                    "  {{ dimension = {dimension}, measure = \"{}\", accuracy = {:.2e}, cost = {:?}, name = \"{}\", settings = {{ {} }} }},",
                    error.key(),
                    choice.error / error.unit(),
                    choice.cost,
                    choice.name,
                    settings.join(", ")
                );
            }
        }
    }
    text.push_str("]\n");
    text
}
