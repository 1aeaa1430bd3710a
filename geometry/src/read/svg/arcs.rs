//! Arcs as cubic pieces that are exact enough: what resolves the drawing would take coarse ones.

use std::fmt::Write as _;
use std::ops::Range;
use std::str::FromStr;

use kurbo::{Arc, Point, SvgArc, Vec2};
use roxmltree::Node;
use svgtypes::{LengthUnit, PathParser, PathSegment};

/// How far the cubic pieces of an arc may be from it, in parts of its larger radius.
const ARC_OVER_RADIUS: f64 = 3e-7;

/// A short arc whose radius is larger than this, over the distance of its ends, is a straight line for every purpose.
const FLAT: f64 = 1e6;

/// A long arc of such a radius would be a circle that no number of 64 bits can close.
const CIRCLE: f64 = 1e9;

/// A part of the text, and what it becomes.
pub(super) type Edit = (Range<usize>, String);

/// The edits that make a shape one without arcs. `styles` are the drawing's style sheets: a shape that they name stays.
pub(super) fn without_arcs(node: Node<'_, '_>, text: &str, styles: &str, edits: &mut Vec<Edit>) {
    let tag = node.tag_name().name();
    if tag == "path" {
        let data = node.attribute_node("d").filter(|a| a.namespace().is_none());
        if let Some(data) = data
            && let Some(path) = cubic(data.value())
        {
            edits.push((data.range(), format!("d=\"{path}\"")));
        }
        return;
    }
    let path = match tag {
        "circle" | "ellipse" => ellipse(node),
        "rect" => rounded(node),
        _ => None,
    };
    let Some(path) = path.filter(|_| !styles.contains(tag) && !node.has_attribute("d")) else {
        return;
    };
    // The tags' names, with a prefix perhaps.
    let Range { start, end } = node.range();
    let element = text.get(start..end).unwrap_or_default();
    let Some(name_at) = element.find(tag) else {
        return;
    };
    let after = name_at + tag.len();
    if !element.ends_with("/>") {
        let Some(at) = element.rfind("</").and_then(|close| {
            let name = element[close..].find(tag)?;
            Some(start + close + name)
        }) else {
            return;
        };
        edits.push((at..at + tag.len(), "path".into()));
    }
    edits.push((start + name_at..start + after, format!("path d=\"{path}\"")));
}

/// Path data with cubic pieces for its arcs; `None` where it has none.
fn cubic(data: &str) -> Option<String> {
    if !data.contains(['a', 'A']) {
        return None;
    }
    let mut text = String::with_capacity(data.len());
    let (mut now, mut start) = (Point::ORIGIN, Point::ORIGIN);
    let mut follows_arc = false;
    for segment in PathParser::from(data) {
        let segment = segment.ok()?;
        let from = if segment.is_abs() { Point::ORIGIN } else { now };
        let at = |x: f64, y: f64| from + Vec2::new(x, y);
        let is_arc = matches!(segment, PathSegment::EllipticalArc { .. });
        let mut put = |letter: char, points: &[Point]| {
            text.push(letter);
            for p in points {
                let _ = write!(text, "{:e} {:e} ", p.x, p.y);
            }
            points.last().copied()
        };
        let to = match segment {
            PathSegment::MoveTo { x, y, .. } => {
                start = at(x, y);
                put('M', &[start])
            }
            PathSegment::LineTo { x, y, .. } => put('L', &[at(x, y)]),
            PathSegment::HorizontalLineTo { x, .. } => put('L', &[Point::new(from.x + x, now.y)]),
            PathSegment::VerticalLineTo { y, .. } => put('L', &[Point::new(now.x, from.y + y)]),
            PathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
                ..
            } => put('C', &[at(x1, y1), at(x2, y2), at(x, y)]),
            // After an arc it starts straight on, not mirrored.
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } if follows_arc => {
                put('C', &[now, at(x2, y2), at(x, y)])
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => put('S', &[at(x2, y2), at(x, y)]),
            PathSegment::Quadratic { x1, y1, x, y, .. } => put('Q', &[at(x1, y1), at(x, y)]),
            PathSegment::SmoothQuadratic { x, y, .. } => put('T', &[at(x, y)]),
            PathSegment::EllipticalArc {
                rx,
                ry,
                x_axis_rotation,
                large_arc,
                sweep,
                x,
                y,
                ..
            } => {
                let to = at(x, y);
                let arc = SvgArc {
                    from: now,
                    to,
                    radii: Vec2::new(rx, ry),
                    x_rotation: x_axis_rotation.to_radians(),
                    large_arc,
                    sweep,
                };
                put_arc(&mut text, arc);
                Some(to)
            }
            PathSegment::ClosePath { .. } => {
                text.push('Z');
                Some(start)
            }
        };
        now = to.unwrap_or(now);
        follows_arc = is_arc;
    }
    Some(text)
}

/// Writes an elliptical arc as cubic pieces. It is worked out for ends that are 1 apart, where no number over- or
/// underflows.
fn put_arc(text: &mut String, arc: SvgArc) {
    let chord = arc.to - arc.from;
    let size = chord.hypot();
    let radii = arc.radii / size;
    let most = if arc.large_arc { CIRCLE } else { FLAT };
    let fits = |radius: f64| radius.abs() < most;
    let is_curved = size > 0.0 && size.is_finite() && fits(radii.x) && fits(radii.y);
    let unit = SvgArc {
        from: Point::ORIGIN,
        to: (chord / size).to_point(),
        radii,
        ..arc
    };
    let mut pieces = Vec::new();
    if let Some(curve) = is_curved.then(|| Arc::from_svg_arc(&unit)).flatten() {
        let tolerance = ARC_OVER_RADIUS * curve.radii.x.max(curve.radii.y);
        curve.to_cubic_beziers(tolerance, |a, b, c| pieces.push([a, b, c]));
    }
    let Some(last) = pieces.len().checked_sub(1) else {
        let _ = write!(text, "L{:e} {:e} ", arc.to.x, arc.to.y);
        return;
    };
    for (k, piece) in pieces.into_iter().enumerate() {
        let [a, b, mut c] = piece.map(|p| arc.from + p.to_vec2() * size);
        if k == last {
            // The next command starts exactly here.
            c = arc.to;
        }
        text.push('C');
        for p in [a, b, c] {
            let _ = write!(text, "{:e} {:e} ", p.x, p.y);
        }
    }
}

fn ellipse(node: Node<'_, '_>) -> Option<String> {
    let [x, y] = [
        length(node, "cx")?.unwrap_or(0.0),
        length(node, "cy")?.unwrap_or(0.0),
    ];
    let [rx, ry] = if node.tag_name().name() == "circle" {
        [length(node, "r")??; 2]
    } else {
        radii(node)?
    };
    let half = |from: f64, to: f64| SvgArc {
        from: Point::new(from, y),
        to: Point::new(to, y),
        radii: Vec2::new(rx, ry),
        x_rotation: 0.0,
        large_arc: false,
        sweep: true,
    };
    if !(rx > 0.0 && ry > 0.0) {
        return None;
    }
    let mut text = format!("M{:e} {y:e}", x + rx);
    put_arc(&mut text, half(x + rx, x - rx));
    put_arc(&mut text, half(x - rx, x + rx));
    text.push('Z');
    Some(text)
}

/// A rectangle with round corners.
fn rounded(node: Node<'_, '_>) -> Option<String> {
    let [x, y] = [
        length(node, "x")?.unwrap_or(0.0),
        length(node, "y")?.unwrap_or(0.0),
    ];
    let [width, height] = [length(node, "width")??, length(node, "height")??];
    let [rx, ry] = radii(node)?;
    let [rx, ry] = [rx.min(0.5 * width), ry.min(0.5 * height)];
    if !(rx > 0.0 && ry > 0.0) {
        return None;
    }
    let (right, bottom) = (x + width, y + height);
    let mut text = format!("M{:e} {y:e}", x + rx);
    for (from, to) in [
        ((right - rx, y), (right, y + ry)),
        ((right, bottom - ry), (right - rx, bottom)),
        ((x + rx, bottom), (x, bottom - ry)),
        ((x, y + ry), (x + rx, y)),
    ] {
        let _ = write!(text, "L{:e} {:e} ", from.0, from.1);
        put_arc(
            &mut text,
            SvgArc {
                from: from.into(),
                to: to.into(),
                radii: Vec2::new(rx, ry),
                x_rotation: 0.0,
                large_arc: false,
                sweep: true,
            },
        );
    }
    text.push('Z');
    Some(text)
}

/// Half axes, of which one may be left out and is like the other then.
fn radii(node: Node<'_, '_>) -> Option<[f64; 2]> {
    let [rx, ry] = [length(node, "rx")?, length(node, "ry")?];
    Some([rx.or(ry)?, ry.or(rx)?])
}

/// A length without a unit; `None` for others, `Some(None)` where there is none.
fn length(node: Node<'_, '_>, name: &str) -> Option<Option<f64>> {
    let Some(text) = node.attribute(name).filter(|text| *text != "auto") else {
        return Some(None);
    };
    let length = svgtypes::Length::from_str(text.trim()).ok()?;
    matches!(length.unit, LengthUnit::None | LengthUnit::Px).then_some(Some(length.number))
}
