//! What the columns of a text are called, and what stands between them: files of others have their names in a header, in
//! a comment above the numbers as `numpy.savetxt` writes it, or nowhere.

use std::borrow::Cow;
use std::path::Path;

use crate::Error;

/// How the columns are to be named where their names are missing.
const CURE: &str = "name the columns in a line above the numbers, as x,y or x,y,z, with volume (or m and rho) and kind if known";

/// What stands between the fields of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    Letter(char),
    /// Any number of spaces or tabs.
    Space,
}

impl Separator {
    const ALL: [Self; 4] = [
        Self::Letter(','),
        Self::Letter(';'),
        Self::Letter('\t'),
        Self::Space,
    ];

    /// The fields of a row, without their quotation marks.
    pub(super) fn fields(self, row: &str) -> Vec<Cow<'_, str>> {
        match self {
            Self::Space if !row.contains('"') => {
                row.split_whitespace().map(Cow::Borrowed).collect()
            }
            Self::Letter(letter) if !row.contains('"') => {
                row.split(letter).map(Cow::Borrowed).collect()
            }
            _ => self
                .quoted_fields(row)
                .into_iter()
                .map(Cow::Owned)
                .collect(),
        }
    }

    /// The fields of a row that is to have `count`; one more, if empty, is only a separator at the end.
    pub(super) fn fields_of(self, row: &str, count: usize) -> Vec<Cow<'_, str>> {
        let mut fields = self.fields(row);
        if fields.len() == count + 1 && fields[count].trim().is_empty() {
            fields.pop();
        }
        fields
    }

    fn is(self, letter: char) -> bool {
        match self {
            Self::Letter(own) => letter == own,
            Self::Space => letter.is_whitespace(),
        }
    }

    fn quoted_fields(self, row: &str) -> Vec<String> {
        let row = if self == Self::Space { row.trim() } else { row };
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
                (c, false) if self.is(c) => {
                    while self == Self::Space && letters.peek().is_some_and(|c| c.is_whitespace()) {
                        letters.next();
                    }
                    all.push(String::new());
                }
                (c, _) => field.into_iter().for_each(|f| f.push(c)),
            }
        }
        all
    }
}

/// What is above the rows, or would be.
#[derive(Debug)]
pub(super) struct Header {
    /// In small letters.
    pub(super) names: Vec<String>,
    /// Between the fields of the rows.
    pub(super) separator: Separator,
    /// The line of names, which is no row, counted from 1; 0 where there is none.
    pub(super) line: usize,
}

fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with('#')
}

/// The lines with something in them that are no comments, each with its number, counted from 1.
pub(super) fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> + Clone {
    (text.lines().enumerate())
        .map(|(index, line)| (index + 1, line))
        .filter(|(_, line)| !line.trim().is_empty() && !is_comment(line))
}

impl Header {
    /// # Errors
    /// [`Error::Input`] where the columns x and y are not found.
    pub(super) fn of(text: &str, path: &Path) -> Result<Self, Error> {
        let mut rows = rows(text);
        let Some((line, first)) = rows.next() else {
            return Err(Error::input(
                path,
                "the file is empty; it needs a header line with x,y and one row per particle",
            ));
        };
        let header = match separator_of_numbers(first) {
            Some((separator, count)) => Self::above(text, line, separator, count)
                .or_else(|| Self::without(separator, count))
                .ok_or_else(|| {
                    Error::input_line(
                        path,
                        line,
                        format!("the rows have {count} numbers and nothing says which are x and y; {CURE}"),
                    )
                })?,
            None => Self::at(line, first, rows.next().map(|(_, row)| row), path)?,
        };
        let names = &header.names;
        let twice = (names.iter().enumerate()).find(|(index, name)| names[..*index].contains(name));
        if let Some((index, twice)) = twice {
            let message = format!(
                "column {} is called \"{twice}\" like an earlier one; give each its own name",
                index + 1
            );
            return Err(match header.line {
                0 => Error::input(path, message),
                line => Error::input_line(path, line, message),
            });
        }
        Ok(header)
    }

    /// The last comment above the numbers that names as many columns.
    fn above(text: &str, line: usize, separator: Separator, count: usize) -> Option<Self> {
        let comments = text.lines().take(line - 1).filter(|line| is_comment(line));
        let named = comments.filter_map(|comment| {
            let comment = comment.trim_start_matches(['#', ' ', '\t']);
            let all = Separator::ALL.map(|separator| names(&separator.fields_of(comment, count)));
            (all.into_iter()).find(|names| names.len() == count && has_places(names))
        });
        let names = named.last()?;
        Some(Self {
            names,
            separator,
            line: 0,
        })
    }

    /// Two numbers are x and y, three x, y and z.
    fn without(separator: Separator, count: usize) -> Option<Self> {
        let names = ["x", "y", "z"].get(..count).filter(|_| count >= 2)?;
        Some(Self {
            names: names.iter().map(|&name| name.to_owned()).collect(),
            separator,
            line: 0,
        })
    }

    /// A line of names.
    fn at(line: usize, header: &str, row: Option<&str>, path: &Path) -> Result<Self, Error> {
        let all = Separator::ALL.map(|separator| (separator, names(&separator.fields(header))));
        let missing = |names: &[String]| {
            ["x", "y"]
                .into_iter()
                .find(|&name| !names.iter().any(|own| own == name))
        };
        let Some((own, mut names)) = all.iter().find(|(_, names)| has_places(names)).cloned()
        else {
            // By what is most likely between the names, for the message.
            let likely = all
                .iter()
                .find(|(_, names)| names.len() > 1)
                .unwrap_or(&all[0]);
            return Err(Error::input_line(
                path,
                line,
                format!(
                    "the header has no column \"{}\"; {CURE}",
                    missing(&likely.1).unwrap_or("x")
                ),
            ));
        };
        // A separator at the end is no column, unless there is something in it.
        let is_last_empty =
            |fields: &[Cow<'_, str>]| fields.last().is_none_or(|last| last.trim().is_empty());
        if names.last().is_some_and(String::is_empty)
            && row.is_none_or(|row| {
                let fields = own.fields(row);
                fields.len() < names.len() || is_last_empty(&fields)
            })
        {
            names.pop();
        }
        // Names with commas may stand above numbers with spaces.
        let count = names.len();
        let fits = |separator: &Separator| {
            row.is_some_and(|row| separator.fields_of(row, count).len() == count)
        };
        let separator = [own]
            .into_iter()
            .chain(Separator::ALL)
            .find(fits)
            .unwrap_or(own);
        Ok(Self {
            names,
            separator,
            line,
        })
    }
}

fn names(fields: &[Cow<'_, str>]) -> Vec<String> {
    fields
        .iter()
        .map(|name| name.trim().to_lowercase())
        .collect()
}

fn has_places(names: &[String]) -> bool {
    ["x", "y"]
        .iter()
        .all(|needed| names.iter().any(|name| name == needed))
}

/// What parts a row into two or more fields that are all numbers, and how many there are.
fn separator_of_numbers(row: &str) -> Option<(Separator, usize)> {
    Separator::ALL.into_iter().find_map(|separator| {
        let mut fields = separator.fields(row);
        if fields.last().is_some_and(|last| last.trim().is_empty()) {
            fields.pop();
        }
        let are_numbers = fields
            .iter()
            .all(|field| field.trim().parse::<f64>().is_ok());
        (fields.len() > 1 && are_numbers).then_some((separator, fields.len()))
    })
}
