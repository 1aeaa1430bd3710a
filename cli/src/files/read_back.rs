//! Whether a particle file holds what was computed, asked of the file itself.

use std::fs;
use std::path::Path;

use super::{Columns, ParticleFormat};
use crate::memory::available_bytes;
use crate::table::Table;

/// What one particle's columns take, bytes: at most thirteen numbers and three words.
const ROW_BYTES: f64 = 300.0;

/// Reads a file of particles again and compares every column with the table, to the bit. Holds the file and its columns
/// for that long; where there is no memory for them, nothing is compared, and the answer is `false`.
///
/// # Errors
/// The first difference, by column and particle, or why the file cannot be read.
pub(crate) fn compare(table: &Table, format: ParticleFormat, path: &Path) -> Result<bool, String> {
    let size = fs::metadata(path).map_or(0, |meta| meta.len()) as f64;
    // What has been computed must not be lost for the sake of looking at it again.
    if size + ROW_BYTES * table.len() as f64 > available_bytes() {
        return Ok(false);
    }
    let columns = fs::read(path)
        .map_err(|e| format!("it cannot be read again ({e})"))
        .and_then(|bytes| {
            Columns::parse(format, &bytes, path)
                .map_err(|e| format!("it cannot be read again ({e})"))
        })?;
    let rows = columns.numbers.get("x").map_or(0, Vec::len);
    if rows != table.len() {
        return Err(format!(
            "read again, it has {rows} particles instead of {}; this is a fault of the disk or of sphpack, try another format",
            table.len()
        ));
    }
    numbers(&columns, table)?;
    words(&columns, table)?;
    Ok(true)
}

fn differs(column: &str, particle: u32, is: impl ToString, instead: impl ToString) -> String {
    format!(
        "read again, {column} of particle {particle} is {} instead of {}; this is a fault of the disk or of sphpack, try another format",
        is.to_string(),
        instead.to_string()
    )
}

fn lacks(column: &str) -> String {
    format!("read again, it has no column {column}; this is a fault of sphpack, try another format")
}

/// A column's entries by row.
type Entries<'a> = Box<dyn Fn(usize) -> f64 + 'a>;

fn numbers(columns: &Columns, table: &Table) -> Result<(), String> {
    let mut all: Vec<(&str, Entries<'_>)> = vec![
        ("id", Box::new(|i| f64::from(table.id[i]))),
        ("x", Box::new(|i| table.position[i][0])),
        ("y", Box::new(|i| table.position[i][1])),
        ("z", Box::new(|i| table.position[i][2])),
        ("volume", Box::new(|i| table.volume[i])),
        ("mass", Box::new(|i| table.mass[i])),
        ("gamma", Box::new(|i| table.gamma[i])),
        ("residual", Box::new(|i| table.residual[i])),
        ("nx", Box::new(|i| table.normal(i)[0])),
        ("ny", Box::new(|i| table.normal(i)[1])),
        ("nz", Box::new(|i| table.normal(i)[2])),
    ];
    if !table.pressure.is_empty() {
        all.push(("pressure", Box::new(|i| table.pressure[i])));
        all.push(("density", Box::new(|i| table.density[i])));
    }
    for (name, expected) in all {
        let Some(column) = columns.numbers.get(name) else {
            // Files of the plane may leave out what is 0 there.
            if table.dimension == 2 && matches!(name, "z" | "nz") {
                continue;
            }
            return Err(lacks(name));
        };
        if column.len() != table.len() {
            return Err(lacks(name));
        }
        for (i, &is) in column.iter().enumerate() {
            let expected = expected(i);
            let is_same = is.to_bits() == expected.to_bits() || is.is_nan() && expected.is_nan();
            if !is_same {
                return Err(differs(name, table.id[i], is, expected));
            }
        }
    }
    Ok(())
}

fn words<'t>(columns: &Columns, table: &'t Table) -> Result<(), String> {
    let body = |i: usize| -> &'t str {
        (table.body[i].and_then(|b| table.bodies.get(usize::from(b)))).map_or("", String::as_str)
    };
    let all: [(&str, &dyn Fn(usize) -> &'t str); 3] = [
        ("kind", &|i| table.kind[i].name()),
        ("side", &|i| table.side[i].name()),
        ("body", &body),
    ];
    for (name, expected) in all {
        let Some(column) = columns
            .words
            .get(name)
            .filter(|all| all.len() == table.len())
        else {
            // Numbers of bodies have no names where there are no bodies.
            let numbers = columns.numbers.get(name);
            let is_none = numbers.is_some_and(|all| all.iter().all(|&number| number == -1.0));
            if name == "body" && is_none && (0..table.len()).all(|i| body(i).is_empty()) {
                continue;
            }
            return Err(lacks(name));
        };
        for (i, is) in column.iter().enumerate() {
            if is != expected(i) {
                let quoted = |word: &str| format!("\"{word}\"");
                return Err(differs(name, table.id[i], quoted(is), quoted(expected(i))));
            }
        }
    }
    Ok(())
}
