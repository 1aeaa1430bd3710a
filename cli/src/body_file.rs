//! Bodies in files: of which format they are, and what was read.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use sphpack_geometry::{BodyFormat, GeometryError};

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
    begin(path).map(|(_, _, format)| format)
}

/// The file, its beginning, and the format that this tells.
fn begin(path: &Path) -> Result<(File, Vec<u8>, BodyFormat), Error> {
    let mut file = crate::files::open(path)?;
    let size = file.metadata().map_or(0, |meta| meta.len());
    let mut head = Vec::new();
    (&mut file)
        .take(BodyFormat::HEAD_BYTES as u64)
        .read_to_end(&mut head)
        .map_err(|e| unreadable(path, &e))?;
    let format = BodyFormat::detect_head(&head, size, &extension(path))
        .map_err(|e| Error::input(path, e.to_string()))?;
    Ok((file, head, format))
}

fn unreadable(path: &Path, error: &io::Error) -> Error {
    Error::input(path, format!("cannot be read ({error})"))
}

/// A body's file, opened once and read to its end.
#[derive(Debug)]
pub(crate) struct BodyFile {
    path: PathBuf,
    /// As its beginning tells.
    pub(crate) format: BodyFormat,
    bytes: Vec<u8>,
}

impl BodyFile {
    /// Reads a file; one of no format that is read is refused by its beginning.
    pub(crate) fn read(path: &Path) -> Result<Self, Error> {
        let (mut file, mut bytes, format) = begin(path)?;
        (file.read_to_end(&mut bytes)).map_err(|e| unreadable(path, &e))?;
        Ok(Self {
            path: path.to_owned(),
            format,
            bytes,
        })
    }

    /// A body from the whole content; errors name the file.
    pub(crate) fn body<T>(
        &self,
        build: impl FnOnce(BodyFormat, &[u8]) -> Result<T, GeometryError>,
    ) -> Result<(BodyFormat, T), GeometryError> {
        BodyFormat::detect(&self.bytes, &extension(&self.path))
            .and_then(|format| Ok((format, build(format, &self.bytes)?)))
            .map_err(|e| e.in_file(&self.path))
    }
}

fn extension(path: &Path) -> String {
    path.extension()
        .map_or_else(String::new, |e| e.to_string_lossy().into_owned())
}

/// The same error about a body's file, saying which body of which scene wants that file.
pub(crate) fn of_body(error: Error, scene: &Path, body: &str) -> Error {
    match error {
        // A body that was named on the command line needs no further introduction.
        Error::Input { path, at, message } if path != scene => Error::Input {
            path,
            at,
            message: format!("{message} (it is body \"{body}\" of {})", scene.display()),
        },
        other => other,
    }
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
