//! Particles as VTK's unstructured grid: one vertex cell per particle, numbers appended in raw binary.

use std::fmt::Write as _;
use std::io::{self, Write};

use sphpack_packing::Kind;
use sphpack_separation::Side;

use crate::table::Table;

/// Appends the bytes of one row's entry.
type Entry<'a> = Box<dyn Fn(usize, &mut Vec<u8>) + 'a>;

/// One array of the file.
struct Array<'a> {
    name: &'static str,
    /// VTK's name of the number type.
    number: &'static str,
    components: usize,
    /// Bytes of one entry.
    size: usize,
    /// Entry `i`, little-endian.
    entry: Entry<'a>,
}

impl<'a> Array<'a> {
    fn float(name: &'static str, value: impl Fn(usize) -> f64 + 'a) -> Self {
        Self {
            name,
            number: "Float64",
            components: 1,
            size: 8,
            entry: Box::new(move |i, to| to.extend(value(i).to_le_bytes())),
        }
    }

    fn byte(name: &'static str, value: impl Fn(usize) -> u8 + 'a) -> Self {
        Self {
            name,
            number: "UInt8",
            components: 1,
            size: 1,
            entry: Box::new(move |i, to| to.push(value(i))),
        }
    }

    fn int32(name: &'static str, value: impl Fn(usize) -> i32 + 'a) -> Self {
        Self {
            name,
            number: "Int32",
            components: 1,
            size: 4,
            entry: Box::new(move |i, to| to.extend(value(i).to_le_bytes())),
        }
    }

    fn int64(name: &'static str, value: impl Fn(usize) -> i64 + 'a) -> Self {
        Self {
            name,
            number: "Int64",
            components: 1,
            size: 8,
            entry: Box::new(move |i, to| to.extend(value(i).to_le_bytes())),
        }
    }
}

fn arrays(table: &Table) -> Vec<Array<'_>> {
    let mut all = vec![
        Array::int64("id", |i| i64::from(table.id[i])),
        Array::byte("kind", |i| place(&Kind::ALL, table.kind[i])),
        Array::byte("side", |i| place(&Side::ALL, table.side[i])),
        Array::int32("body", |i| table.body[i].map_or(-1, i32::from)),
        Array::float("volume", |i| table.volume[i]),
        Array::float("mass", |i| table.mass[i]),
        Array::float("gamma", |i| table.gamma[i]),
        Array::float("residual", |i| table.residual[i]),
        Array::float("nx", |i| table.normal[i][0]),
        Array::float("ny", |i| table.normal[i][1]),
    ];
    if table.dimension == 3 {
        all.push(Array::float("nz", |i| table.normal[i][2]));
    }
    all
}

fn place<T: PartialEq>(all: &[T], one: T) -> u8 {
    all.iter().position(|other| *other == one).unwrap_or(0) as u8
}

/// Writes particles. `kind`, `side` and `body` are integers; what they stand for is in the field data `kind_names`,
/// `side_names` and `body_names` (`body` is −1 where there is none); `stop_reason` says whether the packing was finished.
///
/// # Errors
/// Those of `to`.
pub fn write_vtu(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    let n = table.len();
    let points = Array {
        name: "Points",
        number: "Float64",
        components: 3,
        size: 24,
        entry: Box::new(|i, to| {
            for x in table.position[i] {
                to.extend(x.to_le_bytes());
            }
        }),
    };
    let cells = [
        Array::int64("connectivity", |i| i as i64),
        Array::int64("offsets", |i| i as i64 + 1),
        // VTK_VERTEX
        Array::byte("types", |_| 1),
    ];
    let data = arrays(table);

    let mut offset = 0;
    let mut declare = |array: &Array<'_>| {
        let line = format!(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{offset}\"/>\n",
            array.number, array.name, array.components
        );
        offset += 8 + n * array.size;
        line
    };
    let mut head = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n",
    );
    head += &names("kind_names", &Kind::ALL.map(Kind::name));
    head += &names("side_names", &Side::ALL.map(Side::name));
    if !table.bodies.is_empty() {
        head += &names("body_names", &table.bodies);
    }
    if !table.stop_reason.is_empty() {
        head += &names("stop_reason", std::slice::from_ref(&table.stop_reason));
    }
    let _ = write!(
        head,
        "</FieldData>\n<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{n}\">\n<Points>\n"
    );
    head += &declare(&points);
    head += "</Points>\n<Cells>\n";
    for array in &cells {
        head += &declare(array);
    }
    head += "</Cells>\n<PointData>\n";
    for array in &data {
        head += &declare(array);
    }
    head += "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    to.write_all(head.as_bytes())?;

    let mut block = Vec::with_capacity(1 << 16);
    for array in std::iter::once(&points).chain(&cells).chain(&data) {
        to.write_all(&((n * array.size) as u64).to_le_bytes())?;
        for start in (0..n).step_by(2048) {
            block.clear();
            for i in start..n.min(start + 2048) {
                (array.entry)(i, &mut block);
            }
            to.write_all(&block)?;
        }
    }
    to.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}

/// A field of strings, each letter by its number and each string ended by 0, as VTK wants them.
fn names(name: &str, values: &[impl AsRef<str>]) -> String {
    let mut line = format!(
        "<DataArray type=\"String\" Name=\"{name}\" NumberOfTuples=\"{}\" format=\"ascii\">\n",
        values.len()
    );
    for value in values {
        for byte in value.as_ref().bytes() {
            let _ = write!(line, "{byte} ");
        }
        line += "0\n";
    }
    line + "</DataArray>\n"
}
