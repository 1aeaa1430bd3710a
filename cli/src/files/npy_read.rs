//! Reading NumPy's arrays: one alone in an .npy file, and those in an archive.

use std::path::Path;

use super::Columns;
use super::number_type::{ByteOrder, NumberType};
use crate::Error;

/// Reads particles from one array: two or three numbers in each row, x y or x y z; or records with fields of these names.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, or its array cannot be places.
pub fn read_npy(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    read(bytes).map_err(|message| Error::input(path, message))
}

fn read(bytes: &[u8]) -> Result<Columns, String> {
    let damaged = |what: &str| format!("the NPY file {what}; write it again (numpy.save)");
    if !bytes.starts_with(MAGIC) {
        return Err("this is no NPY file; numpy.save writes one".into());
    }
    let array = Array::of(bytes).ok_or_else(|| damaged("has no readable head"))?;
    let cut_off = || damaged("is cut off");
    let mut columns = Columns::default();
    if let Some(fields) = array.fields()? {
        let [count] = array.shape[..] else {
            return Err(format!(
                "its records have the shape {}; save them with one axis (numpy.ravel)",
                array.shape_words()
            ));
        };
        let stride = (fields.iter()).try_fold(0_usize, |sum, field| sum.checked_add(field.size()?));
        let stride = stride.ok_or_else(|| damaged("has fields of a type that is not read"))?;
        let mut begin = 0;
        for field in fields {
            if let (Some(kind), 1) = (number_type(field.kind), field.entries) {
                let numbers = array.column(kind, order(field.kind), begin, stride, count);
                (columns.numbers).insert(field.name.to_owned(), numbers.ok_or_else(cut_off)?);
            }
            begin += field.size().unwrap_or(0);
        }
        return Ok(columns);
    }
    let kind = number_type(array.kind).ok_or_else(|| {
        format!(
            "its entries are of type \"{}\", not numbers that are read; save it as float64 (array.astype(float))",
            array.kind
        )
    })?;
    let [count, axes @ (2 | 3)] = array.shape[..] else {
        return Err(format!(
            "its array has the shape {}; places are needed, two or three numbers in each row: the shape (n, 2) or (n, 3) (numpy.column_stack)",
            array.shape_words()
        ));
    };
    let (step, stride) = if array.is_fortran {
        (count.checked_mul(kind.size()), Some(kind.size()))
    } else {
        (Some(kind.size()), axes.checked_mul(kind.size()))
    };
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate().take(axes) {
        let numbers = step.zip(stride).and_then(|(step, stride)| {
            let begin = step.checked_mul(axis)?;
            array.column(kind, order(array.kind), begin, stride, count)
        });
        (columns.numbers).insert(name.to_owned(), numbers.ok_or_else(cut_off)?);
    }
    Ok(columns)
}

const MAGIC: &[u8] = b"\x93NUMPY";

/// The number in `size` bytes at `at`, the least byte first.
pub(super) fn number(bytes: &[u8], at: usize, size: usize) -> Option<u64> {
    let mut raw = [0; 8];
    raw[..size].copy_from_slice(bytes.get(at..at.checked_add(size)?)?);
    Some(u64::from_le_bytes(raw))
}

/// What an array's bytes mean.
pub(super) struct Array<'a> {
    /// The type of its entries; empty for records.
    pub(super) kind: &'a str,
    /// How many entries along each axis.
    pub(super) shape: Vec<usize>,
    /// The first axis runs fastest.
    is_fortran: bool,
    /// The list of a record's fields, as it stands in the head.
    record: &'a str,
    data: &'a [u8],
}

/// The entries of an array of one axis.
pub(super) enum Values {
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

/// One field of a record.
struct Field<'a> {
    name: &'a str,
    kind: &'a str,
    /// More than one where the field is an array itself.
    entries: usize,
}

impl Field<'_> {
    /// In bytes.
    fn size(&self) -> Option<usize> {
        let (_, letter, size) = parts(self.kind)?;
        let letter_size = if letter == 'U' { 4 } else { 1 };
        size.checked_mul(letter_size)?.checked_mul(self.entries)
    }
}

impl<'a> Array<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Option<Self> {
        if !bytes.starts_with(MAGIC) {
            return None;
        }
        let (begin, length) = match *bytes.get(6)? {
            1 => (10, number(bytes, 8, 2)?),
            _ => (12, number(bytes, 8, 4)?),
        };
        let data = begin + length as usize;
        let head = std::str::from_utf8(bytes.get(begin..data)?).ok()?;
        let value = |text: &'a str| text.trim_start_matches([':', ' ']);
        // Fields of records may have any name, so what comes after them is sought from the end.
        let after = |key: &str| Some(value(head.rsplit_once(key)?.1));
        let kind = value(head.split_once("'descr'")?.1);
        let (kind, record) = match kind.strip_prefix('\'') {
            Some(kind) => (kind.split_once('\'')?.0, ""),
            None => ("", kind),
        };
        Some(Self {
            kind,
            shape: numbers_in_parentheses(after("'shape'")?)?,
            is_fortran: after("'fortran_order'")?.starts_with("True"),
            record,
            data: bytes.get(data..)?,
        })
    }

    /// Whether its entries are of a type that [`Self::values`] knows.
    pub(super) fn is_known(&self) -> bool {
        number_type(self.kind).is_some() || matches!(parts(self.kind), Some((_, 'U' | 'S', _)))
    }

    /// Whether its entries are objects of Python, which only Python can read.
    pub(super) fn is_of_objects(&self) -> bool {
        self.kind.ends_with('O')
    }

    fn shape_words(&self) -> String {
        let axes: Vec<String> = self.shape.iter().map(usize::to_string).collect();
        match &axes[..] {
            [one] => format!("({one},)"),
            _ => format!("({})", axes.join(", ")),
        }
    }

    /// The fields of records; `None` where the entries are none.
    fn fields(&self) -> Result<Option<Vec<Field<'a>>>, String> {
        if self.record.is_empty() {
            return Ok(None);
        }
        let fields = fields(self.record).filter(|fields| !fields.is_empty());
        fields.map(Some).ok_or_else(|| {
            "the fields of its records are not understood; save the places as an array of shape (n, 2) or (n, 3)".into()
        })
    }

    /// `count` numbers, the first at `begin`, each `stride` bytes after the one before; `None` where there are fewer.
    fn column(
        &self,
        kind: NumberType,
        order: ByteOrder,
        begin: usize,
        stride: usize,
        count: usize,
    ) -> Option<Vec<f64>> {
        // Before anything is reserved: the head may claim any number.
        if let Some(last) = count.checked_sub(1) {
            let end = (last.checked_mul(stride)?.checked_add(begin)?).checked_add(kind.size())?;
            self.data.get(..end)?;
        }
        let at = |i: usize| kind.number(order, self.data.get(begin + i * stride..)?);
        (0..count).map(at).collect()
    }

    /// The entries; `None` where there are fewer, or of another type.
    pub(super) fn values(&self, count: usize) -> Option<Values> {
        let (order, letter, size) = parts(self.kind)?;
        let exactly = |size: usize| self.data.get(..count.checked_mul(size)?);
        if let Some(number_type) = number_type(self.kind) {
            let bytes = exactly(number_type.size())?;
            return Some(Values::Numbers(number_type.numbers(order, bytes)));
        }
        let width = match letter {
            'U' => size.checked_mul(4)?,
            'S' => size,
            _ => return None,
        };
        if width == 0 {
            // `count` is only claimed.
            return (count == 0).then(|| Values::Words(Vec::new()));
        }
        let word = |raw: &[u8]| {
            let letters: String = match letter {
                'U' => (NumberType::U32.numbers(order, raw).into_iter())
                    .map(|letter| char::from_u32(letter as u32).unwrap_or('\u{fffd}'))
                    .collect(),
                _ => String::from_utf8_lossy(raw).into_owned(),
            };
            letters.trim_end_matches('\0').to_owned()
        };
        let words = exactly(width)?.chunks_exact(width).map(word);
        Some(Values::Words(words.collect()))
    }
}

/// The numbers of a tuple that the text begins with.
fn numbers_in_parentheses(text: &str) -> Option<Vec<usize>> {
    let inner = text.strip_prefix('(')?.split_once(')')?.0;
    (inner.split(',').map(str::trim))
        .filter(|axis| !axis.is_empty())
        .map(|axis| axis.parse().ok())
        .collect()
}

/// A type's byte order, its letter, and its size in bytes (of words, in letters).
fn parts(kind: &str) -> Option<(ByteOrder, char, usize)> {
    let mut letters = kind.chars();
    let order = match letters.next()? {
        '>' => ByteOrder::Big,
        _ => ByteOrder::Little,
    };
    let letter = letters.next()?;
    Some((order, letter, letters.as_str().parse().ok()?))
}

fn order(kind: &str) -> ByteOrder {
    parts(kind).map_or(ByteOrder::Little, |(order, _, _)| order)
}

fn number_type(kind: &str) -> Option<NumberType> {
    let (_, letter, size) = parts(kind)?;
    Some(match (letter, size) {
        ('f', 8) => NumberType::F64,
        ('f', 4) => NumberType::F32,
        ('i', 1) => NumberType::I8,
        ('u' | 'b', 1) => NumberType::U8,
        ('i', 2) => NumberType::I16,
        ('u', 2) => NumberType::U16,
        ('i', 4) => NumberType::I32,
        ('u', 4) => NumberType::U32,
        ('i', 8) => NumberType::I64,
        ('u', 8) => NumberType::U64,
        _ => return None,
    })
}

/// The fields in `[('x', '<f8'), ('name', '<U3'), ('v', '<f8', (3,)), …]`.
fn fields(list: &str) -> Option<Vec<Field<'_>>> {
    let mut rest = list.strip_prefix('[')?;
    let mut all = Vec::new();
    loop {
        rest = rest.trim_start_matches([',', ' ']);
        if rest.starts_with(']') {
            return Some(all);
        }
        let (name, more) = quoted(rest.strip_prefix('(')?)?;
        let (kind, more) = quoted(more.trim_start().strip_prefix(',')?.trim_start())?;
        let mut more = more.trim_start_matches([',', ' ']);
        let mut entries = 1_usize;
        if more.starts_with('(') {
            let axes = numbers_in_parentheses(more)?;
            entries = axes.into_iter().try_fold(1, usize::checked_mul)?;
            more = more.split_once(')')?.1;
        }
        rest = more.trim_start_matches([',', ' ']).strip_prefix(')')?;
        all.push(Field {
            name,
            kind,
            entries,
        });
    }
}

/// The text in the quotation marks that `text` begins with, and what follows.
fn quoted(text: &str) -> Option<(&str, &str)> {
    let mark = text.chars().next().filter(|c| matches!(c, '\'' | '"'))?;
    text.get(1..)?.split_once(mark)
}
