//! A map as a picture: a tile for every scene, its colour and sign the outcome, a number the density's deviation.

use std::fmt::Write as _;

use sphpack::picture::text_width;

use super::edges::Grid;
use super::outcome::{APART, Cell, EVEN, Outcome};
use super::panel::Panel;
use crate::drawing;

/// Of letters.
const SIZE: f64 = 12.0;

const TILE: [f64; 2] = [30.0, 20.0];
const LEFT: f64 = 190.0;
const TOP: f64 = 118.0;
/// Below a panel, for the axis.
const BELOW: f64 = 78.0;
/// Above a panel, for its title.
const ABOVE: f64 = 26.0;

/// Fill, colour of the sign, sign: told apart by lightness and sign too, so that nobody needs to see red or green.
fn ink(outcome: Outcome) -> [&'static str; 3] {
    match outcome {
        Outcome::Passes => ["#a9cfe8", "#123", ""],
        Outcome::Degraded => ["#fbb884", "#310", ""],
        Outcome::Refused => ["#ebebeb", "#666", "–"],
        Outcome::Said => ["#9a9a9a", "#fff", "said"],
        Outcome::Fails => ["#4d0f00", "#fff", "✕"],
    }
}

/// What stands in a tile: the number that its colour is for.
fn sign(cell: &Cell) -> String {
    let [.., sign] = ink(cell.outcome);
    let Some(linf) = cell.linf.filter(|_| sign.is_empty()) else {
        return sign.to_owned();
    };
    match cell.closest {
        _ if cell.outcome == Outcome::Passes || linf > EVEN => {}
        Some(closest) if closest < APART => return format!("p.{:02.0}", 100.0 * closest),
        _ => return "out".to_owned(),
    }
    let percent = 100.0 * linf;
    let digits = if percent < 0.095 {
        2
    } else {
        usize::from(percent < 9.95)
    };
    format!("{percent:.digits$}")
}

/// Panels below each other.
pub(super) fn svg(title: &str, panels: &[(&Panel, Grid)]) -> String {
    let columns = panels.iter().map(|(panel, _)| panel.x.count()).max();
    let width = (LEFT + TILE[0] * columns.unwrap_or(0) as f64 + 24.0).max(780.0);
    let rows: usize = panels.iter().map(|(panel, _)| panel.y.count()).sum();
    let height = TOP + TILE[1] * rows as f64 + (ABOVE + BELOW) * panels.len() as f64;
    let mut out = drawing::begin(width, height);
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "<g font-size=\"{SIZE}\">\n<text x=\"16\" y=\"24\" font-size=\"16\">{title}</text>"
    );
    legend(&mut out);
    let mut y = TOP;
    for (panel, grid) in panels {
        draw(&mut out, panel, grid, y + ABOVE);
        y += ABOVE + BELOW + TILE[1] * panel.y.count() as f64;
    }
    out.push_str("</g>\n</svg>\n");
    out
}

fn legend(out: &mut String) {
    let mut x = 16.0;
    for outcome in Outcome::ALL {
        let [fill, colour, sign] = ink(outcome);
        let sign = if sign.is_empty() { "0.4" } else { sign };
        let words = outcome.words();
        let _ = writeln!(
            out,
            "<rect x=\"{x:.0}\" y=\"38\" width=\"28\" height=\"18\" fill=\"{fill}\"/><text x=\"{:.0}\" y=\"51\" font-size=\"10\" text-anchor=\"middle\" fill=\"{colour}\">{sign}</text><text x=\"{:.0}\" y=\"51\">{words}</text>",
            x + 14.0,
            x + 34.0
        );
        x += 54.0 + text_width(words, SIZE);
    }
    let _ = writeln!(
        out,
        "<text x=\"16\" y=\"76\" fill=\"#444\">0.4: L∞, the largest deviation of the density, in %. p.55: a pair 0.55 ∆s apart. out: a part without particles, with a warning.</text>\n\
         <text x=\"16\" y=\"93\" fill=\"#444\">Passes: right, L∞ at most 1 %, pairs at least 0.6 ∆s apart, nothing left out. Degraded: right, but not that. White: not run.</text>"
    );
}

fn draw(out: &mut String, panel: &Panel, grid: &Grid, top: f64) {
    let [columns, rows] = [panel.x.count(), panel.y.count()];
    let x = |column: usize| LEFT + TILE[0] * column as f64;
    // The first y is below, as on any axis; words are read from above.
    let is_listed = matches!(panel.y.ticks, super::panel::Ticks::Words(_));
    let y = |row: usize| {
        let line = if is_listed { row } else { rows - 1 - row };
        top + TILE[1] * line as f64
    };
    let _ = writeln!(
        out,
        "<text x=\"{LEFT}\" y=\"{:.0}\" font-weight=\"bold\">{}</text>",
        top - 8.0,
        panel.title
    );
    for (row, cells) in grid.iter().enumerate() {
        for (column, cell) in cells.iter().enumerate() {
            let Some(cell) = cell else { continue };
            let [fill, colour, _] = ink(cell.outcome);
            let _ = writeln!(
                out,
                "<rect x=\"{:.0}\" y=\"{:.0}\" width=\"{}\" height=\"{}\" fill=\"{fill}\" stroke=\"white\"/><text x=\"{:.1}\" y=\"{:.1}\" font-size=\"9\" text-anchor=\"middle\" fill=\"{colour}\">{}</text>",
                x(column),
                y(row),
                TILE[0],
                TILE[1],
                x(column) + 0.5 * TILE[0],
                y(row) + 13.5,
                sign(cell)
            );
        }
        let _ = writeln!(
            out,
            "<text x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            LEFT - 8.0,
            y(row) + 14.5,
            panel.y.word(row)
        );
    }
    let floor = top + TILE[1] * rows as f64;
    for column in 0..columns {
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.0}\" font-size=\"10\" text-anchor=\"middle\">{}</text>",
            x(column) + 0.5 * TILE[0],
            floor + 14.0,
            panel.x.word(column)
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{:.1}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>",
        LEFT + 0.5 * TILE[0] * columns as f64,
        floor + 34.0,
        panel.x.label
    );
    let _ = writeln!(
        out,
        "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"end\">{}</text>",
        LEFT - 8.0,
        top - 8.0,
        panel.y.label
    );
}

#[cfg(test)]
mod tests {
    use super::super::table::MAPS;
    use super::*;

    #[test]
    fn every_scene_has_a_tile_with_its_number() {
        let panel = &MAPS[0].panels[0];
        let cell = |linf, outcome| Cell {
            outcome,
            linf: Some(linf),
            closest: None,
            why: String::new(),
            seconds: 0.0,
        };
        assert_eq!(sign(&cell(0.0004, Outcome::Passes)), "0.04");
        assert_eq!(sign(&cell(0.0123, Outcome::Passes)), "1.2");
        assert_eq!(sign(&cell(0.123, Outcome::Degraded)), "12");
        assert_eq!(sign(&cell(0.9, Outcome::Fails)), "✕");
        let mut near = cell(0.001, Outcome::Degraded);
        assert_eq!(sign(&near), "out");
        near.closest = Some(0.553);
        assert_eq!(sign(&near), "p.55");
        let grid =
            vec![vec![Some(cell(0.05, Outcome::Degraded)); panel.x.count()]; panel.y.count()];
        let text = svg("Corners", &[(panel, grid)]);
        let document = roxmltree::Document::parse(&text).expect("a picture");
        let tiles = document
            .descendants()
            .filter(|node| node.is_element() && node.text() == Some("5.0"));
        assert_eq!(tiles.count(), panel.x.count() * panel.y.count());
    }
}
