//! Where the workspace is, and how its pages are written.

use std::fs;
use std::path::{Path, PathBuf};

/// The workspace's folder.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

/// Writes a page, a picture or a table of the workspace, by its name from there.
pub(crate) fn write(name: &str, text: &str) -> Result<(), String> {
    let path = root().join(name);
    fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
}
