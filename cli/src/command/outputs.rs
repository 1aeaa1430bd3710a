//! Whether files can be written, asked before any work is done.

use std::fs;
use std::io;
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use crate::Error;
use crate::files::{AtomicFiles, refuse_taken};

/// Refuses what cannot be the name of a file, whatever its format and wherever it is.
pub(super) fn check_name(path: &Path) -> Result<(), Error> {
    let refuse = |what: &str| Err(Error::input(path, what));
    let text = path.to_string_lossy();
    if text.is_empty() {
        return Err(Error::Usage(
            "the name of an output is empty; give the name of a file to write".into(),
        ));
    }
    let Some(name) = path.file_name().map(|name| name.to_string_lossy()) else {
        return refuse("this is no file name; give the name of a file to write");
    };
    if text.ends_with(['/', MAIN_SEPARATOR]) {
        return refuse("this is the name of a folder; give the name of a file in it");
    }
    if name.starts_with('.') && path.extension().is_none() {
        return refuse("this is an ending without a name; put a name before it");
    }
    Ok(())
}

/// Refuses outputs that exist (unless `may_replace`), are inputs, are named twice, or whose folder is missing or not
/// writable.
pub(super) fn check(
    outputs: &[&PathBuf],
    inputs: &[PathBuf],
    may_replace: bool,
) -> Result<(), Error> {
    let mut seen: Vec<PathBuf> = Vec::new();
    for &path in outputs {
        check_name(path)?;
        let (home, name) = (home(path)?, path.file_name().unwrap_or_default());
        let place = home.join(name);
        if seen.contains(&place) {
            return Err(Error::input(
                path,
                "this file is asked for twice; give each output its own name",
            ));
        }
        seen.push(place);
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
        refuse_taken(path, may_replace, "--force to replace it")?;
        AtomicFiles::try_folder(path).map_err(|e| {
            let folder = shown(path);
            Error::input(
                path,
                match e.kind() {
                    io::ErrorKind::ReadOnlyFilesystem => format!("nothing can be written into {folder}, which is on a read-only file system; choose another folder"),
                    _ => format!("nothing can be written into {folder} ({e}); choose another folder, or change its permissions"),
                },
            )
        })?;
    }
    Ok(())
}

/// A path's folder, for messages.
fn shown(path: &Path) -> String {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => {
            format!("the folder {}", folder.display())
        }
        _ => "the working directory".into(),
    }
}

/// A path's folder, if there is one.
fn home(path: &Path) -> Result<PathBuf, Error> {
    let parent = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let found = fs::canonicalize(parent.unwrap_or(Path::new(".")));
    let refuse = |message: String| Err(Error::input(path, message));
    match found {
        Ok(home) if home.is_dir() => Ok(home),
        Ok(_) => refuse(format!(
            "{} is a file, not a folder; choose another",
            shown(path).trim_start_matches("the folder ")
        )),
        Err(e) if parent.is_none() => refuse(format!(
            "the working directory cannot be used any more ({e}); change to one that exists"
        )),
        Err(e) if e.kind() == io::ErrorKind::NotFound => {
            refuse(format!("{} does not exist; create it first", shown(path)))
        }
        Err(e) => refuse(format!(
            "{} cannot be used ({e}); choose another",
            shown(path)
        )),
    }
}
