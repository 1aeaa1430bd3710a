//! Pictures of packings: particles coloured by their density Γ.
//!
//! Plane scenes are drawn as SVG or PNG, scenes in space as PNG: a slice, and the surface particles seen from outside.

mod canvas;
mod colour;
mod font;
mod marks;
mod palette;
mod plane;
mod png;
mod slice;
mod spheres;
mod svg;
#[cfg(test)]
mod tests;

pub(crate) use colour::{Colour, GREY, Scale, diverging, sequential};
pub use font::{FAMILY as FONT_FAMILY, width as text_width};
pub use png::write as write_png;

use std::io::{self, Write};
use std::path::Path;

use crate::Error;
use crate::scene::advice;
use crate::table::Table;

/// What is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// The particles.
    pub table: &'a Table,
    /// In 2-D, the true bodies as closed loops.
    pub loops: &'a [Vec<[f64; 2]>],
    /// The domain's corners, scene units.
    pub domain: [[f64; 3]; 2],
    /// ∆s, scene units.
    pub spacing: f64,
    /// Whether the packing was stopped before its tolerance was reached.
    pub is_unfinished: bool,
}

/// A format of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureFormat {
    /// Pixels.
    Png,
    /// Lines and discs; 2-D only.
    Svg,
}

impl PictureFormat {
    /// The format that a path's ending names, for a scene of a dimension (`None`: not known yet).
    ///
    /// # Errors
    /// [`Error::Input`] with the known endings, or for an SVG of a scene in space.
    pub fn of(path: &Path, dimension: Option<usize>) -> Result<Self, Error> {
        let ending = path
            .extension()
            .map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
        match ending.as_str() {
            "png" => Ok(Self::Png),
            "svg" if dimension == Some(3) => Err(Error::input(
                path,
                "a scene in space is not drawn as SVG; name the picture .png",
            )),
            "svg" => Ok(Self::Svg),
            _ => Err(Error::input(
                path,
                format!(
                    "pictures cannot be written as \"{ending}\"; {}",
                    advice(&ending, &["png", "svg"])
                ),
            )),
        }
    }
}

/// Draws a packing.
///
/// # Errors
/// Those of `to`.
pub fn draw(subject: &Subject<'_>, format: PictureFormat, to: &mut dyn Write) -> io::Result<()> {
    match format {
        PictureFormat::Svg => svg::write(&plane::sheet(subject), to),
        PictureFormat::Png => {
            let canvas = painted(subject);
            png::write(canvas.width as u32, &canvas.pixels, to)
        }
    }
}

/// A packing in pixels.
fn painted(subject: &Subject<'_>) -> canvas::Canvas {
    match subject.table.dimension {
        2 => marks::painted(&plane::sheet(subject)),
        _ => spheres::painted(subject),
    }
}

/// A number with thousands set apart.
pub(crate) fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}
