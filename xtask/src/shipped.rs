//! The scenes that the project ships.

use std::fs;

use sphpack::Scene;

use crate::selection::Selection;
use crate::workspace::root;

/// A shipped scene; `None` where its body's file is not there.
pub(crate) fn load(name: &str, selection: &Selection) -> Result<Option<Scene>, String> {
    let path = root().join("scenes").join(format!("{name}.toml"));
    let mut text =
        fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    if name == "bunny" {
        let file = selection
            .data
            .clone()
            .unwrap_or_else(|| root().join("data"))
            .join("bunny.stl");
        if !file.is_file() {
            return Ok(None);
        }
        let file = file
            .canonicalize()
            .map_err(|error| format!("{}: {error}", file.display()))?;
        text = text.replace("../data/bunny.stl", &file.display().to_string());
    }
    Scene::parse(&text, &path)
        .map(Some)
        .map_err(|error| error.to_string())
}
