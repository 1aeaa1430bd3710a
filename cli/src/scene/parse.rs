//! From text to a scene, with the line and column of whatever is wrong.

use std::ops::Range;
use std::path::Path;

use toml::de::{DeTable, DeValue};

use super::check::{MAX_BODIES, too_many_bodies};
use super::fault::{Fault, Key};
use super::nearest::advice;
use super::{Given, Scene};
use crate::Error;

/// The largest scene, bytes; one of a person has some thousand.
const MAX_BYTES: u64 = 8 << 20;

impl Scene {
    /// Reads and checks a scene file.
    ///
    /// # Errors
    /// [`Error::Input`] where the file cannot be read, [`Error::Scene`] with line and column where its content is
    /// wrong.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let bytes = crate::files::read_up_to(
            path,
            MAX_BYTES,
            "a scene; keep long outlines in files of their own",
        )?;
        let text = String::from_utf8(bytes).map_err(|_| {
            Error::input(
                path,
                "this is not text; a scene is a TOML file (see `sphpack init`)",
            )
        })?;
        Self::parse(&text, path)
    }

    /// A scene from its text; `path` is for messages, and other paths are relative to its folder.
    ///
    /// # Errors
    /// [`Error::Scene`] with line and column.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let fail = |span: Option<Range<usize>>, message: String| Error::Scene {
            path: path.to_owned(),
            at: span.map(|span| line_and_column(text, span.start)),
            message,
        };
        // A parser would be at work on a million of them for long.
        let heads = text
            .match_indices("[[body]]")
            .filter(|(at, _)| is_first_in_line(text, *at));
        let number = heads.count();
        if number > MAX_BODIES {
            return Err(fail(None, too_many_bodies(number)));
        }
        let mut scene: Self =
            toml::from_str(text).map_err(|e| fail(e.span(), explain(e.message())))?;
        scene.path = path.to_owned();
        scene.name = path.file_stem().map_or_else(
            || "scene".to_owned(),
            |stem| stem.to_string_lossy().into_owned(),
        );
        scene.name_bodies();
        scene.packing.given = Given::new(packing_keys(text));
        match scene.check() {
            Ok(()) => Ok(scene),
            Err(Fault { keys, message }) => Err(fail(locate(text, &keys), message)),
        }
    }

    fn name_bodies(&mut self) {
        for (number, body) in self.body.iter_mut().enumerate() {
            if body.name.is_empty() {
                body.name = match number {
                    0 => "body".to_owned(),
                    _ => format!("body {}", number + 1),
                };
            }
        }
    }
}

/// The keys in `[packing]`.
fn packing_keys(text: &str) -> Vec<String> {
    let table = DeTable::parse(text).ok();
    let packing = (table.as_ref()).and_then(|table| table.get_ref().get("packing"));
    match packing.map(|packing| packing.get_ref()) {
        Some(DeValue::Table(keys)) => keys.keys().map(|key| key.get_ref().to_string()).collect(),
        _ => Vec::new(),
    }
}

/// Whether nothing but space is before a byte in its line.
fn is_first_in_line(text: &str, byte: usize) -> bool {
    let before = text[..byte].trim_end_matches([' ', '\t']);
    before.is_empty() || before.ends_with('\n')
}

/// Line and column, counted from 1, of a byte.
fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |end| end + 1);
    (
        before.matches('\n').count() + 1,
        before[line_start..].chars().count() + 1,
    )
}

/// Where a value stands; the innermost of its keys that can be found.
fn locate(text: &str, keys: &[Key]) -> Option<Range<usize>> {
    let table = DeTable::parse(text).ok()?;
    let mut place = None;
    let mut here: Option<&DeValue<'_>> = None;
    for key in keys {
        let found = match (key, here) {
            (Key::Name(name), None) => table.get_ref().get(*name),
            (Key::Name(name), Some(DeValue::Table(inner))) => inner.get(*name),
            (Key::Index(index), Some(DeValue::Array(inner))) => inner.get(*index),
            _ => None,
        };
        let Some(value) = found else { break };
        place = Some(value.span());
        here = Some(value.get_ref());
    }
    place
}

/// A parser's message with the nearest known name in place of a bare list.
fn explain(message: &str) -> String {
    let message = message.trim().replace('\n', "; ");
    if let Some((unknown, known)) = message
        .strip_prefix("unexpected keys in table: ")
        .and_then(|rest| rest.split_once(", available keys: "))
    {
        let known: Vec<&str> = known.split(", ").collect();
        let first = unknown.split(", ").next().unwrap_or(unknown);
        return format!("unknown key \"{first}\"; {}", advice(first, &known));
    }
    if ["recursion limit", "recursion depth"]
        .iter()
        .any(|words| message.contains(words))
    {
        return "values lie within one another deeper than any scene needs; remove brackets".into();
    }
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    if let [unknown, known @ ..] = quoted.as_slice() {
        for (start, what) in [
            ("unknown field", "unknown key"),
            ("unknown variant", "unknown name"),
        ] {
            if message.starts_with(start) {
                if known.is_empty() {
                    return format!("{what} \"{unknown}\"; remove it");
                }
                return format!("{what} \"{unknown}\"; {}", advice(unknown, known));
            }
        }
        if message.starts_with("missing field") {
            return format!(
                "the key \"{unknown}\" is missing; add it (`sphpack init` shows a whole scene)"
            );
        }
    }
    message
}
