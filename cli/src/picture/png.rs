//! Pixels into a PNG file.

use std::io::{self, Write};

use super::palette::Indexed;

/// Writes pixels as a PNG, row after row of so many; of more than 256 colours the most frequent ones are taken, and for others the
/// nearest of them.
///
/// # Errors
/// Those of `to`, and where pixels do not make whole rows.
pub fn write(width: u32, pixels: &[[u8; 3]], to: &mut dyn Write) -> io::Result<()> {
    let fail = |e: ::png::EncodingError| match e {
        ::png::EncodingError::IoError(e) => e,
        other => io::Error::other(other),
    };
    let indexed = Indexed::of(pixels);
    let height = pixels.len() as u32 / width.max(1);
    let mut encoder = ::png::Encoder::new(to, width, height);
    encoder.set_color(::png::ColorType::Indexed);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_palette(indexed.colours.as_flattened());
    encoder.set_compression(::png::Compression::High);
    // Neighbouring places in a list of colours have nothing to do with each other.
    encoder.set_filter(::png::Filter::NoFilter);
    let mut writer = encoder.write_header().map_err(fail)?;
    writer.write_image_data(&indexed.pixels).map_err(fail)?;
    writer.finish().map_err(fail)
}
