//! Hidden files that stand in for outputs until these are whole, and what killed runs have left of them.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};

use tempfile::{Builder, NamedTempFile};

const PREFIX: &str = ".sphpack-";
const SUFFIX: &str = ".unfinished";

/// What is younger may have been made a moment ago, and not be locked yet.
const YOUNG: Duration = Duration::from_secs(60);

/// Temporary files that have not got their final names yet.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The list of temporary files; while it is held, [`forget_unfinished`] waits.
pub(super) fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
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

/// The folder that a path's file is in.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A hidden file that goes away unless it gets a name; readable by whoever the user's mask lets. Locked as long as it is
/// open, so that no other run takes it for a leftover.
pub(super) fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    let prefix = format!("{PREFIX}{}-{}-", std::process::id(), start_time("self"));
    builder.prefix(&prefix).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(folder).map_err(|e| {
        // The hidden name says nothing to anybody.
        let words = e.to_string();
        io::Error::new(
            e.kind(),
            words.split(" at path ").next().unwrap_or_default(),
        )
    })?;
    // Where the file system has no locks, leftovers stay: nobody can tell that they are some. Elsewhere than on Unix locks
    // would keep this process itself from reading the file again.
    #[cfg(unix)]
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// Removes what killed runs have left in a folder: temporary files older than a minute whose process is gone, which is
/// believed only if their lock is free too: the process may be in another container or on another machine.
pub(super) fn clean(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let Some((process, start)) = name.to_str().and_then(maker) else {
            continue;
        };
        let is_old = || {
            let meta = entry.metadata().ok().filter(fs::Metadata::is_file)?;
            let age = SystemTime::now().duration_since(meta.modified().ok()?);
            Some(age.ok()? > YOUNG)
        };
        let is_free = || File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok());
        if is_old() == Some(true) && is_gone(process, start) && is_free() {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Who made a temporary file of this name: process and start time. `None` for any other name.
fn maker(name: &str) -> Option<(u32, u64)> {
    let middle = name.strip_prefix(PREFIX)?.strip_suffix(SUFFIX)?;
    let mut parts = middle.splitn(3, '-');
    let maker = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
    parts.next().map(|_| maker)
}

/// Whether a process is known to have ended.
fn is_gone(process: u32, start: u64) -> bool {
    // Without /proc nothing is known.
    start_time("self") != 0 && start_time(&process.to_string()) != start
}

/// When a process began, in the system's ticks; 0 where there is none, or the system does not say.
fn start_time(process: &str) -> u64 {
    let read = || {
        let text = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
        // The name of the program, in brackets, may hold anything; the start is the 20th word behind it.
        let (_, words) = text.rsplit_once(')')?;
        words.split_whitespace().nth(19)?.parse().ok()
    };
    read().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn only_what_dead_runs_left_is_cleaned() {
        let folder = tempfile::tempdir().unwrap();
        let old = SystemTime::now() - Duration::from_secs(3600);
        let put = |name: &str, when: SystemTime| {
            let file = File::create(folder.path().join(name)).unwrap();
            file.set_modified(when).unwrap();
            file
        };
        // No process has so high a number.
        let dead = format!("{PREFIX}4194304000-1-");
        drop(put(&format!("{dead}old{SUFFIX}"), old));
        drop(put(&format!("{dead}young{SUFFIX}"), SystemTime::now()));
        drop(put(&format!("{dead}finished.vtu"), old));
        drop(put(&format!("{PREFIX}abc{SUFFIX}"), old));
        drop(put("out.vtu", old));
        let locked = put(&format!("{dead}locked{SUFFIX}"), old);
        locked.lock().unwrap();
        let (me, begin) = (std::process::id(), start_time("self"));
        drop(put(&format!("{PREFIX}{me}-{begin}-mine{SUFFIX}"), old));
        // The number is taken again, by another process.
        drop(put(&format!("{PREFIX}{me}-1-before{SUFFIX}"), old));
        clean(folder.path());
        let mut left: Vec<String> = fs::read_dir(folder.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        left.sort();
        let mut expected = vec![
            format!("{dead}young{SUFFIX}"),
            format!("{dead}finished.vtu"),
            format!("{PREFIX}abc{SUFFIX}"),
            "out.vtu".to_owned(),
            format!("{dead}locked{SUFFIX}"),
            format!("{PREFIX}{me}-{begin}-mine{SUFFIX}"),
        ];
        expected.sort();
        assert_eq!(left, expected);
    }

    #[test]
    fn a_file_tells_who_made_it() {
        let folder = tempfile::tempdir().unwrap();
        let file = temporary(folder.path()).unwrap();
        let name = file.path().file_name().unwrap().to_str().unwrap();
        assert_eq!(maker(name), Some((std::process::id(), start_time("self"))));
        assert!(!is_gone(std::process::id(), start_time("self")));
    }
}
