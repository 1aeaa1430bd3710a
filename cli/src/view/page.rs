//! The page: what shows particles, and the particles.

use std::io::{self, Write};

use serde_json::{Value, json};

use super::View;
use super::base64::Base64;
use crate::picture::{Colour, GREY, Scale, diverging, sequential};

const HEAD: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");

/// Scripts by the names by which they import each other, whoever is imported first.
const SCRIPTS: [(&str, &str); 12] = [
    (
        "./three.core.min.js",
        include_str!("../../three/three.core.min.js"),
    ),
    ("three", include_str!("../../three/three.module.min.js")),
    (
        "OrbitControls",
        include_str!("../../three/OrbitControls.js"),
    ),
    ("./rows.js", include_str!("page/rows.js")),
    ("./colours.js", include_str!("page/colours.js")),
    ("./cut.js", include_str!("page/cut.js")),
    ("./pace.js", include_str!("page/pace.js")),
    ("./stage.js", include_str!("page/stage.js")),
    ("./pick.js", include_str!("page/pick.js")),
    ("./axes.js", include_str!("page/axes.js")),
    ("./panel.js", include_str!("page/panel.js")),
    ("./main.js", include_str!("page/main.js")),
];

/// Makes modules of the scripts, one after the other.
const LOADER: &str = include_str!("page/loader.js");

/// The licence of three.js, which goes where it goes.
const THREE_LICENCE: &str = include_str!("../../three/LICENSE");

/// Colours of words, told apart also by who does not see red or green (Okabe and Ito's palette).
const OF_WORDS: [Colour; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [240, 228, 66],
];

/// Steps of a colour scale: with the grey of what is no number, as many as a byte tells apart.
const STEPS: usize = 255;

impl View {
    /// Writes the page. It needs nothing beside itself, and cannot ask for anything.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        let (before, after) = HEAD.split_once("<!-- particles -->").unwrap_or((HEAD, ""));
        let before = before.replace("<!-- title -->", &escaped(&self.name));
        let before = before.replace("/* style */", STYLE);
        to.write_all(before.as_bytes())?;
        writeln!(
            to,
            "<!-- three.js:\n{}-->",
            THREE_LICENCE.replace("--", "- -")
        )?;
        // Nothing in it ends the element.
        let about = self.about().to_string().replace('<', "\\u003c");
        writeln!(
            to,
            "<script type=\"application/json\" id=\"about\">{about}</script>"
        )?;
        let middle = self.middle();
        block(to, "position", |base64| {
            for place in &self.position {
                for k in 0..self.dimension {
                    base64.put(&((place[k] - middle[k]) as f32).to_le_bytes())?;
                }
            }
            Ok(())
        })?;
        block(to, "diameter", |base64| self.size.diameter.write(base64))?;
        for (number, column) in self.columns.iter().enumerate() {
            block(to, &format!("column-{number}"), |base64| {
                column.write(base64)
            })?;
        }
        for (name, script) in SCRIPTS {
            writeln!(
                to,
                "<script type=\"text/plain\" class=\"module\" data-name=\"{name}\">\n{script}</script>"
            )?;
        }
        writeln!(to, "<script>\n{LOADER}</script>")?;
        to.write_all(after.as_bytes())
    }

    /// All but the rows.
    fn about(&self) -> Value {
        let hue = |colour: Colour| colour.map(|part| format!("{part:02x}")).concat();
        let step = |k: usize| k as f64 / (STEPS - 1) as f64;
        let columns = self.columns.iter().map(|column| {
            let mut column = json!(column);
            // About 1, as in pictures.
            if let (Some("gamma"), Some(range)) =
                (column["name"].as_str(), column["range"].as_array())
            {
                let off = range
                    .iter()
                    .filter_map(Value::as_f64)
                    .map(|gamma| (gamma - 1.0).abs());
                let half = Scale::holding(off.fold(0.0, f64::max)).half;
                column["diverging"] = json!([1.0 - half, 1.0 + half]);
            }
            column
        });
        json!({
            "name": self.name,
            "version": env!("CARGO_PKG_VERSION"),
            "rows": self.len(),
            "dimension": self.dimension,
            "middle": self.middle(),
            "min": self.bounds.min,
            "max": self.bounds.max,
            "diameter": self.size.diameter,
            "diameter_is": self.size.words,
            "spacing": self.size.typical,
            "columns": columns.collect::<Vec<Value>>(),
            "colour": self.colour,
            "colours": {
                "none": hue(GREY),
                "words": OF_WORDS.map(hue),
                "sequential": (0..STEPS).map(|k| hue(sequential(step(k)))).collect::<Vec<String>>(),
                "diverging": (0..STEPS).map(|k| hue(diverging(2.0 * step(k) - 1.0))).collect::<Vec<String>>(),
            },
        })
    }
}

/// An element of bytes.
fn block(
    to: &mut dyn Write,
    id: &str,
    content: impl FnOnce(&mut Base64<'_>) -> io::Result<()>,
) -> io::Result<()> {
    write!(to, "<script type=\"text/plain\" id=\"{id}\">")?;
    let mut base64 = Base64::new(&mut *to);
    content(&mut base64)?;
    base64.end()?;
    writeln!(to, "</script>")
}

/// A text within an element.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
