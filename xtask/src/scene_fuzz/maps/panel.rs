//! What a map is declared by: axes, the scene of a cell, and a pin on each side of its edge.

use super::super::case::Case;
use super::outcome::Outcome;

/// The values along an axis.
#[derive(Debug, Clone, Copy)]
pub(super) enum Ticks {
    Numbers(&'static [f64]),
    Words(&'static [&'static str]),
}

/// A side of a map.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    /// What it is, with its unit.
    pub(super) label: &'static str,
    pub(super) ticks: Ticks,
}

impl Axis {
    pub(super) const fn numbers(label: &'static str, numbers: &'static [f64]) -> Self {
        Self {
            label,
            ticks: Ticks::Numbers(numbers),
        }
    }

    pub(super) const fn words(label: &'static str, words: &'static [&'static str]) -> Self {
        Self {
            label,
            ticks: Ticks::Words(words),
        }
    }

    pub(super) fn count(&self) -> usize {
        match self.ticks {
            Ticks::Numbers(numbers) => numbers.len(),
            Ticks::Words(words) => words.len(),
        }
    }

    /// A value; of words it is their number.
    pub(super) fn value(&self, place: usize) -> f64 {
        match self.ticks {
            Ticks::Numbers(numbers) => numbers[place],
            Ticks::Words(_) => place as f64,
        }
    }

    /// A value as people read it.
    pub(super) fn word(&self, place: usize) -> String {
        match self.ticks {
            Ticks::Words(words) => words[place].to_owned(),
            Ticks::Numbers(numbers) => number(numbers[place]),
        }
    }

    /// Where a value is.
    pub(super) fn place(&self, value: f64) -> Option<usize> {
        (0..self.count()).find(|&place| self.value(place) == value)
    }
}

/// A number in a few letters; far from 1 as a power of ten.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        let power = size.log10().floor();
        let part = value / 10f64.powf(power);
        let digits: String = (power.abs().to_string().chars())
            .map(|c| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c as usize - 48).unwrap_or(c))
            .collect();
        let above = if power < 0.0 { "⁻" } else { "" };
        return if (part - 1.0).abs() < 1e-9 {
            format!("10{above}{digits}")
        } else {
            format!("{part:.3}·10{above}{digits}")
        };
    }
    format!("{value}").replace('-', "−")
}

/// A grid of scenes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Panel {
    pub(super) title: &'static str,
    pub(super) x: Axis,
    pub(super) y: Axis,
    /// A value of x where all is well, from which the edges are looked for.
    pub(super) home: f64,
    /// The one method that it is of; `None`: all.
    pub(super) only: Option<&'static str>,
    /// The scene at a value of x and of y, lengths in ∆s.
    pub(super) case: fn(f64, f64) -> Case,
}

/// A cell whose outcome is pinned for the default method: where it changes, the edge has moved.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pin {
    pub(super) panel: usize,
    pub(super) at: [f64; 2],
    pub(super) outcome: Outcome,
}

/// A map: panels of one subject.
#[derive(Debug, Clone, Copy)]
pub(super) struct Map {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    /// What it shows, for its users.
    pub(super) about: &'static str,
    pub(super) panels: &'static [Panel],
    /// On both sides of its edge.
    pub(super) pins: &'static [Pin],
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(-0.25), "−0.25");
        assert_eq!(number(1e6), "10⁶");
        assert_eq!(number(1e-6), "10⁻⁶");
        assert_eq!(number(178.0), "178");
        assert_eq!(number(2e-5), "2.000·10⁻⁵");
    }
}
