//! What is wrong with a scene's text, and where.

use std::ops::Range;

/// What is wrong with a text, and where.
#[derive(Debug)]
pub(super) struct Wrong {
    /// The bytes that it is about.
    pub(super) at: Option<Range<usize>>,
    /// What is wrong, and the cure.
    pub(super) message: String,
}

/// Line and column, counted from 1, of a byte.
pub(super) fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |end| end + 1);
    (
        before.matches('\n').count() + 1,
        before[line_start..].chars().count() + 1,
    )
}
