//! Pixels into a PNG file.

use std::io::{self, Write};

use super::canvas::Canvas;
use super::palette::Indexed;

/// Writes a picture.
pub(super) fn write(canvas: &Canvas, to: &mut dyn Write) -> io::Result<()> {
    let fail = |e: ::png::EncodingError| match e {
        ::png::EncodingError::IoError(e) => e,
        other => io::Error::other(other),
    };
    let indexed = Indexed::of(&canvas.pixels);
    let mut encoder = ::png::Encoder::new(to, canvas.width as u32, canvas.height as u32);
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
