//! Text in DejaVu Sans: how wide it is, and its letters on a canvas with smooth rims.
//!
//! `cli/font/README.md` says which letters the shipped file has and by which command it was made.

use std::sync::LazyLock;

use ab_glyph_rasterizer::{Point, Rasterizer, point};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::canvas::Canvas;
use super::colour::Colour;

/// The family, for pictures whose letters the viewer draws; the others are for viewers that do not have it.
pub const FAMILY: &str = "'DejaVu Sans', Verdana, sans-serif";

/// The shipped part of the font.
const FILE: &[u8] = include_bytes!("../../font/DejaVuSans-subset.ttf");

/// Read once; the tests say that it can be.
static FACE: LazyLock<Option<Face<'static>>> = LazyLock::new(|| Face::parse(FILE, 0).ok());

/// Height of a capital letter, as a part of the letter size.
const CAPITAL: f64 = 0.729;

/// The baseline of a text of a size whose capitals and digits have their middle at `middle`; y points down.
pub(super) fn baseline(middle: f64, size: f64) -> f64 {
    middle + 0.5 * CAPITAL * size
}

/// The glyph of a letter; that of a box for letters that are not there.
fn glyph(face: &Face<'_>, letter: char) -> GlyphId {
    face.glyph_index(letter).unwrap_or(GlyphId(0))
}

/// Whether a letter is there.
#[cfg(test)]
pub(super) fn has(letter: char) -> bool {
    FACE.as_ref()
        .is_some_and(|face| face.glyph_index(letter).is_some())
}

/// Pixels per unit of the font.
fn scale(face: &Face<'_>, size: f64) -> f64 {
    size / f64::from(face.units_per_em())
}

/// How far a glyph takes the pen, in units of the font.
fn advance(face: &Face<'_>, glyph: GlyphId) -> f64 {
    f64::from(face.glyph_hor_advance(glyph).unwrap_or(0))
}

/// How wide a text comes out in letters of a size, pixels.
pub fn width(text: &str, size: f64) -> f64 {
    let Some(face) = &*FACE else { return 0.0 };
    let letters = text.chars().map(|letter| glyph(face, letter));
    scale(face, size) * letters.map(|glyph| advance(face, glyph)).sum::<f64>()
}

/// Writes a text that begins at `at` on its baseline.
pub(super) fn write(canvas: &mut Canvas, text: &str, at: [f64; 2], size: f64, colour: Colour) {
    let Some(face) = &*FACE else { return };
    let scale = scale(face, size);
    // Feet of letters stand on whole pixels, so that they are sharp.
    let baseline = at[1].round();
    let mut pen = at[0];
    for letter in text.chars() {
        let glyph = glyph(face, letter);
        Letter { face, glyph, scale }.paint(canvas, [pen, baseline], colour);
        pen += scale * advance(face, glyph);
    }
}

/// A glyph at a size.
struct Letter<'a> {
    face: &'a Face<'static>,
    glyph: GlyphId,
    /// Pixels per unit of the font.
    scale: f64,
}

impl Letter<'_> {
    /// Colours pixels by how much of them is in the letter; its pen begins at `at`.
    fn paint(&self, canvas: &mut Canvas, at: [f64; 2], colour: Colour) {
        // A blank has no box.
        let Some(bounds) = self.face.glyph_bounding_box(self.glyph) else {
            return;
        };
        let across = |x: i16| at[0] + self.scale * f64::from(x);
        let down = |y: i16| at[1] - self.scale * f64::from(y);
        let [left, top] = [across(bounds.x_min).floor(), down(bounds.y_max).floor()];
        let pixels = |from: f64, to: f64| (to.ceil() - from) as usize + 1;
        let mut outline = Outline {
            pixels: Rasterizer::new(
                pixels(left, across(bounds.x_max)),
                pixels(top, down(bounds.y_min)),
            ),
            origin: [(at[0] - left) as f32, (at[1] - top) as f32],
            scale: self.scale as f32,
            start: point(0.0, 0.0),
            pen: point(0.0, 0.0),
        };
        self.face.outline_glyph(self.glyph, &mut outline);
        outline.pixels.for_each_pixel_2d(|x, y, share| {
            let (x, y) = (left as i64 + i64::from(x), top as i64 + i64::from(y));
            canvas.blend(x, y, colour, f64::from(share));
        });
    }
}

/// An outline on its way from units of the font, y up, to pixels from a corner, y down.
struct Outline {
    pixels: Rasterizer,
    /// Where the font's origin is, pixels.
    origin: [f32; 2],
    /// Pixels per unit of the font.
    scale: f32,
    /// Where the loop began.
    start: Point,
    /// Where it is.
    pen: Point,
}

impl Outline {
    fn place(&self, x: f32, y: f32) -> Point {
        point(
            self.origin[0] + self.scale * x,
            self.origin[1] - self.scale * y,
        )
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.start = self.place(x, y);
        self.pen = self.start;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let end = self.place(x, y);
        self.pixels.draw_line(self.pen, end);
        self.pen = end;
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (middle, end) = (self.place(x1, y1), self.place(x, y));
        self.pixels.draw_quad(self.pen, middle, end);
        self.pen = end;
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (first, second) = (self.place(x1, y1), self.place(x2, y2));
        let end = self.place(x, y);
        self.pixels.draw_cubic(self.pen, first, second, end);
        self.pen = end;
    }

    fn close(&mut self) {
        self.pixels.draw_line(self.pen, self.start);
        self.pen = self.start;
    }
}
