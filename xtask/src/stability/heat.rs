//! Heat maps over h/∆s: one panel each, a row for every lattice or kernel.

use std::fmt::Write as _;

use super::ink::{Shades, begin, tiles};

/// A panel, with a row for each name.
pub(super) struct Panel {
    pub(super) title: String,
    pub(super) rows: Vec<(String, Vec<f64>)>,
    /// Numbers of a row and of columns of it that a line below marks.
    pub(super) marked: Vec<(usize, Vec<bool>)>,
}

const LEFT: f64 = 110.0;
const WIDTH: f64 = 640.0;
const ROW: f64 = 17.0;

/// The panels below each other, over the same h/∆s.
pub(super) fn svg(title: &str, hs: &[f64], panels: &[Panel], shades: &Shades) -> String {
    let rows: usize = panels.iter().map(|panel| panel.rows.len()).sum();
    let height = 96.0 + rows as f64 * ROW + 54.0 * panels.len() as f64;
    let width = LEFT + WIDTH + 30.0;
    let mut out = begin(width, height, title);
    let mut y = 50.0;
    y += shades.legend(&mut out, [16.0, y], width - 32.0) + 18.0;
    let step = if hs.len() > 1 { hs[1] - hs[0] } else { 1.0 };
    let tile = WIDTH / hs.len() as f64;
    // A tile is about its h/∆s.
    let x = |h: f64| LEFT + ((h - hs[0]) / step + 0.5) * tile;
    for panel in panels {
        let values: Vec<Vec<f64>> = panel.rows.iter().map(|(_, row)| row.clone()).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<text x=\"{LEFT}\" y=\"{:.1}\" font-weight=\"bold\">{}</text>",
            y - 6.0,
            panel.title
        );
        tiles(&mut out, [LEFT, y], [tile, ROW], &values, shades);
        for (row, (name, _)) in panel.rows.iter().enumerate() {
            let at = y + ROW * row as f64;
            let _ = writeln!(
                out,
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text><path d=\"M{LEFT} {at:.1}h{WIDTH}\" stroke=\"white\"/>",
                LEFT - 8.0,
                at + 13.0
            );
        }
        for (row, marks) in &panel.marked {
            let at = y + ROW * (*row as f64 + 1.0) - 2.5;
            let mut way = String::new();
            let mut from = 0;
            while from < marks.len() {
                let run = marks[from..]
                    .iter()
                    .take_while(|m| **m == marks[from])
                    .count();
                if marks[from] {
                    let _ = write!(
                        way,
                        "M{:.1} {at:.1}h{:.1}",
                        LEFT + from as f64 * tile,
                        run as f64 * tile
                    );
                }
                from += run;
            }
            let _ = writeln!(
                out,
                "<path d=\"{way}\" stroke=\"black\" stroke-width=\"3\"/>"
            );
        }
        let floor = y + ROW * panel.rows.len() as f64;
        for tenths in 0..=30 {
            let h = f64::from(tenths) / 10.0;
            if h >= hs[0] - 1e-9 && h <= hs[hs.len() - 1] + 1e-9 {
                let long = tenths % 2 == 0;
                let _ = writeln!(
                    out,
                    "<path d=\"M{:.1} {floor:.1}v{}\" stroke=\"#333\"/>",
                    x(h),
                    if long { 6 } else { 3 }
                );
                if long {
                    let _ = writeln!(
                        out,
                        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{h:.1}</text>",
                        x(h),
                        floor + 19.0
                    );
                }
            }
        }
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">h/∆s</text>",
            LEFT - 8.0,
            floor + 19.0
        );
        y = floor + 54.0;
    }
    out.push_str("</svg>\n");
    out
}
