//! Bodies in files: of which format they are, and what was read.

use std::io::Read;
use std::path::Path;

use sphpack_geometry::{BodyFormat, GeometryError, ReadError};

use crate::Error;

/// What was read from a body's file.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadBody {
    /// The body's name in the scene.
    pub name: String,
    /// The file's format.
    pub format: BodyFormat,
    /// Triangles of a mesh, points of an outline.
    pub count: usize,
    /// The sides of the box around the placed body, scene units.
    pub size: Vec<f64>,
}

/// The format of a body's file; looks into its beginning.
///
/// # Errors
/// [`Error::Input`] where the file cannot be read, or is of no format that is read.
pub fn body_format(path: &Path) -> Result<BodyFormat, Error> {
    let file = crate::files::open(path)?;
    let size = file.metadata().map_or(0, |meta| meta.len());
    let mut head = Vec::new();
    file.take(BodyFormat::HEAD_BYTES as u64)
        .read_to_end(&mut head)
        .map_err(|e| Error::input(path, format!("cannot be read ({e})")))?;
    BodyFormat::detect_head(&head, size, &extension(path))
        .map_err(|e| Error::input(path, e.to_string()))
}

/// Builds a body from its file's whole content; errors name the file.
pub(crate) fn read<T>(
    path: &Path,
    build: impl FnOnce(BodyFormat, &[u8]) -> Result<T, GeometryError>,
) -> Result<(BodyFormat, T), GeometryError> {
    std::fs::read(path)
        .map_err(|e| {
            GeometryError::from(ReadError::Unreadable {
                reason: e.to_string(),
            })
        })
        .and_then(|bytes| {
            let format = BodyFormat::detect(&bytes, &extension(path))?;
            Ok((format, build(format, &bytes)?))
        })
        .map_err(|e| e.in_file(path))
}

fn extension(path: &Path) -> String {
    path.extension()
        .map_or_else(String::new, |e| e.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_decides() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str, content: &[u8]| {
            let path = folder.path().join(name);
            std::fs::write(&path, content).unwrap();
            body_format(&path)
        };
        assert_eq!(of("a.stl", b"x,y\n0,0\n1,0\n").unwrap(), BodyFormat::Csv);
        assert_eq!(of("a.DAT", b"0 0\n1 0\n").unwrap(), BodyFormat::Airfoil);
        assert_eq!(of("empty.stl", b"").unwrap(), BodyFormat::Stl);
        let message = of("a.step", b"ISO-10303-21;").unwrap_err().to_string();
        assert!(
            message.contains("a.step: STEP") && message.contains(".stl"),
            "{message}"
        );
    }
}
