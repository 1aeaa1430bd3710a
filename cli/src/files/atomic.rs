//! Files that appear whole and all together, or not at all.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::size_limit::Limited;
use super::temporary::{clean, folder_of, temporary, unfinished};
use crate::Error;

/// Files written under temporary names beside their final ones, which they get all together at the end. Where that
/// fails, what was complete stays under another name: it may have taken hours.
#[derive(Debug)]
pub(crate) struct AtomicFiles {
    may_replace: bool,
    pending: Vec<Pending>,
}

/// A complete file, and the name that it is to get.
#[derive(Debug)]
struct Pending {
    file: NamedTempFile,
    path: PathBuf,
}

/// A file that has its name, and the one that had it before.
struct Renamed {
    path: PathBuf,
    before: Option<PathBuf>,
}

impl AtomicFiles {
    /// No files yet. `may_replace`: whether files that exist may be replaced.
    pub(crate) fn new(may_replace: bool) -> Self {
        Self {
            may_replace,
            pending: Vec::new(),
        }
    }

    /// Whether files can be made in the folder of `path`, tried out; what killed runs have left there goes away.
    pub(crate) fn try_folder(path: &Path) -> io::Result<()> {
        clean(folder_of(path));
        temporary(folder_of(path)).map(drop)
    }

    /// Writes a file under a temporary name, down to the disk.
    pub(crate) fn write(
        &mut self,
        path: &Path,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Error> {
        self.write_and_check(path, content, |_| Ok(()))
    }

    /// Writes a file under a temporary name and has it looked at there.
    ///
    /// # Errors
    /// [`Error::Write`] with what `check` found, or with why it could not be written; complete files, and one that
    /// did not pass, stay under other names.
    pub(crate) fn write_and_check(
        &mut self,
        path: &Path,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
        check: impl FnOnce(&Path) -> Result<(), String>,
    ) -> Result<(), Error> {
        match written(path, content) {
            Ok(file) => {
                let found = check(file.path());
                let path = path.to_owned();
                self.pending.push(Pending { file, path });
                let Err(reason) = found else { return Ok(()) };
                let path = self.pending.last().map(|last| last.path.clone());
                Err(self.failed(&path.unwrap_or_default(), reason, Vec::new()))
            }
            Err(e) => Err(self.failed(path, e, Vec::new())),
        }
    }

    /// Gives all files their names.
    ///
    /// # Errors
    /// [`Error::Write`] where one cannot get its name; then none has it, and what was there before is there again.
    pub(crate) fn finish(mut self) -> Result<(), Error> {
        // A second Ctrl-C waits until the set is whole.
        let mut registered = unfinished();
        let mut done: Vec<Renamed> = Vec::new();
        while !self.pending.is_empty() {
            let Pending { file, path } = self.pending.remove(0);
            let temporary = file.path().to_owned();
            match rename(file, &path, self.may_replace) {
                Ok(renamed) => {
                    registered.retain(|p| *p != temporary);
                    done.push(renamed);
                }
                Err((file, e)) => {
                    self.pending.insert(
                        0,
                        Pending {
                            file,
                            path: path.clone(),
                        },
                    );
                    drop(registered);
                    return Err(self.failed(&path, e, done));
                }
            }
        }
        for renamed in &done {
            if let Some(before) = &renamed.before {
                let _ = fs::remove_file(before);
            }
            sync_folder(folder_of(&renamed.path));
        }
        Ok(())
    }

    /// The error, once everything is undone and what is complete has been put aside.
    fn failed(&mut self, path: &Path, reason: impl ToString, done: Vec<Renamed>) -> Error {
        let mut kept = Vec::new();
        let mut lost = Vec::new();
        for Renamed { path, before } in done {
            let Ok(name) = rescued(&path, &path) else {
                // It stays where it is: what was there before has another name at least.
                if is_there(&path) {
                    kept.push(path.clone());
                }
                let before = before.filter(|before| is_there(before));
                lost.extend(before.map(|before| (path, before)));
                continue;
            };
            kept.push(name);
            if let Some(before) = before
                && fs::rename(&before, &path).is_err()
            {
                lost.push((path, before));
            }
        }
        for Pending { file, path } in self.pending.drain(..) {
            let temporary = file.path().to_owned();
            if let Ok((file, hidden)) = file.keep() {
                unfinished().retain(|p| *p != temporary);
                let name = rescued(&hidden, &path).or_else(|_| {
                    // Not taken for a leftover by a later run.
                    let name = hidden.with_extension("complete");
                    fs::rename(&hidden, &name).map(|()| name)
                });
                // Under its hidden name a later run would take it away, and its folder may have gone with it.
                kept.extend(name.ok());
                drop(file);
            }
        }
        Error::write(path, reason).with_kept(&kept, &lost)
    }
}

fn is_there(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

/// Writes a single file, down to the disk, in place of whatever has its name: at any instant the one or the other is
/// there, whole.
pub(crate) fn replace(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let file = written(path, content)?;
    let mut registered = unfinished();
    let temporary = file.path().to_owned();
    file.persist(path).map_err(|e| e.error)?;
    registered.retain(|p| *p != temporary);
    drop(registered);
    sync_folder(folder_of(path));
    Ok(())
}

/// A file under a temporary name beside `path`, its content on the disk.
fn written(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<NamedTempFile> {
    let mut file = {
        let mut registered = unfinished();
        let file = temporary(folder_of(path))?;
        registered.push(file.path().to_owned());
        file
    };
    let mut buffered = BufWriter::with_capacity(1 << 18, Limited::new(file.as_file_mut()));
    content(&mut buffered)?;
    buffered.flush()?;
    drop(buffered);
    durable(file.as_file().sync_all())?;
    Ok(file)
}

/// Gives a complete file its name; what had that name before is beside it then.
fn rename(
    file: NamedTempFile,
    path: &Path,
    may_replace: bool,
) -> Result<Renamed, (NamedTempFile, io::Error)> {
    if !may_replace {
        let renamed = Renamed {
            path: path.to_owned(),
            before: None,
        };
        return match file.persist_noclobber(path) {
            Ok(_) => Ok(renamed),
            Err(e) => Err((e.file, e.error)),
        };
    }
    let before = match put_aside(path, &file) {
        Ok(before) => before,
        Err(e) => return Err((file, e)),
    };
    match file.persist(path) {
        Ok(_) => Ok(Renamed {
            path: path.to_owned(),
            before,
        }),
        Err(e) => {
            if let Some(before) = before {
                // Where both are one file, this does nothing, and the second name goes.
                let _ = fs::rename(&before, path);
                let _ = fs::remove_file(&before);
            }
            Err((e.file, e.error))
        }
    }
}

/// Gives the file at `path`, if there is one, a second, hidden name, and `new` its permissions and as far as allowed its
/// owner. A symbolic link is put aside as such: it will be replaced, and what it points to stays.
fn put_aside(path: &Path, new: &NamedTempFile) -> io::Result<Option<PathBuf>> {
    let meta = match fs::symlink_metadata(path) {
        Ok(meta) => meta,
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(e),
    };
    if meta.is_dir() {
        return Err(io::Error::new(
            io::ErrorKind::IsADirectory,
            "a folder of that name is in the way",
        ));
    }
    if meta.is_file() {
        take_after(new, &meta);
    }
    let folder = folder_of(path);
    for number in 0..1000 {
        let name = format!(".sphpack-{}-{number}.replaced", std::process::id());
        let before = folder.join(name);
        match fs::hard_link(path, &before) {
            Ok(()) => return Ok(Some(before)),
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
            Err(_) if fs::symlink_metadata(&before).is_ok() => {}
            // No second names here: there is a moment without the file then.
            Err(_) => {
                fs::rename(path, &before)?;
                return Ok(Some(before));
            }
        }
    }
    Err(io::Error::other(
        "its folder is full of replaced files (.sphpack-*.replaced)",
    ))
}

#[cfg(unix)]
fn take_after(new: &NamedTempFile, old: &fs::Metadata) {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
    // Not everybody may give files away; the owner first, as that may take permissions off.
    if fchown(new.as_file(), Some(old.uid()), Some(old.gid())).is_err() {
        let _ = fchown(new.as_file(), None, Some(old.gid()));
    }
    let mode = fs::Permissions::from_mode(old.permissions().mode() & 0o777);
    let _ = new.as_file().set_permissions(mode);
}

#[cfg(not(unix))]
fn take_after(new: &NamedTempFile, old: &fs::Metadata) {
    let _ = new.as_file().set_permissions(old.permissions());
}

/// Renames a complete file to a free name like that which it was to get, with "rescued" in it.
fn rescued(from: &Path, wanted: &Path) -> io::Result<PathBuf> {
    let part = |part: Option<&std::ffi::OsStr>| {
        part.map_or_else(String::new, |part| part.to_string_lossy().into_owned())
    };
    let (stem, ending) = (part(wanted.file_stem()), part(wanted.extension()));
    for number in 1..1000 {
        let mark = if number == 1 {
            String::new()
        } else {
            format!("-{number}")
        };
        let name = wanted.with_file_name(format!("{stem}.rescued{mark}.{ending}"));
        // A second name is refused where there is a file, as a new name is not.
        match fs::hard_link(from, &name) {
            Ok(()) => {
                fs::remove_file(from)?;
                return Ok(name);
            }
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
            Err(_) if fs::symlink_metadata(&name).is_ok() => {}
            Err(_) => {
                fs::rename(from, &name)?;
                return Ok(name);
            }
        }
    }
    Err(io::Error::other("all names are taken"))
}

/// Not every file system can say when its data has reached the disk; that is no failure.
fn durable(synced: io::Result<()>) -> io::Result<()> {
    match synced {
        Err(e)
            if matches!(
                e.kind(),
                io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported
            ) =>
        {
            Ok(())
        }
        other => other,
    }
}

/// Has the folder's names written to the disk, as far as it can be opened; the files are there in any case.
fn sync_folder(folder: &Path) {
    if let Ok(folder) = fs::File::open(folder) {
        let _ = folder.sync_all();
    }
}
