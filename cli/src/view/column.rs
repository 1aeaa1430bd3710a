//! A column as a page holds it: in as few bytes as its values need.

use std::collections::HashMap;
use std::io;

use serde::Serialize;

use super::base64::Base64;

/// So many different numbers are a table, and every row a place in it.
const MOST_IN_TABLE: usize = 256;

/// What rounding to 32 bits may change, as a part of the value.
const ROUNDING: f64 = 1e-6;

/// How every row's entry is stored, little-endian.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Store {
    /// Not at all: every row has the table's one entry.
    None,
    U8,
    U16,
    U32,
    F32,
    F64,
}

/// How a page reads a column.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Stored {
    pub(super) name: String,
    pub(super) store: Store,
    /// What the stored numbers are places in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) table: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) words: Option<Vec<String>>,
    /// The least and the largest finite number; `None` where there is none.
    pub(super) range: Option<[f64; 2]>,
    #[serde(skip)]
    entries: Entries,
}

#[derive(Debug, Clone, PartialEq)]
enum Entries {
    Places(Vec<u32>),
    Numbers(Vec<f64>),
}

impl Stored {
    /// A column of words: these first, then as they come; what has no name last.
    pub(super) fn words(name: String, rows: &[String], first: &[&str]) -> Self {
        let mut names: Vec<String> = Vec::new();
        let mut places: HashMap<&str, u32> = HashMap::new();
        let named = rows
            .iter()
            .map(String::as_str)
            .filter(|word| !word.is_empty());
        let has_unnamed = rows.iter().any(String::is_empty);
        for word in (first.iter().copied())
            .chain(named)
            .chain(has_unnamed.then_some(""))
        {
            places.entry(word).or_insert_with(|| {
                names.push(word.to_owned());
                names.len() as u32 - 1
            });
        }
        let codes = rows.iter().map(|word| places[word.as_str()]).collect();
        Self {
            name,
            store: store_of_places(names.len()),
            table: None,
            words: Some(names),
            range: None,
            entries: Entries::Places(codes),
        }
    }

    /// A column of numbers.
    pub(super) fn numbers(name: String, numbers: Vec<f64>) -> Self {
        let finite = numbers.iter().copied().filter(|number| number.is_finite());
        let range = finite.fold(None, |range: Option<[f64; 2]>, number| {
            let [low, high] = range.unwrap_or([number; 2]);
            Some([low.min(number), high.max(number)])
        });
        let (store, table, entries) = match tabled(&numbers) {
            Some((table, places)) => (
                store_of_places(table.len()),
                Some(table),
                Entries::Places(places),
            ),
            None => (store_of(&numbers), None, Entries::Numbers(numbers)),
        };
        Self {
            name,
            store,
            table,
            words: None,
            range,
            entries,
        }
    }

    /// Whether all rows have the same entry.
    pub(super) fn is_one_value(&self) -> bool {
        self.store == Store::None || self.range.is_none_or(|[low, high]| low == high)
    }

    /// Writes the rows' entries.
    pub(super) fn write(&self, to: &mut Base64<'_>) -> io::Result<()> {
        match &self.entries {
            Entries::Places(places) => places.iter().try_for_each(|&place| match self.store {
                Store::None => Ok(()),
                Store::U8 => to.put(&[place as u8]),
                Store::U16 => to.put(&(place as u16).to_le_bytes()),
                _ => to.put(&place.to_le_bytes()),
            }),
            Entries::Numbers(numbers) => numbers.iter().try_for_each(|&number| match self.store {
                Store::U32 => to.put(&(number as u32).to_le_bytes()),
                Store::F32 => to.put(&(number as f32).to_le_bytes()),
                _ => to.put(&number.to_le_bytes()),
            }),
        }
    }
}

fn store_of_places(count: usize) -> Store {
    match count {
        0..=1 => Store::None,
        2..=0x100 => Store::U8,
        0x101..=0x1_0000 => Store::U16,
        _ => Store::U32,
    }
}

/// What numbers need. Whole ones, such as `id`, stay whole.
fn store_of(numbers: &[f64]) -> Store {
    let is_whole = |&number: &f64| number == f64::from(number as u32);
    let is_kept = |&number: &f64| {
        let error = (f64::from(number as f32) - number).abs();
        !number.is_finite() || error <= ROUNDING * number.abs()
    };
    if numbers.iter().all(is_whole) {
        Store::U32
    } else if numbers.iter().all(is_kept) {
        Store::F32
    } else {
        Store::F64
    }
}

/// The different numbers and each row's place among them, where they are few and can be written as text.
fn tabled(numbers: &[f64]) -> Option<(Vec<f64>, Vec<u32>)> {
    let mut table: Vec<f64> = Vec::new();
    let mut place_of: HashMap<u64, u32> = HashMap::new();
    let mut places = Vec::with_capacity(numbers.len());
    for &number in numbers {
        if number.is_infinite() {
            return None;
        }
        let number = if number.is_nan() { f64::NAN } else { number };
        let place = *place_of.entry(number.to_bits()).or_insert_with(|| {
            table.push(number);
            table.len() as u32 - 1
        });
        if table.len() > MOST_IN_TABLE {
            return None;
        }
        places.push(place);
    }
    Some((table, places))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn store(numbers: impl IntoIterator<Item = f64>) -> Store {
        Stored::numbers("a".into(), numbers.into_iter().collect()).store
    }

    #[test]
    fn as_few_bytes_as_the_values_need() {
        let many = || (0..300).map(f64::from);
        assert_eq!(store([0.1; 9]), Store::None);
        assert_eq!(store([0.1, f64::NAN, 0.1]), Store::U8);
        assert_eq!(store([f64::INFINITY, 1.0]), Store::F32);
        assert_eq!(store(many()), Store::U32);
        assert_eq!(store(many().map(|k| k / 7.0)), Store::F32);
        assert_eq!(store(many().map(|k| 1e300 / (k + 1.0))), Store::F64);
        assert_eq!(store(many().map(|k| 1e-300 * k)), Store::F64);
        assert_eq!(store(many().map(|k| k - 1.0)), Store::F32);
        let words: Vec<String> = (0..300).map(|k| k.to_string()).collect();
        let all = Stored::words("body".into(), &words, &[]);
        assert_eq!((all.store, all.range), (Store::U16, None));
        let words = ["", "b", "a"].map(str::to_owned);
        let all = Stored::words("body".into(), &words, &["c"]).words;
        assert_eq!(all.unwrap(), ["c", "b", "a", ""]);
    }

    #[test]
    fn what_is_not_finite_is_no_end_of_the_range() {
        let numbers = vec![f64::NAN, 2.0, f64::INFINITY, -1.0];
        let column = Stored::numbers("a".into(), numbers);
        assert_eq!(column.range, Some([-1.0, 2.0]));
        assert!(Stored::numbers("a".into(), vec![f64::NAN; 2]).is_one_value());
    }
}
