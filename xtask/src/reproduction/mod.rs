//! What the papers print about packing, beside what this program gets.

mod claims;
mod curves;
mod divergence;
mod interpolation;
mod measure;
mod measured;
mod page;
mod row;
mod rows;
mod setup;
mod subject;
mod thumbnail;
mod trials;

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::arguments::Arguments;
use crate::power_law::PowerLaw;
use crate::selection::Selection;
use crate::shown_table::ShownTable;
use crate::workspace::{root, write};
use claims::{FIGURES, KNOWN_MISSES};
use measure::Measure;
pub(crate) use measured::paint;
use measured::{Measured, Store};
use page::{Result as Ended, Verdict, figure, published};
use row::{Row, Taken};
use rows::rows;
use setup::Setup;
pub(crate) use trials::{REVOLUTION, Stirred};

/// The papers that have rows.
const PAPERS: &str = "000|001|002|003|004";

/// What to run.
#[derive(Debug, Default)]
pub(crate) struct Settings {
    selection: Selection,
    /// The one paper.
    paper: Option<String>,
    /// The longest rows, too.
    fine: bool,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &[
        PAPERS,
        "--only FIGURE",
        "--quick",
        "--fine",
        "--data DIR",
        "--write",
    ];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        let settings = Self {
            selection: Selection::of(arguments)?,
            paper: arguments.text(PAPERS),
            fine: arguments.has("--fine"),
        };
        if settings.selection.write && settings.paper.is_some() {
            return Err("--write needs every row: leave the paper out".to_owned());
        }
        Ok(settings)
    }

    /// The rows that CI runs.
    pub(crate) fn quick() -> Self {
        Self {
            selection: Selection {
                quick: true,
                ..Selection::default()
            },
            paper: None,
            fine: false,
        }
    }

    fn wants(&self, row: &Row) -> bool {
        self.selection.wants(row.figure, row.quick)
            && (self.fine || !row.fine)
            && self.paper.as_ref().is_none_or(|paper| paper == row.paper)
    }
}

const HEAD: &str = "\
| paper | figure | packing | figure of it | published | ours | | seconds |
|---|---|---|---|---|---|---|---|
";

/// Runs the rows that are asked for; what was measured before by the same code is not packed again. Fails where a verdict is
/// another than is known.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let folder = root().join("target/reproduction");
    let store = Store::open(&folder.join("packings"))?;
    let asked: Vec<Row> = rows()
        .into_iter()
        .filter(|row| settings.wants(row))
        .collect();
    if asked.is_empty() {
        let figures: BTreeSet<String> = (rows().iter())
            .map(|row| format!("{} {}", row.paper, row.figure))
            .collect();
        let all: Vec<String> = figures.into_iter().collect();
        return Err(format!("no row is asked for; there are {}", all.join(", ")));
    }
    let mut results = Vec::new();
    let mut table = ShownTable::new(HEAD);
    for (number, row) in asked.iter().enumerate() {
        eprintln!("── {} of {}: {}", number + 1, asked.len(), row.id());
        let interpolates = (asked.iter()).any(|other| {
            other.measure.interpolates()
                && (other.subject == row.subject || other.taken.others().contains(&row.subject))
        });
        let own = store.measured(&row.subject, interpolates, &settings.selection)?;
        let others = (row.taken.others().iter())
            .map(|other| store.measured(other, row.measure.interpolates(), &settings.selection))
            .collect::<Result<Vec<Option<Measured>>, String>>()?;
        let ended = judged(row, own, others.into_iter().collect());
        table.push(&line(&ended));
        results.push(ended);
    }
    curves::write(&folder, &results)?;
    write_scenes(&folder.join(SCENES), &results, &settings.selection)?;
    page::write(&folder, &results, settings.selection.quick)?;
    eprintln!("── {}", folder.join("index.html").display());
    if settings.selection.write {
        document(&table.into_text(), settings.selection.quick)?;
    }
    let changed: Vec<String> = (results.iter())
        .filter(|result| result.verdict == Verdict::Changed)
        .map(|result| result.row.id())
        .collect();
    if changed.is_empty() {
        Ok(())
    } else {
        Err(format!(
            "other verdicts than are known: {}",
            changed.join("; ")
        ))
    }
}

/// The folder of the scenes that the rows' numbers are of.
const SCENES: &str = "scenes";

/// Writes every packed scene as a file that can be packed again.
fn write_scenes(folder: &Path, results: &[Ended], selection: &Selection) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for result in results {
        let Some(setup) = result.row.subject.packing() else {
            continue;
        };
        let Some(scene) = setup.scene(selection)? else {
            continue;
        };
        let path = folder.join(setup.file_name());
        let text = toml::to_string(&scene).map_err(|error| error.to_string())?;
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

/// The row's number, and a curve where it is of one; `None` where a figure is missing.
fn number(row: &Row, own: &Measured, others: &[Measured]) -> Option<(f64, Vec<[f64; 2]>)> {
    let value = |measured: &Measured| measured.figures.get(&row.measure).copied();
    let own = value(own)?;
    let others: Vec<f64> = others.iter().map(value).collect::<Option<_>>()?;
    let over = |x: fn(&Setup) -> f64, setups: &[Setup]| -> Vec<[f64; 2]> {
        let all = row.subject.packing().into_iter().chain(setups).map(x);
        let figures = std::iter::once(own).chain(others.iter().copied());
        all.zip(figures).map(|(x, figure)| [x, figure]).collect()
    };
    let spacing = |setup: &Setup| setup.spacing / setup.enlarged;
    match &row.taken {
        Taken::Alone => Some((own, Vec::new())),
        Taken::Over(_) => Some((others.first()? / own, Vec::new())),
        Taken::Slope(setups) => Some((
            PowerLaw::through(&over(spacing, setups))?.exponent,
            Vec::new(),
        )),
        Taken::SlopeError(setups) => Some((
            PowerLaw::through(&over(spacing, setups))?.standard_error,
            Vec::new(),
        )),
        Taken::Greatest(setups) => {
            let curve = over(|setup| setup.h_over_spacing.unwrap_or(f64::NAN), setups);
            let greatest = curve
                .iter()
                .map(|point| point[1])
                .fold(f64::NEG_INFINITY, f64::max);
            Some((greatest, curve))
        }
    }
}

fn judged(row: &Row, own: Option<Measured>, others: Option<Vec<Measured>>) -> Ended {
    let found =
        (own.as_ref().zip(others.as_ref())).and_then(|(own, others)| number(row, own, others));
    let (ours, curve) = found.map_or((None, Vec::new()), |(ours, curve)| (Some(ours), curve));
    let seconds = own
        .as_ref()
        .and_then(|own| own.figures.get(&Measure::Seconds));
    let seconds = seconds.copied().unwrap_or(0.0);
    let is_known = KNOWN_MISSES.iter().any(|(id, _)| *id == row.id());
    let is_at_rest =
        own.as_ref().is_some_and(|own| own.is_at_rest) || !matches!(row.taken, Taken::Alone);
    let verdict = match ours.map(|ours| row.holds(ours).map(|holds| holds && is_at_rest)) {
        None => Verdict::NoData,
        Some(None) => Verdict::Beside,
        Some(Some(true)) if is_known => Verdict::Changed,
        Some(Some(true)) => Verdict::Holds,
        Some(Some(false)) if is_known => Verdict::KnownMiss,
        Some(Some(false)) => Verdict::Changed,
    };
    Ended {
        row: row.clone(),
        ours,
        curve,
        verdict,
        seconds,
        picture: own.and_then(|own| own.picture),
    }
}

fn line(ended: &Ended) -> String {
    let row = &ended.row;
    let taken = row.taken.words();
    let mut line = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        line,
        "| {} | {} | {}{taken} | {} | {} | {} | {} | {:.1} |",
        row.paper,
        row.figure,
        row.subject.words(),
        row.measure.name().replace('|', "\\|"),
        published(row),
        ended.ours.map_or_else(|| "–".to_owned(), figure),
        ended.verdict.name(),
        ended.seconds
    );
    line
}

/// Writes docs/reproduction.md.
fn document(table: &str, is_quick: bool) -> Result<(), String> {
    let mut text = format!(
        "# What the papers print, and ours\n\n\
         Papers go by their numbers in [papers.md](papers.md). Defaults, no tuning per shape{}. Regenerate with\n\
         `cargo xtask reproduce-paper --data DIR --write`, where DIR holds `bunny.stl`; pictures and a page of all are then in\n\
         `target/reproduction/index.html`. Published numbers are from the papers' texts and tables. A row *holds* where ours is within its bar,\n\
         rows *beside* are not judged; a ratio is the named method's number over the first one's. A slope is fitted in logarithms. Curves, of the repulsion and\n\
         of errors against h/∆s, are in `target/reproduction` as CSV and SVG. Times are wall-clock seconds of the packing and depend on the\n\
         machine.\n\n{table}",
        if is_quick {
            " (the quick rows only)"
        } else {
            ""
        }
    );
    if !KNOWN_MISSES.is_empty() {
        text.push_str("\n## Known misses\n\n| row | why |\n|---|---|\n");
        for (id, why) in KNOWN_MISSES {
            let _ = writeln!(text, "| {id} | {why} |");
        }
    }
    text.push_str(
        "\n## Not yet done\n\n| paper | figure | it shows | why not |\n|---|---|---|---|\n",
    );
    for figure in FIGURES.iter() {
        if let Some(why) = figure.missing {
            let _ = writeln!(
                text,
                "| {} | {} | {} | {why} |",
                figure.paper, figure.figure, figure.claim
            );
        }
    }
    write("docs/reproduction.md", &text)
}
