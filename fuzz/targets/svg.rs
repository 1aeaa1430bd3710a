//! The reader of SVG drawings.

#![no_main]

use libfuzzer_sys::fuzz_target;
use sphpack_geometry::BodyFormat;

fuzz_target!(|bytes: &[u8]| bodies::build(BodyFormat::Svg, bytes));
