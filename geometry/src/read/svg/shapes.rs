//! The elements that draw: path, polygon, polyline, rect, circle, ellipse.

use std::borrow::Cow;

use kurbo::{BezPath, Point, SvgArc};
use quick_xml::XmlVersion;
use quick_xml::events::BytesStart;

use super::path;
use super::scan::{Scan, length};

/// What an element draws, in its own coordinates; nothing where it is no shape.
pub(super) fn drawn(element: &BytesStart<'_>) -> Result<Option<BezPath>, String> {
    let number = |name: &str| match attribute(element, name)? {
        Some(text) => length(&text).map(Some),
        None => Ok(None),
    };
    let or_zero = |name: &str| number(name).map(|value| value.unwrap_or(0.0));
    Ok(match element.local_name().into_inner() {
        "path" => match attribute(element, "d")? {
            Some(data) => Some(path::parse(&data)?),
            None => None,
        },
        "polygon" => Some(through(element, true)?),
        "polyline" => Some(through(element, false)?),
        "circle" => {
            let radius = or_zero("r")?;
            ellipse([or_zero("cx")?, or_zero("cy")?], [radius; 2])
        }
        "ellipse" => ellipse(
            [or_zero("cx")?, or_zero("cy")?],
            radii(number("rx")?, number("ry")?),
        ),
        "rect" => {
            let size = [or_zero("width")?, or_zero("height")?];
            let [rx, ry] = radii(number("rx")?, number("ry")?);
            let round = [
                rx.min(0.5 * size[0]).max(0.0),
                ry.min(0.5 * size[1]).max(0.0),
            ];
            rectangle([or_zero("x")?, or_zero("y")?], size, round)
        }
        _ => None,
    })
}

/// Half axes, of which one may be left out and is like the other then.
fn radii(rx: Option<f64>, ry: Option<f64>) -> [f64; 2] {
    [rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0)]
}

/// An attribute's value.
pub(super) fn attribute<'a>(
    element: &'a BytesStart<'_>,
    name: &str,
) -> Result<Option<Cow<'a, str>>, String> {
    // Checks for doubled names would take quadratic time.
    for attribute in element.attributes().with_checks(false) {
        let attribute = attribute
            .map_err(|e| format!("an attribute cannot be read ({e}); save the drawing again"))?;
        if attribute.key.into_inner() == name {
            return attribute
                .normalized_value(XmlVersion::Implicit1_0)
                .map(Some)
                .map_err(|e| {
                    format!("the value of {name} cannot be read ({e}); save the drawing again")
                });
        }
    }
    Ok(None)
}

/// Straight lines through an element's points.
fn through(element: &BytesStart<'_>, is_closed: bool) -> Result<BezPath, String> {
    let text = attribute(element, "points")?.unwrap_or_default();
    let mut scan = Scan::new(&text);
    let mut path = BezPath::new();
    scan.skip_space();
    while scan.peek().is_some() {
        let mut number = || {
            let number = scan.number();
            scan.skip_separator();
            number
        };
        let (Some(x), Some(y)) = (number(), number()) else {
            return Err(format!(
                "character {} of a list of points: pairs of numbers are needed; save the drawing again",
                scan.place() + 1
            ));
        };
        if path.elements().is_empty() {
            path.move_to((x, y));
        } else {
            path.line_to((x, y));
        }
    }
    if is_closed && !path.elements().is_empty() {
        path.close_path();
    }
    Ok(path)
}

fn ellipse(center: [f64; 2], radii: [f64; 2]) -> Option<BezPath> {
    let ([x, y], [rx, ry]) = (center, radii);
    if rx <= 0.0 || ry <= 0.0 {
        return None;
    }
    let mut path = BezPath::new();
    let ends = [Point::new(x + rx, y), Point::new(x - rx, y)];
    path.move_to(ends[0]);
    quarter_turns(&mut path, ends[0], ends[1], radii);
    quarter_turns(&mut path, ends[1], ends[0], radii);
    path.close_path();
    Some(path)
}

/// A rectangle with its upper left corner at `corner`, its corners rounded.
fn rectangle(corner: [f64; 2], size: [f64; 2], radii: [f64; 2]) -> Option<BezPath> {
    let ([x, y], [width, height], [rx, ry]) = (corner, size, radii);
    if width <= 0.0 || height <= 0.0 {
        return None;
    }
    let (right, bottom) = (x + width, y + height);
    let mut path = BezPath::new();
    if rx == 0.0 || ry == 0.0 {
        path.move_to((x, y));
        for corner in [(right, y), (right, bottom), (x, bottom)] {
            path.line_to(corner);
        }
    } else {
        let mut now = Point::new(x + rx, y);
        path.move_to(now);
        for (from, to) in [
            ((right - rx, y), (right, y + ry)),
            ((right, bottom - ry), (right - rx, bottom)),
            ((x + rx, bottom), (x, bottom - ry)),
            ((x, y + ry), (x + rx, y)),
        ] {
            let (from, to) = (Point::from(from), Point::from(to));
            if from != now {
                path.line_to(from);
            }
            quarter_turns(&mut path, from, to, radii);
            now = to;
        }
    }
    path.close_path();
    Some(path)
}

/// A part of an upright ellipse, a quarter or a half of it.
fn quarter_turns(path: &mut BezPath, from: Point, to: Point, radii: [f64; 2]) {
    path::arc(
        path,
        SvgArc {
            from,
            to,
            radii: (radii[0], radii[1]).into(),
            x_rotation: 0.0,
            large_arc: false,
            sweep: true,
        },
    );
}
