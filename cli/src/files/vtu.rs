//! Particles as VTK's unstructured grid.

use std::io::{self, Write};

use super::arrays::Array;
use super::vtk_xml::{Grid, one_point_each, write};
use crate::table::Table;

/// VTK's number of the cell that is one point.
pub(super) const VERTEX: u8 = 1;

/// Writes particles, one vertex cell each. `kind`, `side` and `body` are integers; what they stand for is in the field
/// data, one integer for each name: `kind:free` is 0, `body:wing` the wing's number (`body` is −1 where there is none); `stop_reason:…`
/// says whether the packing was finished. `normal` and `velocity`, which is 0, are vectors. Takes one pass over the table and some kilobytes.
///
/// # Errors
/// Those of `to`; where a number is not finite, before anything is written.
pub fn write_vtu(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    let mut arrays = Vec::from(one_point_each());
    arrays.push(Array::byte("types", |_| VERTEX));
    let grid = Grid {
        kind: "UnstructuredGrid",
        cells: "Cells",
        count: "NumberOfCells=\"{n}\"",
        arrays,
    };
    write(table, &grid, to)
}
