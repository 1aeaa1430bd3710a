//! The numbers after the head of a PLY file, one after another, as text or binary.

use super::header::Scalar;
use crate::read::lines::{Lines, row, shown, words};
use crate::{GeometryError, ReadError};

/// Where rows of numbers come from.
pub(super) trait Numbers {
    /// Begins the next row of an element.
    fn begin(&mut self, element: &[u8]) -> Result<(), GeometryError>;

    /// The next number of the row; text of 64-bit floats may be infinite or no number, like these.
    fn next(&mut self, kind: Scalar) -> Result<f64, GeometryError>;

    /// Ends the row.
    fn end(&mut self) -> Result<(), GeometryError>;

    /// An error in the current row.
    fn fault(&self, reason: String) -> GeometryError;
}

/// Rows of text, one a line.
pub(super) struct TextNumbers<'a> {
    lines: Lines<'a>,
    at: usize,
    line: &'a [u8],
    rest: &'a [u8],
}

impl<'a> TextNumbers<'a> {
    pub(super) fn new(body: &'a [u8], next_line: usize) -> Self {
        Self {
            lines: Lines::from_line(body, next_line),
            at: next_line,
            line: b"",
            rest: b"",
        }
    }
}

impl Numbers for TextNumbers<'_> {
    fn begin(&mut self, element: &[u8]) -> Result<(), GeometryError> {
        for (at, line) in self.lines.by_ref() {
            let rest = line.trim_ascii();
            if !rest.is_empty() {
                (self.at, self.line, self.rest) = (at, line, rest);
                return Ok(());
            }
        }
        Err(self.fault(format!(
            "after this line rows of \"{}\" are missing: the file is cut off, export the body again",
            shown(element)
        )))
    }

    fn next(&mut self, _: Scalar) -> Result<f64, GeometryError> {
        let end = self
            .rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest.trim_ascii_start();
        std::str::from_utf8(word)
            .ok()
            .and_then(|word| word.parse().ok())
            .ok_or_else(|| {
                self.fault(format!(
                    "\"{}\" has a word that is no number, or too few of them; export the body again",
                    shown(self.line)
                ))
            })
    }

    fn end(&mut self) -> Result<(), GeometryError> {
        match words(self.rest).count() {
            0 => Ok(()),
            more => Err(self.fault(format!(
                "\"{}\" has {more} numbers more than the file's head says; export the body again",
                shown(self.line)
            ))),
        }
    }

    fn fault(&self, reason: String) -> GeometryError {
        row(self.at, reason)
    }
}

/// Binary numbers, the highest byte first or last.
pub(super) struct BinaryNumbers<'a, const BIG_ENDIAN: bool> {
    rest: &'a [u8],
    /// Bytes of the whole file, to say where something is.
    size: usize,
    /// Where the current row began.
    row: usize,
}

impl<'a, const BIG_ENDIAN: bool> BinaryNumbers<'a, BIG_ENDIAN> {
    pub(super) fn new(body: &'a [u8], size: usize) -> Self {
        Self {
            rest: body,
            size,
            row: size - body.len(),
        }
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], GeometryError> {
        let Some((first, rest)) = self.rest.split_first_chunk() else {
            return Err(self.fault(
                "the file ends within this row: it is cut off or damaged, export the body again"
                    .into(),
            ));
        };
        self.rest = rest;
        let mut bytes = *first;
        if BIG_ENDIAN {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<const BIG_ENDIAN: bool> Numbers for BinaryNumbers<'_, BIG_ENDIAN> {
    fn begin(&mut self, _: &[u8]) -> Result<(), GeometryError> {
        self.row = self.size - self.rest.len();
        Ok(())
    }

    fn next(&mut self, kind: Scalar) -> Result<f64, GeometryError> {
        Ok(match kind {
            Scalar::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn end(&mut self) -> Result<(), GeometryError> {
        Ok(())
    }

    fn fault(&self, reason: String) -> GeometryError {
        ReadError::BadByte {
            offset: self.row,
            reason,
        }
        .into()
    }
}
