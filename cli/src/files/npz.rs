//! Particles as NumPy's archive of arrays.

use std::io::{self, Write};

use sphpack_packing::Kind;
use sphpack_separation::Side;

use super::arrays::{Array, Values, in_blocks, measures, normals};
use super::number_type::ByteOrder;
use super::zip::Zip;
use crate::table::Table;

/// Writes particles, one array per column, not compressed; `kind`, `side` and `body` are text (`body` is empty where there
/// is none). The archive's remark says whether the packing was finished. Takes two passes over the table, one for checksums,
/// and some kilobytes.
///
/// # Errors
/// Those of `to`; where a number is not finite, before anything is written.
pub fn write_npz(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    let mut archive = Zip::new(to);
    write(table, &mut archive)?;
    let remark = match table.stop_reason.as_str() {
        "" => String::new(),
        reason => format!("stop_reason {reason}"),
    };
    archive.finish(&remark)
}

/// Adds the arrays.
pub(super) fn write(table: &Table, archive: &mut Zip<'_>) -> io::Result<()> {
    let n = table.len();
    let mut numbers = vec![
        Array::long("id", |i| i64::from(table.id[i])),
        Array::float("x", |i| table.position[i][0]),
        Array::float("y", |i| table.position[i][1]),
    ];
    if table.dimension == 3 {
        numbers.push(Array::float("z", |i| table.position[i][2]));
    }
    for array in &numbers {
        add_numbers(archive, array, n)?;
    }
    add_words(archive, "kind", &Kind::ALL.map(Kind::name), n, |i| {
        Kind::ALL.iter().position(|kind| *kind == table.kind[i])
    })?;
    add_words(archive, "side", &Side::ALL.map(Side::name), n, |i| {
        Side::ALL.iter().position(|side| *side == table.side[i])
    })?;
    let bodies: Vec<&str> = table.bodies.iter().map(String::as_str).collect();
    add_words(archive, "body", &bodies, n, |i| {
        table.body[i].map(usize::from)
    })?;
    for array in measures(table).iter().chain(&normals(table)) {
        add_numbers(archive, array, n)?;
    }
    Ok(())
}

fn add_numbers(archive: &mut Zip<'_>, array: &Array<'_>, count: usize) -> io::Result<()> {
    let kind = match array.values {
        Values::Byte(_) => "|u1",
        Values::Int(_) => "<i4",
        Values::Unsigned(_) => "<u4",
        Values::Long(_) => "<i8",
        Values::Float(_) | Values::Point(_) => "<f8",
    };
    archive.add(&format!("{}.npy", array.name), |to| {
        to.write_all(&head(kind, count))?;
        array.write(count, ByteOrder::Little, to)
    })
}

/// An array of words, each in as many letters of four bytes as the longest has.
fn add_words(
    archive: &mut Zip<'_>,
    name: &str,
    words: &[&str],
    count: usize,
    which: impl Fn(usize) -> Option<usize>,
) -> io::Result<()> {
    let width = words.iter().map(|word| word.chars().count()).max();
    // NumPy has no words without letters.
    let width = width.unwrap_or(0).max(1);
    let written = |word: &str| {
        let mut bytes: Vec<u8> = (word.chars())
            .flat_map(|letter| u32::from(letter).to_le_bytes())
            .collect();
        bytes.resize(4 * width, 0);
        bytes
    };
    let none = written("");
    let words: Vec<Vec<u8>> = words.iter().map(|word| written(word)).collect();
    archive.add(&format!("{name}.npy"), |to| {
        to.write_all(&head(&format!("<U{width}"), count))?;
        in_blocks(count, to, |i, block| {
            let word = which(i).and_then(|place| words.get(place));
            block.extend(word.unwrap_or(&none));
        })
    })
}

/// The head of one array: what its entries are and how many, filled up to a multiple of 64 bytes.
fn head(kind: &str, count: usize) -> Vec<u8> {
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({count},), }}");
    let length = (10 + text.len() + 1).next_multiple_of(64) - 10;
    while text.len() + 1 < length {
        text.push(' ');
    }
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(text.bytes());
    bytes
}
