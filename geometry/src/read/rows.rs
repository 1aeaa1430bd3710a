//! Outlines from rows of x,y.

use super::lines::{Lines, is_text, number, row, shown, whole};
use crate::GeometryError;

/// Loops of points: a blank line ends one, `#` starts a comment, and one line before the first point may be a header
/// or title.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Vec<[f64; 2]>>, GeometryError> {
    check_text(bytes)?;
    let mut loops: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    let mut header_allowed = true;
    for (at, line) in Lines::of(bytes) {
        let content = content(line);
        if content.is_empty() {
            // A comment alone does not end a loop.
            if !line.contains(&b'#') && loops.last().is_some_and(|l| !l.is_empty()) {
                loops.push(Vec::new());
            }
            continue;
        }
        match pair(content) {
            Ok(p) => {
                header_allowed = false;
                if let Some(last) = loops.last_mut() {
                    last.push(p);
                }
            }
            Err(_) if header_allowed => header_allowed = false,
            Err(reason) => return Err(row(at, reason)),
        }
    }
    loops.retain(|l| !l.is_empty());
    Ok(loops)
}

/// What a line holds besides a comment; nothing where only separators are left.
pub(super) fn content(line: &[u8]) -> &[u8] {
    let content = line.split(|&b| b == b'#').next().unwrap_or_default();
    if content.iter().all(separates) {
        b""
    } else {
        content.trim_ascii()
    }
}

fn separates(b: &u8) -> bool {
    matches!(b, b',' | b';' | b'"' | 0x1a) || b.is_ascii_whitespace()
}

/// The fields of a row.
pub(super) fn fields(content: &[u8]) -> impl Iterator<Item = &[u8]> {
    content.split(separates).filter(|f| !f.is_empty())
}

/// Two finite numbers, or what is wrong with them.
pub(super) fn pair(content: &[u8]) -> Result<[f64; 2], String> {
    if let Some(pair) = with_decimal_commas(content) {
        return Ok(pair);
    }
    let mut fields = fields(content);
    let (Some(x), Some(y), None) = (fields.next(), fields.next(), fields.next()) else {
        return Err(format!(
            "\"{}\" has {} fields; a row is two numbers with decimal points, \"x,y\"",
            shown(content),
            self::fields(content).count()
        ));
    };
    match (number(x), number(y)) {
        (Some(x), Some(y)) => Ok([x, y]),
        _ => Err(format!(
            "\"{}\" is not two finite numbers; write \"x,y\" with decimal points",
            shown(content)
        )),
    }
}

/// Two numbers with decimal commas: only where another separator is between them and no point is in them, so that it
/// is plain what the commas mean.
fn with_decimal_commas(content: &[u8]) -> Option<[f64; 2]> {
    if !content.contains(&b',') || content.contains(&b'.') {
        return None;
    }
    let parts = |mark: u8| {
        let mut parts = content.split(move |&b| b == mark).map(<[u8]>::trim_ascii);
        let pair = (parts.next()?, parts.next()?);
        parts.next().is_none().then_some(pair)
    };
    let (x, y) = parts(b';').or_else(|| parts(b'\t'))?;
    let value = |part: &[u8]| {
        let commas = part.iter().filter(|&&b| b == b',').count();
        let is_within = part.first() != Some(&b',') && part.last() != Some(&b',');
        let point: Vec<u8> = part
            .iter()
            .map(|&b| if b == b',' { b'.' } else { b })
            .collect();
        (commas <= 1 && is_within).then(|| number(&point)).flatten()
    };
    Some([value(x)?, value(y)?])
}

/// Binary content is an error.
pub(super) fn check_text(bytes: &[u8]) -> Result<(), GeometryError> {
    if is_text(bytes) {
        return Ok(());
    }
    Err(whole(
        "this is not text (in UTF-8); export the outline as rows of \"x,y\"",
    ))
}
