//! Particles as comma-separated text: a header, then one row per particle.

use std::fmt;
use std::io::{self, Write};
use std::path::Path;

use super::Columns;
use super::columns::NUMBERS;
use crate::Error;
use crate::table::Table;

/// Writes particles. Numbers are the shortest that read back to the same bits.
///
/// # Errors
/// Those of `to`; where a number is not finite, before anything is written.
pub fn write_csv(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::sound::check(table)?;
    let space = table.dimension == 3;
    let has_pressure = !table.pressure.is_empty();
    let more = if has_pressure {
        ",pressure,density"
    } else {
        ""
    };
    let (z, nz) = if space { (",z", ",nz") } else { ("", "") };
    writeln!(
        to,
        "id,x,y{z},kind,side,body,volume,mass,gamma,residual,nx,ny{nz}{more}"
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
            ",{},{},{body},{},{},{},{},{nx},{ny}",
            table.kind[i].name(),
            table.side[i].name(),
            Short(table.volume[i]),
            Short(table.mass[i]),
            Short(table.gamma[i]),
            Short(table.residual[i]),
        )?;
        if space {
            write!(to, ",{nz}")?;
        }
        if has_pressure {
            write!(
                to,
                ",{},{}",
                Short(table.pressure[i]),
                Short(table.density[i])
            )?;
        }
        writeln!(to)?;
    }
    Ok(())
}

/// A number as the shortest text that reads back to the same bits.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size != 0.0 && !(1e-5..1e16).contains(&size) {
            write!(f, "{:e}", self.0)
        } else {
            write!(f, "{}", self.0)
        }
    }
}

/// A field in quotation marks where it needs them.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', ';']) || field.trim() != field {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

/// Reads particles: a header with x and y at least, fields separated by commas, semicolons or tabs.
///
/// # Errors
/// [`Error::Input`] with the line.
pub fn read_csv(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    let text = std::str::from_utf8(bytes).map_err(|_| {
        Error::input(
            path,
            "this is not text; a particle CSV has a header line with x,y and numbers below",
        )
    })?;
    let mut lines = text
        .trim_start_matches('\u{feff}')
        .lines()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let Some((header_line, header)) = lines.next() else {
        return Err(Error::input(
            path,
            "the file is empty; it needs a header line with x,y and one row per particle",
        ));
    };
    let separator = [',', ';', '\t']
        .into_iter()
        .find(|&c| header.contains(c))
        .unwrap_or(',');
    let names: Vec<String> = fields(header, separator)
        .into_iter()
        .map(|name| name.trim().to_lowercase())
        .collect();
    for needed in ["x", "y"] {
        if !names.iter().any(|name| name == needed) {
            return Err(Error::input_line(
                path,
                header_line + 1,
                format!(
                    "the header has no column \"{needed}\"; write it as x,y or x,y,z, with volume and kind if known"
                ),
            ));
        }
    }
    if let Some((index, twice)) = names
        .iter()
        .enumerate()
        .find(|(index, name)| names[..*index].contains(name))
    {
        return Err(Error::input_line(
            path,
            header_line + 1,
            format!(
                "column {} is called \"{twice}\" like an earlier one; give each its own name",
                index + 1
            ),
        ));
    }
    let mut columns: Vec<Vec<String>> = vec![Vec::new(); names.len()];
    let mut line_numbers = Vec::new();
    for (index, line) in lines {
        let row = fields(line, separator);
        if row.len() != names.len() {
            return Err(Error::input_line(
                path,
                index + 1,
                format!(
                    "{} fields, but the header has {}; complete the row",
                    row.len(),
                    names.len()
                ),
            ));
        }
        for (column, field) in columns.iter_mut().zip(row) {
            column.push(field);
        }
        line_numbers.push(index + 1);
    }
    let mut result = Columns::default();
    for (name, column) in names.into_iter().zip(columns) {
        let parsed: Vec<Option<f64>> = column.iter().map(|f| f.trim().parse().ok()).collect();
        let must = NUMBERS.contains(&name.as_str());
        if must
            && let Some(bad) = parsed
                .iter()
                .position(|number| !number.is_some_and(f64::is_finite))
        {
            return Err(Error::input_line(
                path,
                line_numbers[bad],
                format!(
                    "{name} is \"{}\", not a finite number; correct or remove the row",
                    column[bad].chars().take(40).collect::<String>()
                ),
            ));
        }
        match parsed.into_iter().collect::<Option<Vec<f64>>>() {
            Some(numbers) if must || !matches!(name.as_str(), "kind" | "side" | "body") => {
                result.numbers.insert(name, numbers);
            }
            _ => {
                result.words.insert(name, column);
            }
        }
    }
    Ok(result)
}

/// The fields of a row, without their quotation marks.
fn fields(row: &str, separator: char) -> Vec<String> {
    let mut all = vec![String::new()];
    let mut inside = false;
    let mut letters = row.chars().peekable();
    while let Some(letter) = letters.next() {
        let field = all.last_mut();
        match (letter, inside) {
            ('"', true) if letters.peek() == Some(&'"') => {
                letters.next();
                field.into_iter().for_each(|f| f.push('"'));
            }
            ('"', _) => inside = !inside,
            (c, false) if c == separator => all.push(String::new()),
            (c, _) => field.into_iter().for_each(|f| f.push(c)),
        }
    }
    all
}
