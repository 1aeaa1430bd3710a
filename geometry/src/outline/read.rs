//! Outlines from text files.

use std::path::Path;

use super::Outline;
use crate::GeometryError;

impl Outline {
    /// Reads an outline from rows of "x,y" (or "x y", "x;y"). `#` starts a comment; a header or title is allowed
    /// before the first point; a blank line ends a loop. Airfoil coordinate files are read too, if they go round the
    /// outline in one run.
    ///
    /// # Errors
    /// [`GeometryError::InFile`] with the file's name around [`GeometryError::Unreadable`],
    /// [`GeometryError::BadRow`] with the line, or what [`Outline::new`] finds.
    pub fn from_csv(path: impl AsRef<Path>) -> Result<Self, GeometryError> {
        let path = path.as_ref();
        let read = || {
            let bytes = std::fs::read(path).map_err(|e| GeometryError::Unreadable {
                reason: e.to_string(),
            })?;
            let text = String::from_utf8(bytes).map_err(|_| GeometryError::BadRow {
                line: 1,
                reason: "this is not text; export the outline as rows of \"x,y\"".into(),
            })?;
            Self::from_text(&text)
        };
        read().map_err(|e| e.in_file(path))
    }

    /// [`Outline::from_csv`] for text that is already in memory.
    ///
    /// # Errors
    /// As [`Outline::from_csv`], without a file's name.
    pub fn from_text(text: &str) -> Result<Self, GeometryError> {
        let mut loops: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
        let mut header_allowed = true;
        for (index, row) in text.trim_start_matches('\u{feff}').lines().enumerate() {
            let content = row.split('#').next().unwrap_or("").trim();
            if content.is_empty() {
                // A comment alone does not end a loop.
                if row.trim().is_empty() && loops.last().is_some_and(|l| !l.is_empty()) {
                    loops.push(Vec::new());
                }
                continue;
            }
            match parse(content) {
                Ok(p) => {
                    header_allowed = false;
                    if let Some(last) = loops.last_mut() {
                        last.push(p);
                    }
                }
                Err(_) if header_allowed => header_allowed = false,
                Err(reason) => {
                    return Err(GeometryError::BadRow {
                        line: index + 1,
                        reason,
                    });
                }
            }
        }
        loops.retain(|l| !l.is_empty());
        Self::new(loops)
    }
}

/// Two finite numbers.
fn parse(content: &str) -> Result<[f64; 2], String> {
    let shown: String = content.chars().take(60).collect();
    let fields: Vec<&str> = content
        .split(|c: char| c == ',' || c == ';' || c.is_whitespace())
        .filter(|f| !f.is_empty())
        .collect();
    let &[x, y] = fields.as_slice() else {
        return Err(format!(
            "\"{shown}\" has {} fields; a row is two numbers, \"x,y\"",
            fields.len()
        ));
    };
    let number = |s: &str| match s.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!(
            "\"{shown}\" is not two finite numbers; write \"x,y\" with decimal points"
        )),
    };
    Ok([number(x)?, number(y)?])
}
