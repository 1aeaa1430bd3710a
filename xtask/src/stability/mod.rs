//! Where perfect lattices stay and where they fall apart: the analysis, its pictures, and time evolutions that confirm it.

mod alone;
mod arrows;
mod clamped;
mod evolution;
mod growth;
mod heat;
mod ink;
mod page;
mod pairing;
mod safe;
mod sweep;
mod time_step;
mod zones;

use crate::arguments::Arguments;
use crate::workspace::write;

/// What to run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Settings {
    /// A few cases of every section, in seconds.
    quick: bool,
    /// Write docs/stability.md and its pictures.
    write: bool,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["lattice", "--quick", "--write"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        let settings = Self {
            quick: arguments.has("--quick"),
            write: arguments.has("--write"),
        };
        if settings.quick && settings.write {
            return Err("--write needs every row: leave --quick out".to_owned());
        }
        Ok(settings)
    }

    /// What CI runs.
    pub(crate) fn quick() -> Self {
        Self {
            quick: true,
            write: false,
        }
    }
}

/// A part of the page: its text, and the pictures in it by their file names.
struct Section {
    text: String,
    pictures: Vec<(&'static str, String)>,
}

/// Runs every section; each fails where what it says does not hold.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let is_quick = settings.quick;
    let sweep = sweep::Sweep::run(is_quick)?;
    let sections: [&dyn Fn() -> Result<Section, String>; 7] = [
        &|| Ok(page::maps(&sweep)),
        &|| page::waves(is_quick),
        &|| growth::section(is_quick),
        &|| alone::section(is_quick),
        &|| clamped::section(is_quick),
        &|| pairing::section(is_quick),
        &|| time_step::section(is_quick),
    ];
    let mut page = page::beginning(&sweep);
    print!("{page}");
    for section in sections {
        let Section { text, pictures } = section()?;
        print!("{text}");
        page.push_str(&text);
        if settings.write {
            for (name, svg) in &pictures {
                write(&format!("docs/{name}"), svg)?;
            }
        }
    }
    if settings.write {
        write("docs/stability.md", &page)?;
    }
    Ok(())
}
