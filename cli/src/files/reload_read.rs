//! Reading the particles that SPHinXsys reloads.

use std::path::Path;

use super::Columns;
use super::reload::FLUID;
use super::vtk_xml::unescaped;
use super::xml_tag::Tag;
use crate::Error;

/// Reads particles of either kind of file: `x`, `y`, `z` where they are in space, and `volume`; of `Reload.xml` the `body` too, empty for the
/// fluid.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, or no such one.
pub fn read_reload(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    read(bytes).map_err(|message| Error::input(path, message))
}

fn damaged(what: &str) -> String {
    format!("the XML file is damaged: {what}; write it again")
}

fn read(bytes: &[u8]) -> Result<Columns, String> {
    let mut text = std::str::from_utf8(bytes).map_err(|_| "this is not text, as XML is")?;
    let mut root = None;
    let mut is_whole = false;
    let mut body: Option<String> = None;
    let mut position: [Vec<f64>; 3] = Default::default();
    let mut volume = Vec::new();
    let mut bodies = Vec::new();
    while let Some(tag) = Tag::next(text) {
        text = tag.rest;
        match (root, tag.name) {
            (None, "reload_data" | "particles") => root = Some(tag.name),
            (Some(_), "/reload_data" | "/particles") => is_whole = true,
            (Some("reload_data"), "body") => {
                let name = unescaped(tag.get("name"));
                body = Some(if name == FLUID { String::new() } else { name });
            }
            (Some(_), "/body") => body = None,
            (Some(root), "particle") => {
                let mut axes = 0;
                for word in tag.get("Position").split(',') {
                    let column = position
                        .get_mut(axes)
                        .ok_or_else(|| damaged("a position has more than three numbers"))?;
                    column.push(number("Position", word)?);
                    axes += 1;
                }
                if axes < 2 || position[axes - 1].len() != volume.len() + 1 {
                    return Err(damaged("positions have different numbers of axes"));
                }
                volume.push(number("VolumetricMeasure", tag.get("VolumetricMeasure"))?);
                if root == "reload_data" {
                    let name = body.as_ref();
                    bodies.push(
                        name.ok_or_else(|| damaged("a particle is in no body"))?
                            .clone(),
                    );
                }
            }
            _ => {}
        }
    }
    let Some(root) = root else {
        return Err(
            "this is no file of particles that SPHinXsys reloads; one has a root reload_data or particles"
                .into(),
        );
    };
    if !is_whole {
        return Err(damaged("it is cut off"));
    }
    let [x, y, z] = position;
    let mut columns = Columns::default();
    let is_flat = z.is_empty() && !x.is_empty();
    if !is_flat && z.len() != x.len() {
        return Err(damaged("positions have different numbers of axes"));
    }
    columns.numbers.insert("x".to_owned(), x);
    columns.numbers.insert("y".to_owned(), y);
    if !is_flat {
        columns.numbers.insert("z".to_owned(), z);
    }
    columns.numbers.insert("volume".to_owned(), volume);
    if root == "reload_data" {
        columns.words.insert("body".to_owned(), bodies);
    }
    Ok(columns)
}

fn number(name: &str, word: &str) -> Result<f64, String> {
    let number: Option<f64> = word.trim().parse().ok();
    number.filter(|number| number.is_finite()).ok_or_else(|| {
        let shown: String = word.chars().take(40).collect();
        damaged(&format!(
            "{name} has \"{shown}\", which is no finite number"
        ))
    })
}
