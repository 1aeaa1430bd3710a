//! Reading PLY files, as far as particles need it: the numbers of vertices.

use std::collections::BTreeMap;
use std::path::Path;

use super::Columns;
use super::number_type::{ByteOrder, NumberType};
use crate::Error;

/// Reads particles: one column for each property of the vertices. Integers that comments give names for (`comment kind 0
/// free`) become words.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, or vertices have lists.
pub fn read_ply(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    read(bytes).map_err(|message| Error::input(path, message))
}

fn damaged(what: &str) -> String {
    format!("the PLY file is damaged: {what}; write it again")
}

/// One row of numbers after another.
struct Element {
    name: String,
    count: usize,
    /// Names and types; `None` for a list.
    properties: Vec<(String, Option<NumberType>)>,
}

/// What the file says before its numbers.
#[derive(Default)]
struct Head {
    /// `None` for text.
    order: Option<ByteOrder>,
    elements: Vec<Element>,
    names: BTreeMap<String, BTreeMap<usize, String>>,
}

fn number_type(name: &str) -> Option<NumberType> {
    Some(match name {
        "double" | "float64" => NumberType::F64,
        "float" | "float32" => NumberType::F32,
        "char" | "int8" => NumberType::I8,
        "uchar" | "uint8" => NumberType::U8,
        "short" | "int16" => NumberType::I16,
        "ushort" | "uint16" => NumberType::U16,
        "int" | "int32" => NumberType::I32,
        "uint" | "uint32" => NumberType::U32,
        "int64" => NumberType::I64,
        "uint64" => NumberType::U64,
        _ => return None,
    })
}

impl Head {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["comment", column, code, ..] => {
                // The name may have spaces, at its ends too.
                let name = line.splitn(4, ' ').nth(3);
                if let (Ok(code), Some(name)) = (code.parse(), name) {
                    let names = self.names.entry(column.to_owned()).or_default();
                    names.insert(code, name.to_owned());
                }
            }
            ["format", format, _] => {
                self.order = match format {
                    "ascii" => None,
                    "binary_little_endian" => Some(ByteOrder::Little),
                    "binary_big_endian" => Some(ByteOrder::Big),
                    _ => return Err(damaged("nobody knows its format")),
                };
            }
            ["element", name, count] => self.elements.push(Element {
                name: name.to_owned(),
                count: count
                    .parse()
                    .map_err(|_| damaged("the number of an element is no number"))?,
                properties: Vec::new(),
            }),
            ["property", .., name] => {
                let (Some(element), Some(kind)) = (self.elements.last_mut(), words.get(1)) else {
                    return Err(damaged("a property belongs to nothing"));
                };
                let known = number_type(kind);
                if known.is_none() && *kind != "list" {
                    return Err(damaged(&format!("nobody knows the type of {name}")));
                }
                element.properties.push((name.to_owned(), known));
            }
            _ => {}
        }
        Ok(())
    }
}

fn read(bytes: &[u8]) -> Result<Columns, String> {
    let mut head = Head::default();
    let mut rest = bytes;
    let mut is_first = true;
    loop {
        let end = rest
            .iter()
            .position(|&byte| byte == b'\n')
            .filter(|_| !is_first || bytes.starts_with(b"ply"))
            .ok_or(
                "this is no PLY file; one begins with a line \"ply\" and has a line \"end_header\"",
            )?;
        let line = String::from_utf8_lossy(&rest[..end]);
        let line = line.trim_end_matches('\r');
        rest = &rest[end + 1..];
        is_first = false;
        if line.trim_end() == "end_header" {
            break;
        }
        head.line(line)?;
    }
    let place = (head.elements.iter())
        .position(|element| element.name == "vertex")
        .ok_or_else(|| damaged("it has no vertices"))?;
    let vertex = &head.elements[place];
    let types = |element: &Element| -> Result<Vec<NumberType>, String> {
        let types = element.properties.iter().map(|(_, number)| *number);
        types.collect::<Option<_>>().ok_or_else(|| {
            format!("the PLY file's {} has lists up to where its vertices end, which is not read; save vertices alone, without lists", element.name)
        })
    };
    let mut numbers: Vec<Vec<f64>> = vec![Vec::new(); vertex.properties.len()];
    let cut_off = || damaged(&format!("it has fewer than {} vertices", vertex.count));
    match head.order {
        Some(order) => {
            for element in &head.elements[..place] {
                let row: usize = types(element)?.into_iter().map(NumberType::size).sum();
                let skip = element.count.checked_mul(row);
                rest = skip.and_then(|skip| rest.get(skip..)).ok_or_else(cut_off)?;
            }
            let types = types(vertex)?;
            let row: usize = types.iter().map(|number| number.size()).sum();
            let all = (vertex.count.checked_mul(row))
                .and_then(|size| rest.get(..size))
                .filter(|_| row > 0)
                .ok_or_else(cut_off)?;
            for row in all.chunks_exact(row) {
                let mut at = 0;
                for (column, kind) in numbers.iter_mut().zip(&types) {
                    column.extend(kind.number(order, &row[at..]));
                    at += kind.size();
                }
            }
        }
        None => {
            let types = types(vertex)?;
            let text = std::str::from_utf8(rest).map_err(|_| damaged("it is no text"))?;
            let before = (head.elements[..place].iter())
                .fold(0_usize, |sum, element| sum.saturating_add(element.count));
            let mut lines = (text.lines())
                .filter(|line| !line.trim().is_empty())
                .skip(before);
            for _ in 0..vertex.count {
                let line = lines.next().ok_or_else(cut_off)?;
                let row: Option<Vec<f64>> = line
                    .split_whitespace()
                    .map(|word| word.parse().ok())
                    .collect();
                let row = row
                    .filter(|row| row.len() == types.len() && !row.is_empty())
                    .ok_or_else(|| {
                        let shown: String = line.chars().take(40).collect();
                        damaged(&format!("\"{shown}\" is no row of {} numbers", types.len()))
                    })?;
                for (column, number) in numbers.iter_mut().zip(row) {
                    column.push(number);
                }
            }
        }
    }
    let mut columns = Columns::default();
    for ((name, _), numbers) in vertex.properties.iter().zip(numbers) {
        columns.numbers.insert(name.clone(), numbers);
    }
    for (column, names) in head.names {
        columns.name(&column, |code| names.get(&code).cloned());
    }
    Ok(columns)
}
