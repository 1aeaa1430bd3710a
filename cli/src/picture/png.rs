//! Pixels into a PNG file.

use std::io::{self, Write};

use super::canvas::Canvas;

/// Writes a picture.
pub(super) fn write(canvas: &Canvas, to: &mut dyn Write) -> io::Result<()> {
    let fail = |e: ::png::EncodingError| match e {
        ::png::EncodingError::IoError(e) => e,
        other => io::Error::other(other),
    };
    let mut encoder = ::png::Encoder::new(to, canvas.width as u32, canvas.height as u32);
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_compression(::png::Compression::High);
    let mut writer = encoder.write_header().map_err(fail)?;
    writer
        .write_image_data(canvas.pixels.as_flattened())
        .map_err(fail)?;
    writer.finish().map_err(fail)
}
