//! Maps of where methods fail: grids of scenes by formula, packed by the command and judged by brute force.

mod bench;
mod corner;
mod curvature;
mod dirt;
mod edges;
mod gap;
mod kernels;
mod outcome;
mod page;
mod panel;
mod parts;
mod picture;
mod pinned;
mod resolution;
mod scenes;
mod settings;
mod table;
mod thin;
mod units;
mod wall;

use std::path::PathBuf;

use super::build;
use crate::arguments::Arguments;
use bench::{Bench, METHODS, Method, folder};
use edges::Grid;
use outcome::Outcome;
use panel::{Map, Panel};
use table::MAPS;

/// What to run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Settings {
    /// The pinned cells only.
    quick: bool,
    write: bool,
    /// The one map.
    map: Option<String>,
    /// The one method.
    method: Option<String>,
    /// The command, where it is not to be built.
    program: Option<PathBuf>,
}

/// The names of the maps, as an argument.
const NAMES: &str =
    "corner|edge|thin|gap|parts|curvature|resolution|wall|dirt|parameters|kernel|units";

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &[
        "map",
        NAMES,
        "--method NAME",
        "--quick",
        "--program FILE",
        "--write",
    ];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            quick: arguments.has("--quick"),
            write: arguments.has("--write"),
            map: arguments.text(NAMES),
            method: arguments.text("--method"),
            program: arguments.path("--program"),
        })
    }

    /// What CI runs.
    pub(crate) fn quick() -> Self {
        Self {
            quick: true,
            ..Self::default()
        }
    }

    fn maps(&self) -> impl Iterator<Item = &'static Map> {
        let is_asked = |map: &&Map| self.map.as_deref().is_none_or(|name| name == map.name);
        MAPS.iter().filter(is_asked)
    }

    fn methods(&self) -> Result<Vec<Method>, String> {
        let is_asked = |method: &Method| {
            self.method
                .as_deref()
                .is_none_or(|name| name == method.name)
        };
        let asked: Vec<Method> = METHODS.into_iter().filter(is_asked).collect();
        if asked.is_empty() {
            let names = METHODS.map(|method| method.name).join(", ");
            return Err(format!("there are maps of the methods {names}"));
        }
        if self.write && self.quick {
            return Err("--write needs every cell: leave --quick out".to_owned());
        }
        Ok(asked)
    }
}

/// Makes maps; fails where a scene fails in silence, or in the short form where a pinned cell is not as it was.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let methods = settings.methods()?;
    let program = match &settings.program {
        Some(program) => std::path::absolute(program).map_err(|error| error.to_string())?,
        None => build()?,
    };
    let bench = Bench::open(program, settings.program.is_some())?;
    let result = if settings.quick {
        pinned::run(&bench, settings.maps())
    } else {
        made(&bench, settings, &methods)
    };
    bench.clear();
    result
}

fn made(bench: &Bench, settings: &Settings, methods: &[Method]) -> Result<(), String> {
    let mut failures = Vec::new();
    for map in settings.maps() {
        for method in methods {
            let mut panels: Vec<(&Panel, Grid)> = Vec::new();
            for (number, panel) in map.panels.iter().enumerate() {
                if panel.only.is_some_and(|only| only != method.name) {
                    continue;
                }
                let grid = bench.panel(map, number, *method)?;
                failures.extend(listed(map, number, *method, &grid));
                panels.push((panel, grid));
            }
            let section = page::Section::of(map, *method, &panels);
            println!("{}", section.text);
            if settings.write {
                section.write(map, *method)?;
            }
        }
    }
    if failures.is_empty() {
        return Ok(());
    }
    Err(format!(
        "{} scenes fail in silence; they are in {}:\n{}",
        failures.len(),
        folder("failures").display(),
        failures.join("\n")
    ))
}

/// The cells of a panel that fail, by the names of their scenes.
fn listed(map: &Map, number: usize, method: Method, grid: &Grid) -> Vec<String> {
    let panel = &map.panels[number];
    let mut lines = Vec::new();
    for (y, row) in grid.iter().enumerate() {
        for (x, cell) in row.iter().enumerate() {
            if let Some(cell) = cell.as_ref().filter(|cell| cell.outcome == Outcome::Fails) {
                lines.push(format!(
                    "{}.toml: {}: {}, {}: {}: {}",
                    bench::file_name(map, number, method, [x, y]),
                    panel.x.label,
                    panel.x.word(x),
                    panel.y.label,
                    panel.y.word(y),
                    cell.why
                ));
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_are_those_of_the_maps() {
        let names: Vec<&str> = MAPS.iter().map(|map| map.name).collect();
        assert_eq!(names.join("|"), NAMES);
    }
}
