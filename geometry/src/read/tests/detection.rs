//! What a file is, told from its content.

use super::*;

#[track_caller]
fn detected(content: &[u8], extension: &str, expected: Result<BodyFormat, &str>) {
    match (BodyFormat::detect(content, extension), expected) {
        (Ok(format), Ok(wanted)) => assert_eq!(format, wanted),
        (Err(error), Err(part)) => assert!(error.to_string().contains(part), "{error}"),
        (got, wanted) => panic!("{got:?}, not {wanted:?}"),
    }
}

#[test]
fn content_decides() {
    use BodyFormat::{Airfoil, Csv, Obj, Ply, Stl, Svg};
    let mut binary = vec![b'x'; 84 + 50];
    binary[80..84].copy_from_slice(&1_u32.to_le_bytes());
    detected(&binary, "dat", Ok(Stl));
    binary[..5].copy_from_slice(b"solid");
    detected(&binary, "csv", Ok(Stl));
    detected(b"\xef\xbb\xbf\n SOLID cube\nfacet", "csv", Ok(Stl));
    detected(b"x,y\n0,0\n1,0\n0,1\n", "stl", Ok(Csv));
    detected(b"# outline\n0 0\n1 0\n", "txt", Ok(Csv));
    detected(b"v 0 0 0\nv 1 0 0\n", "stl", Ok(Obj));
    detected(b"# made by hand\n\n\to body\n", "ply", Ok(Obj));
    detected(b"ply\r\nformat ascii 1.0\n", "stl", Ok(Ply));
    detected(b"<?xml version='1.0'?>\n<!-- a -->\n<svg>", "txt", Ok(Svg));
    detected(b"<a:svg width='1'/>", "", Ok(Svg));
    detected(b"<!-- a long preamble", "svg", Ok(Svg));
    detected(b"0 0\n1 0\n", "dat", Ok(Airfoil));
    detected(b"0 0\n1 0\n", "DAT", Ok(Airfoil));
    detected(b"NACA 0012\n 61. 61.\n\n0 0\n", "txt", Ok(Airfoil));
    detected(b"NACA 0012\n 35\n1 0\n", "", Ok(Airfoil));
    detected(b"NACA 0012\n1 0.001\n0.9 0.01\n", "", Ok(Csv));
}

#[test]
fn names_decide_where_content_does_not() {
    for format in BodyFormat::ALL {
        detected(b"", format.extension(), Ok(format));
        detected(b"hello", &format.extension().to_uppercase(), Ok(format));
    }
}

#[test]
fn others_are_named() {
    detected(b"ISO-10303-21;", "stp", Err("STEP"));
    detected(b"PK\x03\x04rest", "3mf", Err("archive"));
    detected(b"\x1f\x8b\x08", "svgz", Err("unpack"));
    detected(b"OFF\n8 6 0\n", "off", Err("OFF"));
    detected(b"<COLLADA>", "dae", Err("no SVG"));
    detected(b"\xff\xfex\0,\0y\0", "csv", Err("UTF-8"));
    detected(b"hello", "step", Err("export the body as .stl"));
    detected(b"", "", Err("export the body as .stl"));
}

#[test]
fn a_head_is_enough() {
    let rows = "0.5,0.25\n".repeat(10_000);
    let head = &rows.as_bytes()[..BodyFormat::HEAD_BYTES];
    assert_eq!(
        BodyFormat::detect_head(head, rows.len() as u64, ""),
        Ok(BodyFormat::Csv)
    );
    let mut binary = vec![0; 84];
    binary[80..84].copy_from_slice(&1_000_000_u32.to_le_bytes());
    let size = 84 + 50_000_000;
    assert_eq!(
        BodyFormat::detect_head(&binary, size, ""),
        Ok(BodyFormat::Stl)
    );
    assert!(BodyFormat::detect_head(&binary, size - 1, "").is_err());
}
