//! Outlines from files of any format.

use std::path::Path;

use super::{BodyFormat, svg};
use crate::{GeometryError, Outline, ReadError, Sketch};

impl Outline {
    /// Reads an outline without defects: rows of x,y, an airfoil's coordinates, or a drawing in SVG, by its content.
    ///
    /// Rows are "x,y" (or "x y", "x;y"; with decimal commas where ";" or a tab parts them); `#` starts a comment, one header or title is allowed, a blank line ends a
    /// loop. Airfoils are Selig's (once round) or Lednicer's (upper and lower surface, with their numbers of points); titles,
    /// MSES's domain and remarks may stand before the points, text and tables after them.
    /// A drawing is what a viewer paints of it, fills and strokes alike and whatever their colour, even where the page
    /// ends before. Its units are those of the outermost viewBox (width and height do not matter), and since its y points
    /// down, (x, y) is read as (x, −y). Texts, images, masks and filters are not read, and [`Sketch::body`] says so.
    /// Curves become straight sides within [`FLATTENING_OVER_SIZE`](crate::FLATTENING_OVER_SIZE) of the
    /// drawing's size. [`Sketch::read`] takes outlines with defects too.
    ///
    /// # Errors
    /// [`GeometryError::InFile`] with the file's name around [`ReadError::Unreadable`], what
    /// [`BodyFormat::detect`] or [`BodyFormat::loops`] finds, or what [`Outline::new`] finds.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        in_file(path.as_ref(), |bytes, extension| {
            Self::from_bytes(BodyFormat::detect(bytes, extension)?, bytes)
        })
    }

    /// [`Outline::read`] for a file's content that is already in memory, in a format that is known.
    ///
    /// # Errors
    /// As [`Outline::read`], without a file's name.
    pub fn from_bytes(format: BodyFormat, bytes: &[u8]) -> Result<Self, GeometryError> {
        Self::new(format.loops(bytes)?)
    }

    /// Reads an outline from rows of x,y, whatever the file looks like.
    ///
    /// # Errors
    /// As [`Outline::read`].
    pub fn from_csv(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        in_file(path.as_ref(), |bytes, _| {
            Self::from_bytes(BodyFormat::Csv, bytes)
        })
    }

    /// [`Outline::from_csv`] for text that is already in memory.
    ///
    /// # Errors
    /// As [`Outline::from_csv`], without a file's name.
    pub fn from_text(text: &str) -> Result<Self, GeometryError> {
        Self::from_bytes(BodyFormat::Csv, text.as_bytes())
    }
}

impl Sketch {
    /// Reads an outline with whatever defects it has, from files as those of [`Outline::read`].
    ///
    /// # Errors
    /// [`GeometryError::InFile`] with the file's name around [`ReadError::Unreadable`], what
    /// [`BodyFormat::detect`] or [`BodyFormat::loops`] finds, or what [`Sketch::new`] finds.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        in_file(path.as_ref(), |bytes, extension| {
            Self::from_bytes(BodyFormat::detect(bytes, extension)?, bytes)
        })
    }

    /// [`Sketch::read`] for a file's content that is already in memory, in a format that is known.
    ///
    /// # Errors
    /// As [`Sketch::read`], without a file's name.
    pub fn from_bytes(format: BodyFormat, bytes: &[u8]) -> Result<Self, GeometryError> {
        match format {
            BodyFormat::Svg => {
                let (loops, done) = svg::read(bytes)?;
                Self::remarked(loops, done)
            }
            _ => Self::new(format.loops(bytes)?),
        }
    }
}

/// What becomes of a file's content and its name's ending; the name stands in front of every error.
pub(super) fn in_file<T>(
    path: &Path,
    read: impl FnOnce(&[u8], &str) -> Result<T, GeometryError>,
) -> Result<T, GeometryError> {
    let extension = path
        .extension()
        .map_or_else(String::new, |e| e.to_string_lossy().into_owned());
    std::fs::read(path)
        .map_err(|e| {
            ReadError::Unreadable {
                reason: e.to_string(),
            }
            .into()
        })
        .and_then(|bytes| read(&bytes, &extension))
        .map_err(|e| e.in_file(path))
}
