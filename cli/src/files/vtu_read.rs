//! Reading VTK's XML files (unstructured grids and polygonal data), as far as particles need it: points and their numbers, as text or appended raw.

use std::collections::BTreeMap;
use std::io::{Cursor, Read, Seek, SeekFrom};
use std::path::Path;

use super::Columns;
use super::number_type::{ByteOrder, NumberType};
use super::vtk_xml::unescaped;
use super::xml_tag::Tag;
use crate::Error;

/// Reads particles: points, every point array of one component, and `normal`. Arrays of integers with fields `NAME:WORD`, or one
/// `NAME_names`, become words.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, or written in a way that is not read (compressed, base64, big-endian).
pub fn read_vtu(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    let mut columns = Columns::default();
    let mut take = |name: &str, piece: &[f64]| {
        let column = columns.numbers.entry(name.to_owned()).or_default();
        column.extend_from_slice(piece);
    };
    let names =
        visit(&mut Cursor::new(bytes), &mut take).map_err(|message| Error::input(path, message))?;
    for (column, words) in names {
        columns.name(&column, |code| words.get(code).cloned());
    }
    Ok(columns)
}

/// What the numbers of a column stand for, by its name.
pub(super) type Names = BTreeMap<String, Vec<String>>;

/// No file has so many bodies.
const MOST_NAMES: usize = 1 << 20;

const MARK: &[u8] = b"<AppendedData";

fn find(bytes: &[u8], what: &[u8]) -> Option<usize> {
    bytes.windows(what.len()).position(|window| window == what)
}

/// Where the appended numbers begin and end, and how long the length before each array is.
struct Appended<'a, R> {
    source: &'a mut R,
    begin: u64,
    end: u64,
    length_bytes: usize,
}

/// Bytes that are read at a time: whole points of any numbers.
const PIECE: usize = 24 << 15;

/// Gives away one column after the other, a piece at a time, so that none need be held; those of words as numbers of the names that
/// it ends with. An empty column is one empty piece.
pub(super) fn visit<R: Read + Seek>(
    source: &mut R,
    take: &mut dyn FnMut(&str, &[f64]),
) -> Result<Names, String> {
    let (bytes, mark) = head(source)?;
    let head = String::from_utf8_lossy(&bytes[..mark]);
    let mut text: &str = &head;
    let mut appended = Appended {
        end: source.seek(SeekFrom::End(0)).map_err(|e| e.to_string())?,
        source,
        begin: 0,
        length_bytes: 8,
    };
    let mut section = "";
    let mut count = None;
    let mut has_points = false;
    let mut names = Names::new();
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
                let tail = &bytes[mark..];
                appended.begin = (mark + before_appended(tail)?) as u64;
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
                let n = count.unwrap_or(0);
                match section {
                    "FieldData" => {
                        name_of_field(&unescaped(&name), content, &mut names);
                    }
                    "Points" => {
                        let mut points = |points: &[f64]| split(points, ["x", "y", "z"], take);
                        numbers(&tag, content, &mut appended, n, 3, &mut points)?;
                        has_points = true;
                    }
                    "PointData" if name == "normal" && tag.get("NumberOfComponents") == "3" => {
                        let mut normals = |all: &[f64]| split(all, ["nx", "ny", "nz"], take);
                        numbers(&tag, content, &mut appended, n, 3, &mut normals)?;
                    }
                    "PointData" if matches!(tag.get("NumberOfComponents"), "" | "1") => {
                        let mut whole = |piece: &[f64]| take(&name, piece);
                        numbers(&tag, content, &mut appended, n, 1, &mut whole)?;
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
    if !has_points {
        return Err(damaged("it has no points"));
    }
    Ok(names)
}

/// Gives away points, or vectors, axis by axis.
fn split(points: &[f64], names: [&str; 3], take: &mut dyn FnMut(&str, &[f64])) {
    for (axis, name) in names.into_iter().enumerate() {
        let along = points.iter().skip(axis).step_by(3);
        take(name, &along.copied().collect::<Vec<f64>>());
    }
}

/// Names of a field: `COLUMN:NAME` is the number that stands for it, `COLUMN_names` are all names in order.
fn name_of_field(field: &str, content: &str, names: &mut Names) {
    if let Some(column) = field.strip_suffix("_names") {
        names.insert(column.to_owned(), strings(content));
    }
    let Some((column, name)) = field.split_once(':') else {
        return;
    };
    let Some(code) = content
        .trim()
        .parse::<usize>()
        .ok()
        .filter(|&code| code < MOST_NAMES)
    else {
        return;
    };
    let all = names.entry(column.to_owned()).or_default();
    if all.len() <= code {
        all.resize(code + 1, String::new());
    }
    all[code] = name.to_owned();
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

/// The text before the appended part with what comes next of it, and where that begins; all of a file that has none.
fn head<R: Read>(source: &mut R) -> Result<(Vec<u8>, usize), String> {
    let mut bytes = Vec::new();
    let mut mark = None;
    loop {
        let before = bytes.len();
        let mut piece = source.by_ref().take(PIECE as u64);
        piece.read_to_end(&mut bytes).map_err(|e| e.to_string())?;
        // A piece more than the mark itself: it has an end, and numbers begin behind that.
        if mark.is_some() || bytes.len() == before {
            return Ok((bytes, mark.unwrap_or(before)));
        }
        let from = before.saturating_sub(MARK.len());
        mark = find(&bytes[from..], MARK).map(|at| from + at);
    }
}

/// How far behind the beginning of the appended part its numbers begin: behind an underscore.
fn before_appended(tail: &[u8]) -> Result<usize, String> {
    if tail.is_empty() {
        return Ok(0);
    }
    let close = find(tail, b">").ok_or_else(|| damaged("its end is missing"))?;
    if find(&tail[..close], b"raw").is_none() {
        return Err("the VTK file's numbers are in base64, which is not read; save it appended raw or ascii (or as .csv)".into());
    }
    let start = find(&tail[close..], b"_").ok_or_else(|| damaged("its end is missing"))?;
    Ok(close + start + 1)
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

/// Gives an array's numbers away, a piece at a time.
fn numbers<R: Read + Seek>(
    tag: &Tag<'_>,
    content: &str,
    appended: &mut Appended<'_, R>,
    count: usize,
    components: usize,
    take: &mut dyn FnMut(&[f64]),
) -> Result<(), String> {
    let name = tag.get("Name");
    let check = |found: usize| {
        if Some(found) == count.checked_mul(components) {
            return Ok(());
        }
        Err(damaged(&format!(
            "array {name} has {found} numbers for {count} points"
        )))
    };
    match tag.get("format") {
        "ascii" => {
            let all: Vec<f64> = content
                .split_whitespace()
                .map(|word| {
                    word.parse().map_err(|_| {
                        damaged(&format!(
                            "\"{}\" in array {name} is no number",
                            word.chars().take(20).collect::<String>()
                        ))
                    })
                })
                .collect::<Result<_, _>>()?;
            check(all.len())?;
            take(&all);
            Ok(())
        }
        "appended" => {
            let offset: u64 = tag
                .get("offset")
                .parse()
                .map_err(|_| damaged(&format!("array {name} has no offset")))?;
            let kind = number_type(tag.get("type"))?;
            let cut_off = || damaged(&format!("array {name} is cut off"));
            let mut left = appended.length_at(offset).ok_or_else(cut_off)?;
            check(left / kind.size())?;
            let mut bytes = vec![0; left.min(PIECE)];
            loop {
                let piece = &mut bytes[..left.min(PIECE)];
                (appended.source.read_exact(piece)).map_err(|_| cut_off())?;
                take(&kind.numbers(ByteOrder::Little, piece));
                left -= piece.len();
                if left == 0 {
                    return Ok(());
                }
            }
        }
        other => Err(format!(
            "array {name} of the VTK file is in format \"{other}\", which is not read; save it appended raw or ascii (or as .csv)"
        )),
    }
}

impl<R: Read + Seek> Appended<'_, R> {
    /// The bytes of the array at `offset`, which are read next; `None` where the file does not have as many.
    fn length_at(&mut self, offset: u64) -> Option<usize> {
        let begin = self.begin.checked_add(offset)?;
        if self.begin == 0 || begin > self.end {
            return None;
        }
        self.source.seek(SeekFrom::Start(begin)).ok()?;
        let mut length = [0; 8];
        let bytes = &mut length[..self.length_bytes];
        self.source.read_exact(bytes).ok()?;
        let length = u64::from_le_bytes(length);
        let left = self.end - begin - self.length_bytes as u64;
        (length <= left).then(|| usize::try_from(length).ok())?
    }
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
