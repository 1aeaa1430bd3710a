//! Sets of files, as they succeed and fail.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::AtomicFiles;

fn write(files: &mut AtomicFiles, path: &Path, content: &str) {
    files
        .write(path, |to| to.write_all(content.as_bytes()))
        .unwrap();
}

/// Two paths in a folder of their own.
fn two() -> (TempDir, PathBuf, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (folder.path().join("a.txt"), folder.path().join("b.txt"));
    (folder, a, b)
}

/// Names in a folder, hidden ones too, sorted.
pub(super) fn names(folder: &TempDir) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[cfg(unix)]
fn mode(path: &Path) -> u32 {
    use std::os::unix::fs::PermissionsExt;
    fs::metadata(path).unwrap().permissions().mode() & 0o7777
}

#[test]
fn nothing_has_its_name_before_the_end() {
    let (folder, a, b) = two();
    let mut files = AtomicFiles::new(false);
    write(&mut files, &a, "first");
    write(&mut files, &b, "second");
    assert!(!a.exists() && !b.exists());
    files.finish().unwrap();
    assert_eq!(names(&folder), ["a.txt", "b.txt"]);
    assert_eq!(fs::read(&a).unwrap(), b"first");
}

#[test]
fn sets_that_are_given_up_leave_nothing() {
    let (folder, a, _) = two();
    let mut files = AtomicFiles::new(false);
    write(&mut files, &a, "first");
    drop(files);
    assert!(names(&folder).is_empty());
}

#[test]
fn a_file_that_fails_does_not_take_the_others_with_it() {
    let (folder, a, b) = two();
    let mut files = AtomicFiles::new(false);
    let failed = files.write(&b, |_| Err(io::Error::other("full")));
    let message = failed.unwrap_err().to_string();
    assert!(
        message.ends_with("b.txt: full; nothing was left behind"),
        "{message}"
    );
    assert!(names(&folder).is_empty());

    write(&mut files, &a, "first");
    let failed = files.write(&b, |_| Err(io::Error::other("full")));
    let message = failed.unwrap_err().to_string();
    assert!(
        message.contains("kept as ") && message.contains("a.rescued.txt;"),
        "{message}"
    );
    drop(files);
    assert_eq!(names(&folder), ["a.rescued.txt"]);
    assert_eq!(
        fs::read(folder.path().join("a.rescued.txt")).unwrap(),
        b"first"
    );
}

#[test]
fn what_does_not_pass_is_kept_to_be_looked_at() {
    let (folder, a, _) = two();
    let mut files = AtomicFiles::new(false);
    let failed = files.write_and_check(
        &a,
        |to| to.write_all(b"first"),
        |written| {
            assert_eq!(fs::read(written).unwrap(), b"first");
            Err("x of particle 7 is 1 instead of 2".into())
        },
    );
    let message = failed.unwrap_err().to_string();
    assert!(
        message.contains("x of particle 7") && message.contains("a.rescued.txt"),
        "{message}"
    );
    assert_eq!(names(&folder), ["a.rescued.txt"]);
}

#[test]
fn a_name_that_is_taken_meanwhile_undoes_all() {
    let (folder, a, b) = two();
    let mut files = AtomicFiles::new(false);
    write(&mut files, &a, "first");
    write(&mut files, &b, "second");
    fs::write(&b, "precious").unwrap();
    fs::write(folder.path().join("b.rescued.txt"), "of an earlier day").unwrap();
    let message = files.finish().unwrap_err().to_string();
    assert!(
        message.contains("b.txt: ") && message.contains("a.rescued.txt, "),
        "{message}"
    );
    assert!(
        message.contains("b.rescued-2.txt; files that were there"),
        "{message}"
    );
    assert_eq!(
        names(&folder),
        ["a.rescued.txt", "b.rescued-2.txt", "b.rescued.txt", "b.txt"]
    );
    assert_eq!(fs::read(&b).unwrap(), b"precious");
    assert_eq!(
        fs::read(folder.path().join("b.rescued-2.txt")).unwrap(),
        b"second"
    );
}

#[test]
fn replaced_files_come_back() {
    let (folder, a, b) = two();
    fs::write(&a, "old").unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(&a, fs::Permissions::from_mode(0o640)).unwrap();
    }
    let mut files = AtomicFiles::new(true);
    write(&mut files, &a, "first");
    write(&mut files, &b, "second");
    // A folder is in the way of the second.
    fs::create_dir(&b).unwrap();
    fs::write(b.join("inside"), "").unwrap();
    let message = files.finish().unwrap_err().to_string();
    assert!(
        message.contains("b.txt: a folder of that name is in the way"),
        "{message}"
    );
    assert_eq!(
        names(&folder),
        ["a.rescued.txt", "a.txt", "b.rescued.txt", "b.txt"]
    );
    assert_eq!(fs::read(&a).unwrap(), b"old");
    #[cfg(unix)]
    assert_eq!(mode(&a), 0o640);
    assert_eq!(
        fs::read(folder.path().join("a.rescued.txt")).unwrap(),
        b"first"
    );
    assert_eq!(
        fs::read(folder.path().join("b.rescued.txt")).unwrap(),
        b"second"
    );
}

#[cfg(unix)]
#[test]
fn replacing_keeps_mode_and_owner() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
    let (folder, a, b) = two();
    fs::write(&a, "old").unwrap();
    fs::set_permissions(&a, fs::Permissions::from_mode(0o604)).unwrap();
    // Only an administrator may.
    let is_given_away = chown(&a, Some(12345), Some(54321)).is_ok();
    let mut files = AtomicFiles::new(true);
    write(&mut files, &a, "first");
    write(&mut files, &b, "second");
    files.finish().unwrap();
    assert_eq!(names(&folder), ["a.txt", "b.txt"]);
    assert_eq!(fs::read(&a).unwrap(), b"first");
    assert_eq!(mode(&a), 0o604);
    if is_given_away {
        let meta = fs::metadata(&a).unwrap();
        assert_eq!((meta.uid(), meta.gid()), (12345, 54321));
    }
}

#[cfg(unix)]
#[test]
fn links_are_replaced_not_followed() {
    let (folder, a, b) = two();
    fs::write(&b, "precious").unwrap();
    std::os::unix::fs::symlink(&b, &a).unwrap();
    let mut files = AtomicFiles::new(true);
    write(&mut files, &a, "first");
    files.finish().unwrap();
    assert_eq!(names(&folder), ["a.txt", "b.txt"]);
    assert!(!fs::symlink_metadata(&a).unwrap().is_symlink());
    assert_eq!(fs::read(&b).unwrap(), b"precious");
}

#[test]
fn names_too_long_for_more_are_kept_hidden() {
    let folder = tempfile::tempdir().unwrap();
    let long = folder.path().join("x".repeat(251) + ".txt");
    let mut files = AtomicFiles::new(false);
    write(&mut files, &long, "first");
    fs::write(&long, "precious").unwrap();
    let message = files.finish().unwrap_err().to_string();
    let all = names(&folder);
    assert_eq!(all.len(), 2);
    assert!(
        all[0].starts_with(".sphpack-") && all[0].ends_with(".complete"),
        "{all:?}"
    );
    assert!(message.contains(&all[0]), "{message}");
    assert_eq!(fs::read(folder.path().join(&all[0])).unwrap(), b"first");
}

#[test]
fn what_has_gone_with_its_folder_is_not_said_to_be_kept() {
    let folder = tempfile::tempdir().unwrap();
    let sub = folder.path().join("sub");
    fs::create_dir(&sub).unwrap();
    let mut files = AtomicFiles::new(true);
    write(&mut files, &sub.join("a.txt"), "a");
    fs::rename(&sub, folder.path().join("gone")).unwrap();
    let error = files.finish().unwrap_err();
    assert!(error.is_all_lost(), "{error}");
}
