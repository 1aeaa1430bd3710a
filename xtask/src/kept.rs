//! Results that are kept until the code that makes them changes: long tasks go on where they were stopped.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::workspace::root;

/// What every packing depends on.
const PACKING: [&str; 9] = [
    "Cargo.lock",
    "scenes",
    "kernels/src",
    "neighbors/src",
    "pairs/src",
    "geometry/src",
    "packing/src",
    "separation/src",
    "cli/src",
];

/// Results in a folder, a file each or several.
pub(crate) struct Kept {
    folder: PathBuf,
    /// Tells the code that packs and measures, and the scenes, from others.
    code: u64,
}

impl Kept {
    /// What is in `folder`, which is made where it is not there; `own` are the sources that measure, beside those that pack.
    pub(crate) fn open(folder: &Path, own: &[&str]) -> Result<Self, String> {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let mut code = FNV;
        for room in PACKING.iter().chain(own) {
            digest(&root().join(room), &mut code)?;
        }
        Ok(Self {
            folder: folder.to_owned(),
            code,
        })
    }

    /// The result that is known of something: `of` says all that it is of, beside the code.
    pub(crate) fn known<T: DeserializeOwned>(&self, of: &str) -> Option<T> {
        serde_json::from_slice(&fs::read(self.path(of, "json")).ok()?).ok()
    }

    /// Keeps a result, whole or not at all, whenever the task is stopped.
    pub(crate) fn keep<T: Serialize>(&self, of: &str, result: &T) -> Result<(), String> {
        /// Tells those apart that several workers write at once.
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        let path = self.path(of, "json");
        let number = NUMBER.fetch_add(1, Relaxed);
        let beside = path.with_extension(format!("{}-{number}.part", std::process::id()));
        let text = serde_json::to_string(result).map_err(|error| error.to_string())?;
        fs::write(&beside, text + "\n")
            .and_then(|()| fs::rename(&beside, &path))
            .map_err(|error| format!("{}: {error}", path.display()))
    }

    /// The result that is known, or else made, and known from then on.
    pub(crate) fn once<T: Serialize + DeserializeOwned>(
        &self,
        of: &str,
        make: impl FnOnce() -> Result<T, String>,
    ) -> Result<T, String> {
        if let Some(known) = self.known(of) {
            return Ok(known);
        }
        let made = make()?;
        self.keep(of, &made)?;
        Ok(made)
    }

    /// The file of a result, or of what goes with it.
    pub(crate) fn path(&self, of: &str, ending: &str) -> PathBuf {
        let key = hash(self.code, of.as_bytes());
        self.folder.join(format!("{key:016x}.{ending}"))
    }
}

/// Takes a file, or all files of a folder in the order of their names, into a hash.
fn digest(path: &Path, into: &mut u64) -> Result<(), String> {
    let fail = |error: std::io::Error| format!("{}: {error}", path.display());
    if path.is_dir() {
        let entries = fs::read_dir(path).and_then(Iterator::collect::<Result<Vec<_>, _>>);
        let mut inside: Vec<PathBuf> = (entries.map_err(fail)?.iter())
            .map(fs::DirEntry::path)
            .collect();
        inside.sort_unstable();
        return inside.iter().try_for_each(|path| digest(path, into));
    }
    *into = hash(*into, &fs::read(path).map_err(fail)?);
    Ok(())
}

/// FNV-1a's beginning.
const FNV: u64 = 0xcbf2_9ce4_8422_2325;

/// FNV-1a: good enough to tell versions and setups apart.
fn hash(begin: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(begin, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_that_of_its_authors() {
        assert_eq!(hash(FNV, b""), FNV);
        assert_eq!(hash(FNV, b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(hash(FNV, b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn a_result_is_made_once() {
        let folder = std::env::temp_dir().join(format!("kept-{}", std::process::id()));
        let kept = Kept::open(&folder, &[]).unwrap();
        let again = || Err("made twice".to_owned());
        assert_eq!(kept.once("a", || Ok(0.1_f64)), Ok(0.1));
        assert_eq!(kept.once("a", again), Ok(0.1_f64));
        // Of something else, by other code, or damaged: made anew.
        assert!(kept.once::<f64>("b", again).is_err());
        let other = Kept::open(&folder, &[file!()]).unwrap();
        assert_eq!(other.known::<f64>("a"), None);
        fs::write(kept.path("a", "json"), "0.").unwrap();
        assert_eq!(kept.once("a", || Ok(0.2)), Ok(0.2));
        assert_eq!(kept.known("a"), Some(0.2));
        fs::remove_dir_all(&folder).unwrap();
    }
}
