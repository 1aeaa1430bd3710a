//! Kernels that pack against kernels that judge.

use super::judges::{self, DENSITY, judges};
use super::points::{DEFAULT, Factor};
use super::sheet::Sheet;
use super::table::Table;

/// The table of a scene: a row for each kernel that packed, a column for each that judges.
pub(super) fn table(sheet: &Sheet) -> Table {
    let judges = judges(sheet.place.dimension);
    let mut table = Table::new(&["packed by", "evaluations", "time, s"]);
    (table.head).extend(judges.iter().map(|&judge| judges::name(judge)));
    let rows: Vec<_> = (sheet.rivals())
        .filter(|(point, ..)| point.factor == Factor::Kernel || point.name == DEFAULT)
        .collect();
    let least = |k: usize| {
        let column = rows.iter().map(|(_, figures, _)| figures.judged[k]);
        column.fold(f64::INFINITY, f64::min)
    };
    for (point, figures, _) in &rows {
        let name = if point.name == DEFAULT {
            format!("{} (the default)", judges::name(DENSITY))
        } else {
            point.name.clone()
        };
        let mut row = vec![
            name,
            format!("{}", figures.evaluations),
            format!("{:.2}", figures.seconds),
        ];
        row.extend(figures.judged.iter().enumerate().map(|(k, &error)| {
            let text = format!("{:.3} %", 100.0 * error);
            if error <= least(k) {
                format!("**{text}**")
            } else {
                text
            }
        }));
        table.rows.push(row);
    }
    table
}
