//! What came of all runs under faults, as a table.

use std::fmt::Write;

use super::Outcome;

/// What came of the runs under one fault.
#[derive(Debug)]
pub(super) struct Row {
    name: &'static str,
    /// Done, refused, failed, killed.
    counts: [usize; 4],
    skipped: Option<&'static str>,
    pub(super) wrong: Vec<String>,
}

impl Row {
    pub(super) fn new(name: &'static str) -> Self {
        Self {
            name,
            counts: [0; 4],
            skipped: None,
            wrong: Vec::new(),
        }
    }

    pub(super) fn count(&mut self, outcome: Outcome) {
        let column = match outcome {
            Outcome::Done => 0,
            Outcome::Refused => 1,
            Outcome::Failed => 2,
            Outcome::Killed => 3,
            Outcome::Skipped(why) => {
                self.skipped = Some(why);
                return;
            }
        };
        self.counts[column] += 1;
    }
}

/// The table as Markdown.
pub(super) fn table(seed: u64, rows: &[Row]) -> String {
    let mut text = format!(
        "| seed {seed} | runs | done | refused | failed, said so | killed, then done | not right |\n|---|---|---|---|---|---|---|\n"
    );
    let mut sums = [0; 6];
    let mut line = |name: &str, numbers: [usize; 6]| {
        let cells = numbers.map(|number| number.to_string()).join(" | ");
        let _ = writeln!(text, "| {name} | {cells} |");
    };
    for row in rows {
        let [done, refused, failed, killed] = row.counts;
        let wrong = row.wrong.len();
        let runs = done + refused + failed + killed + wrong;
        let numbers = [runs, done, refused, failed, killed, wrong];
        line(row.name, numbers);
        for (sum, number) in sums.iter_mut().zip(numbers) {
            *sum += number;
        }
    }
    line("all", sums);
    for row in rows {
        if let Some(why) = row.skipped {
            let _ = write!(text, "\nLeft out: {} ({why}).\n", row.name);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_add_up() {
        let mut row = Row::new("a fault");
        row.count(Outcome::Done);
        row.count(Outcome::Failed);
        row.count(Outcome::Skipped("no way"));
        row.wrong.push("bad".into());
        let text = table(1, &[row]);
        assert!(
            text.contains("| a fault | 3 | 1 | 0 | 1 | 0 | 1 |"),
            "{text}"
        );
        assert!(text.contains("Left out: a fault (no way)."), "{text}");
    }
}
