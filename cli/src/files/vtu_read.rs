//! Reading VTK's XML files (unstructured grids and polygonal data), as far as particles need it: points and their numbers, as text or appended raw.

use std::collections::BTreeMap;
use std::path::Path;

use super::Columns;
use super::number_type::{ByteOrder, NumberType};
use crate::Error;

/// Reads particles: points, and every point array of one component. Arrays of integers with a field array
/// `NAME_names` become words.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, or written in a way that is not read (compressed, base64, big-endian).
pub fn read_vtu(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    read(bytes).map_err(|message| Error::input(path, message))
}

const MARK: &[u8] = b"<AppendedData";

fn find(bytes: &[u8], what: &[u8]) -> Option<usize> {
    bytes.windows(what.len()).position(|window| window == what)
}

/// An opening tag: its name and what it says.
struct Tag<'a> {
    name: &'a str,
    attributes: BTreeMap<&'a str, &'a str>,
    /// What follows it.
    rest: &'a str,
}

impl<'a> Tag<'a> {
    /// The next tag of `text`.
    fn next(text: &'a str) -> Option<Self> {
        let start = text.find('<')? + 1;
        let length = text[start..].find('>')?;
        let inner = text[start..start + length].trim_end_matches('/');
        let (name, mut list) = inner.split_once(char::is_whitespace).unwrap_or((inner, ""));
        let mut attributes = BTreeMap::new();
        while let Some((key, after)) = list.split_once('=') {
            let after = after.trim_start();
            let Some(quote) = after.chars().next().filter(|c| matches!(c, '"' | '\'')) else {
                break;
            };
            let Some((value, more)) = after[1..].split_once(quote) else {
                break;
            };
            attributes.insert(key.trim(), value);
            list = more;
        }
        Some(Self {
            name,
            attributes,
            rest: &text[start + length + 1..],
        })
    }

    fn get(&self, key: &str) -> &'a str {
        self.attributes.get(key).copied().unwrap_or("")
    }
}

/// The appended numbers, and how long the length before each array is.
struct Appended<'a> {
    bytes: &'a [u8],
    length_bytes: usize,
}

fn read(bytes: &[u8]) -> Result<Columns, String> {
    let end = find(bytes, MARK).unwrap_or(bytes.len());
    let head = String::from_utf8_lossy(&bytes[..end]);
    let mut text: &str = &head;
    let mut appended = Appended {
        bytes: &[],
        length_bytes: 8,
    };
    let mut section = "";
    let mut count = None;
    let mut points = None;
    let mut columns = Columns::default();
    let mut names: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut is_vtk = false;
    while let Some(tag) = Tag::next(text) {
        text = tag.rest;
        match tag.name {
            "VTKFile" => {
                is_vtk = true;
                check_head(&tag)?;
                appended.length_bytes = if tag.get("header_type") == "UInt64" {
                    8
                } else {
                    4
                };
                appended.bytes = appended_bytes(&bytes[end..])?;
            }
            "FieldData" | "Points" | "PointData" | "Cells" | "CellData" | "Verts" | "Lines"
            | "Strips" | "Polys" => section = tag.name,
            "Piece" if count.is_some() => {
                return Err(
                    "the file has several pieces; merge them into one and save again".into(),
                );
            }
            "Piece" => {
                let number: usize = tag
                    .get("NumberOfPoints")
                    .parse()
                    .map_err(|_| damaged("the number of points is no number"))?;
                count = Some(number);
            }
            "DataArray" => {
                let name = tag.get("Name").to_owned();
                let content = text.split('<').next().unwrap_or("");
                match section {
                    "FieldData" if name.ends_with("_names") => {
                        names.insert(name, strings(content));
                    }
                    "Points" => {
                        let n = count.unwrap_or(0);
                        points = Some(numbers(&tag, content, &appended, n, 3)?);
                    }
                    "PointData" if matches!(tag.get("NumberOfComponents"), "" | "1") => {
                        let n = count.unwrap_or(0);
                        columns
                            .numbers
                            .insert(name, numbers(&tag, content, &appended, n, 1)?);
                    }
                    _ => {}
                }
            }
            _ => {}
        }
    }
    if !is_vtk {
        return Err(
            "this is no VTU or VTP file; one begins with <VTKFile type=\"UnstructuredGrid\" or \"PolyData\"".into(),
        );
    }
    let points = points.ok_or_else(|| damaged("it has no points"))?;
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let coordinates: Vec<f64> = points.iter().skip(axis).step_by(3).copied().collect();
        columns.numbers.insert(name.to_owned(), coordinates);
    }
    for (name, words) in names {
        if let Some(column) = name.strip_suffix("_names") {
            columns.name(column, |code| words.get(code).cloned());
        }
    }
    Ok(columns)
}

fn damaged(what: &str) -> String {
    format!("the VTK file is damaged: {what}; write it again")
}

fn check_head(tag: &Tag<'_>) -> Result<(), String> {
    let cure = "save it uncompressed, little-endian, appended raw or ascii (or as .csv)";
    if !["UnstructuredGrid", "PolyData"].contains(&tag.get("type")) {
        return Err(format!(
            "this is a VTK file of type \"{}\"; particles are read from types \"UnstructuredGrid\" (.vtu) and \"PolyData\" (.vtp)",
            tag.get("type")
        ));
    }
    if tag.get("byte_order") == "BigEndian" {
        return Err(format!(
            "the VTK file is big-endian, which is not read; {cure}"
        ));
    }
    if !tag.get("compressor").is_empty() {
        return Err(format!(
            "the VTK file is compressed, which is not read; {cure}"
        ));
    }
    Ok(())
}

/// What stands behind the underscore of the appended part.
fn appended_bytes(tail: &[u8]) -> Result<&[u8], String> {
    if tail.is_empty() {
        return Ok(tail);
    }
    let close = find(tail, b">").ok_or_else(|| damaged("its end is missing"))?;
    if find(&tail[..close], b"raw").is_none() {
        return Err("the VTK file's numbers are in base64, which is not read; save it appended raw or ascii (or as .csv)".into());
    }
    let start = find(&tail[close..], b"_").ok_or_else(|| damaged("its end is missing"))?;
    Ok(&tail[close + start + 1..])
}

/// The strings of an array of letters by number, each ended by 0.
fn strings(content: &str) -> Vec<String> {
    let bytes: Vec<u8> = content
        .split_whitespace()
        .map_while(|word| word.parse().ok())
        .collect();
    let mut all: Vec<String> = bytes
        .split(|&b| b == 0)
        .map(|part| String::from_utf8_lossy(part).into_owned())
        .collect();
    // After the last 0.
    all.pop();
    all
}

fn numbers(
    tag: &Tag<'_>,
    content: &str,
    appended: &Appended<'_>,
    count: usize,
    components: usize,
) -> Result<Vec<f64>, String> {
    let name = tag.get("Name");
    let all: Vec<f64> = match tag.get("format") {
        "ascii" => content
            .split_whitespace()
            .map(|word| {
                word.parse().map_err(|_| {
                    damaged(&format!(
                        "\"{}\" in array {name} is no number",
                        word.chars().take(20).collect::<String>()
                    ))
                })
            })
            .collect::<Result<_, _>>()?,
        "appended" => {
            let offset: usize = tag
                .get("offset")
                .parse()
                .map_err(|_| damaged(&format!("array {name} has no offset")))?;
            let bytes = block(appended, offset)
                .ok_or_else(|| damaged(&format!("array {name} is cut off")))?;
            number_type(tag.get("type"))?.numbers(ByteOrder::Little, bytes)
        }
        other => {
            return Err(format!(
                "array {name} of the VTK file is in format \"{other}\", which is not read; save it appended raw or ascii (or as .csv)"
            ));
        }
    };
    if Some(all.len()) != count.checked_mul(components) {
        return Err(damaged(&format!(
            "array {name} has {} numbers for {count} points",
            all.len()
        )));
    }
    Ok(all)
}

/// The bytes of the array at `offset`, without its length.
fn block<'a>(appended: &Appended<'a>, offset: usize) -> Option<&'a [u8]> {
    let start = offset.checked_add(appended.length_bytes)?;
    let mut length = [0; 8];
    length[..appended.length_bytes].copy_from_slice(appended.bytes.get(offset..start)?);
    let length = usize::try_from(u64::from_le_bytes(length)).ok()?;
    appended.bytes.get(start..start.checked_add(length)?)
}

fn number_type(name: &str) -> Result<NumberType, String> {
    Ok(match name {
        "Float64" => NumberType::F64,
        "Float32" => NumberType::F32,
        "Int8" => NumberType::I8,
        "UInt8" => NumberType::U8,
        "Int16" => NumberType::I16,
        "UInt16" => NumberType::U16,
        "Int32" => NumberType::I32,
        "UInt32" => NumberType::U32,
        "Int64" => NumberType::I64,
        "UInt64" => NumberType::U64,
        _ => return Err(damaged(&format!("\"{name}\" is no type of numbers"))),
    })
}
