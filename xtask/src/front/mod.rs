//! Speed charted against accuracy: every method, and one setting of the default at a time.

mod advice;
mod choices;
mod errors;
mod figures;
mod judged;
mod judges;
mod labels;
mod one;
mod packings;
mod page;
mod pairs;
mod panel;
mod pareto;
mod points;
mod shapes;
mod sheet;
mod shipped_table;
mod table;

use std::path::PathBuf;
use std::time::Instant;

use crate::arguments::Arguments;
use crate::selection::Selection;
use crate::workspace::{root, write};
use figures::Ended;
use packings::Packings;
use points::{Place, Point, places, points};
use sheet::Sheet;

/// What to run.
#[derive(Debug, Default)]
pub(crate) struct Settings {
    selection: Selection,
    /// Only what may be advised, and nothing but the advice and the shipped table.
    advice: bool,
    /// Pack nothing: of what was packed before.
    known: bool,
    /// Pack the scene of this file alone, as the chart has its children do; the result goes beside it.
    one: Option<PathBuf>,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &[
        "--quick",
        "--only SCENE",
        "--data DIR",
        "--write",
        "--advice",
        "--known",
        "--one FILE",
    ];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            selection: Selection::of(arguments)?,
            advice: arguments.has("--advice"),
            known: arguments.has("--known"),
            one: arguments.path("--one"),
        })
    }

    /// The packings that CI makes.
    pub(crate) fn quick() -> Self {
        Self {
            selection: Selection {
                quick: true,
                ..Selection::default()
            },
            advice: false,
            known: false,
            one: None,
        }
    }
}

/// Charts the scenes that are asked for; what was measured before by the same code is not packed again. Fails where a method beats the default
/// in evaluations and density at once.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    if let Some(file) = &settings.one {
        return one::run(file, &file.with_extension("json"));
    }
    let selection = &settings.selection;
    let folder = root().join("target/chart");
    let packings = Packings::open(&folder.join("packings"))?;
    let mut asked: Vec<(Place, Vec<Point>)> = Vec::new();
    for place in places(selection) {
        let mut points = points(place, selection)?;
        if settings.advice {
            points.retain(choices::may_be_asked);
        }
        if !points.is_empty() {
            asked.push((place, points));
        }
    }
    if asked.is_empty() {
        return Err("no scene is asked for, or its body's file is not there".to_owned());
    }
    let total: usize = asked.iter().map(|(_, points)| points.len()).sum();
    let (begin, mut done) = (Instant::now(), 0);
    let names: Vec<&str> = asked.iter().map(|(place, _)| place.scene).collect();
    let mut sheets = Vec::new();
    for (place, points) in asked {
        let mut sheet = Sheet {
            place,
            measured: Vec::new(),
            left_out: Vec::new(),
        };
        for point in points {
            done += 1;
            let was_known = packings.known(&point.scene).is_some();
            if !was_known && settings.known {
                continue;
            }
            if !was_known {
                eprintln!(
                    "── {done} of {total}: {}, {}, after {:.0} s",
                    place.scene,
                    point.name,
                    begin.elapsed().as_secs_f64()
                );
            }
            match packings.measured(&point.scene)? {
                Ended::Measured(figures) => sheet.measured.push((point, *figures)),
                Ended::LeftOut(why) => sheet.left_out.push((point.name, why)),
            }
        }
        sheets.push(sheet);
        // After each scene: whoever stops here has what there is.
        let missing = &names[sheets.len()..];
        if settings.advice {
            continue;
        }
        page::write(&folder, &sheets, missing)?;
        if selection.write {
            page::document(&root().join("docs"), &sheets, missing)?;
        }
    }
    if !settings.advice {
        eprintln!("── {}", folder.join("index.html").display());
    }
    if selection.write && settings.advice {
        page::advise(&root().join("docs"), &sheets)?;
    }
    // Of some scenes alone it would promise what the others do not keep.
    if selection.write && selection.only.is_none() && !selection.quick {
        write(shipped_table::FILE, &shipped_table::text(&sheets))?;
    }
    print!("{}", advice::table(&sheets).markdown());
    let beaten = advice::beaten(&sheets);
    if beaten.is_empty() {
        Ok(())
    } else {
        Err(format!("the default is beaten: {}", beaten.join("; ")))
    }
}
