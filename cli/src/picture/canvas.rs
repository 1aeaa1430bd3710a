//! Pixels, and smooth discs and lines on them.

use super::colour::{Colour, WHITE, mixed};

/// A picture in pixels; y points down.
#[derive(Debug, Clone)]
pub(crate) struct Canvas {
    /// Pixels across.
    pub(crate) width: usize,
    /// Pixels down.
    pub(crate) height: usize,
    /// Row after row.
    pub(crate) pixels: Vec<Colour>,
}

impl Canvas {
    /// A white one.
    pub(crate) fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            pixels: vec![WHITE; width * height],
        }
    }

    /// Covers a share of a pixel.
    pub(crate) fn blend(&mut self, x: i64, y: i64, colour: Colour, share: f64) {
        if share <= 0.0 || x < 0 || y < 0 || x >= self.width as i64 || y >= self.height as i64 {
            return;
        }
        let pixel = &mut self.pixels[y as usize * self.width + x as usize];
        *pixel = mixed(*pixel, colour, share.min(1.0));
    }

    /// Pixels from `low` to `high` that are on the canvas.
    fn span(low: f64, high: f64, size: usize) -> std::ops::Range<i64> {
        let clamp = |v: f64| v.clamp(0.0, size as f64) as i64;
        clamp(low.floor())..clamp(high.ceil())
    }

    /// Colours every pixel near a box by how much of it `coverage` (at the pixel's middle) says.
    fn shade(
        &mut self,
        [left, top, right, bottom]: [f64; 4],
        colour: Colour,
        coverage: impl Fn(f64, f64) -> f64,
    ) {
        for y in Self::span(top, bottom, self.height) {
            for x in Self::span(left, right, self.width) {
                self.blend(x, y, colour, coverage(x as f64 + 0.5, y as f64 + 0.5));
            }
        }
    }

    /// A filled disc.
    pub(crate) fn disc(&mut self, [cx, cy]: [f64; 2], radius: f64, colour: Colour) {
        let reach = radius + 1.0;
        // A disc smaller than a pixel covers a part of it.
        let strength = (radius / 0.5).min(1.0).powi(2);
        let radius = radius.max(0.5);
        self.shade(
            [cx - reach, cy - reach, cx + reach, cy + reach],
            colour,
            |x, y| strength * (radius + 0.5 - (x - cx).hypot(y - cy)).clamp(0.0, 1.0),
        );
    }

    /// A straight line with round ends.
    pub(crate) fn line(&mut self, a: [f64; 2], b: [f64; 2], width: f64, colour: Colour) {
        let reach = 0.5 * width + 1.0;
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let length_squared = dx * dx + dy * dy;
        self.shade(
            [
                a[0].min(b[0]) - reach,
                a[1].min(b[1]) - reach,
                a[0].max(b[0]) + reach,
                a[1].max(b[1]) + reach,
            ],
            colour,
            |x, y| {
                let along = if length_squared > 0.0 {
                    (((x - a[0]) * dx + (y - a[1]) * dy) / length_squared).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let distance = (x - a[0] - along * dx).hypot(y - a[1] - along * dy);
                (0.5 * width + 0.5 - distance).clamp(0.0, 1.0)
            },
        );
    }

    /// A filled rectangle with whole pixels.
    pub(crate) fn rectangle(
        &mut self,
        [left, top]: [f64; 2],
        [right, bottom]: [f64; 2],
        colour: Colour,
    ) {
        self.shade(
            [left.round(), top.round(), right.round(), bottom.round()],
            colour,
            |_, _| 1.0,
        );
    }

    /// Lays `other` on top, its upper left corner at (`x`, `y`).
    pub(crate) fn paste(&mut self, other: &Self, x: usize, y: usize) {
        for (row, line) in other.pixels.chunks(other.width.max(1)).enumerate() {
            for (column, &pixel) in line.iter().enumerate() {
                self.blend((x + column) as i64, (y + row) as i64, pixel, 1.0);
            }
        }
    }

    /// Half as large, four pixels made one.
    pub(crate) fn halved(&self) -> Self {
        let mut small = Self::new(self.width / 2, self.height / 2);
        for y in 0..small.height {
            for x in 0..small.width {
                let mut sum = [0_u32; 3];
                for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let pixel = self.pixels[(2 * y + dy) * self.width + 2 * x + dx];
                    for k in 0..3 {
                        sum[k] += u32::from(pixel[k]);
                    }
                }
                small.pixels[y * small.width + x] = sum.map(|s| ((s + 2) / 4) as u8);
            }
        }
        small
    }
}
