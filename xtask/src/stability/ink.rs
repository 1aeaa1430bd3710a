//! Colours of classes of numbers, their legend, and tiles in these colours.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sphpack::picture::text_width;

use crate::drawing;

/// Classes of a number: below which bound, in which colour, in which words; the last has all that is left.
pub(super) struct Shades {
    pub(super) title: &'static str,
    pub(super) classes: &'static [(f64, &'static str, &'static str)],
}

/// Of a least eigenvalue over the greatest: from dark to light orange where it is negative, blue where it is not. Told apart by
/// lightness too, so that nobody needs to see red or green.
pub(super) const STABILITY: Shades = Shades {
    title: "least eigenvalue over the greatest",
    classes: &[
        (-1e-1, "#4d0f00", "below −0.1"),
        (-1e-2, "#b33000", "−0.1 … −0.01"),
        (-1e-3, "#ef7b3c", "−0.01 … −0.001"),
        (-1e-4, "#fbb884", "−10⁻³ … −10⁻⁴"),
        (-1e-9, "#fee6cf", "−10⁻⁴ … 0"),
        (f64::INFINITY, "#a9cfe8", "stable"),
    ],
};

/// Of the least eigenvalue of one wave over the greatest of all.
pub(super) const WAVES: Shades = Shades {
    title: "least eigenvalue of the wave over the greatest of all",
    classes: &[
        (-1e-1, "#4d0f00", "below −0.1"),
        (-1e-2, "#b33000", "−0.1 … −0.01"),
        (-1e-3, "#ef7b3c", "−0.01 … −0.001"),
        (-1e-9, "#fbb884", "−0.001 … 0"),
        (0.01, "#e3f0f8", "0 … 0.01"),
        (0.1, "#a9cfe8", "0.01 … 0.1"),
        (0.3, "#5f9fcb", "0.1 … 0.3"),
        (f64::INFINITY, "#1f5f94", "above 0.3"),
    ],
};

/// Of a part in pairs.
pub(super) const PAIRED: Shades = Shades {
    title: "particles with another nearer than ∆s/2",
    classes: &[
        (1e-12, "#a9cfe8", "none"),
        (0.01, "#fee6cf", "below 1 %"),
        (0.1, "#fbb884", "1 … 10 %"),
        (0.5, "#ef7b3c", "10 … 50 %"),
        (0.9, "#b33000", "50 … 90 %"),
        (f64::INFINITY, "#4d0f00", "90 % and more"),
    ],
};

impl Shades {
    fn colour(&self, value: f64) -> &'static str {
        (self.classes.iter())
            .find(|(bound, _, _)| value < *bound)
            .map_or("#ffffff", |(_, colour, _)| colour)
    }

    /// A line of boxes with their words, wrapped where it is wider than `width`; gives the height that it takes.
    pub(super) fn legend(&self, out: &mut String, at: [f64; 2], width: f64) -> f64 {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\">{}</text>",
            at[0], at[1], self.title
        );
        let (mut x, mut y) = (at[0], at[1] + 10.0);
        for (_, colour, words) in self.classes {
            let room = 38.0 + text_width(words, 13.0);
            if x + room > at[0] + width {
                (x, y) = (at[0], y + 20.0);
            }
            let _ = writeln!(
                out,
                "<rect x=\"{x:.0}\" y=\"{y:.0}\" width=\"16\" height=\"13\" fill=\"{colour}\"/><text x=\"{:.0}\" y=\"{:.0}\">{words}</text>",
                x + 21.0,
                y + 11.0
            );
            x += room;
        }
        y + 20.0 - at[1]
    }
}

/// A grid of values as tiles, the first row on top; runs of one colour are one tile.
pub(super) fn tiles(
    out: &mut String,
    corner: [f64; 2],
    tile: [f64; 2],
    rows: &[Vec<f64>],
    shades: &Shades,
) {
    let mut paths: BTreeMap<&str, String> = BTreeMap::new();
    for (row, values) in rows.iter().enumerate() {
        let y = corner[1] + row as f64 * tile[1];
        let mut from = 0;
        while from < values.len() {
            let colour = shades.colour(values[from]);
            let run = (values[from..].iter())
                .take_while(|value| shades.colour(**value) == colour)
                .count();
            let (x, width) = (corner[0] + from as f64 * tile[0], run as f64 * tile[0]);
            let path = paths.entry(colour).or_default();
            // Writing to a string cannot fail.
            let _ = write!(
                path,
                "M{x:.1} {y:.1}h{width:.1}v{:.1}h-{width:.1}z",
                tile[1]
            );
            from += run;
        }
    }
    for (colour, path) in paths {
        let _ = writeln!(
            out,
            "<path fill=\"{colour}\" shape-rendering=\"crispEdges\" d=\"{path}\"/>"
        );
    }
}

/// A number with two digits, and no sign where it is nought.
pub(super) fn digits(value: f64) -> String {
    let rounded = (100.0 * value).round() / 100.0;
    format!("{:.2}", if rounded == 0.0 { 0.0 } else { rounded }).replace('-', "−")
}

/// The head of a picture.
pub(super) fn begin(width: f64, height: f64, title: &str) -> String {
    let head = drawing::begin(width, height);
    format!("{head}<text x=\"16\" y=\"24\" font-size=\"16\">{title}</text>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_the_colour_of_its_class() {
        assert_eq!(STABILITY.colour(-0.2), "#4d0f00");
        assert_eq!(STABILITY.colour(-1e-5), "#fee6cf");
        assert_eq!(STABILITY.colour(-1e-12), "#a9cfe8");
        assert_eq!(PAIRED.colour(0.0), "#a9cfe8");
        assert_eq!(PAIRED.colour(1.0), "#4d0f00");
    }

    #[test]
    fn nought_has_no_sign() {
        assert_eq!(digits(-0.001), "0.00");
        assert_eq!(digits(-1.239), "−1.24");
    }

    #[test]
    fn runs_are_one_tile() {
        let mut out = String::new();
        tiles(
            &mut out,
            [10.0, 20.0],
            [2.0, 5.0],
            &[vec![1.0, 1.0, -1.0]],
            &STABILITY,
        );
        assert!(out.contains("M10.0 20.0h4.0v5.0h-4.0z"), "{out}");
        assert!(out.contains("M14.0 20.0h2.0v5.0h-2.0z"), "{out}");
    }
}
