//! Text as lines, words and numbers, straight from bytes.

use crate::{GeometryError, ReadError};

/// The lines of a text, numbered from 1, without their ends ("\n", "\r\n" or "\r") and a leading byte order mark.
#[derive(Debug, Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn of(text: &'a [u8]) -> Self {
        Self::from_line(without_mark(text), 1)
    }

    /// The lines of what follows in a file, the first of them being line `number`.
    pub(super) fn from_line(rest: &'a [u8], number: usize) -> Self {
        Self {
            rest,
            number: number - 1,
        }
    }

    /// What comes after the lines that were taken.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let (line, rest) = match end {
            None => (self.rest, &self.rest[..0]),
            Some(end) => {
                let is_pair = self.rest[end..].starts_with(b"\r\n");
                let after = end + if is_pair { 2 } else { 1 };
                (&self.rest[..end], &self.rest[after..])
            }
        };
        self.rest = rest;
        self.number += 1;
        Some((self.number, line))
    }
}

/// The bytes after a UTF-8 byte order mark.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|w| !w.is_empty())
}

/// A finite number, written as programs do: decimal points, and `e` or Fortran's `d` before an exponent.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    // Rust reads "inf" and "nan" too.
    if !matches!(word.first()?, b'0'..=b'9' | b'+' | b'-' | b'.')
        || matches!(word.get(1), Some(b'i' | b'n' | b'I' | b'N'))
    {
        return None;
    }
    let text = std::str::from_utf8(word).ok()?;
    let value: f64 = match text.parse() {
        Ok(value) => value,
        Err(_) if word.iter().any(|b| matches!(b, b'd' | b'D')) => {
            text.replace(['d', 'D'], "e").parse().ok()?
        }
        Err(_) => return None,
    };
    value.is_finite().then_some(value)
}

/// As much of a text as a message can show.
pub(super) fn shown(text: &[u8]) -> String {
    const MOST: usize = 40;
    let text = String::from_utf8_lossy(&text[..text.len().min(4 * MOST)]);
    let text: String = text.trim().chars().filter(|c| !c.is_control()).collect();
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

/// Whether nothing in the text is what only binary files hold.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let is_control = |&b: &u8| b < b' ' && !matches!(b, b'\t' | b'\n' | b'\r' | 0x0c | 0x1a);
    !bytes.iter().any(is_control)
}

/// An error in a line.
pub(super) fn row(line: usize, reason: impl Into<String>) -> GeometryError {
    ReadError::BadLine {
        line,
        reason: reason.into(),
    }
    .into()
}

/// An error in a file as a whole.
pub(super) fn whole(reason: impl Into<String>) -> GeometryError {
    ReadError::BadFile {
        reason: reason.into(),
    }
    .into()
}
