//! Particles as comma-separated text: a header, then one row per particle.

use std::io::{self, Write};
use std::path::Path;

use super::Columns;
use super::columns::NUMBERS;
use super::csv_header::{Header, rows};
use super::shortest::Short;
use crate::Error;
use crate::table::Table;

/// Writes particles. Numbers are the shortest that read back to the same bits.
///
/// # Errors
/// Those of `to`; where a number is not finite, before anything is written.
pub fn write_csv(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    let space = table.dimension == 3;
    let has_pressure = !table.pressure.is_empty();
    let has_distance = !table.distance.is_empty();
    let pressure = if has_pressure { ",pressure" } else { "" };
    let distance = if has_distance { ",distance" } else { "" };
    let (z, nz) = if space { (",z", ",nz") } else { ("", "") };
    writeln!(
        to,
        "id,x,y{z},kind,side,body,volume,mass,density,h,spacing,gamma,residual,nx,ny{nz}{pressure}{distance}"
    )?;
    let names: Vec<String> = table.bodies.iter().map(|name| quoted(name)).collect();
    for i in 0..table.len() {
        let [x, y, z] = table.position[i].map(Short);
        write!(to, "{},{x},{y}", table.id[i])?;
        if space {
            write!(to, ",{z}")?;
        }
        let body = table.body[i]
            .and_then(|b| names.get(usize::from(b)))
            .map_or("", String::as_str);
        let [nx, ny, nz] = table.normal(i).map(Short);
        write!(
            to,
            ",{},{},{body},{},{},{},{},{},{},{},{nx},{ny}",
            table.kind[i].name(),
            table.side[i].name(),
            Short(table.volume[i]),
            Short(table.mass[i]),
            Short(table.density_of(i)),
            Short(table.smoothing_length_of(i)),
            Short(table.spacing_of(i)),
            Short(table.gamma[i]),
            Short(table.residual[i]),
        )?;
        if space {
            write!(to, ",{nz}")?;
        }
        if has_pressure {
            write!(to, ",{}", Short(table.pressure[i]))?;
        }
        if has_distance {
            write!(to, ",{}", Short(table.distance[i]))?;
        }
        writeln!(to)?;
    }
    Ok(())
}

/// A field in quotation marks where it needs them.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', ';']) || field.trim() != field {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

/// No header has so many bytes.
const LONGEST_LINE: usize = 1 << 20;

/// Reads particles: names with x and y at least, in a header or a comment above the numbers, or none above two or three
/// columns of numbers; fields separated by commas, semicolons, tabs or spaces.
///
/// # Errors
/// [`Error::Input`] with the line.
pub fn read_csv(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    // Bytes that no text has, or a line that is no row: seen before anything is made of them that takes as much memory again.
    let first = bytes.iter().position(|&byte| byte == b'\n' || byte == 0);
    let is_line = first.map_or(bytes.len() <= LONGEST_LINE, |at| {
        bytes[at] != 0 && at <= LONGEST_LINE
    });
    let text = (is_line.then(|| std::str::from_utf8(bytes)))
        .and_then(Result::ok)
        .ok_or_else(|| {
            Error::input(
                path,
                "this is not text in lines; a particle CSV has a header line with x,y and numbers below",
            )
        })?;
    let text = text.trim_start_matches('\u{feff}');
    let Header {
        names,
        separator,
        line: header_line,
    } = Header::of(text, path)?;
    let rows = rows(text).filter(|&(line, _)| line > header_line);
    let fields = |row| separator.fields_of(row, names.len());
    // Twice over the rows, first to see what they are: as text they would take many times the memory.
    let mut kinds = names
        .iter()
        .map(|name| Column::of(name))
        .collect::<Vec<_>>();
    let mut count = 0;
    for (line, row) in rows.clone() {
        let row = fields(row);
        if row.len() != names.len() {
            return Err(Error::input_line(
                path,
                line,
                format!(
                    "{} fields, but the {} has {}; complete the row",
                    row.len(),
                    if header_line > 0 {
                        "header"
                    } else {
                        "first row"
                    },
                    names.len()
                ),
            ));
        }
        for (kind, field) in kinds.iter_mut().zip(&row) {
            kind.see(field, line);
        }
        count += 1;
    }
    for (name, kind) in names.iter().zip(&kinds) {
        if let Column::Spoilt(line, field) = kind {
            return Err(Error::input_line(
                path,
                *line,
                format!("{name} is \"{field}\", not a finite number; correct or remove the row"),
            ));
        }
    }
    let mut numbers: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
    let mut words: Vec<Vec<String>> = vec![Vec::new(); names.len()];
    for (place, kind) in kinds.iter().enumerate() {
        match kind {
            Column::Words => words[place].reserve_exact(count),
            _ => numbers[place].reserve_exact(count),
        }
    }
    for (_, row) in rows {
        for (place, field) in fields(row).into_iter().enumerate() {
            match kinds[place] {
                Column::Words => words[place].push(field.into_owned()),
                _ => numbers[place].extend(field.trim().parse::<f64>()),
            }
        }
    }
    let mut result = Columns::default();
    let columns = names
        .into_iter()
        .zip(kinds)
        .zip(numbers.into_iter().zip(words));
    for ((name, kind), (numbers, words)) in columns {
        match kind {
            Column::Words => drop(result.words.insert(name, words)),
            _ => drop(result.numbers.insert(name, numbers)),
        }
    }
    Ok(result)
}

/// What a column's fields have turned out to be so far.
enum Column {
    /// They must be finite numbers.
    Needed,
    /// One of them is not, in this line.
    Spoilt(usize, String),
    /// All are numbers.
    Numbers,
    Words,
}

impl Column {
    fn of(name: &str) -> Self {
        match name {
            "kind" | "side" | "body" => Self::Words,
            name if NUMBERS.contains(&name) => Self::Needed,
            _ => Self::Numbers,
        }
    }

    fn see(&mut self, field: &str, line: usize) {
        let number = || field.trim().parse::<f64>().ok();
        match self {
            Self::Needed if !number().is_some_and(f64::is_finite) => {
                *self = Self::Spoilt(line, field.chars().take(40).collect());
            }
            Self::Numbers if number().is_none() => *self = Self::Words,
            _ => {}
        }
    }
}
