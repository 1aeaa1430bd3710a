//! What no particle file may hold.

use std::io;

use sphpack_packing::Kind;

use crate::table::Table;

/// Refuses numbers that are not finite, and names of bodies that would break lines.
pub(super) fn check(table: &Table) -> io::Result<()> {
    let refuse = |message: String| Err(io::Error::new(io::ErrorKind::InvalidData, message));
    if let Some(name) = (table.bodies.iter()).find(|name| name.chars().any(char::is_control)) {
        return refuse(format!(
            "the name of body {name:?} holds a control character"
        ));
    }
    for i in 0..table.len() {
        let [[x, y, z], [nx, ny, nz]] = [table.position[i], table.normal(i)];
        // What is frozen, and a wall in layers, is not judged.
        let is_unjudged = table.kind[i] == Kind::Frozen || table.is_wall(i);
        let judged = |number: f64| {
            if is_unjudged && number.is_nan() {
                0.0
            } else {
                number
            }
        };
        let row = [
            ("x", x),
            ("y", y),
            ("z", z),
            ("volume", table.volume[i]),
            ("mass", table.mass[i]),
            ("gamma", judged(table.gamma[i])),
            ("residual", judged(table.residual[i])),
            ("nx", nx),
            ("ny", ny),
            ("nz", nz),
            ("pressure", table.pressure.get(i).copied().unwrap_or(0.0)),
            ("distance", distance(table, i)),
            ("density", table.density_of(i)),
            ("h", table.smoothing_length_of(i)),
            ("spacing", table.spacing_of(i)),
        ];
        if let Some((name, number)) = row.iter().find(|(_, number)| !number.is_finite()) {
            return refuse(format!(
                "{name} of particle {} is {number}, which is no finite number",
                table.id[i]
            ));
        }
    }
    Ok(())
}

/// The distance of particle `i` of a wall, 0 of others.
fn distance(table: &Table, i: usize) -> f64 {
    let own = table.distance.get(i).copied();
    own.filter(|distance| !distance.is_nan()).unwrap_or(0.0)
}

/// Refuses numbers that 32 bits are too few for; `row` has a particle's, by name.
pub(super) fn check_single<const N: usize>(
    table: &Table,
    row: impl Fn(usize) -> [(&'static str, f64); N],
) -> io::Result<()> {
    for i in 0..table.len() {
        let row = row(i);
        let is_beyond = |number: f64| !(number as f32).is_finite();
        if let Some((name, number)) = row.iter().find(|(_, number)| is_beyond(*number)) {
            return Err(io::Error::new(
                io::ErrorKind::InvalidData,
                format!(
                    "{name} of particle {} is {number:e}, too large for the 32 bits that this format has; use other units, or another format",
                    table.id[i]
                ),
            ));
        }
    }
    Ok(())
}
