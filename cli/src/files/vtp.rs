//! Particles as VTK's polygonal data.

use std::io::{self, Write};

use super::vtk_xml::{Grid, one_point_each, write};
use crate::table::Table;

/// Writes particles, one vertex each, with the arrays and names of [`super::write_vtu`]; takes as much.
///
/// # Errors
/// Those of [`super::write_vtu`].
pub fn write_vtp(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    let grid = Grid {
        kind: "PolyData",
        cells: "Verts",
        count: "NumberOfVerts=\"{n}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"",
        arrays: Vec::from(one_point_each()),
    };
    write(table, &grid, to)
}
