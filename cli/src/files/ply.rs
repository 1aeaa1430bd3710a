//! Particles as the vertices of a PLY file, little-endian binary.

use std::io::{self, Write};

use super::arrays::{Array, Values, code_names, codes, in_blocks, measures, normals};
use super::number_type::ByteOrder;
use crate::table::Table;

/// Writes particles as vertices with one property per column: x, y, z first, for readers that go by order; z and nz are
/// there in 2-D too, as 0. `kind`, `side` and `body` are integers; comments `kind 0 free`, `body 0 wing` … say what they
/// stand for (`body` is −1 where there is none). Takes one pass over the table and some kilobytes.
///
/// # Errors
/// Those of `to`; where a number is not finite, before anything is written.
pub fn write_ply(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    let mut all = vec![
        Array::float("x", |i| table.position[i][0]),
        Array::float("y", |i| table.position[i][1]),
        Array::float("z", |i| table.position[i][2]),
        Array::unsigned("id", |i| table.id[i]),
    ];
    all.extend(codes(table));
    all.extend(measures(table));
    all.extend(normals(table));
    if table.dimension == 2 {
        all.push(Array::float("nz", |i| table.normal(i)[2]));
    }

    to.write_all(b"ply\nformat binary_little_endian 1.0\ncomment particles of sphpack\n")?;
    for (column, names) in code_names(table) {
        for (code, name) in names.iter().enumerate() {
            writeln!(to, "comment {column} {code} {name}")?;
        }
    }
    if !table.stop_reason.is_empty() {
        writeln!(to, "comment stop_reason {}", table.stop_reason)?;
    }
    writeln!(to, "element vertex {}", table.len())?;
    for array in &all {
        writeln!(to, "property {} {}", type_name(&array.values), array.name)?;
    }
    to.write_all(b"end_header\n")?;
    in_blocks(table.len(), to, |i, block| {
        for array in &all {
            array.put(i, ByteOrder::Little, block);
        }
    })
}

fn type_name(values: &Values<'_>) -> &'static str {
    match values {
        Values::Byte(_) => "uchar",
        Values::Int(_) => "int",
        Values::Unsigned(_) => "uint",
        // PLY has no integers of 64 bits, and no points.
        Values::Long(_) | Values::Float(_) | Values::Point(_) => "double",
    }
}
