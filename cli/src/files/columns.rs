//! Anybody's particles, as columns by name.

use std::collections::BTreeMap;

/// Columns that must be numbers where they are there.
pub(super) const NUMBERS: [&str; 4] = ["x", "y", "z", "volume"];

/// A column's entries by row.
pub(super) type Entries<'a> = Box<dyn Fn(usize) -> f64 + 'a>;

/// A particle file's columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Columns {
    /// Columns of numbers, all of one length.
    pub numbers: BTreeMap<String, Vec<f64>>,
    /// Columns of words, all of that same length.
    pub words: BTreeMap<String, Vec<String>>,
}

impl Columns {
    /// Names in small letters, where that makes no two of them the same.
    pub(super) fn lower_case(&mut self) {
        fn fold<T>(columns: &mut BTreeMap<String, T>, is_taken: impl Fn(&str) -> bool) {
            let names: Vec<String> = columns.keys().cloned().collect();
            for name in names {
                let lower = name.to_lowercase();
                if lower == name || is_taken(&lower) || columns.contains_key(&lower) {
                    continue;
                }
                if let Some(values) = columns.remove(&name) {
                    columns.insert(lower, values);
                }
            }
        }
        fold(&mut self.numbers, |name| self.words.contains_key(name));
        fold(&mut self.words, |name| self.numbers.contains_key(name));
    }

    /// Makes words of a column of whole numbers; empty ones where a number has no name.
    pub(super) fn name(&mut self, column: &str, name: impl Fn(usize) -> Option<String>) {
        if let Some(numbers) = self.numbers.remove(column) {
            let word = |number: &f64| {
                let code = (*number >= 0.0).then_some(*number as usize);
                code.and_then(&name).unwrap_or_default()
            };
            (self.words).insert(column.to_owned(), numbers.iter().map(word).collect());
        }
    }
}
