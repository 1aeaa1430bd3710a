//! No damage makes a reader panic, run on, or ask for memory that the file does not warrant.

use super::*;
use crate::read::mangle::Mangler;

/// Inputs for each reader; `cargo xtask fuzz` has more.
const INPUTS: usize = 20_000;

/// Reads a file that may be damaged, in its format and in that which it looks like.
fn survive(format: BodyFormat, bytes: &[u8]) {
    let detected = BodyFormat::detect(bytes, format.extension());
    for format in [Some(format), detected.ok().filter(|&other| other != format)]
        .into_iter()
        .flatten()
    {
        if let Ok(solids) = format.solids(bytes) {
            let count: usize = solids.iter().map(|solid| solid.triangles.len()).sum();
            assert!(0 < count && count <= bytes.len());
        }
        if let Ok(loops) = format.loops(bytes) {
            let count: usize = loops.iter().map(Vec::len).sum();
            assert!(count <= 1_010_000 + 4 * bytes.len());
        }
        let _ = contents(format, bytes);
    }
}

#[test]
fn files_that_are_cut_off_anywhere() {
    for format in BodyFormat::ALL {
        for (_, bytes) in files(format) {
            for end in 0..bytes.len() {
                survive(format, &bytes[..end]);
            }
        }
    }
}

#[test]
fn files_with_any_byte_changed() {
    for format in BodyFormat::ALL {
        for (_, mut bytes) in files(format) {
            for at in 0..bytes.len() {
                let original = bytes[at];
                for changed in [original ^ 1, original ^ 0x80, 0, b'9', b'\n', 0xff] {
                    bytes[at] = changed;
                    survive(format, &bytes);
                }
                bytes[at] = original;
            }
        }
    }
}

#[test]
fn files_mangled_at_random() {
    for format in BodyFormat::ALL {
        let files: Vec<Vec<u8>> = files(format).into_iter().map(|file| file.1).collect();
        let mut mangler = Mangler::new(1, 0);
        for _ in 0..INPUTS {
            survive(format, &mangler.mangled(&files));
        }
    }
}
