//! The head of a PLY file: how it is written, and which elements with which properties follow.

use crate::GeometryError;
use crate::read::lines::{Lines, row, shown, whole, words};

/// How the numbers after the head are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// A type of number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    /// By its old or its new name.
    fn named(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }
}

/// What an element has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Property<'a> {
    pub(super) name: &'a [u8],
    /// The type of a list's length, where it is a list.
    pub(super) length: Option<Scalar>,
    pub(super) item: Scalar,
}

/// A table of the file.
#[derive(Debug, Clone)]
pub(super) struct Element<'a> {
    pub(super) name: &'a [u8],
    /// As the head says; the file may have fewer.
    pub(super) count: u64,
    pub(super) properties: Vec<Property<'a>>,
}

/// A head.
#[derive(Debug, Clone)]
pub(super) struct Header<'a> {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element<'a>>,
    /// What follows it.
    pub(super) body: &'a [u8],
    /// The line after it.
    pub(super) next_line: usize,
}

/// Reads the head.
pub(super) fn read(bytes: &[u8]) -> Result<Header<'_>, GeometryError> {
    let mut lines = Lines::of(bytes);
    let mut encoding = None;
    let mut elements: Vec<Element<'_>> = Vec::new();
    if !matches!(lines.next(), Some((_, line)) if line.trim_ascii() == b"ply") {
        return Err(whole(
            "this is no PLY file: its first line is not \"ply\"; export the body again",
        ));
    }
    while let Some((at, line)) = lines.next() {
        let bad = |wanted: &str| {
            row(
                at,
                format!(
                    "\"{}\" in the head of the PLY file; {wanted}, export the body again",
                    shown(line)
                ),
            )
        };
        let mut words = words(line);
        match words.next() {
            None | Some(b"comment" | b"obj_info") => {}
            Some(b"format") => {
                encoding = Some(match words.next() {
                    Some(b"ascii") => Encoding::Text,
                    Some(b"binary_little_endian") => Encoding::LittleEndian,
                    Some(b"binary_big_endian") => Encoding::BigEndian,
                    _ => {
                        return Err(bad(
                            "the format must be ascii, binary_little_endian or binary_big_endian",
                        ));
                    }
                });
            }
            Some(b"element") => {
                let name = words.next();
                let count = words
                    .next()
                    .and_then(|word| std::str::from_utf8(word).ok()?.parse().ok());
                let (Some(name), Some(count)) = (name, count) else {
                    return Err(bad("an element has a name and a count"));
                };
                elements.push(Element {
                    name,
                    count,
                    properties: Vec::new(),
                });
            }
            Some(b"property") => {
                let Some(element) = elements.last_mut() else {
                    return Err(bad("a property follows its element"));
                };
                let mut scalar = || words.next().map(|word| (word, Scalar::named(word)));
                let (length, item) = match scalar() {
                    Some((b"list", _)) => match (scalar(), scalar()) {
                        (Some((_, Some(length))), Some((_, Some(item)))) => (Some(length), item),
                        _ => return Err(bad("a list has two types of numbers")),
                    },
                    Some((_, Some(item))) => (None, item),
                    _ => return Err(bad("a property has a type, such as float or uchar")),
                };
                let Some(name) = words.next() else {
                    return Err(bad("a property has a name"));
                };
                element.properties.push(Property { name, length, item });
            }
            Some(b"end_header") => {
                let Some(encoding) = encoding else {
                    return Err(row(
                        at,
                        "the head of the PLY file has no line \"format …\"; export the body again",
                    ));
                };
                return Ok(Header {
                    encoding,
                    elements,
                    body: lines.rest(),
                    next_line: at + 1,
                });
            }
            Some(_) => return Err(bad("this word is not known")),
        }
    }
    Err(whole(
        "the head of the PLY file has no end (\"end_header\"): the file is cut off, export the body again",
    ))
}
