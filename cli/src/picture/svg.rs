//! A sheet as SVG.

use std::io::{self, Write};

use super::colour::{Colour, INK};
use super::font::{FAMILY, baseline};
use super::marks::{Anchor, Mark, Sheet};

fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A text as XML wants it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// A coordinate in hundredths of a pixel.
fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Writes a sheet.
pub(super) fn write(sheet: &Sheet, to: &mut dyn Write) -> io::Result<()> {
    let (width, height, ink) = (sheet.width, sheet.height, hex(INK));
    writeln!(
        to,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"{FAMILY}\">"
    )?;
    writeln!(
        to,
        "<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>"
    )?;
    for mark in &sheet.marks {
        match mark {
            Mark::Disc {
                center,
                radius,
                fill,
                ring,
            } => {
                // The ring lies inside the rim, a stroke about it.
                let (radius, stroke) = match ring {
                    Some((width, colour)) => (
                        radius - 0.5 * width,
                        format!(
                            " stroke=\"{}\" stroke-width=\"{}\"",
                            hex(*colour),
                            short(*width)
                        ),
                    ),
                    None => (*radius, String::new()),
                };
                writeln!(
                    to,
                    "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"{stroke}/>",
                    short(center[0]),
                    short(center[1]),
                    short(radius),
                    hex(*fill)
                )?;
            }
            Mark::Line {
                points,
                is_closed,
                width,
            } => {
                let path: Vec<String> = points
                    .iter()
                    .map(|[x, y]| format!("{},{}", short(*x), short(*y)))
                    .collect();
                let element = if *is_closed { "polygon" } else { "polyline" };
                writeln!(
                    to,
                    "<{element} points=\"{}\" fill=\"none\" stroke=\"{ink}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>",
                    path.join(" "),
                    short(*width)
                )?;
            }
            Mark::Rectangle {
                from,
                to: corner,
                fill,
            } => writeln!(
                to,
                "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" shape-rendering=\"crispEdges\"/>",
                short(from[0]),
                short(from[1]),
                short(corner[0] - from[0]),
                short(corner[1] - from[1]),
                hex(*fill)
            )?,
            Mark::Text {
                at,
                size,
                anchor,
                text,
            } => {
                let anchor = match anchor {
                    Anchor::Start => "start",
                    Anchor::Middle => "middle",
                };
                writeln!(
                    to,
                    "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{ink}\">{}</text>",
                    short(at[0]),
                    short(baseline(at[1], *size)),
                    short(*size),
                    escaped(text)
                )?;
            }
        }
    }
    writeln!(to, "</svg>")
}
