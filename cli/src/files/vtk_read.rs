//! Reading VTK's legacy files (unstructured grids and polygonal data), as far as particles need it: points and their
//! numbers, as text or in big-endian binary.

use std::collections::BTreeMap;
use std::path::Path;

use super::Columns;
use super::number_type::{ByteOrder, NumberType};
use crate::Error;

/// Reads particles: points, every point array of one component, and `normal`; others are left out. Integers with a field array
/// `NAME_names` become words. Memory grows with the bytes that are there, whatever they claim.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, or has no points.
pub fn read_vtk(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    let mut reader = Reader {
        rest: bytes,
        is_text: false,
    };
    reader.read().map_err(|message| Error::input(path, message))
}

fn damaged(what: &str) -> String {
    format!("the VTK file is damaged: {what}; write it again")
}

/// A few letters of something for a message.
fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}

/// What the arrays that are being read belong to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Whole,
    Points,
    Other,
}

struct Reader<'a> {
    rest: &'a [u8],
    is_text: bool,
}

/// An array's numbers or words, and how many make one entry.
enum Values {
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

impl<'a> Reader<'a> {
    fn read(&mut self) -> Result<Columns, String> {
        self.head()?;
        let mut columns = Columns::default();
        let mut names: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut points: Option<Vec<f64>> = None;
        let (mut section, mut count) = (Section::Whole, 0);
        while let Some(line) = self.line() {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[..] {
                ["POINTS", number, kind] => {
                    count = number_of(number)?;
                    points = Some(self.numbers(number_type(kind)?, times(count, 3)?)?);
                }
                ["POINT_DATA", number] => {
                    if number_of(number)? != count {
                        return Err(damaged(
                            "it has numbers for more or fewer points than there are",
                        ));
                    }
                    section = Section::Points;
                }
                ["CELL_DATA", _] => section = Section::Other,
                ["FIELD", _, number] => {
                    for _ in 0..number_of(number)? {
                        let (name, components, values) = self.array()?;
                        match values {
                            Values::Words(words) if section == Section::Whole => {
                                names.insert(name, words);
                            }
                            Values::Words(words)
                                if section == Section::Points && words.len() == count =>
                            {
                                columns.words.insert(name, words);
                            }
                            Values::Numbers(numbers)
                                if section == Section::Points && components == 1 =>
                            {
                                self.keep(&mut columns, name, numbers, count)?;
                            }
                            Values::Numbers(numbers)
                                if section == Section::Points
                                    && components == 3
                                    && name == "normal" =>
                            {
                                for (axis, name) in ["nx", "ny", "nz"].into_iter().enumerate() {
                                    let along = numbers.iter().skip(axis).step_by(3).copied();
                                    self.keep(
                                        &mut columns,
                                        name.to_owned(),
                                        along.collect(),
                                        count,
                                    )?;
                                }
                            }
                            _ => {}
                        }
                    }
                }
                ["SCALARS", name, kind, ref more @ ..] => {
                    let components = more.first().map_or(Ok(1), |number| number_of(number))?;
                    // A table of colours may follow, by name.
                    self.skip_line("LOOKUP_TABLE");
                    let numbers = self.numbers(number_type(kind)?, times(count, components)?)?;
                    if section == Section::Points && components == 1 {
                        self.keep(&mut columns, plain(name), numbers, count)?;
                    }
                }
                ["VECTORS" | "NORMALS", _, kind] => {
                    self.numbers(number_type(kind)?, times(count, 3)?)?;
                }
                ["CELL_TYPES", number] => {
                    self.numbers(NumberType::I32, number_of(number)?)?;
                }
                [
                    "CELLS" | "VERTICES" | "LINES" | "POLYGONS" | "TRIANGLE_STRIPS",
                    cells,
                    size,
                ] => {
                    self.cells(number_of(cells)?, number_of(size)?)?;
                }
                ["METADATA"] => {
                    while self.next_line().is_some_and(|line| !line.trim().is_empty()) {}
                }
                _ => {
                    return Err(format!(
                        "the VTK file has a part \"{}\", which is not read; save it as .vtu, .vtp, .npz, .ply or .csv",
                        shown(&line)
                    ));
                }
            }
        }
        let points = points.ok_or_else(|| damaged("it has no points"))?;
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let coordinates = points.iter().skip(axis).step_by(3).copied().collect();
            columns.numbers.insert(name.to_owned(), coordinates);
        }
        for (name, words) in names {
            if let Some(column) = name.strip_suffix("_names") {
                columns.name(column, |code| words.get(code).cloned());
            }
        }
        Ok(columns)
    }

    fn head(&mut self) -> Result<(), String> {
        if !self.rest.starts_with(b"# vtk DataFile") {
            return Err(
                "this is no legacy VTK file; one begins with \"# vtk DataFile Version\"".into(),
            );
        }
        // The version, and a title.
        self.next_line();
        self.next_line();
        self.is_text = match self.line().as_deref().map(str::trim) {
            Some("BINARY") => false,
            Some("ASCII") => true,
            _ => return Err(damaged("it says neither ASCII nor BINARY")),
        };
        let dataset = self.line().unwrap_or_default();
        match dataset.split_whitespace().collect::<Vec<_>>()[..] {
            ["DATASET", "UNSTRUCTURED_GRID" | "POLYDATA"] => Ok(()),
            _ => Err(format!(
                "this is a VTK file of \"{}\"; particles are read from UNSTRUCTURED_GRID and POLYDATA",
                shown(&dataset)
            )),
        }
    }

    fn keep(
        &self,
        columns: &mut Columns,
        name: String,
        numbers: Vec<f64>,
        count: usize,
    ) -> Result<(), String> {
        if numbers.len() != count {
            return Err(damaged(&format!(
                "array {} has {} numbers for {count} points",
                shown(&name),
                numbers.len()
            )));
        }
        columns.numbers.insert(name, numbers);
        Ok(())
    }

    /// The next line, however empty.
    fn next_line(&mut self) -> Option<String> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&byte| byte == b'\n');
        let (line, rest) = match end {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &self.rest[self.rest.len()..]),
        };
        self.rest = rest;
        Some(String::from_utf8_lossy(line).into_owned())
    }

    /// The next line with something in it.
    fn line(&mut self) -> Option<String> {
        loop {
            let line = self.next_line()?;
            if !line.trim().is_empty() {
                return Some(line);
            }
        }
    }

    /// Goes over the next line if it begins with `word`.
    fn skip_line(&mut self, word: &str) {
        if self.rest.starts_with(word.as_bytes()) {
            self.next_line();
        }
    }

    /// An array of a field: its name, the components of an entry, and its values.
    fn array(&mut self) -> Result<(String, usize, Values), String> {
        // Arrays may be followed by words about them.
        let mut line = self.line();
        while line
            .as_deref()
            .is_some_and(|line| line.trim() == "METADATA")
        {
            while self.next_line().is_some_and(|line| !line.trim().is_empty()) {}
            line = self.line();
        }
        let line = line.ok_or_else(|| damaged("an array is missing"))?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let [name, components, count, kind] = words[..] else {
            return Err(damaged(&format!("\"{}\" is no array", shown(&line))));
        };
        let components = number_of(components)?;
        let count = times(number_of(count)?, components)?;
        let values = if kind == "string" {
            Values::Words(self.strings(count)?)
        } else {
            Values::Numbers(self.numbers(number_type(kind)?, count)?)
        };
        Ok((plain(name), components, values))
    }

    /// `count` numbers; memory grows with the bytes that are there.
    fn numbers(&mut self, kind: NumberType, count: usize) -> Result<Vec<f64>, String> {
        let cut_off = || damaged(&format!("it ends before {count} numbers have been read"));
        if self.is_text {
            let mut numbers = Vec::new();
            while numbers.len() < count {
                let word = self.word().ok_or_else(cut_off)?;
                let number = std::str::from_utf8(word)
                    .ok()
                    .and_then(|word| word.parse().ok());
                numbers.push(number.ok_or_else(|| {
                    let word = String::from_utf8_lossy(word);
                    damaged(&format!("\"{}\" is no number", shown(&word)))
                })?);
            }
            return Ok(numbers);
        }
        let size = count.checked_mul(kind.size()).ok_or_else(cut_off)?;
        let (bytes, rest) = self.rest.split_at_checked(size).ok_or_else(cut_off)?;
        self.rest = rest.strip_prefix(b"\n").unwrap_or(rest);
        Ok(kind.numbers(ByteOrder::Big, bytes))
    }

    /// The next word of a text file.
    fn word(&mut self) -> Option<&'a [u8]> {
        let start = self
            .rest
            .iter()
            .position(|byte| !byte.is_ascii_whitespace())?;
        let rest = &self.rest[start..];
        let end = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        self.rest = &rest[end..];
        Some(&rest[..end])
    }

    fn strings(&mut self, count: usize) -> Result<Vec<String>, String> {
        let mut all = Vec::new();
        for _ in 0..count {
            let text = if self.is_text {
                self.next_line()
                    .map(|line| plain(line.trim_end_matches('\r')))
            } else {
                self.string()
            };
            all.push(text.ok_or_else(|| damaged("a word is cut off"))?);
        }
        Ok(all)
    }

    /// A string in binary: its length in as many bytes as its first two bits say, then its letters.
    fn string(&mut self) -> Option<String> {
        let size = [8, 4, 2, 1][usize::from(self.rest.first()? >> 6)];
        let (head, rest) = self.rest.split_at_checked(size)?;
        let length = head
            .iter()
            .fold(0, |number: u64, &byte| number << 8 | u64::from(byte));
        let length = length & (u64::MAX >> (64 - 8 * size + 2));
        let (text, rest) = rest.split_at_checked(usize::try_from(length).ok()?)?;
        self.rest = rest;
        Some(String::from_utf8_lossy(text).into_owned())
    }

    /// Goes over the lists of the cells' points.
    fn cells(&mut self, cells: usize, size: usize) -> Result<(), String> {
        // Since version 5: where each cell's list ends, then the lists, each with its type.
        if !self.rest.starts_with(b"OFFSETS") {
            return self.numbers(NumberType::I32, size).map(drop);
        }
        for (part, count) in [("OFFSETS", cells), ("CONNECTIVITY", size)] {
            let line = self.line().unwrap_or_default();
            match line.split_whitespace().collect::<Vec<_>>()[..] {
                [name, kind] if name == part => {
                    self.numbers(number_type(kind)?, count)?;
                }
                _ => return Err(damaged(&format!("its cells have no {part}"))),
            }
        }
        Ok(())
    }
}

fn number_of(word: &str) -> Result<usize, String> {
    word.parse()
        .map_err(|_| damaged(&format!("\"{}\" is no number of things", shown(word))))
}

fn times(count: usize, components: usize) -> Result<usize, String> {
    (count.checked_mul(components))
        .ok_or_else(|| damaged("it claims more numbers than there can be"))
}

/// A name or word without VTK's `%20` in place of spaces and the like.
fn plain(word: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = word.as_bytes();
    while let [first, more @ ..] = rest {
        let code = more.get(..2).filter(|_| *first == b'%');
        let code = code.and_then(|digits| std::str::from_utf8(digits).ok());
        if let Some(byte) = code.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            bytes.push(byte);
            rest = &more[2..];
        } else {
            bytes.push(*first);
            rest = more;
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn number_type(name: &str) -> Result<NumberType, String> {
    Ok(match name.to_ascii_lowercase().as_str() {
        "double" => NumberType::F64,
        "float" => NumberType::F32,
        "char" | "vtktypeint8" => NumberType::I8,
        "unsigned_char" | "vtktypeuint8" => NumberType::U8,
        "short" => NumberType::I16,
        "unsigned_short" => NumberType::U16,
        "int" | "vtkidtype" => NumberType::I32,
        "unsigned_int" => NumberType::U32,
        "long" | "vtktypeint64" => NumberType::I64,
        "unsigned_long" | "vtktypeuint64" => NumberType::U64,
        _ => {
            return Err(damaged(&format!(
                "\"{}\" is no type of numbers",
                shown(name)
            )));
        }
    })
}
