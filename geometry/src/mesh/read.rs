//! Meshes from STL files.

use std::io::Cursor;
use std::path::Path;

use super::Mesh;
use crate::{GeometryError, Soup};

/// Bytes before the first triangle of a binary file: 80 of title, 4 of count.
const HEAD: usize = 84;

/// Bytes per triangle of a binary file.
const RECORD: usize = 50;

impl Mesh {
    /// Reads an STL file, binary or text (several solids are taken together), by its content.
    ///
    /// # Errors
    /// [`GeometryError::InFile`] with the file's name around [`GeometryError::Unreadable`],
    /// [`GeometryError::BadStl`] (not STL, empty, cut off, count and size that disagree), or what [`Mesh::new`]
    /// finds.
    pub fn read_stl(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        let path = path.as_ref();
        std::fs::read(path)
            .map_err(|e| GeometryError::Unreadable {
                reason: e.to_string(),
            })
            .and_then(Self::from_stl_bytes)
            .map_err(|e| e.in_file(path))
    }

    /// [`Mesh::read_stl`] for a file's content that is already in memory.
    ///
    /// # Errors
    /// As [`Mesh::read_stl`], without a file's name.
    pub fn from_stl_bytes(bytes: Vec<u8>) -> Result<Self, GeometryError> {
        Self::from_loose(&loose_from_stl_bytes(bytes)?)
    }
}

impl Soup {
    /// Reads an STL file, binary or text, with whatever defects its triangles have.
    ///
    /// # Errors
    /// [`GeometryError::InFile`] with the file's name around [`GeometryError::Unreadable`],
    /// [`GeometryError::BadStl`], [`GeometryError::NotFinite`].
    pub fn read_stl(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        let path = path.as_ref();
        std::fs::read(path)
            .map_err(|e| GeometryError::Unreadable {
                reason: e.to_string(),
            })
            .and_then(|bytes| Self::from_loose(&loose_from_stl_bytes(bytes)?))
            .map_err(|e| e.in_file(path))
    }
}

/// The triangles of an STL file's content, each its three corners.
fn loose_from_stl_bytes(bytes: Vec<u8>) -> Result<Corners, GeometryError> {
    let corners = if bytes.is_empty() {
        return Err(bad("the file is empty; export the body again".into()));
    } else if let Some(count) = binary_count(&bytes) {
        // Room for every triangle has been checked, so the count cannot ask for more memory than there is file.
        read_binary(bytes, count)?
    } else if is_text(&bytes) {
        read_text(&bytes)?
    } else {
        return Err(wrong_size(&bytes));
    };
    if corners.is_empty() {
        return Err(bad(
            "the file holds no triangles; export the body again".into()
        ));
    }
    Ok(corners)
}

fn bad(reason: String) -> GeometryError {
    GeometryError::BadStl { reason }
}

/// The count a binary head promises.
fn promised(bytes: &[u8]) -> Option<usize> {
    let field: [u8; 4] = bytes.get(80..HEAD)?.try_into().ok()?;
    Some(u32::from_le_bytes(field) as usize)
}

/// The number of triangles, where the size is that of a binary file (a few bytes more do no harm).
fn binary_count(bytes: &[u8]) -> Option<usize> {
    let count = promised(bytes)?;
    let needed = HEAD + RECORD * count;
    let fits = needed <= bytes.len() && bytes.len() < needed + RECORD;
    (fits && !(count == 0 && is_text(bytes))).then_some(count)
}

fn is_text(bytes: &[u8]) -> bool {
    let start = bytes
        .iter()
        .position(|b| !b.is_ascii_whitespace())
        .unwrap_or(0);
    bytes[start..].len() >= 5 && bytes[start..start + 5].eq_ignore_ascii_case(b"solid")
}

/// What is wrong with a file that is neither text nor of the size it promises.
fn wrong_size(bytes: &[u8]) -> GeometryError {
    match promised(bytes) {
        Some(count) if HEAD + RECORD * count > bytes.len() && count < 1 << 28 => bad(format!(
            "its head promises {count} triangles ({} bytes) but the file has {} bytes; it is cut off or no STL file, export it again",
            HEAD + RECORD * count,
            bytes.len()
        )),
        Some(count) if HEAD + RECORD * count <= bytes.len() => bad(format!(
            "its head promises {count} triangles ({} bytes) but the file has {} bytes; it is damaged or no STL file, export it again",
            HEAD + RECORD * count,
            bytes.len()
        )),
        _ => bad(
            "this is no STL file, neither text (\"solid …\") nor binary; export the body as STL"
                .into(),
        ),
    }
}

type Corners = Vec<[[f64; 3]; 3]>;

fn collect(content: &[u8], into: &mut Corners, what: &str) -> Result<(), GeometryError> {
    let explain = |e: std::io::Error| {
        bad(format!(
            "{what} cannot be read ({e}); export the body again"
        ))
    };
    let mut cursor = Cursor::new(content);
    for triangle in stl_io::create_stl_reader(&mut cursor).map_err(explain)? {
        let triangle = triangle.map_err(explain)?;
        into.push(triangle.vertices.map(|v| v.0.map(f64::from)));
    }
    Ok(())
}

fn read_binary(mut bytes: Vec<u8>, count: usize) -> Result<Corners, GeometryError> {
    // Some exporters begin the title with "solid", the mark of text files.
    bytes[..5].copy_from_slice(b"bytes");
    let mut corners = Vec::with_capacity(count);
    collect(&bytes, &mut corners, "the binary STL file")?;
    Ok(corners)
}

/// Solid by solid, each in the spelling the reader wants: lower case, with a name.
fn read_text(bytes: &[u8]) -> Result<Corners, GeometryError> {
    let text = String::from_utf8_lossy(bytes).to_ascii_lowercase();
    let mut corners = Vec::new();
    let mut solid = String::new();
    let mut number = 0;
    for line in text.lines() {
        let word = line.split_whitespace().next().unwrap_or("");
        if word == "solid" && solid.is_empty() {
            number += 1;
            solid.push_str("solid body\n");
        } else if word == "endsolid" && !solid.is_empty() {
            solid.push_str("endsolid body\n");
            collect(
                solid.as_bytes(),
                &mut corners,
                &format!("solid {number} of the text STL file"),
            )?;
            solid.clear();
        } else if !word.is_empty() {
            if solid.is_empty() {
                return Err(bad(format!(
                    "\"{}\" stands outside any solid; export the body again",
                    line.trim().chars().take(40).collect::<String>()
                )));
            }
            solid.push_str(line);
            solid.push('\n');
        }
    }
    if !solid.is_empty() {
        return Err(bad(format!(
            "solid {number} of the text STL file has no \"endsolid\": the file is cut off, or no STL file; export the body again"
        )));
    }
    Ok(corners)
}
