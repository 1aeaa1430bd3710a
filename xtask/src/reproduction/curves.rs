//! Curves of a reproduction, each figure's as a table and as a chart.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::page::Result as Ended;
use crate::chart::{Axis, Chart, Scale, Series};

/// Writes the curves of rows that have one into a folder, those of one measure of a figure together.
pub(crate) fn write(folder: &Path, results: &[Ended]) -> Result<(), String> {
    let mut charts: BTreeMap<String, Vec<Series>> = BTreeMap::new();
    for ended in results.iter().filter(|ended| !ended.curve.is_empty()) {
        let row = &ended.row;
        let kernel = (row.subject.packing()).and_then(|setup| setup.kernel);
        let kernel = kernel.map_or("", |kernel| kernel.name());
        let name = format!("{}-{}-over-h", row.paper, row.figure);
        charts.entry(name).or_default().push(Series {
            name: format!("{kernel}, {}", row.measure.name()),
            points: ended.curve.clone(),
            joined: true,
        });
    }
    for (name, series) in charts {
        let chart = Chart {
            title: "Error off the sites over the lattice's own",
            axes: [
                Axis {
                    title: "h/∆s",
                    scale: Scale::Linear,
                },
                Axis {
                    title: "L2 / lattice's",
                    scale: Scale::Linear,
                },
            ],
            series,
        };
        put(folder, &name, &chart)?;
    }
    Ok(())
}

/// Writes a chart as a table and as a drawing.
pub(crate) fn put(folder: &Path, name: &str, chart: &Chart) -> Result<(), String> {
    for (extension, text) in [("csv", chart.csv()), ("svg", chart.svg())] {
        let path = folder.join(format!("{name}.{extension}"));
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}
