//! Pictures small enough for a page that has many.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use sphpack::picture::write_png;

/// No wider than this, pixels: half of what the pictures are, so that their letters can still be read.
const WIDTH: u32 = 960;

/// A PNG file's picture, smaller, as a PNG.
pub(super) fn thumbnail(path: &Path) -> Result<Vec<u8>, String> {
    let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let file = File::open(path).map_err(|e| fail(&e))?;
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|e| fail(&e))?;
    let size = reader
        .output_buffer_size()
        .ok_or_else(|| fail(&"it is too large"))?;
    let mut pixels = vec![0; size];
    let info = reader.next_frame(&mut pixels).map_err(|e| fail(&e))?;
    if info.color_type != png::ColorType::Rgb {
        return Err(fail(&"it is not in colours"));
    }
    let (width, small) = shrunk(&pixels, info.width, info.height);
    let mut bytes = Vec::new();
    write_png(width, &small, &mut bytes).map_err(|e| fail(&e))?;
    Ok(bytes)
}

/// The picture with squares of pixels made one each, as wide as allowed, and how wide that is.
fn shrunk(pixels: &[u8], width: u32, height: u32) -> (u32, Vec<[u8; 3]>) {
    let side = width.div_ceil(WIDTH).max(1);
    let (across, down) = (width / side, height / side);
    let mut small = Vec::with_capacity((across * down) as usize);
    for y in 0..down {
        for x in 0..across {
            let mean = |colour: u32| {
                let places = (0..side * side).map(|k| (k % side, k / side));
                let values = places.map(|(dx, dy)| {
                    let at = 3 * ((side * y + dy) * width + side * x + dx) + colour;
                    u32::from(pixels[at as usize])
                });
                (values.sum::<u32>() / (side * side)) as u8
            };
            small.push([mean(0), mean(1), mean(2)]);
        }
    }
    (across, small)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_of_pixels_become_one() {
        // Twice as wide as allowed: columns of black and white in turn.
        let width = 2 * WIDTH;
        let row: Vec<u8> = (0..3 * width)
            .map(|k| if k / 3 % 2 == 0 { 0 } else { 255 })
            .collect();
        let (across, small) = shrunk(&[row.clone(), row].concat(), width, 2);
        assert_eq!((across, small.len()), (WIDTH, WIDTH as usize));
        assert!(small.iter().all(|&pixel| pixel == [127; 3]));
    }
}
