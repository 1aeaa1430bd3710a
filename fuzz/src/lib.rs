//! What every target does with its input.

use sphpack_geometry::{BodyFormat, GeometryError, Sketch, Soup};

/// Reads `bytes` in a format, and in that which they look like; checks, mends and builds the body that they hold.
pub fn build(format: BodyFormat, bytes: &[u8]) {
    let _ = body(format, bytes);
    if let Ok(other) = BodyFormat::detect(bytes, format.extension())
        && other != format
    {
        let _ = body(other, bytes);
    }
}

fn body(format: BodyFormat, bytes: &[u8]) -> Result<(), GeometryError> {
    match format.dimension() {
        3 => Soup::from_bytes(format, bytes)?.body().map(drop),
        _ => Sketch::from_bytes(format, bytes)?.body().map(drop),
    }
}
