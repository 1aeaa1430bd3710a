//! Letters of eight by eight dots.

use font8x8::legacy::{BASIC_LEGACY, GREEK_LEGACY, LATIN_LEGACY};

use super::canvas::Canvas;
use super::colour::Colour;

/// Dots across and down.
const DOTS: usize = 8;

/// The dots of a letter, row by row, the leftmost in the lowest bit; a box for letters that are not there.
fn dots(letter: char) -> [u8; 8] {
    const UNKNOWN: [u8; 8] = [0x7e, 0x42, 0x42, 0x42, 0x42, 0x42, 0x7e, 0];
    // Signs that look like a letter which is there.
    let letter = match letter {
        '∆' => 'Δ',
        '−' | '–' => '-',
        '…' => return [0, 0, 0, 0, 0, 0xdb, 0xdb, 0],
        // Without the gap that makes it look like ¦.
        '|' => return [0x18; 8],
        other => other,
    };
    let code = letter as usize;
    match code {
        0..0x80 => BASIC_LEGACY[code],
        0xa0..0x100 => LATIN_LEGACY[code - 0xa0],
        0x390..0x3ca => GREEK_LEGACY[code - 0x390],
        _ => UNKNOWN,
    }
}

/// Dots of one pixel count for letters of a height in pixels.
fn dot_size(height: f64) -> usize {
    ((height / DOTS as f64).round() as usize).max(1)
}

/// How wide a text comes out, pixels.
pub(super) fn width(text: &str, height: f64) -> f64 {
    (text.chars().count() * DOTS * dot_size(height)) as f64
}

/// Writes a text, its upper left corner at `at`.
pub(super) fn write(canvas: &mut Canvas, text: &str, at: [f64; 2], height: f64, colour: Colour) {
    let size = dot_size(height);
    for (place, letter) in text.chars().enumerate() {
        let left = at[0].round() as i64 + (place * DOTS * size) as i64;
        for (row, bits) in dots(letter).into_iter().enumerate() {
            for column in (0..DOTS).filter(|column| bits >> column & 1 == 1) {
                for dy in 0..size {
                    for dx in 0..size {
                        let x = left + (column * size + dx) as i64;
                        let y = at[1].round() as i64 + (row * size + dy) as i64;
                        canvas.blend(x, y, colour, 1.0);
                    }
                }
            }
        }
    }
}
