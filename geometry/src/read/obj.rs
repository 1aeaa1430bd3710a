//! Wavefront OBJ files: vertices, faces, objects and groups.

use std::borrow::Cow;
use std::collections::HashMap;

use super::lines::{Lines, number, row, shown, whole, words};
use super::{Faces, Solid, loosened};
use crate::GeometryError;

/// A part for each name that an object or group has; what comes before the first name is a part without one. Texture
/// places, normals, materials, lines and points are passed over.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Solid>, GeometryError> {
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut parts = Parts::default();
    let mut corners: Vec<u32> = Vec::new();
    // The highest vertex that a face refers to, and where: it may come later in the file.
    let mut highest = (0, 0);
    let mut lines = Lines::of(bytes);
    while let Some((at, line)) = lines.next() {
        let line = continued(line, &mut lines);
        let line = line.split(|&b| b == b'#').next().unwrap_or_default();
        let mut words = words(line);
        match words.next() {
            Some(b"v") => {
                let mut vertex = [0.0; 3];
                for x in &mut vertex {
                    *x = words.next().and_then(number).ok_or_else(|| {
                        row(
                            at,
                            format!(
                                "\"{}\" is not \"v\" and three finite numbers; export the body again",
                                shown(line)
                            ),
                        )
                    })?;
                }
                if vertices.len() >= u32::MAX as usize {
                    return Err(row(
                        at,
                        "more vertices than can be numbered; use a coarser mesh",
                    ));
                }
                vertices.push(vertex);
            }
            Some(b"f") => {
                corners.clear();
                for word in words {
                    let vertex = corner(word, vertices.len())
                        .map_err(|reason| row(at, format!("\"{}\" {reason}", shown(word))))?;
                    if vertex >= highest.0 {
                        highest = (vertex, at);
                    }
                    corners.push(vertex);
                }
                parts.current().add(&corners);
            }
            Some(name @ (b"o" | b"g")) => {
                let line = line.trim_ascii();
                parts.name = String::from_utf8_lossy(&line[name.len()..])
                    .trim()
                    .to_owned();
                parts.open = None;
            }
            Some(b"surf" | b"curv" | b"cstype") => {
                return Err(row(
                    at,
                    "the file holds free-form curves or surfaces, which are not read; export the body as triangles",
                ));
            }
            _ => {}
        }
    }
    if parts.all.is_empty() {
        return Err(whole(
            "the OBJ file holds no faces (\"f\" and the numbers of vertices); export the body as a mesh",
        ));
    }
    let (vertex, at) = highest;
    if vertex as usize >= vertices.len() {
        return Err(row(
            at,
            format!(
                "a face refers to vertex {}, but the file has only {}; it is cut off or damaged, export it again",
                u64::from(vertex) + 1,
                vertices.len()
            ),
        ));
    }
    loosened(&vertices, parts.all)
}

/// Triangles by the name of their object or group.
#[derive(Default)]
struct Parts {
    all: Vec<(String, Faces)>,
    numbers: HashMap<String, usize>,
    name: String,
    /// The part of `name`, once it has faces.
    open: Option<usize>,
}

impl Parts {
    fn current(&mut self) -> &mut Faces {
        let number = *self.open.get_or_insert_with(|| {
            *self.numbers.entry(self.name.clone()).or_insert_with(|| {
                self.all.push((self.name.clone(), Faces::default()));
                self.all.len() - 1
            })
        });
        &mut self.all[number].1
    }
}

/// The line with what a backslash at its end ties to it.
fn continued<'a>(line: &'a [u8], lines: &mut Lines<'a>) -> Cow<'a, [u8]> {
    let mut whole = Cow::Borrowed(line);
    while let Some(open) = whole.trim_ascii_end().strip_suffix(b"\\") {
        let length = open.len();
        let Some((_, next)) = lines.next() else { break };
        let joined = whole.to_mut();
        joined.truncate(length);
        joined.push(b' ');
        joined.extend_from_slice(next);
    }
    whole
}

/// The vertex, counted from 0, of a face's word: "v", "v/vt", "v//vn" or "v/vt/vn", counted from 1 or, below 0, from
/// the last vertex so far.
fn corner(word: &[u8], so_far: usize) -> Result<u32, &'static str> {
    let digits = word.split(|&b| b == b'/').next().unwrap_or_default();
    let number: i64 = std::str::from_utf8(digits)
        .ok()
        .and_then(|digits| digits.parse().ok())
        .ok_or("is not the number of a vertex; export the body again")?;
    let index = match number {
        0 => return Err("is no vertex: they count from 1; export the body again"),
        1.. => number - 1,
        _ => i64::try_from(so_far)
            .unwrap_or(i64::MAX)
            .checked_add(number)
            .unwrap_or(-1),
    };
    u32::try_from(index)
        .ok()
        .filter(|&index| index < u32::MAX)
        .ok_or("is a vertex that the file does not have; export the body again")
}
