//! Whether a particle file holds what was computed, asked of the file itself.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::bi4_case::derived;
use super::carried::Digits;
use super::columns::Entries;
use super::vtu_read::{Names, visit};
use super::{Columns, ParticleFormat};
use crate::memory::available_bytes;
use crate::table::Table;

/// Memory for a file and its columns, in bytes of the file: most is that of text with words, more where the file has a word once for
/// many particles.
fn bytes_per_byte(format: ParticleFormat) -> f64 {
    if format.carried().is_some() { 6.0 } else { 3.0 }
}

/// Reads a file of particles again and compares every column that the format holds with the table, to the last bit that it holds: VTK's XML files piece by piece; others
/// are held with their columns for that long, and where there is no memory for that, nothing is compared, and the answer is `false`.
///
/// # Errors
/// The first difference, by column and particle, or why the file cannot be read.
pub(crate) fn compare(table: &Table, format: ParticleFormat, path: &Path) -> Result<bool, String> {
    let unreadable = |why: &dyn ToString| format!("it cannot be read again ({})", why.to_string());
    let mut found = Found::of(table, format);
    if format.is_read_by_column() {
        let mut file = fs::File::open(path).map_err(|e| unreadable(&e))?;
        let mut take = |name: &str, piece: &[f64]| found.piece(name, piece);
        let names = visit(&mut file, &mut take).map_err(|e| unreadable(&e))?;
        found.names(&names);
        return found.end().map(|()| true);
    }
    let size = fs::metadata(path).map_or(0, |meta| meta.len()) as f64;
    // What has been computed must not be lost for the sake of looking at it again.
    if bytes_per_byte(format) * size > available_bytes() {
        return Ok(false);
    }
    let bytes = fs::read(path).map_err(|e| unreadable(&e))?;
    let columns = Columns::parse(format, &bytes, path).map_err(|e| unreadable(&e))?;
    drop(bytes);
    for (name, numbers) in &columns.numbers {
        found.piece(name, numbers);
    }
    for (name, words) in &columns.words {
        found.words(name, words.len(), |i| &words[i]);
    }
    found.end().map(|()| true)
}

fn differs(column: &str, particle: u32, is: impl ToString, instead: impl ToString) -> String {
    format!(
        "read again, {column} of particle {particle} is {} instead of {}; this is a fault of the disk or of sphpack, try another format",
        is.to_string(),
        instead.to_string()
    )
}

fn lacks(column: &str) -> String {
    format!("read again, it has no column {column}; this is a fault of sphpack, try another format")
}

/// What is found in a file, column by column.
struct Found<'t> {
    table: &'t Table,
    /// The rows that the file has, in its order, where that is not the table's.
    order: Option<Vec<u32>>,
    /// Columns of numbers that are to be there.
    expected: Vec<(&'static str, Entries<'t>, Digits)>,
    /// Columns of words that are to be there.
    words: &'static [&'static str],
    /// Rows of every column so far.
    rows: BTreeMap<String, usize>,
    /// Columns of words that stand as numbers.
    codes: BTreeMap<String, Vec<f64>>,
    /// The first difference.
    difference: Option<String>,
}

/// Columns of words.
const WORDS: [&str; 3] = ["kind", "side", "body"];

impl<'t> Found<'t> {
    fn of(table: &'t Table, format: ParticleFormat) -> Self {
        let mut all: Vec<(&str, Entries<'_>)> = vec![
            ("x", Box::new(|i| table.position[i][0])),
            ("y", Box::new(|i| table.position[i][1])),
            ("z", Box::new(|i| table.position[i][2])),
            ("id", Box::new(|i| f64::from(table.id[i]))),
            ("volume", Box::new(|i| table.volume[i])),
            ("mass", Box::new(|i| table.mass[i])),
            ("density", Box::new(|i| table.density_of(i))),
            ("h", Box::new(|i| table.smoothing_length_of(i))),
            ("spacing", Box::new(|i| table.spacing_of(i))),
            ("gamma", Box::new(|i| table.gamma[i])),
            ("residual", Box::new(|i| table.residual[i])),
            ("nx", Box::new(|i| table.normal(i)[0])),
            ("ny", Box::new(|i| table.normal(i)[1])),
            ("nz", Box::new(|i| table.normal(i)[2])),
        ];
        if !table.pressure.is_empty() {
            all.push(("pressure", Box::new(|i| table.pressure[i])));
        }
        if !table.distance.is_empty() {
            all.push(("distance", Box::new(|i| table.distance[i])));
        }
        if format == ParticleFormat::Bi4 {
            all.extend(derived(table));
        }
        let carried = format.carried();
        let digits = |name: &str| match &carried {
            None => Some(Digits::All),
            Some(carried) => {
                let mut numbers = carried.numbers.iter();
                numbers
                    .find(|(own, _)| *own == name)
                    .map(|(_, digits)| *digits)
            }
        };
        let expected = (all.into_iter())
            .filter_map(|(name, entries)| Some((name, entries, digits(name)?)))
            .collect();
        Self {
            table,
            order: format.order(table),
            expected,
            words: carried.as_ref().map_or(&WORDS, |carried| carried.words),
            rows: BTreeMap::new(),
            codes: BTreeMap::new(),
            difference: None,
        }
    }

    /// Rows that the file is to have.
    fn len(&self) -> usize {
        (self.order.as_ref()).map_or(self.table.len(), Vec::len)
    }

    /// The table's row that is the file's row `i`.
    fn row(&self, i: usize) -> usize {
        (self.order.as_ref()).map_or(i, |order| order[i] as usize)
    }

    /// More of a column of numbers.
    fn piece(&mut self, name: &str, piece: &[f64]) {
        let len = self.len();
        if WORDS.contains(&name) {
            let codes = self.codes.entry(name.to_owned()).or_default();
            codes.extend_from_slice(piece);
            return;
        }
        let Some((_, expected, digits)) = self.expected.iter().find(|(own, ..)| *own == name)
        else {
            return;
        };
        let rows = self.rows.entry(name.to_owned()).or_default();
        let begin = *rows;
        *rows += piece.len();
        if *rows > len || self.difference.is_some() {
            return;
        }
        let is_same = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
        let instead = |i: usize| digits.of(expected(self.row(i)));
        let difference = (piece.iter().zip(begin..))
            .find(|&(&is, i)| !is_same(is, instead(i)))
            .map(|(is, i)| differs(name, self.table.id[self.row(i)], is, instead(i)));
        self.difference = difference;
    }

    /// What the numbers stand for.
    fn names(&mut self, names: &Names) {
        for (name, names) in names {
            if let Some(codes) = self.codes.remove(name) {
                let word = |i: usize| {
                    let code = (codes[i] >= 0.0).then_some(codes[i] as usize);
                    code.and_then(|code| names.get(code))
                        .map_or("", String::as_str)
                };
                self.words(name, codes.len(), word);
            }
        }
    }

    /// A column of so many words.
    fn words<'w>(&mut self, name: &str, count: usize, word: impl Fn(usize) -> &'w str) {
        if !self.words.contains(&name) || count != self.len() {
            return;
        }
        self.rows.insert(name.to_owned(), count);
        let quoted = |word: &str| format!("\"{word}\"");
        let difference = (0..count)
            .find(|&i| word(i) != self.expected_word(name, i))
            .map(|i| {
                let instead = quoted(self.expected_word(name, i));
                differs(name, self.table.id[self.row(i)], quoted(word(i)), instead)
            });
        self.difference = self.difference.take().or(difference);
    }

    fn expected_word(&self, name: &str, i: usize) -> &'t str {
        let (table, i) = (self.table, self.row(i));
        match name {
            "kind" => table.kind[i].name(),
            "side" => table.side[i].name(),
            _ => table.body_name(i).unwrap_or(""),
        }
    }

    /// Whether nothing differs and nothing lacks.
    fn end(mut self) -> Result<(), String> {
        let len = self.len();
        // Numbers of bodies have no names where there are no bodies.
        if let Some(codes) = self.codes.remove("body")
            && codes.len() == len
            && codes.iter().all(|&code| code == -1.0)
        {
            self.words("body", codes.len(), |_| "");
        }
        let rows = |name: &str| self.rows.get(name).copied();
        if let Some(rows) = rows("x").filter(|&rows| rows != len) {
            return Err(format!(
                "read again, it has {rows} particles instead of {len}; this is a fault of the disk or of sphpack, try another format"
            ));
        }
        if let Some(difference) = self.difference {
            return Err(difference);
        }
        let is_whole = |name: &str| match rows(name) {
            Some(rows) => rows == len,
            // Files of the plane may leave out what is 0 there.
            None => self.table.dimension == 2 && matches!(name, "z" | "nz"),
        };
        let numbers = (self.expected.iter()).map(|&(name, ..)| name);
        let mut needed = numbers.chain(self.words.iter().copied());
        (needed.find(|name| !is_whole(name))).map_or(Ok(()), |name| Err(lacks(name)))
    }
}
