//! What is seen in a picture of a page, told from its pixels.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// How far a colour's channels may be off.
const NEAR: i32 = 2;

/// How far the direction of a colour from black may be off, as a cosine.
const SAME_HUE: f64 = 0.985;

/// What is darker, or greyer, has no hue to go by.
const LEAST_LIGHT: f64 = 60.0;

/// A picture's pixels.
pub(super) struct Picture {
    width: usize,
    pixels: Vec<[u8; 3]>,
}

/// Where in a picture a colour is.
#[derive(Debug)]
pub(super) struct Spot {
    pub(super) pixels: usize,
    /// Mean place, from the left and from the top.
    pub(super) middle: [f64; 2],
    pub(super) left: usize,
    pub(super) right: usize,
    pub(super) top: usize,
    pub(super) bottom: usize,
}

impl Spot {
    /// Where the middle is in a drawing that begins with one colour on the left and ends with another on the right; to the right and
    /// up, from 0 to 1.
    pub(super) fn middle_within(&self, [first, last]: [&Self; 2]) -> [f64; 2] {
        let (left, right) = (first.left as f64, last.right as f64);
        let top = first.top.min(last.top) as f64;
        let bottom = first.bottom.max(last.bottom) as f64;
        [
            (self.middle[0] - left) / (right - left),
            (bottom - self.middle[1]) / (bottom - top),
        ]
    }
}

impl Picture {
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let file = File::open(path).map_err(|error| fail(&error))?;
        let mut reader =
            (png::Decoder::new(BufReader::new(file)).read_info()).map_err(|error| fail(&error))?;
        let size = reader
            .output_buffer_size()
            .ok_or_else(|| fail(&"too large"))?;
        let mut bytes = vec![0; size];
        let frame = reader
            .next_frame(&mut bytes)
            .map_err(|error| fail(&error))?;
        let channels = frame.color_type.samples();
        if channels < 3 || frame.bit_depth != png::BitDepth::Eight {
            return Err(fail(&"a picture in other colours than a browser's"));
        }
        let pixels = bytes[..frame.buffer_size()].chunks_exact(channels);
        Ok(Self {
            width: frame.width as usize,
            pixels: pixels.map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect(),
        })
    }

    /// Where a colour is, as far as the drawing goes.
    pub(super) fn of_colour(&self, colour: [u8; 3]) -> Spot {
        let is_near = |pixel: [u8; 3]| {
            (0..3).all(|k| (i32::from(pixel[k]) - i32::from(colour[k])).abs() <= NEAR)
        };
        self.spot(is_near)
    }

    /// Where a colour is, in any light.
    pub(super) fn of_hue(&self, colour: [u8; 3]) -> Spot {
        let length = |c: [f64; 3]| c.iter().map(|x| x * x).sum::<f64>().sqrt();
        let wanted = colour.map(f64::from);
        self.spot(|pixel| {
            let own = pixel.map(f64::from);
            let size = length(own);
            let dot: f64 = (0..3).map(|k| own[k] * wanted[k]).sum();
            size > LEAST_LIGHT && dot > SAME_HUE * size * length(wanted)
        })
    }

    fn spot(&self, is_of: impl Fn([u8; 3]) -> bool) -> Spot {
        let mut spot = Spot {
            pixels: 0,
            middle: [0.0; 2],
            left: usize::MAX,
            right: 0,
            top: usize::MAX,
            bottom: 0,
        };
        for (place, &pixel) in self.pixels.iter().enumerate() {
            let (x, y) = (place % self.width, place / self.width);
            // Beside the drawing is the panel, with a legend in the same colours.
            if x + PANEL >= self.width || !is_of(pixel) {
                continue;
            }
            spot.pixels += 1;
            spot.middle[0] += x as f64;
            spot.middle[1] += y as f64;
            spot.left = spot.left.min(x);
            spot.right = spot.right.max(x);
            spot.top = spot.top.min(y);
            spot.bottom = spot.bottom.max(y);
        }
        let count = spot.pixels.max(1) as f64;
        spot.middle = spot.middle.map(|sum| sum / count);
        spot
    }
}

/// Width of the panel with the line beside it, pixels.
const PANEL: usize = 274;

#[cfg(test)]
mod tests {
    use super::*;

    /// White, with a block of a colour.
    fn block([left, top, right, bottom]: [usize; 4], colour: [u8; 3]) -> Picture {
        let width = 400;
        let mut pixels = vec![[255; 3]; width * 100];
        for y in top..bottom {
            pixels[y * width + left..y * width + right].fill(colour);
        }
        Picture { width, pixels }
    }

    #[test]
    fn a_colour_is_found_where_it_is() {
        let picture = block([10, 20, 30, 60], [0, 65, 154]);
        let spot = picture.of_colour([0, 65, 154]);
        assert_eq!((spot.pixels, spot.middle), (800, [19.5, 39.5]));
        assert_eq!(
            (spot.left, spot.right, spot.top, spot.bottom),
            (10, 29, 20, 59)
        );
        assert_eq!(picture.of_colour([151, 13, 20]).pixels, 0);
        // The legend is none of the drawing.
        assert_eq!(
            block([200, 0, 300, 100], [0, 65, 154])
                .of_colour([0, 65, 154])
                .pixels,
            0
        );
    }

    #[test]
    fn a_hue_is_found_in_the_shade() {
        let picture = block([0, 0, 10, 10], [0, 57, 89]);
        assert_eq!(picture.of_hue([0, 114, 178]).pixels, 100);
        assert_eq!(picture.of_hue([213, 94, 0]).pixels, 0);
    }
}
