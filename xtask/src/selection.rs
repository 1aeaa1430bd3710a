//! Which of a page's figures to run, and whether to write the page.

use std::path::PathBuf;

use crate::arguments::Arguments;

/// What to run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Selection {
    /// Leave out the long rows.
    pub(crate) quick: bool,
    /// Write the page.
    pub(crate) write: bool,
    /// The one scene to run.
    pub(crate) only: Option<String>,
    /// Where bunny.stl and 30p30n are; `data` in the workspace if not said.
    pub(crate) data: Option<PathBuf>,
}

impl Selection {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--quick", "--only SCENE", "--data DIR", "--write"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        let selection = Self {
            quick: arguments.has("--quick"),
            write: arguments.has("--write"),
            only: arguments.text("--only"),
            data: arguments.path("--data"),
        };
        if selection.write && selection.only.is_some() {
            return Err("--write needs every row: leave --only out".to_owned());
        }
        Ok(selection)
    }

    /// Whether a row is asked for.
    pub(crate) fn wants(&self, scene: &str, quick: bool) -> bool {
        (quick || !self.quick) && self.only.as_ref().is_none_or(|only| only == scene)
    }
}
