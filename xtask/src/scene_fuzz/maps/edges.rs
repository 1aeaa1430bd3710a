//! Where a map's edges lie, in sentences that are computed from its cells.

use super::outcome::{Cell, Outcome};
use super::panel::{Panel, Ticks};

/// Rows of cells, the first y first.
pub(super) type Grid = Vec<Vec<Option<Cell>>>;

/// What people want to know of a panel.
pub(super) fn sentences(panel: &Panel, grid: &Grid) -> String {
    let cells = || grid.iter().flatten().flatten();
    let all = cells().count();
    if all == 0 {
        return "no scene of it is small enough for this method.".to_owned();
    }
    let counts: Vec<String> = (Outcome::ALL.into_iter())
        .map(|outcome| {
            (
                cells().filter(|cell| cell.outcome == outcome).count(),
                outcome,
            )
        })
        .filter(|(count, _)| *count > 0)
        .map(|(count, outcome)| format!("{}: {count}", outcome.words()))
        .collect();
    let mut text = format!("{all} scenes, {}.", counts.join("; "));
    let passes = |cell: &Cell| cell.outcome == Outcome::Passes;
    let holds = |cell: &Cell| matches!(cell.outcome, Outcome::Passes | Outcome::Degraded);
    let label = panel.x.label;
    match common(panel, grid, passes) {
        Some(range) if range[0] < range[1] => {
            text += &format!(
                " Every row passes with {label}: {}.",
                range_words(panel, range)
            );
        }
        _ => text += &best_rows(panel, grid, passes),
    }
    match common(panel, grid, holds) {
        Some(range) if Some(range) != common(panel, grid, passes) => {
            text += &format!(" No worse than degraded: {}.", range_words(panel, range));
        }
        _ => {}
    }
    let most = |of: fn(&Cell) -> Option<f64>, sign: f64| {
        let values = cells().filter(|cell| passes(cell)).filter_map(of);
        sign * values
            .map(|value| sign * value)
            .fold(f64::NEG_INFINITY, f64::max)
    };
    if cells().any(passes) {
        text += &format!(
            " Of those that pass, L∞ is {:.2} to {:.2} %, the closest pair {:.2} ∆s.",
            100.0 * most(|cell| cell.linf, -1.0),
            100.0 * most(|cell| cell.linf, 1.0),
            most(|cell| cell.closest, -1.0)
        );
    }
    text
}

/// The places of x around the home in which it holds, of one row.
fn range(panel: &Panel, row: &[Option<Cell>], holds: impl Fn(&Cell) -> bool) -> Option<[usize; 2]> {
    let home = panel.x.place(panel.home)?;
    let is = |place: usize| row[place].as_ref().is_none_or(&holds);
    if !is(home) {
        return None;
    }
    let first = (0..=home).rev().take_while(|place| is(*place)).last()?;
    let last = (home..row.len()).take_while(|place| is(*place)).last()?;
    Some([first, last])
}

/// The places of x around the home in which it holds in all rows.
fn common(panel: &Panel, grid: &Grid, holds: impl Fn(&Cell) -> bool) -> Option<[usize; 2]> {
    let mut all = [0, panel.x.count() - 1];
    for row in grid {
        let [first, last] = range(panel, row, &holds)?;
        all = [all[0].max(first), all[1].min(last)];
    }
    Some(all)
}

/// Rows in which it holds somewhere, those of one range together.
fn best_rows(panel: &Panel, grid: &Grid, holds: impl Fn(&Cell) -> bool) -> String {
    let mut groups: Vec<([usize; 2], Vec<usize>)> = Vec::new();
    for (y, row) in grid.iter().enumerate() {
        let Some(range) = range(panel, row, &holds) else {
            continue;
        };
        match groups.iter_mut().find(|(other, _)| *other == range) {
            Some((_, rows)) => rows.push(y),
            None => groups.push((range, vec![y])),
        }
    }
    if groups.is_empty() {
        let home = super::panel::number(panel.home);
        return format!(" At {home} {} nothing passes.", panel.x.label);
    }
    let parts: Vec<String> = (groups.iter())
        .map(|(range, rows)| {
            format!(
                "{} ({})",
                range_words(panel, *range),
                row_words(panel, rows)
            )
        })
        .collect();
    format!(" Passes, {}: {}.", panel.x.label, parts.join("; "))
}

/// The names of rows; of numbers that follow each other the first and the last.
fn row_words(panel: &Panel, rows: &[usize]) -> String {
    let [first, last] = [rows[0], rows[rows.len() - 1]];
    let are_numbers = matches!(panel.y.ticks, Ticks::Numbers(_));
    if are_numbers && rows.len() > 2 && last - first + 1 == rows.len() {
        return format!("{} to {}", panel.y.word(first), panel.y.word(last));
    }
    let names: Vec<String> = rows.iter().map(|row| panel.y.word(*row)).collect();
    names.join(", ")
}

/// "from 2 to 6", or from or up to one of them where the other is the axis's end.
fn range_words(panel: &Panel, [first, last]: [usize; 2]) -> String {
    let is_whole = [first == 0, last + 1 == panel.x.count()];
    let (from, to) = (panel.x.word(first), panel.x.word(last));
    match is_whole {
        _ if first == last => format!("at {from} only"),
        [true, true] => format!("all of {from} to {to}"),
        [true, false] => format!("up to {to}"),
        [false, true] => format!("from {from}"),
        [false, false] => format!("from {from} to {to}"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::table::MAPS;
    use super::*;

    fn cell(outcome: Outcome) -> Option<Cell> {
        Some(Cell {
            outcome,
            linf: Some(0.01),
            closest: Some(0.8),
            why: String::new(),
            seconds: 0.1,
        })
    }

    #[test]
    fn edges_are_found_from_the_home_outward() {
        let panel = &MAPS[2].panels[0];
        let count = panel.x.count();
        let row = |from: usize| -> Vec<Option<Cell>> {
            (0..count)
                .map(|x| {
                    // One that passes by chance, below the edge, is none.
                    let passes = x >= from || x == 1;
                    cell(if passes {
                        Outcome::Passes
                    } else {
                        Outcome::Degraded
                    })
                })
                .collect()
        };
        let said = sentences(panel, &vec![row(10), row(12)]);
        let edge = panel.x.word(12);
        assert!(
            said.contains(&format!(
                "Every row passes with {}: from {edge}.",
                panel.x.label
            )),
            "{said}"
        );
        assert!(said.contains("No worse than degraded: all of"), "{said}");
        let mut rows = vec![row(10), row(12)];
        rows[0][count - 1] = cell(Outcome::Fails);
        let said = sentences(panel, &rows);
        assert!(said.contains(&format!("from {edge} (5)")), "{said}");
    }
}
