//! Files as people have them: every file of public collections, read and judged.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use sphpack_geometry::{GeometryError, Outline, Sketch, Surface};

use crate::arguments::Arguments;
use crate::workspace::root;

/// By how much an area may differ from the judge's, in parts of it.
const MOST_OFF: f64 = 0.01;

/// Kinds of refusal that are shown.
const MOST_REASONS: usize = 12;

const ABOUT: &str = "\
# Files as they are

`cargo xtask corpora --data DIR --write` reads every file of public collections, none of which is shipped: in
`DIR/airfoils/*.dat` the sections that the Python package aerosandbox carries, in `DIR/icons/**/*.svg` the icons of the
npm packages simple-icons, bootstrap-icons and @mdi/svg. A file counts as read when it becomes a body, and as right
when that body's area is within 1 % of the judge's. The judge shares no code with the readers. An airfoil's area and box
are summed over the file's rows of two numbers, as they stand. An icon's area comes from `DIR/icons-areas.csv` (rows
`file,area`, the file below `DIR/icons`, the area in units of the view box), which `python3 xtask/icon_areas.py DIR` makes of every
13th icon with rasters of 800 pixels by CairoSVG.

";

/// What to run.
#[derive(Debug, Default)]
pub(crate) struct Settings {
    data: PathBuf,
    write: bool,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--data DIR", "--write"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        let data = arguments.path("--data");
        Ok(Self {
            data: data.ok_or("cargo xtask corpora needs --data DIR; see cargo xtask help")?,
            write: arguments.has("--write"),
        })
    }
}

/// What became of a file.
enum Outcome {
    /// It was read, and nobody else says how large it is.
    Read,
    Right,
    /// By so many parts of the judge's area.
    Wrong(f64),
    Refused(String),
}

/// A file below the collection's folder, and what became of it.
type Judged = (String, Outcome);

/// Reads everything, prints the figures and, where asked, writes docs/corpora.md.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let mut text = String::from(
        "| collection | files | read | | compared | right | |\n|---|---|---|---|---|---|---|\n",
    );
    let mut details = String::new();
    let folder = settings.data.join("airfoils");
    let airfoils: Vec<Judged> = files(&folder, "dat")?
        .into_par_iter()
        .map(|path| (below(&folder, &path), airfoil(&path)))
        .collect();
    summarise("airfoils", &airfoils, &mut text, &mut details);
    let areas = areas(&settings.data.join("icons-areas.csv"))?;
    let folder = settings.data.join("icons");
    let icons: Vec<Judged> = files(&folder, "svg")?
        .into_par_iter()
        .map(|path| {
            let name = below(&folder, &path);
            let outcome = icon(&path, areas.get(&name).copied());
            (name, outcome)
        })
        .collect();
    summarise("icons", &icons, &mut text, &mut details);
    println!("{text}{details}");
    if settings.write {
        let path = root().join("docs/corpora.md");
        fs::write(&path, format!("{ABOUT}{text}{details}"))
            .map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

fn summarise(name: &str, judged: &[Judged], text: &mut String, details: &mut String) {
    let count = |is: &dyn Fn(&Outcome) -> bool| judged.iter().filter(|(_, o)| is(o)).count();
    let refused = count(&|o| matches!(o, Outcome::Refused(_)));
    let right = count(&|o| matches!(o, Outcome::Right));
    let compared = right + count(&|o| matches!(o, Outcome::Wrong(_)));
    let read = judged.len() - refused;
    let percent = |part: usize, of: usize| 100.0 * part as f64 / of.max(1) as f64;
    let _ = writeln!(
        text,
        "| {name} | {} | {read} | {:.2} % | {compared} | {right} | {:.2} % |",
        judged.len(),
        percent(read, judged.len()),
        percent(right, compared)
    );
    let mut reasons: BTreeMap<String, (usize, &str)> = BTreeMap::new();
    for (file, outcome) in judged {
        let reason = match outcome {
            Outcome::Read | Outcome::Right => continue,
            Outcome::Wrong(off) => format!("{file}: off by {:.1} %", 100.0 * off),
            Outcome::Refused(reason) => without_numbers(reason),
        };
        reasons.entry(reason).or_insert((0, file)).0 += 1;
    }
    let mut reasons: Vec<_> = reasons.into_iter().collect();
    reasons.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
    let _ = writeln!(details, "\nWhat is wrong with {name}:\n");
    if reasons.is_empty() {
        let _ = writeln!(details, "nothing.");
    }
    for (reason, (count, first)) in reasons.iter().take(MOST_REASONS) {
        let _ = writeln!(details, "- {count} × {reason} (first {first})");
    }
    if reasons.len() > MOST_REASONS {
        let _ = writeln!(details, "- {} kinds more", reasons.len() - MOST_REASONS);
    }
}

/// A message with every number as N, so that those of a kind are one.
fn without_numbers(message: &str) -> String {
    let mut text = String::new();
    let mut is_number = false;
    for c in message.chars() {
        let goes_on = c.is_ascii_digit() || is_number && matches!(c, '.' | 'e');
        if !goes_on {
            text.push(c);
        } else if !is_number {
            text.push('N');
        }
        is_number = goes_on;
    }
    text
}

/// Files with an ending, in a folder and those within it.
fn files(folder: &Path, ending: &str) -> Result<Vec<PathBuf>, String> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let entries =
            fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        for path in entries.flatten().map(|entry| entry.path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

fn below(folder: &Path, path: &Path) -> String {
    let path = path.strip_prefix(folder).unwrap_or(path);
    path.to_string_lossy().replace('\\', "/")
}

/// Areas by file; none where the table is not there.
fn areas(path: &Path) -> Result<BTreeMap<String, f64>, String> {
    let Ok(text) = fs::read_to_string(path) else {
        eprintln!(
            "{} is not there: icons are read, but not compared",
            path.display()
        );
        return Ok(BTreeMap::new());
    };
    let row = |line: &str| {
        let (file, area) = line.rsplit_once(',')?;
        Some((file.to_owned(), area.trim().parse().ok()?))
    };
    (text.lines().skip(1))
        .map(|line| row(line).ok_or_else(|| format!("{}: \"{line}\"", path.display())))
        .collect()
}

fn body(path: &Path) -> Result<Outline, String> {
    let reason = |error: GeometryError| match error {
        GeometryError::InFile { error, .. } => error.to_string(),
        other => other.to_string(),
    };
    let mended = Sketch::read(path).and_then(|sketch| sketch.body());
    mended.map(|mended| mended.outline).map_err(reason)
}

fn icon(path: &Path, area: Option<f64>) -> Outcome {
    match (body(path), area) {
        (Err(reason), _) => Outcome::Refused(reason),
        (Ok(_), None) => Outcome::Read,
        (Ok(outline), Some(area)) => near(outline.volume(), area),
    }
}

fn near(found: f64, area: f64) -> Outcome {
    let off = (found / area - 1.0).abs();
    if off <= MOST_OFF {
        Outcome::Right
    } else {
        Outcome::Wrong(off)
    }
}

fn airfoil(path: &Path) -> Outcome {
    let outline = match body(path) {
        Ok(outline) => outline,
        Err(reason) => return Outcome::Refused(reason),
    };
    let text = fs::read(path).unwrap_or_default();
    let rows: Vec<[f64; 2]> = String::from_utf8_lossy(&text)
        .split(['\n', '\r'])
        .filter_map(|line| {
            let numbers: Option<Vec<f64>> = (line.split_ascii_whitespace())
                .map(|word| word.parse().ok())
                .collect();
            <[f64; 2]>::try_from(numbers?).ok()
        })
        .collect();
    let area: f64 = (rows.iter().zip(rows.iter().cycle().skip(1)))
        .map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0]))
        .sum();
    let bounds = outline.bounds();
    let far = (rows.iter())
        .flat_map(|p| [0, 1].map(|k| (bounds.min[k] - p[k]).max(p[k] - bounds.max[k])))
        .fold(0.0, f64::max);
    // A row beyond the body is one that was lost.
    if far > MOST_OFF {
        return Outcome::Wrong(far);
    }
    near(outline.volume(), area.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn collections_are_judged() {
        let data = std::env::temp_dir().join(format!("corpora-{}", std::process::id()));
        let write = |name: &str, content: &str| {
            let path = data.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, content).unwrap();
        };
        write("airfoils/a.dat", "a\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n");
        write("icons/i/a.svg", "<svg><path d='M0 0H1V1H0z'/></svg>");
        write("icons/i/b.svg", "<svg><path d='M0 0H1V1H0z'/></svg>");
        write("icons/i/c.svg", "<svg/>");
        write("icons-areas.csv", "file,area\ni/a.svg,1.001\ni/b.svg,2\n");
        assert!(matches!(
            airfoil(&data.join("airfoils/a.dat")),
            Outcome::Right
        ));
        let areas = areas(&data.join("icons-areas.csv")).unwrap();
        let judge = |name: &str| icon(&data.join("icons").join(name), areas.get(name).copied());
        assert!(matches!(judge("i/a.svg"), Outcome::Right));
        assert!(matches!(judge("i/b.svg"), Outcome::Wrong(off) if off == 0.5));
        assert!(matches!(judge("i/c.svg"), Outcome::Refused(_)));
        assert_eq!(files(&data, "svg").unwrap().len(), 3);
        assert_eq!(without_numbers("line 12: 1.5e3 m"), "line N: N m");
        fs::remove_dir_all(&data).unwrap();
    }
}
