//! Outlines from SVG drawings.

mod flatten;
mod path;
mod scan;
mod shapes;
mod transform;

use kurbo::{Affine, BezPath};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use self::shapes::attribute;
use super::lines::{row, whole, without_mark};
use crate::GeometryError;

pub use self::flatten::FLATTENING_OVER_SIZE;

/// A shape, where the file draws it.
struct Drawn {
    line: usize,
    path: BezPath,
}

/// What an element passes on to those within it.
#[derive(Clone, Copy)]
struct Inherited {
    place: Affine,
    is_hidden: bool,
}

/// Elements whose content is not drawn where it stands, or holds no shapes.
const HIDDEN: [&str; 14] = [
    "defs",
    "symbol",
    "clipPath",
    "mask",
    "pattern",
    "marker",
    "linearGradient",
    "radialGradient",
    "filter",
    "metadata",
    "title",
    "desc",
    "text",
    "foreignObject",
];

/// Every closed subpath, y up.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Vec<[f64; 2]>>, GeometryError> {
    let text = std::str::from_utf8(without_mark(bytes)).map_err(|e| {
        row(
            line_of(bytes, e.valid_up_to()),
            "this is not UTF-8; save the drawing in that encoding",
        )
    })?;
    let mut shapes: Vec<Drawn> = Vec::new();
    // What the elements that are open pass on.
    let mut open: Vec<Inherited> = Vec::new();
    // A drawing's y points down.
    let outer = Inherited {
        place: Affine::FLIP_Y,
        is_hidden: false,
    };
    let mut lines = LineCount::default();
    let mut reader = Reader::from_str(text);
    loop {
        let before = reader.buffer_position();
        let event = reader.read_event().map_err(|e| {
            row(
                line_of(text.as_bytes(), reader.error_position() as usize),
                format!("the drawing is damaged ({e}); save it again"),
            )
        })?;
        let (element, is_empty) = match &event {
            Event::Start(element) => (element, false),
            Event::Empty(element) => (element, true),
            Event::End(_) => {
                open.pop();
                continue;
            }
            Event::Eof => break,
            _ => continue,
        };
        let above = open.last().copied().unwrap_or(outer);
        let mut within = above;
        if !above.is_hidden {
            let line = lines.at(text, before as usize);
            within = inherit(element, above, !open.is_empty()).map_err(|e| row(line, e))?;
            if !within.is_hidden
                && let Some(mut path) = shapes::drawn(element).map_err(|e| row(line, e))?
            {
                path.apply_affine(within.place);
                shapes.push(Drawn { line, path });
            }
        }
        if !is_empty {
            open.push(within);
        }
    }
    if !open.is_empty() {
        return Err(whole(
            "the drawing ends within an element: it is cut off, save it again",
        ));
    }
    let loops = flatten::loops(&shapes, bytes.len())?;
    if loops.is_empty() {
        return Err(whole(
            "the drawing holds no closed paths; draw the outline as a path and close it (text must be turned into paths)",
        ));
    }
    Ok(loops)
}

/// What an element passes on, or why it cannot be read.
fn inherit(
    element: &BytesStart<'_>,
    above: Inherited,
    is_within: bool,
) -> Result<Inherited, String> {
    let name = element.local_name();
    let name = name.into_inner();
    match name {
        "use" => {
            return Err(
                "a clone (<use>) is not read; unlink it in the drawing (Inkscape: Edit, Clone, Unlink)"
                    .into(),
            );
        }
        "svg" if is_within => {
            return Err("a drawing within the drawing (<svg>) is not read; ungroup it".into());
        }
        _ => {}
    }
    let has = |name: &str, value: &str| -> Result<bool, String> {
        Ok(attribute(element, name)?.is_some_and(|text| text.trim() == value))
    };
    let styled = attribute(element, "style")?.is_some_and(|style| {
        style
            .split(';')
            .filter_map(|rule| rule.split_once(':'))
            .any(|(key, value)| key.trim() == "display" && value.trim() == "none")
    });
    let is_hidden = HIDDEN.contains(&name) || styled || has("display", "none")?;
    let place = match attribute(element, "transform")? {
        Some(text) if !is_hidden => above.place * transform::parse(&text)?,
        _ => above.place,
    };
    Ok(Inherited { place, is_hidden })
}

/// The line of a byte, counted from 1.
fn line_of(bytes: &[u8], offset: usize) -> usize {
    1 + bytes[..offset.min(bytes.len())]
        .iter()
        .filter(|&&b| b == b'\n')
        .count()
}

/// Lines of places that only go forward.
#[derive(Default)]
struct LineCount {
    offset: usize,
    breaks: usize,
}

impl LineCount {
    fn at(&mut self, text: &str, offset: usize) -> usize {
        self.breaks += line_of(&text.as_bytes()[self.offset..], offset - self.offset) - 1;
        self.offset = offset;
        self.breaks + 1
    }
}
