//! What kind of body a file holds, told from its content rather than its name.

use super::lines::{Lines, number, whole, without_mark, words};
use super::rows::{content, fields, pair};
use super::{airfoil, stl};
use crate::GeometryError;

/// The formats of body files that can be read. Serde names them by their extensions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum BodyFormat {
    /// Triangles, binary or text, 3-D.
    Stl,
    /// Wavefront OBJ: polygons, 3-D.
    Obj,
    /// Polygons, text or binary, 3-D.
    Ply,
    /// Rows of x,y, 2-D.
    Csv,
    /// Airfoil coordinates after Selig or Lednicer, 2-D.
    #[cfg_attr(feature = "serde", serde(rename = "dat"))]
    Airfoil,
    /// Closed paths of a drawing, 2-D.
    Svg,
}

impl BodyFormat {
    /// Every format.
    pub const ALL: [Self; 6] = [
        Self::Stl,
        Self::Obj,
        Self::Ply,
        Self::Csv,
        Self::Airfoil,
        Self::Svg,
    ];

    /// As much of a file as [`BodyFormat::detect_head`] wants to see, bytes.
    pub const HEAD_BYTES: usize = 1 << 14;

    /// The format of a file's whole content. `extension` is what its name ends with, "" where unknown, and decides
    /// only where the content does not.
    ///
    /// ```
    /// use sphpack_geometry::BodyFormat;
    /// assert_eq!(BodyFormat::detect(b"solid cube\n", "txt"), Ok(BodyFormat::Stl));
    /// assert_eq!(BodyFormat::detect(b"x,y\n0,0\n1,0\n", "stl"), Ok(BodyFormat::Csv));
    /// assert!(BodyFormat::detect(b"ISO-10303-21;", "step").is_err());
    /// ```
    ///
    /// # Errors
    /// [`ReadError::BadFile`](crate::ReadError::BadFile) where it is of no format that is read.
    pub fn detect(bytes: &[u8], extension: &str) -> Result<Self, GeometryError> {
        Self::detect_head(bytes, bytes.len() as u64, extension)
    }

    /// [`BodyFormat::detect`] from the first [`BodyFormat::HEAD_BYTES`] of a file of `size` bytes, or more of them.
    ///
    /// # Errors
    /// As [`BodyFormat::detect`].
    pub fn detect_head(head: &[u8], size: u64, extension: &str) -> Result<Self, GeometryError> {
        let named = Self::named(extension);
        if stl::binary_count(head, size).is_some_and(|count| count > 0) {
            return Ok(Self::Stl);
        }
        let head = &head[..head.len().min(Self::HEAD_BYTES)];
        let text = without_mark(head).trim_ascii_start();
        if text.starts_with(b"ply\n") || text.starts_with(b"ply\r") || text.starts_with(b"ply ") {
            return Ok(Self::Ply);
        }
        if text.starts_with(b"<") && (named == Some(Self::Svg) || is_svg(text)) {
            return Ok(Self::Svg);
        }
        if stl::is_text(head) {
            return Ok(Self::Stl);
        }
        if let Some(what) = unread(text) {
            return Err(whole(format!("{what}; {CURE}")));
        }
        match rows(head) {
            _ if is_obj(head) => return Ok(Self::Obj),
            Rows::None => {}
            Rows::Airfoil => return Ok(Self::Airfoil),
            Rows::Plain if named == Some(Self::Airfoil) => return Ok(Self::Airfoil),
            Rows::Plain => return Ok(Self::Csv),
        }
        named.ok_or_else(|| {
            whole(format!(
                "this is no mesh (3-D) and no outline (2-D) that is read; {CURE}"
            ))
        })
    }

    /// The format that a file name's ending stands for.
    fn named(extension: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }

    /// 2 or 3.
    pub fn dimension(self) -> usize {
        match self {
            Self::Stl | Self::Obj | Self::Ply => 3,
            Self::Csv | Self::Airfoil | Self::Svg => 2,
        }
    }

    /// What its files' names usually end with, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Stl => "stl",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Csv => "csv",
            Self::Airfoil => "dat",
            Self::Svg => "svg",
        }
    }

    /// A few words for messages: "an STL mesh", "rows of x,y".
    pub fn description(self) -> &'static str {
        match self {
            Self::Stl => "an STL mesh",
            Self::Obj => "an OBJ mesh",
            Self::Ply => "a PLY mesh",
            Self::Csv => "rows of x,y",
            Self::Airfoil => "an airfoil's coordinates",
            Self::Svg => "an SVG drawing",
        }
    }
}

const CURE: &str = "export the body as .stl, .obj or .ply, the outline as .csv, .dat or .svg";

/// Files that people try, and that are none of ours.
fn unread(text: &[u8]) -> Option<&'static str> {
    let starts = |mark: &[u8]| text.starts_with(mark);
    if starts(b"ISO-10303-21") {
        Some("STEP files are not read")
    } else if starts(b"PK\x03\x04") {
        Some("this is an archive (a .zip, .3mf or .FCStd file)")
    } else if starts(b"\x1f\x8b") {
        Some("this is compressed (.gz or .svgz); unpack it first")
    } else if starts(b"glTF") {
        Some("glTF files are not read")
    } else if starts(b"OFF") {
        Some("OFF files are not read")
    } else if starts(b"<") {
        Some("this is XML, but no SVG drawing")
    } else if starts(b"\xff\xfe") || starts(b"\xfe\xff") {
        Some("this is text in UTF-16; save it in UTF-8")
    } else {
        None
    }
}

/// Whether the first element is svg, with or without a prefix.
fn is_svg(text: &[u8]) -> bool {
    text.split(|&b| b == b'<').any(|tag| {
        let name = tag
            .split(|b| b.is_ascii_whitespace() || matches!(b, b'>' | b'/'))
            .next()
            .unwrap_or_default();
        name == b"svg" || name.ends_with(b":svg")
    })
}

/// Whether the first line that says something is one of an OBJ file.
fn is_obj(head: &[u8]) -> bool {
    Lines::of(head)
        .map(|(_, line)| line.split(|&b| b == b'#').next().unwrap_or_default())
        .find(|line| words(line).next().is_some())
        .is_some_and(|line| {
            let mut words = words(line);
            let (keyword, next) = (words.next(), words.next());
            match keyword {
                Some(b"v" | b"vn" | b"vt") => next.and_then(number).is_some(),
                Some(b"o" | b"g" | b"s" | b"mtllib" | b"usemtl") => next.is_some(),
                Some(b"f") => next.is_some_and(|w| matches!(w[0], b'0'..=b'9' | b'-')),
                _ => false,
            }
        })
}

/// What rows there are at the beginning of a text.
#[derive(Debug, PartialEq, Eq)]
enum Rows {
    None,
    Plain,
    Airfoil,
}

/// Lines that may stand before the points of an airfoil.
const MOST_TITLES: usize = 6;

/// Looks for two numbers in the second line at the latest, as the first may be a header; for an airfoil these are whole
/// numbers of points, alone between blank lines, below a name, or more lines stand before the points.
fn rows(head: &[u8]) -> Rows {
    let mut filled = Lines::of(head).filter(|(_, line)| !content(line).is_empty());
    let Some((_, first)) = filled.next() else {
        return Rows::None;
    };
    if pair(content(first)).is_ok() {
        return Rows::Plain;
    }
    let Some((at, second)) = filled.next() else {
        return Rows::None;
    };
    let is_whole = |field: &[u8]| number(field).is_some_and(|x| x >= 2.0 && x.fract() == 0.0);
    match pair(content(second)) {
        Ok(_) => {
            let blank_follows = Lines::of(head)
                .nth(at)
                .is_some_and(|(_, line)| line.trim_ascii().is_empty());
            if blank_follows && fields(content(second)).all(is_whole) {
                Rows::Airfoil
            } else {
                Rows::Plain
            }
        }
        // A name, the number of points, the points.
        Err(_) if fields(content(second)).count() == 1 && is_whole(content(second)) => {
            match filled.next() {
                Some((_, third)) if pair(content(third)).is_ok() => Rows::Airfoil,
                _ => Rows::None,
            }
        }
        Err(_) => {
            let is_point = |line: &[u8]| airfoil::in_plane(content(line)).is_ok();
            let all = Lines::of(head).map(|(_, line)| line);
            let mut points = all
                .filter(|line| !content(line).is_empty())
                .take(MOST_TITLES + 3)
                .skip_while(|line| !is_point(line));
            let is_run = (0..3).all(|_| points.next().is_some_and(is_point));
            if is_run { Rows::Airfoil } else { Rows::None }
        }
    }
}
