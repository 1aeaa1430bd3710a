//! Particles as SPHinXsys reloads them: XML, a body at a time.

use std::io::{self, Write};

use super::by_body::{by_body, place_of_body};
use super::shortest::Short;
use super::vtk_xml::escaped;
use crate::table::Table;

/// The name that the fluid has as a body.
pub(super) const FLUID: &str = "fluid";

/// Writes particles as `Reload.xml` of SPHinXsys (`io_base.cpp`, from May 2026 on): in `reload_data` a `body` for each body that has
/// particles, in the scene's order, and one called `fluid` for what belongs to none; in it a row
/// `<particle Position="x, y, z" VolumetricMeasure="v" OriginalID="i"/>` each, without z in 2-D. Ids count from 0 in each body: the
/// solver takes them for places. Lengths are scene units. Masses, densities and normals are not in it.
///
/// # Errors
/// Those of `to`; before anything is written, where a number is not finite, or a body is called `fluid` as the fluid is.
pub fn write_reload(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    if has_fluid(table) && table.bodies.iter().any(|name| name == FLUID) {
        return Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "a body is called \"fluid\", as the fluid is in this file; give the body another name",
        ));
    }
    to.write_all(b"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<reload_data>\n")?;
    let order = by_body(table);
    for rows in order
        .chunk_by(|&i, &j| place_of_body(table, i as usize) == place_of_body(table, j as usize))
    {
        let name = table.body_name(rows[0] as usize).unwrap_or(FLUID);
        writeln!(to, "<body name=\"{}\">", escaped(name))?;
        particles(table, rows.iter().map(|&i| i as usize), to)?;
        writeln!(to, "</body>")?;
    }
    to.write_all(b"</reload_data>\n")
}

/// Writes particles as `NAME_rld.xml` of SPHinXsys (before May 2026): the rows of [`write_reload`] in the root `particles`, as those of one
/// body.
///
/// # Errors
/// Those of `to`; where a number is not finite, before anything is written.
pub fn write_reload_body(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    to.write_all(b"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<particles>\n")?;
    particles(table, 0..table.len(), to)?;
    to.write_all(b"</particles>\n")
}

fn particles(
    table: &Table,
    rows: impl Iterator<Item = usize>,
    to: &mut dyn Write,
) -> io::Result<()> {
    for (number, i) in rows.enumerate() {
        let [x, y, z] = table.position[i].map(Short);
        write!(to, "<particle Position=\"{x}, {y}")?;
        if table.dimension == 3 {
            write!(to, ", {z}")?;
        }
        let volume = Short(table.volume[i]);
        writeln!(
            to,
            "\" VolumetricMeasure=\"{volume}\" OriginalID=\"{number}\"/>"
        )?;
    }
    Ok(())
}

fn has_fluid(table: &Table) -> bool {
    (0..table.len()).any(|i| table.body_name(i).is_none())
}
