//! The scenes that the project ships.

use std::fs;

use sphpack::Scene;
use sphpack::scene::Method;
use sphpack_packing::Coupled;

use crate::selection::Selection;
use crate::workspace::root;

/// So many iterations in which all particles settle together: what comes before that, with the method coupled, is beside.
pub(crate) fn iterations_together(method: Method, most: usize) -> usize {
    match method {
        Method::Coupled => most + 2 * Coupled::default().apart_iterations,
        _ => most,
    }
}

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
