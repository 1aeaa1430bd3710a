//! What SVGs that tasks draw have in common: white paper, the typeface of the command's own pictures, and marks of points.

use std::fmt::Write as _;

use sphpack::picture::FONT_FAMILY;

/// Marks around a point, as data of a path: told apart in print, and by who does not see red or green.
pub(crate) const CIRCLE: &str = "M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0-9 0";
pub(crate) const SQUARE: &str = "M-4-4h8v8h-8z";
pub(crate) const DIAMOND: &str = "M0-5.6L4.6 0L0 5.6L-4.6 0z";
pub(crate) const UP: &str = "M0-5.2L4.8 3.6H-4.8z";
pub(crate) const DOWN: &str = "M0 5.2L4.8-3.6H-4.8z";

/// An open picture of a size in pixels; whoever calls closes it.
pub(crate) fn begin(width: f64, height: f64) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"{FONT_FAMILY}\" font-size=\"13\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    )
}

/// A text that begins at a place, with a white rim, so that lines behind it do not cross it out. The rim is a text of its own: not
/// every viewer knows how to paint it below the letters of the same.
pub(crate) fn rimmed(out: &mut String, [x, y]: [f64; 2], size: f64, text: &str) {
    for rim in [" stroke=\"white\" stroke-width=\"3\"", ""] {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\"{rim}>{text}</text>"
        );
    }
}
