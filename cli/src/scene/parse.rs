//! From text to a scene, with the line and column of whatever is wrong.

use std::io::Read;
use std::path::Path;

use toml::de::DeValue;

use super::check::{MAX_BODIES, too_many_bodies};
use super::document::Document;
use super::explain::typed;
use super::fault::{Fault, Key};
use super::wrong::{Wrong, line_and_column};
use super::{Given, Scene, length_unit, solver_words, tables};
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
                "this is not text; a scene is a TOML file (see `sphpack init`), or JSON",
            )
        })?;
        Self::parse(&text, path)
    }

    /// Reads and checks a scene that comes from elsewhere, which is called `name` in messages. Its paths are relative to the working
    /// directory.
    pub(crate) fn read_from(from: impl Read, name: &str) -> Result<Self, Error> {
        let path = Path::new(name);
        let mut text = String::new();
        let read = from.take(MAX_BYTES + 1).read_to_string(&mut text);
        read.map_err(|e| Error::input(path, format!("cannot be read as text ({e})")))?;
        if text.len() as u64 > MAX_BYTES {
            let message = "this is too large for a scene; keep long outlines in files of their own";
            return Err(Error::input(path, message));
        }
        if text.trim().is_empty() {
            let message =
                "there is no scene; write one to it, as in: sphpack pack - -o OUT.vtu < scene.toml";
            return Err(Error::input(path, message));
        }
        let mut scene = Self::parse(&text, path)?;
        scene.name = "scene".into();
        Ok(scene)
    }

    /// A scene from its text, TOML or JSON; `path` is for messages, and other paths are relative to its folder.
    ///
    /// # Errors
    /// [`Error::Scene`] with line and column.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let fail = |Wrong { at, message }| Error::Scene {
            path: path.to_owned(),
            at: at.map(|span| line_and_column(text, span.start)),
            message,
        };
        let mut scene = read(text, is_json(text, path)).map_err(fail)?;
        scene.path = path.to_owned();
        scene.name = path.file_stem().map_or_else(
            || "scene".to_owned(),
            |stem| stem.to_string_lossy().into_owned(),
        );
        match scene.check() {
            Ok(()) => Ok(scene),
            Err(Fault { keys, message }) => {
                let mut document = document(text, is_json(text, path)).map_err(fail)?;
                // Values stand by a scene's own keys then, and are found by them.
                solver_words::translate(&mut document).map_err(fail)?;
                let at = document.locate(&keys);
                let read = (keys.last() == Some(&Key::Name("h_over_spacing")))
                    .then(|| scene.notes.join("; "))
                    .filter(|notes| !notes.is_empty());
                let message = match read {
                    Some(notes) => format!("{message}; {notes}"),
                    None => message,
                };
                Err(fail(Wrong { at, message }))
            }
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

/// Whether a scene is JSON: by its content, or where that is neither, by its name.
fn is_json(text: &str, path: &Path) -> bool {
    let is_named = (path.extension()).is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
    is_named || text.trim_start().starts_with('{')
}

/// The values of a text, where tables are tables.
fn document(text: &str, is_json: bool) -> Result<Document<'_>, Wrong> {
    let document = Document::read(text, is_json)?;
    tables::check(&document, text)?;
    Ok(document)
}

/// A scene as it is written.
fn read(text: &str, is_json: bool) -> Result<Scene, Wrong> {
    let many = |number: usize| {
        Err(Wrong {
            at: None,
            message: too_many_bodies(number),
        })
    };
    // A parser would be at work on a million of them for long.
    let heads = text
        .match_indices("[[body]]")
        .filter(|(at, _)| is_first_in_line(text, *at));
    let number = heads.count();
    if number > MAX_BODIES {
        return many(number);
    }
    let mut written = document(text, is_json)?;
    if let Some(DeValue::Array(bodies)) = written.table.get("body").map(|body| body.get_ref())
        && bodies.len() > MAX_BODIES
    {
        return many(bodies.len());
    }
    let words = solver_words::translate(&mut written)?;
    let units = length_unit::taken(&mut written)?;
    let given = Given::new(written.keys_of("packing"));
    let mut scene = match written.scene() {
        Ok(scene) => scene,
        Err(error) => {
            let at = error.span();
            let byte = at.as_ref().map(|at| at.start);
            let message = typed(error.message(), text, &document(text, is_json)?, byte);
            return Err(Wrong { at, message });
        }
    };
    scene.name_bodies();
    scene.packing.given = given;
    words.settle(&mut scene);
    length_unit::settle(units, &mut scene);
    Ok(scene)
}

/// Whether nothing but space is before a byte in its line.
fn is_first_in_line(text: &str, byte: usize) -> bool {
    let before = text[..byte].trim_end_matches([' ', '\t']);
    before.is_empty() || before.ends_with('\n')
}
