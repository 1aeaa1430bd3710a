//! PLY files, text or binary in either byte order: vertices, and faces by their corners' numbers.

mod header;
mod numbers;

use sphpack_neighbors::point;

use self::header::{Element, Encoding, Scalar};
use self::numbers::{BinaryNumbers, Numbers, TextNumbers};
use super::lines::whole;
use super::{Faces, Solid, loosened};
use crate::{GeometryError, MeshError};

/// One part without a name. Elements and properties other than vertices' x, y, z and the lists of vertices of faces
/// and strips are passed over.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Solid>, GeometryError> {
    let header = header::read(bytes)?;
    let mut surface = PolygonSurface::default();
    match header.encoding {
        Encoding::Text => surface.read(
            &header.elements,
            TextNumbers::new(header.body, header.next_line),
        )?,
        Encoding::LittleEndian => surface.read(
            &header.elements,
            BinaryNumbers::<false>::new(header.body, bytes.len()),
        )?,
        Encoding::BigEndian => surface.read(
            &header.elements,
            BinaryNumbers::<true>::new(header.body, bytes.len()),
        )?,
    }
    let PolygonSurface { vertices, faces } = surface;
    let triangles = faces.triangles();
    if triangles.is_empty() {
        return Err(whole(format!(
            "the PLY file holds {} points and no faces of three of them; a body needs a closed surface, export it as a mesh",
            vertices.len()
        )));
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(MeshError::BadIndex {
                triangle,
                vertex: vertex as usize,
                vertices: vertices.len(),
            }
            .into());
        }
    }
    loosened(&vertices, vec![(String::new(), faces)])
}

/// What is of use in the file.
#[derive(Debug, Default)]
struct PolygonSurface {
    vertices: Vec<[f64; 3]>,
    faces: Faces,
}

/// What becomes of a property's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Use {
    Axis(usize),
    Corners,
    /// Corners of strips, each triangle the last two and the next; −1 begins another strip.
    Strip,
    Nothing,
}

impl PolygonSurface {
    fn read(
        &mut self,
        elements: &[Element<'_>],
        mut numbers: impl Numbers,
    ) -> Result<(), GeometryError> {
        for element in elements {
            // Nothing stands in the file for them, however many there are said to be.
            if element.properties.is_empty() {
                continue;
            }
            let columns = columns(element)?;
            let is_vertex = element.name == b"vertex";
            let mut corners: Vec<u32> = Vec::new();
            for _ in 0..element.count {
                numbers.begin(element.name)?;
                let mut vertex = [0.0; 3];
                corners.clear();
                for &(what, length, item) in &columns {
                    let Some(length) = length else {
                        let value = numbers.next(item)?;
                        if let Use::Axis(axis) = what {
                            vertex[axis] = value;
                        }
                        continue;
                    };
                    let length = numbers.next(length)?;
                    let Some(length) = counted(length) else {
                        return Err(numbers.fault(format!(
                            "a list of {length} entries; the file is damaged, export the body again"
                        )));
                    };
                    for _ in 0..length {
                        let value = numbers.next(item)?;
                        if what == Use::Strip && (value == -1.0 || value == f64::from(u32::MAX)) {
                            self.add_strip(&corners);
                            corners.clear();
                        } else if matches!(what, Use::Corners | Use::Strip) {
                            let Some(corner) = counted(value) else {
                                return Err(numbers.fault(format!(
                                    "a face refers to vertex {value}; the file is damaged, export the body again"
                                )));
                            };
                            corners.push(corner);
                        }
                    }
                }
                numbers.end()?;
                if is_vertex {
                    if !point::is_finite(vertex) {
                        return Err(MeshError::NotFinite {
                            what: "vertex",
                            index: self.vertices.len(),
                        }
                        .into());
                    }
                    self.vertices.push(vertex);
                } else if columns.iter().any(|column| column.0 == Use::Strip) {
                    self.add_strip(&corners);
                } else {
                    self.faces.add(&corners);
                }
            }
        }
        Ok(())
    }

    /// Triangles of a strip: every other one is the other way round; those that only turn it have a corner twice.
    fn add_strip(&mut self, corners: &[u32]) {
        for (k, corners) in corners.windows(3).enumerate() {
            let [a, b, c] = [corners[0], corners[1], corners[2]];
            if a != b && b != c && c != a {
                let (a, b) = if k % 2 == 0 { (a, b) } else { (b, a) };
                self.faces.add(&[a, b, c]);
            }
        }
    }
}

/// A property as it is read: its use, the type of its length where it is a list, the type of its numbers.
type Column = (Use, Option<Scalar>, Scalar);

fn columns(element: &Element<'_>) -> Result<Vec<Column>, GeometryError> {
    let columns: Vec<Column> = element
        .properties
        .iter()
        .map(|property| {
            let what = match (element.name, property.name, property.length) {
                (b"vertex", b"x", None) => Use::Axis(0),
                (b"vertex", b"y", None) => Use::Axis(1),
                (b"vertex", b"z", None) => Use::Axis(2),
                (b"face", b"vertex_indices" | b"vertex_index", Some(_)) => Use::Corners,
                (b"tristrips", b"vertex_indices" | b"vertex_index", Some(_)) => Use::Strip,
                _ => Use::Nothing,
            };
            (what, property.length, property.item)
        })
        .collect();
    let has = |what| columns.iter().any(|column| column.0 == what);
    match element.name {
        b"vertex" if !(0..3).all(|axis| has(Use::Axis(axis))) => Err(whole(
            "the PLY file's vertices lack a property x, y or z; export the body again",
        )),
        b"face" if !has(Use::Corners) => Err(whole(
            "the PLY file's faces lack the list vertex_indices; export the body again",
        )),
        b"tristrips" if !has(Use::Strip) => Err(whole(
            "the PLY file's strips of triangles lack the list vertex_indices; export the body again",
        )),
        _ => Ok(columns),
    }
}

/// A whole number that counts something.
fn counted(value: f64) -> Option<u32> {
    (value >= 0.0 && value < f64::from(u32::MAX) && value.fract() == 0.0).then_some(value as u32)
}
