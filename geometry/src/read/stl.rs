//! STL files, binary or text, told apart by their content.

use std::borrow::Cow;
use std::io::Cursor;

use sphpack_neighbors::point;

use super::lines::{whole, without_mark};
use super::{Solid, stl_text};
use crate::{GeometryError, MeshError};

/// Bytes before the first triangle of a binary file: 80 of title, 4 of count.
const HEAD: usize = 84;

/// Bytes per triangle of a binary file.
const RECORD: usize = 50;

/// What some exporters write for a count that they do not know yet.
const UNKNOWN: u64 = u32::MAX as u64;

/// A binary file is one solid, named by its title; a text file may hold several.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Solid>, GeometryError> {
    if bytes.is_empty() {
        return Err(whole("the file is empty; export the body again"));
    }
    if let Some(count) = binary_count(bytes, bytes.len() as u64) {
        return Ok(vec![read_binary(bytes, count)?]);
    }
    // A binary file that was cut off may have a title that begins with "solid", but soon has zeros too.
    if is_text(bytes) && !bytes[..bytes.len().min(1024)].contains(&0) {
        return stl_text::read(bytes);
    }
    Err(wrong_size(bytes))
}

/// The count that a binary head promises.
fn promised(head: &[u8]) -> Option<u64> {
    let field: [u8; 4] = head.get(80..HEAD)?.try_into().ok()?;
    Some(u64::from(u32::from_le_bytes(field)))
}

/// The size that a count asks for.
fn needed(count: u64) -> u64 {
    HEAD as u64 + RECORD as u64 * count
}

/// The number of triangles, where the size is that of a binary file (a few bytes more do no harm).
pub(super) fn binary_count(head: &[u8], size: u64) -> Option<u64> {
    let count = promised(head)?;
    let fits = needed(count) <= size && size < needed(count) + RECORD as u64;
    if !fits && matches!(count, 0 | UNKNOWN) {
        return counted_by_size(head, size);
    }
    (fits && !(count == 0 && is_text(head))).then_some(count)
}

/// The number of triangles by the size, for exporters that write the head first and never go back to it.
fn counted_by_size(head: &[u8], size: u64) -> Option<u64> {
    let rest = size.checked_sub(HEAD as u64)?;
    let first = head.get(HEAD..HEAD + RECORD)?;
    let number = |bytes: &[u8]| {
        let bytes: [u8; 4] = bytes.try_into().ok()?;
        Some(f32::from_le_bytes(bytes))
    };
    // What follows must look like a triangle.
    let is_sound = first[..RECORD - 2]
        .chunks(4)
        .all(|bytes| number(bytes).is_some_and(|x| x == 0.0 || (1e-30..1e30).contains(&x.abs())));
    let count = rest / RECORD as u64;
    (rest % RECORD as u64 == 0 && count < UNKNOWN && is_sound).then_some(count)
}

/// Whether the first word is "solid".
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let bytes = without_mark(bytes).trim_ascii_start();
    bytes.len() >= 5
        && bytes[..5].eq_ignore_ascii_case(b"solid")
        && bytes.get(5).is_none_or(u8::is_ascii_whitespace)
}

/// What is wrong with a file that is neither text nor of the size it promises.
fn wrong_size(bytes: &[u8]) -> GeometryError {
    match promised(bytes) {
        Some(count) if count < 1 << 28 => {
            let fault = if needed(count) > bytes.len() as u64 {
                "cut off"
            } else {
                "damaged"
            };
            whole(format!(
                "its head promises {count} triangles ({} bytes) but the file has {} bytes; it is {fault} or no STL file, export it again",
                needed(count),
                bytes.len()
            ))
        }
        _ => whole(
            "this is no STL file, neither text (\"solid …\") nor binary; export the body as STL",
        ),
    }
}

fn read_binary(bytes: &[u8], count: u64) -> Result<Solid, GeometryError> {
    // Some exporters begin the title with "solid", by which the library knows text files.
    let is_misleading = bytes.trim_ascii_start().len() < bytes.len() || is_text(bytes);
    let bytes = if is_misleading || promised(bytes) != Some(count) {
        let mut copy = bytes.to_vec();
        if is_misleading {
            copy[..80].fill(b'.');
        }
        copy[80..HEAD].copy_from_slice(&(count as u32).to_le_bytes());
        Cow::Owned(copy)
    } else {
        Cow::Borrowed(bytes)
    };
    let explain = |e: std::io::Error| {
        whole(format!(
            "the binary STL file cannot be read ({e}); export the body again"
        ))
    };
    let title = String::from_utf8_lossy(&bytes[..80]);
    let name = title
        .trim_matches(|c: char| c.is_control() || c.is_whitespace() || c == '.')
        .chars()
        .take_while(|c| !c.is_control())
        .collect();
    // There is room in the file for every triangle that the count promises.
    let mut triangles = Vec::with_capacity(count as usize);
    let mut cursor = Cursor::new(bytes.as_ref());
    for triangle in stl_io::create_stl_reader(&mut cursor).map_err(explain)? {
        let corners = triangle
            .map_err(explain)?
            .vertices
            .map(|v| v.0.map(f64::from));
        if corners.iter().any(|&v| !point::is_finite(v)) {
            return Err(MeshError::NotFinite {
                what: "triangle",
                index: triangles.len(),
            }
            .into());
        }
        triangles.push(corners);
    }
    Ok(Solid { name, triangles })
}
