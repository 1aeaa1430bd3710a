//! Units of a body's file, beside a scene in metres.

use std::ops::Range;
use std::str::FromStr;

use toml::Spanned;
use toml::de::DeValue;

use super::Scene;
use super::document::Document;
use super::nearest::advice;
use super::wrong::Wrong;

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LengthUnit {
    /// Its sign.
    pub(crate) name: &'static str,
    /// How many metres it has.
    pub(crate) metres: f64,
}

const UNITS: [LengthUnit; 7] = {
    const fn unit(name: &'static str, metres: f64) -> LengthUnit {
        LengthUnit { name, metres }
    }
    [
        unit("m", 1.0),
        unit("cm", 1e-2),
        unit("mm", 1e-3),
        unit("um", 1e-6),
        unit("in", 0.0254),
        unit("ft", 0.3048),
        unit("km", 1e3),
    ]
};

impl FromStr for LengthUnit {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        (UNITS.into_iter())
            .find(|unit| unit.name == name)
            .ok_or_else(|| {
                let known = UNITS.map(|unit| unit.name);
                format!("no unit is called \"{name}\"; {}", advice(name, &known))
            })
    }
}

impl LengthUnit {
    /// The signs of all.
    #[cfg(feature = "schema")]
    pub(super) fn names() -> [&'static str; 7] {
        UNITS.map(|unit| unit.name)
    }

    /// What is said where a body's file is in it.
    pub(crate) fn note(self, body: &str) -> String {
        format!(
            "body \"{body}\": its file in {} is read with scale = {}, into a scene in metres",
            self.name, self.metres
        )
    }
}

/// The bodies that are written with units, which are taken out: they are another word for the scale.
pub(super) fn taken(document: &mut Document<'_>) -> Result<Vec<(usize, LengthUnit)>, Wrong> {
    let mut found = Vec::new();
    let Some(DeValue::Array(bodies)) = document.table.get_mut("body").map(Spanned::get_mut) else {
        return Ok(found);
    };
    for (index, body) in bodies.iter_mut().enumerate() {
        let DeValue::Table(body) = body.get_mut() else {
            continue;
        };
        let Some((key, value)) = body.remove_entry("units") else {
            continue;
        };
        let wrong = |at: Range<usize>, message: String| Wrong {
            at: Some(at),
            message,
        };
        if body.contains_key("scale") {
            let message =
                "units and scale are both given, and units are a word for a scale; keep one";
            return Err(wrong(key.span(), message.into()));
        }
        let shape = body
            .get("shape")
            .and_then(|shape| shape.get_ref().as_table());
        if shape.is_some_and(|shape| !shape.contains_key("file")) {
            let message = "units are those of a body's file; a shape's measures are in the scene's units: leave units out, or write scale = …";
            return Err(wrong(key.span(), message.into()));
        }
        let unit = match value.get_ref() {
            DeValue::String(name) => name.parse(),
            _ => Err("units are text, in quotes, such as units = \"mm\"".into()),
        };
        found.push((index, unit.map_err(|message| wrong(value.span(), message))?));
    }
    Ok(found)
}

/// Scales bodies by the units of their files, and says so.
pub(super) fn settle(units: Vec<(usize, LengthUnit)>, scene: &mut Scene) {
    for (index, unit) in units {
        if let Some(body) = scene.body.get_mut(index) {
            body.scale = unit.metres;
            scene.notes.push(unit.note(&body.name));
        }
    }
}
