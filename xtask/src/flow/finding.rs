//! What a case has to say: numbers beside their bars, and what the packing changes.

use super::run::Run;
use crate::chart::Chart;

/// A number beside what is published and its bar.
pub(super) struct Row {
    /// The case and what is measured.
    pub(super) what: String,
    /// What a paper prints, the exact answer, or nothing.
    pub(super) published: String,
    /// The most that the number may be; the least where `at_least`.
    pub(super) bar: f64,
    pub(super) at_least: bool,
    pub(super) ours: f64,
    /// Parts of one are shown as per cent.
    pub(super) as_percent: bool,
    /// Why a missed bar is missed.
    pub(super) reason: &'static str,
}

impl Row {
    /// A number of at most `bar`.
    pub(super) fn at_most(what: String, published: &str, bar: f64, ours: f64) -> Self {
        Self {
            what,
            published: published.to_owned(),
            bar,
            at_least: false,
            ours,
            as_percent: false,
            reason: "",
        }
    }

    /// A number of at least `bar`.
    pub(super) fn at_least(what: String, published: &str, bar: f64, ours: f64) -> Self {
        Self {
            at_least: true,
            ..Self::at_most(what, published, bar, ours)
        }
    }

    pub(super) fn percent(self) -> Self {
        Self {
            as_percent: true,
            ..self
        }
    }

    /// What the page says where the bar is missed.
    pub(super) fn because(self, reason: &'static str) -> Self {
        Self { reason, ..self }
    }

    /// Whether the bar is kept. What is no number keeps none.
    pub(super) fn holds(&self) -> bool {
        if self.at_least {
            self.ours >= self.bar
        } else {
            self.ours <= self.bar
        }
    }

    pub(super) fn line(&self) -> String {
        let show = |value: f64| match self.as_percent {
            true => format!("{} %", number(100.0 * value)),
            false => number(value),
        };
        let sign = if self.at_least { "≥" } else { "≤" };
        let verdict = match (self.holds(), self.reason) {
            (true, _) => "holds".to_owned(),
            (false, "") => "**misses**".to_owned(),
            (false, reason) => format!("**misses**: {reason}"),
        };
        format!(
            "| {} | {} | {sign} {} | {} | {verdict} |\n",
            self.what,
            self.published,
            show(self.bar),
            show(self.ours)
        )
    }
}

/// The same number from a clipped lattice and from a packing.
pub(super) struct Change {
    pub(super) what: String,
    pub(super) clipped: f64,
    pub(super) packed: f64,
    /// The packing's name.
    pub(super) by: &'static str,
    pub(super) as_percent: bool,
}

impl Change {
    pub(super) fn line(&self) -> String {
        let show = |value: f64| match self.as_percent {
            true => format!("{} %", number(100.0 * value)),
            false => number(value),
        };
        let ratio = (self.clipped / self.packed).abs();
        format!(
            "| {} | {} | {} ({}) | {} |\n",
            self.what,
            show(self.clipped),
            show(self.packed),
            self.by,
            if ratio.is_finite() {
                number(ratio)
            } else {
                "–".to_owned()
            }
        )
    }
}

/// All that a case has found.
#[derive(Default)]
pub(super) struct Findings {
    pub(super) rows: Vec<Row>,
    pub(super) changes: Vec<Change>,
    /// Drawings, by the name of their file in `docs`, without ending.
    pub(super) charts: Vec<(&'static str, Chart)>,
}

impl Findings {
    /// What differs between a run from the clipped lattice and one from the balanced packing: numbers of theirs, what they are, and whether
    /// they are parts of one.
    pub(super) fn compare(
        &mut self,
        case: &str,
        [clipped, balanced]: [&Run; 2],
        numbers: &[(&str, &str, bool)],
    ) {
        let change = |&(number, what, as_percent): &(&str, &str, bool)| Change {
            what: format!("{case}: {what}"),
            clipped: clipped.number(number),
            packed: balanced.number(number),
            by: "balanced",
            as_percent,
        };
        self.changes.extend(numbers.iter().map(change));
    }
}

/// Two or three digits of a number.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if (100.0..1e6).contains(&size) {
        format!("{value:.0}")
    } else if (10.0..100.0).contains(&size) {
        format!("{value:.1}")
    } else if (0.01..10.0).contains(&size) {
        format!("{value:.2}")
    } else {
        format!("{value:.1e}")
    }
    .replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_kept_on_their_side() {
        let most = |ours| Row::at_most(String::new(), "", 2.0, ours).holds();
        let least = |ours| Row::at_least(String::new(), "", 2.0, ours).holds();
        assert_eq!([most(1.0), most(2.0), most(3.0)], [true, true, false]);
        assert_eq!([least(1.0), least(2.0), least(3.0)], [false, true, true]);
        assert!(!most(f64::NAN) && !least(f64::NAN));
    }

    #[test]
    fn a_missed_bar_has_its_reason_in_its_line() {
        let row = Row::at_most("x".to_owned(), "1", 0.02, 0.031).percent();
        let line = row.because("too coarse").line();
        assert_eq!(
            line,
            "| x | 1 | ≤ 2.00 % | 3.10 % | **misses**: too coarse |\n"
        );
    }

    #[test]
    fn numbers_have_few_digits() {
        let shown = [0.0, 1234.5, 12.34, -0.0123, 1.2e-7].map(number);
        assert_eq!(shown, ["0", "1234", "12.3", "−0.01", "1.2e−7"]);
    }
}
