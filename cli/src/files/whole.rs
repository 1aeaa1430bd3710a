//! Files that appear whole or not at all.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

use crate::Error;

/// Temporary files that have not got their final names yet.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every temporary file and lets none be made any more, for a process that ends at once: the lock is never
/// given back.
pub(crate) fn forget_unfinished() {
    let mut files = unfinished();
    for path in files.drain(..) {
        let _ = fs::remove_file(path);
    }
    std::mem::forget(files);
}

/// Files written under temporary names beside their final ones, which they get all together at the end.
#[derive(Debug)]
pub(crate) struct WholeFiles {
    may_replace: bool,
    pending: Vec<(NamedTempFile, PathBuf)>,
}

impl WholeFiles {
    /// No files yet. `may_replace`: whether files that exist may be replaced.
    pub(crate) fn new(may_replace: bool) -> Self {
        Self {
            may_replace,
            pending: Vec::new(),
        }
    }

    /// Whether files can be made in the folder of `path`, tried out.
    pub(crate) fn try_folder(path: &Path) -> io::Result<()> {
        temporary(folder_of(path)).map(drop)
    }

    /// Writes a file under a temporary name.
    pub(crate) fn write(
        &mut self,
        path: &Path,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Error> {
        let attempt = || {
            let mut file = {
                let mut registered = unfinished();
                let file = temporary(folder_of(path))?;
                registered.push(file.path().to_owned());
                file
            };
            let mut buffered = BufWriter::with_capacity(1 << 18, file.as_file_mut());
            content(&mut buffered)?;
            buffered.flush()?;
            drop(buffered);
            Ok::<_, io::Error>(file)
        };
        let file = attempt().map_err(|e| Error::write(path, e))?;
        self.pending.push((file, path.to_owned()));
        Ok(())
    }

    /// Gives all files their names.
    pub(crate) fn finish(mut self) -> Result<(), Error> {
        for (file, path) in self.pending.drain(..) {
            let temporary = file.path().to_owned();
            let renamed = if self.may_replace {
                file.persist(&path)
            } else {
                file.persist_noclobber(&path)
            };
            renamed.map_err(|e| Error::write(&path, e.error))?;
            unfinished().retain(|p| *p != temporary);
        }
        Ok(())
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A hidden file that goes away unless it gets a name; readable by whoever the user's mask lets.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".sphpack-").suffix(".unfinished");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
