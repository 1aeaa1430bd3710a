//! Curves of a reproduction, each figure's as a table and as a chart.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::measure::Measure;
use super::page::Result as Ended;
use super::subject::Subject;
use super::trials::{Repelled, Trial};
use crate::chart::{Axis, Chart, Scale, Series};

/// Writes the curves of rows that have one into a folder, those of one measure of a figure together.
pub(crate) fn write(folder: &Path, results: &[Ended]) -> Result<(), String> {
    let mut drawn: Vec<String> = Vec::new();
    let mut charts: BTreeMap<String, Vec<Series>> = BTreeMap::new();
    for ended in results.iter().filter(|ended| !ended.curve.is_empty()) {
        let row = &ended.row;
        let kernel = (row.subject.packing()).and_then(|setup| setup.kernel);
        let kernel = kernel.map_or("", |kernel| kernel.name());
        // The legend has little room.
        let what = if row.measure == Measure::DerivativeOffSites {
            "derivative"
        } else {
            "function"
        };
        let name = format!("{}-{}-over-h", row.paper, row.figure);
        charts.entry(name).or_default().push(Series {
            name: format!("{kernel}, {what}"),
            points: ended.curve.clone(),
            joined: true,
        });
    }
    for ended in results {
        if let Subject::Trial(Trial::Repelled(trial)) = ended.row.subject {
            let name = format!("{}-{}", ended.row.paper, ended.row.figure);
            // One chart of several α: that of the figure, which comes first.
            if !drawn.contains(&name) {
                put(folder, &name, &repulsion(&trial))?;
                drawn.push(name);
            }
        }
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

fn repulsion(trial: &Repelled) -> Chart {
    Chart {
        title: "Repulsion of two particles",
        axes: [
            Axis {
                title: "r/∆s",
                scale: Scale::Linear,
            },
            Axis {
                title: "force, p_b = ∆s = 1",
                scale: Scale::Linear,
            },
        ],
        series: (trial.curves().into_iter())
            .map(|(name, points)| Series {
                name,
                points,
                joined: true,
            })
            .collect(),
    }
}

/// Writes a chart as a table and as a drawing.
fn put(folder: &Path, name: &str, chart: &Chart) -> Result<(), String> {
    for (extension, text) in [("csv", chart.csv()), ("svg", chart.svg())] {
        let path = folder.join(format!("{name}.{extension}"));
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}
