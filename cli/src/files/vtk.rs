//! Particles as VTK's legacy file: an unstructured grid in big-endian binary, for readers that know nothing newer.

use std::io::{self, Write};

use super::arrays::{Array, Values, code_names, codes, measures, points, vectors};
use super::number_type::ByteOrder;
use super::vtu::VERTEX;
use crate::table::Table;

/// The format counts with 32 bits, twice for each particle.
const MOST: usize = i32::MAX as usize / 2;

/// Writes particles, one vertex cell each, with the arrays and names of [`super::write_vtu`]; takes as much.
///
/// # Errors
/// Those of `to`; where a number is not finite, or where there are more than 2³⁰ particles, before anything is written.
pub fn write_vtk(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    let n = table.len();
    if n > MOST {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            format!("{n} particles are more than the {MOST} that a .vtk file can hold; write .vtu"),
        ));
    }
    to.write_all(
        b"# vtk DataFile Version 3.0\nparticles of sphpack\nBINARY\nDATASET UNSTRUCTURED_GRID\n",
    )?;

    let mut fields: Vec<(String, Vec<&str>)> = code_names(table)
        .into_iter()
        .filter(|(_, values)| !values.is_empty())
        .map(|(column, values)| (format!("{column}_names"), values))
        .collect();
    if !table.stop_reason.is_empty() {
        fields.push(("stop_reason".to_owned(), vec![&table.stop_reason]));
    }
    writeln!(to, "FIELD FieldData {}", fields.len())?;
    for (name, values) in fields {
        writeln!(to, "{name} 1 {} string", values.len())?;
        for value in values {
            to.write_all(&length(value.len()))?;
            to.write_all(value.as_bytes())?;
        }
        writeln!(to)?;
    }

    let block = |array: &Array<'_>, to: &mut dyn Write| {
        array.write(n, ByteOrder::Big, to)?;
        writeln!(to)
    };
    writeln!(to, "POINTS {n} double")?;
    block(&points(table), to)?;
    writeln!(to, "CELLS {n} {}", 2 * n)?;
    // How many points each cell has, then which: 1 and i are one number of 64 bits.
    block(&Array::long("cells", |i| 1 << 32 | i as i64), to)?;
    writeln!(to, "CELL_TYPES {n}")?;
    block(&Array::int("types", |_| VERTEX.into()), to)?;

    let mut data = vec![Array::unsigned("id", |i| table.id[i])];
    data.extend(codes(table));
    data.extend(measures(table));
    data.extend(vectors(table));
    write!(to, "POINT_DATA {n}\nFIELD FieldData {}\n", data.len())?;
    for array in &data {
        let (name, components) = (array.name, array.components());
        writeln!(to, "{name} {components} {n} {}", type_name(&array.values))?;
        block(array, to)?;
    }
    Ok(())
}

fn type_name(values: &Values<'_>) -> &'static str {
    match values {
        Values::Byte(_) => "unsigned_char",
        Values::Int(_) => "int",
        Values::Unsigned(_) => "unsigned_int",
        Values::Long(_) => "vtktypeint64",
        Values::Float(_) | Values::Point(_) => "double",
    }
}

/// A string's length in bytes; the first two bits say in how many bytes it is written.
fn length(bytes: usize) -> Vec<u8> {
    match bytes {
        0..=0x3f => vec![0b11 << 6 | bytes as u8],
        0x40..=0x3fff => (0b10 << 14 | bytes as u16).to_be_bytes().to_vec(),
        0x4000..=0x3fff_ffff => (0b01 << 30 | bytes as u32).to_be_bytes().to_vec(),
        _ => (bytes as u64).to_be_bytes().to_vec(),
    }
}
