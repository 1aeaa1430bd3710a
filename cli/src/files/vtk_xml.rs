//! VTK's XML files: one vertex cell per particle, numbers appended in raw binary.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::arrays::{Array, Values, code_names, codes, measures, points, vectors};
use super::number_type::ByteOrder;
use crate::table::Table;

/// What differs between the kinds of grids.
pub(super) struct Grid<'a> {
    /// VTK's name of the kind.
    pub(super) kind: &'static str,
    /// The element that holds the cells.
    pub(super) cells: &'static str,
    /// How a piece counts its cells; "{n}" is their number.
    pub(super) count: &'static str,
    /// What the cells are, one entry per particle.
    pub(super) arrays: Vec<Array<'a>>,
}

/// Where each cell's point is, and where its list of points ends.
pub(super) fn one_point_each() -> [Array<'static>; 2] {
    [
        Array::long("connectivity", |i| i as i64),
        Array::long("offsets", |i| i as i64 + 1),
    ]
}

/// Writes particles as `grid`.
pub(super) fn write(table: &Table, grid: &Grid<'_>, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    let n = table.len();
    let points = points(table);
    let mut data = vec![Array::long("id", |i| i64::from(table.id[i]))];
    data.extend(codes(table));
    data.extend(measures(table));
    data.extend(vectors(table));

    let mut offset = 0;
    let mut declare = |array: &Array<'_>| {
        // Said of one number only where it must be: some readers make a table of one column of it.
        let components = match array.components() {
            1 => String::new(),
            several => format!(" NumberOfComponents=\"{several}\""),
        };
        let line = format!(
            "<DataArray type=\"{}\" Name=\"{}\"{components} format=\"appended\" offset=\"{offset}\"/>\n",
            type_name(&array.values),
            array.name
        );
        offset += 8 + n * array.size();
        line
    };
    let Grid { kind, cells, .. } = grid;
    let mut head = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<{kind}>\n<FieldData>\n"
    );
    for (column, values) in code_names(table) {
        for (code, name) in values.iter().enumerate() {
            head += &field(column, name, code);
        }
    }
    if !table.stop_reason.is_empty() {
        head += &field("stop_reason", &table.stop_reason, 0);
    }
    let count = grid.count.replace("{n}", &n.to_string());
    let _ = write!(
        head,
        "</FieldData>\n<Piece NumberOfPoints=\"{n}\" {count}>\n<Points>\n"
    );
    head += &declare(&points);
    let _ = write!(head, "</Points>\n<{cells}>\n");
    for array in &grid.arrays {
        head += &declare(array);
    }
    let _ = write!(head, "</{cells}>\n<PointData>\n");
    for array in &data {
        head += &declare(array);
    }
    let _ = write!(
        head,
        "</PointData>\n</Piece>\n</{kind}>\n<AppendedData encoding=\"raw\">\n_"
    );
    to.write_all(head.as_bytes())?;

    for array in std::iter::once(&points).chain(&grid.arrays).chain(&data) {
        to.write_all(&((n * array.size()) as u64).to_le_bytes())?;
        array.write(n, ByteOrder::Little, to)?;
    }
    to.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}

fn type_name(values: &Values<'_>) -> &'static str {
    match values {
        Values::Byte(_) => "UInt8",
        Values::Int(_) => "Int32",
        Values::Unsigned(_) => "UInt32",
        Values::Long(_) => "Int64",
        Values::Float(_) | Values::Point(_) => "Float64",
    }
}

/// A field that says which number stands for a name: `kind:free` is 0. Not all readers know fields of strings.
fn field(column: &str, name: &str, code: usize) -> String {
    format!(
        "<DataArray type=\"Int32\" Name=\"{column}:{}\" NumberOfTuples=\"1\" format=\"ascii\">{code}</DataArray>\n",
        escaped(name)
    )
}

/// A name as an attribute's value.
pub(super) fn escaped(name: &str) -> String {
    let mut text = String::new();
    for letter in name.chars() {
        match letter {
            '&' => text += "&amp;",
            '<' => text += "&lt;",
            '>' => text += "&gt;",
            '"' => text += "&quot;",
            other => text.push(other),
        }
    }
    text
}

/// A name from an attribute's value.
pub(super) fn unescaped(value: &str) -> String {
    (value.replace("&lt;", "<").replace("&gt;", ">"))
        .replace("&quot;", "\"")
        .replace("&apos;", "'")
        .replace("&amp;", "&")
}
