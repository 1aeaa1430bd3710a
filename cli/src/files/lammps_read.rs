//! Reading data files of LAMMPS, as far as particles need it: atoms of the style sph.

use std::collections::BTreeMap;
use std::path::Path;

use super::Columns;
use crate::Error;

/// Reads particles: `id` (from 0), `x`, `y`, `z`, `mass` and `density`; `kind`, `side` and `body` where the comments behind the masses say them
/// as sphpack writes it.
///
/// # Errors
/// [`Error::Input`] with the line.
pub fn read_lammps(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    let text = std::str::from_utf8(bytes).map_err(|_| {
        Error::input(
            path,
            "this is not text; a data file of LAMMPS has lines of it",
        )
    })?;
    let mut data = Data::default();
    // LAMMPS passes over the first line, whatever it says.
    for (at, line) in text.lines().enumerate().skip(1) {
        data.line(line)
            .map_err(|message| Error::input_line(path, at + 1, message))?;
    }
    data.columns()
        .map_err(|message| Error::input(path, message))
}

/// The names of the columns, in the order of [`Atom`]'s numbers.
const NAMES: [&str; 5] = ["id", "density", "x", "y", "z"];

/// Which columns of a row these are.
const PLACES: [usize; 5] = [0, 2, 5, 6, 7];

/// Columns of a row of the style sph, and with three numbers of images behind them.
const WIDTHS: [usize; 2] = [8, 11];

/// What a file has said so far.
#[derive(Default)]
struct Data<'a> {
    section: &'a str,
    count: Option<usize>,
    /// The mass of each type, and what the comment behind it says.
    types: BTreeMap<&'a str, (f64, &'a str)>,
    /// The type of every atom.
    kind: Vec<&'a str>,
    numbers: [Vec<f64>; 5],
}

impl<'a> Data<'a> {
    fn line(&mut self, line: &'a str) -> Result<(), String> {
        let (content, comment) = line.split_once('#').unwrap_or((line, ""));
        let words: Vec<&str> = content.split_whitespace().collect();
        let Some(first) = words.first() else {
            return Ok(());
        };
        if first.starts_with(|c: char| c.is_ascii_alphabetic()) {
            self.section = first;
            let style = comment.trim();
            if *first == "Atoms" && !style.is_empty() && style != "sph" {
                return Err(format!(
                    "atoms of the style {style} are not read; write them with atom_style sph"
                ));
            }
            return Ok(());
        }
        match self.section {
            "" if words.get(1) == Some(&"atoms") => {
                let count = first.parse();
                self.count = Some(count.map_err(|_| "the number of atoms is none")?);
            }
            "Masses" => {
                let mass = words.get(1).and_then(|mass| mass.parse().ok());
                let mass = mass.ok_or("a mass is a type and a number; correct the row")?;
                // One blank belongs to the comment's mark, others may be a name's.
                let comment = comment.strip_prefix(' ').unwrap_or(comment);
                self.types.insert(first, (mass, comment));
            }
            "Atoms" => self.atom(&words)?,
            _ => {}
        }
        Ok(())
    }

    fn atom(&mut self, words: &[&'a str]) -> Result<(), String> {
        if !WIDTHS.contains(&words.len()) {
            return Err(format!(
                "{} numbers, but a row of the style sph has 8: id type rho esph cv x y z",
                words.len()
            ));
        }
        for (column, at) in self.numbers.iter_mut().zip(PLACES) {
            let number: Option<f64> = words[at].parse().ok();
            let number = number.filter(|number| number.is_finite());
            column.push(number.ok_or_else(|| {
                let shown: String = words[at].chars().take(40).collect();
                format!("\"{shown}\" is no finite number; correct or remove the row")
            })?);
        }
        self.kind.push(words[1]);
        Ok(())
    }

    fn columns(self) -> Result<Columns, String> {
        let rows = self.kind.len();
        let count = self.count.ok_or(
            "this is no data file of LAMMPS; one says how many atoms there are: \"100 atoms\"",
        )?;
        if rows != count {
            return Err(format!(
                "there are {rows} atoms instead of {count}; the file is cut off or damaged, write it again"
            ));
        }
        let mut columns = Columns::default();
        for (name, mut numbers) in NAMES.into_iter().zip(self.numbers) {
            if name == "id" {
                numbers.iter_mut().for_each(|id| *id -= 1.0);
            }
            columns.numbers.insert(name.to_owned(), numbers);
        }
        let of = |kind: &str| {
            let missing = || format!("type {kind} has no mass; add it to the section Masses");
            self.types.get(kind).copied().ok_or_else(missing)
        };
        let masses = self.kind.iter().map(|kind| of(kind).map(|(mass, _)| mass));
        let masses = masses.collect::<Result<_, _>>()?;
        columns.numbers.insert("mass".to_owned(), masses);
        let is_ours = |comment: &str| {
            let mut words = comment.splitn(3, ' ');
            words
                .next()
                .is_some_and(|kind| kind.parse::<sphpack_packing::Kind>().is_ok())
                && matches!(words.next(), Some("solid" | "fluid"))
        };
        if self.types.values().all(|(_, comment)| is_ours(comment)) {
            for (at, name) in ["kind", "side", "body"].into_iter().enumerate() {
                let word = |kind: &&str| {
                    let (_, comment) = self.types[kind];
                    comment.splitn(3, ' ').nth(at).unwrap_or("").to_owned()
                };
                let words = self.kind.iter().map(word).collect();
                columns.words.insert(name.to_owned(), words);
            }
        }
        Ok(columns)
    }
}
