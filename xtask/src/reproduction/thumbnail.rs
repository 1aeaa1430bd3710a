//! Pictures small enough for a page that has many.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// No wider than this, pixels: the page shows them at half of it.
const WIDTH: u32 = 680;

/// Colours are told in steps of this: particles that differ less look alike, and so many fewer colours are packed far smaller.
const STEP: u16 = 8;

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
    let height = small.len() / (3 * width as usize).max(1);
    let mut encoder = png::Encoder::new(&mut bytes, width, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().map_err(|e| fail(&e))?;
    writer.write_image_data(&small).map_err(|e| fail(&e))?;
    writer.finish().map_err(|e| fail(&e))?;
    Ok(bytes)
}

/// The picture with squares of pixels made one each, as wide as allowed, and how wide that is.
fn shrunk(pixels: &[u8], width: u32, height: u32) -> (u32, Vec<u8>) {
    let side = width.div_ceil(WIDTH).max(1);
    let (across, down) = (width / side, height / side);
    let mut small = Vec::with_capacity(3 * (across * down) as usize);
    for y in 0..down {
        for x in 0..across {
            for colour in 0..3 {
                let mut sum = 0_u32;
                for (dx, dy) in (0..side * side).map(|k| (k % side, k / side)) {
                    let at = 3 * ((side * y + dy) * width + side * x + dx) + colour;
                    sum += u32::from(pixels[at as usize]);
                }
                small.push(stepped((sum / (side * side)) as u8));
            }
        }
    }
    (across, small)
}

/// The nearest of the steps; white stays white.
fn stepped(value: u8) -> u8 {
    ((u16::from(value) + STEP / 2) / STEP * STEP).min(255) as u8
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
        assert_eq!((across, small.len()), (WIDTH, 3 * WIDTH as usize));
        assert!(small.iter().all(|&value| value == stepped(127)));
        assert_eq!([stepped(255), stepped(0), stepped(252)], [255, 0, 255]);
    }
}
