//! Whether files can be written, asked before any work is done.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::files::WholeFiles;

/// Refuses outputs that exist (unless `may_replace`), are inputs, are named twice, or whose folder is missing or not
/// writable.
pub(super) fn check(
    outputs: &[&PathBuf],
    inputs: &[PathBuf],
    may_replace: bool,
) -> Result<(), Error> {
    let mut seen: Vec<PathBuf> = Vec::new();
    for &path in outputs {
        let Some(name) = path.file_name() else {
            return Err(Error::input(
                path,
                "this is no file name; give the name of a file to write",
            ));
        };
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let Ok(home) = fs::canonicalize(folder) else {
            return Err(Error::input(
                path,
                format!(
                    "the folder {} does not exist; create it first",
                    folder.display()
                ),
            ));
        };
        let place = home.join(name);
        if seen.contains(&place) {
            return Err(Error::input(
                path,
                "this file is asked for twice; give each output its own name",
            ));
        }
        seen.push(place);
        if path.is_dir() {
            return Err(Error::input(
                path,
                "this is a folder; give the name of a file in it",
            ));
        }
        let itself = fs::canonicalize(path).ok();
        if itself.is_some()
            && inputs
                .iter()
                .any(|input| fs::canonicalize(input).ok() == itself)
        {
            return Err(Error::input(
                path,
                "this file is an input too; give the output another name",
            ));
        }
        if !may_replace && fs::symlink_metadata(path).is_ok() {
            return Err(Error::input(
                path,
                "the file exists; give another name, or --force to replace it",
            ));
        }
        WholeFiles::try_folder(path).map_err(|e| {
            Error::input(
                path,
                format!("nothing can be written into the folder {} ({e}); choose another, or change its permissions", folder.display()),
            )
        })?;
    }
    Ok(())
}
