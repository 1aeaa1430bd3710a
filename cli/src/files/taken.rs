//! Names that a file cannot be given.

use std::fs;
use std::io;
use std::path::Path;

use crate::Error;

/// Refuses a name that is taken, or that no file can have.
pub(crate) fn refuse_taken(path: &Path, may_replace: bool, otherwise: &str) -> Result<(), Error> {
    let refuse = |message: String| Err(Error::input(path, message));
    let meta = match fs::symlink_metadata(path) {
        Ok(meta) => meta,
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(e) if e.kind() == io::ErrorKind::InvalidFilename => {
            return refuse("the name is too long for the file system; give a shorter one".into());
        }
        Err(e) => return refuse(format!("no file can have this name ({e}); give another")),
    };
    // Also where it is a link to one.
    if path.is_dir() {
        return refuse("this is a folder; give the name of a file in it".into());
    }
    if !meta.is_file() && !meta.is_symlink() {
        return refuse(
            "this is a pipe or a device, which is not replaced; give the name of a file".into(),
        );
    }
    if !may_replace {
        return refuse(format!(
            "the file exists; give another name, or {otherwise}"
        ));
    }
    Ok(())
}
