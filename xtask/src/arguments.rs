//! The words after a task's name.

use std::path::PathBuf;
use std::str::FromStr;

/// What was given of that which a task knows: flags as the usage shows them, `--write`, or with a word for their value, `--seed N`;
/// and one of several words, `000|001`.
#[derive(Debug)]
pub(crate) struct Arguments {
    known: &'static [&'static str],
    /// Flags, with their values; the value of a flag that takes none is empty.
    given: Vec<(String, String)>,
}

impl Arguments {
    /// The words given to `task`, which knows these flags.
    ///
    /// # Errors
    /// An unknown word, with the task's name and all that it knows; a value that is missing.
    pub(crate) fn read(
        task: &str,
        known: &'static [&'static str],
        words: &[String],
    ) -> Result<Self, String> {
        let mut given = Vec::new();
        let mut words = words.iter();
        while let Some(word) = words.next() {
            if let Some(choice) = (known.iter()).find(|known| is_choice(known, word)) {
                given.push(((*choice).to_owned(), word.clone()));
                continue;
            }
            let value = match known
                .iter()
                .map(|flag| parts(flag))
                .find(|(f, _)| f == word)
            {
                Some((_, None)) => String::new(),
                Some((flag, Some(what))) => (words.next())
                    .filter(|value| !value.starts_with("--"))
                    .ok_or_else(|| format!("cargo xtask {task}: {flag} needs a value, {what}"))?
                    .clone(),
                None if known.is_empty() => {
                    return Err(format!(
                        "cargo xtask {task} does not know {word}; it takes no arguments"
                    ));
                }
                None => {
                    return Err(format!(
                        "cargo xtask {task} does not know {word}; it knows {}",
                        known.join(", ")
                    ));
                }
            };
            given.push((word.clone(), value));
        }
        Ok(Self { known, given })
    }

    /// The value of a flag; the last one where it is given several times.
    fn value(&self, flag: &str) -> Option<&str> {
        debug_assert!(
            self.known.iter().any(|known| parts(known).0 == flag),
            "{flag} is asked for, but not among what the task knows"
        );
        let given = self.given.iter().rev().find(|(name, _)| name == flag);
        given.map(|(_, value)| value.as_str())
    }

    /// Whether a flag is given.
    pub(crate) fn has(&self, flag: &str) -> bool {
        self.value(flag).is_some()
    }

    /// A flag's value as it is.
    pub(crate) fn text(&self, flag: &str) -> Option<String> {
        self.value(flag).map(str::to_owned)
    }

    /// A flag's value as a path.
    pub(crate) fn path(&self, flag: &str) -> Option<PathBuf> {
        self.value(flag).map(PathBuf::from)
    }

    /// A flag's value as a whole number.
    pub(crate) fn whole<T: FromStr>(&self, flag: &str) -> Result<Option<T>, String> {
        let read = |value: &str| {
            let wrong = |_| format!("{flag} is {value}; it must be a whole number");
            value.parse().map_err(wrong)
        };
        self.value(flag).map(read).transpose()
    }
}

/// Whether a word is one of those between which there is a choice.
fn is_choice(known: &str, word: &str) -> bool {
    known.contains('|') && known.split('|').any(|one| one == word)
}

/// A flag, and the word for its value where it takes one.
fn parts(known: &'static str) -> (&'static str, Option<&'static str>) {
    match known.split_once(' ') {
        Some((flag, what)) => (flag, Some(what)),
        None => (known, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KNOWN: &[&str] = &["--write", "--seed N", "--program FILE"];

    fn read(line: &str) -> Result<Arguments, String> {
        let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
        Arguments::read("pack", KNOWN, &words)
    }

    #[test]
    fn what_is_given_comes_back() {
        let arguments = read("--seed 7 --write --program ./a --seed 8").unwrap();
        assert!(arguments.has("--write"));
        assert_eq!(arguments.whole::<u64>("--seed"), Ok(Some(8)));
        assert_eq!(arguments.path("--program"), Some(PathBuf::from("./a")));
        assert_eq!(arguments.text("--program").as_deref(), Some("./a"));
        let arguments = read("").unwrap();
        assert!(!arguments.has("--write"));
        assert_eq!(arguments.whole::<u64>("--seed"), Ok(None));
        assert_eq!(arguments.path("--program"), None);
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (line, message) in [
            (
                "--write --foo",
                "cargo xtask pack does not know --foo; it knows --write, --seed N, --program FILE",
            ),
            ("--seed", "cargo xtask pack: --seed needs a value, N"),
            (
                "--program --write",
                "cargo xtask pack: --program needs a value, FILE",
            ),
        ] {
            assert_eq!(read(line).unwrap_err(), message);
        }
        let wrong = read("--seed -1").unwrap().whole::<u64>("--seed");
        assert_eq!(
            wrong.unwrap_err(),
            "--seed is -1; it must be a whole number"
        );
    }

    #[test]
    #[should_panic(expected = "--only is asked for")]
    fn nobody_asks_for_what_is_not_known() {
        read("").unwrap().has("--only");
    }
}
