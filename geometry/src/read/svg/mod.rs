//! Outlines from SVG drawings: what a viewer paints.

mod arcs;
mod checked;
mod cost;
mod flatten;
mod painted;
mod region;

use usvg::{ImageHrefResolver, Options, Tree};

use super::lines::{row, whole, without_mark};
use crate::{GeometryError, OutlineRepair};

pub use self::flatten::FLATTENING_OVER_SIZE;

/// Loops, and what there is to say about how they were read.
pub(super) type Drawing = (Vec<Vec<[f64; 2]>>, Vec<OutlineRepair>);

/// The boundary of everything that is painted, y up.
pub(super) fn read(bytes: &[u8]) -> Result<Drawing, GeometryError> {
    let text = std::str::from_utf8(without_mark(bytes)).map_err(|e| {
        row(
            line_of(bytes, e.valid_up_to()),
            "this is not UTF-8; save the drawing in that encoding",
        )
    })?;
    let document = checked::document(text)?;
    let left_out = document.left_out();
    let tree = Tree::from_str(&document.prepared(), &options()).map_err(|e| {
        whole(format!(
            "the drawing cannot be read ({e}); save it again, as plain SVG"
        ))
    })?;
    let painted = painted::Painted::of(&tree, document.origin());
    let (loops, mut done) = painted.outline(bytes.len())?;
    done.extend(painted.remarks());
    done.extend(left_out.remarks());
    if loops.is_empty() {
        return Err(whole(format!(
            "the drawing paints nothing that is read{}; draw the body as a path with a fill (text must be turned into paths)",
            left_out.words()
        )));
    }
    Ok((loops, done))
}

/// Nothing is fetched, from the disk or elsewhere.
fn options() -> Options<'static> {
    Options {
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    }
}

/// The line of a byte, counted from 1.
fn line_of(bytes: &[u8], offset: usize) -> usize {
    1 + bytes[..offset.min(bytes.len())]
        .iter()
        .filter(|&&b| b == b'\n')
        .count()
}
