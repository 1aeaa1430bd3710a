//! Arrays as NumPy saves them, written out by hand.

use std::path::Path;

use super::*;

/// What `numpy.save` writes: magic, version, the head's length, the head, the numbers.
fn npy(version: u8, head: &str, data: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend([version, 0]);
    let padded = format!("{head:<117}\n");
    if version == 1 {
        bytes.extend((padded.len() as u16).to_le_bytes());
    } else {
        bytes.extend((padded.len() as u32).to_le_bytes());
    }
    bytes.extend(padded.as_bytes());
    bytes.extend(data);
    bytes
}

fn head(kind: &str, is_fortran: bool, shape: &str) -> String {
    let order = if is_fortran { "True" } else { "False" };
    format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape}, }}")
}

fn little(numbers: &[f64]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn read(bytes: &[u8]) -> Result<Columns, String> {
    read_npy(bytes, Path::new("p.npy")).map_err(|error| error.to_string())
}

#[test]
fn places_in_rows() {
    for version in [1, 2, 3] {
        let bytes = npy(
            version,
            &head("<f8", false, "(2, 3)"),
            &little(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        );
        let columns = read(&bytes).unwrap();
        assert_eq!(columns.numbers["x"], [1.0, 4.0]);
        assert_eq!(columns.numbers["y"], [2.0, 5.0]);
        assert_eq!(columns.numbers["z"], [3.0, 6.0]);
    }
    // A whole file to the byte, as numpy.save("p.npy", numpy.array([[0.5, -1.0]], numpy.float32)) makes it.
    let mut bytes =
        b"\x93NUMPY\x01\x00\x76\x00{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }"
            .to_vec();
    bytes.resize(127, b' ');
    bytes.extend(b"\n\x00\x00\x00\x3f\x00\x00\x80\xbf");
    let columns = read(&bytes).unwrap();
    assert_eq!(
        [columns.numbers["x"][0], columns.numbers["y"][0]],
        [0.5, -1.0]
    );
    assert_eq!(columns.numbers.len(), 2);
}

#[test]
fn places_in_columns_and_of_other_types() {
    let numbers = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let columns = read(&npy(1, &head("<f8", true, "(3, 2)"), &little(&numbers))).unwrap();
    assert_eq!(columns.numbers["x"], [1.0, 2.0, 3.0]);
    assert_eq!(columns.numbers["y"], [4.0, 5.0, 6.0]);
    let big: Vec<u8> = numbers[..4].iter().flat_map(|x| x.to_be_bytes()).collect();
    let columns = read(&npy(1, &head(">f8", false, "(2, 2)"), &big)).unwrap();
    assert_eq!(columns.numbers["y"], [2.0, 4.0]);
    let whole: Vec<u8> = [7_i64, -8].iter().flat_map(|x| x.to_le_bytes()).collect();
    let columns = read(&npy(1, &head("<i8", false, "(1, 2)"), &whole)).unwrap();
    assert_eq!(columns.numbers["y"], [-8.0]);
    let columns = read(&npy(1, &head("<f8", false, "(0, 2)"), &[])).unwrap();
    assert!(columns.numbers["x"].is_empty());
}

#[test]
fn records() {
    let mut row = b"ab\0".to_vec();
    row.extend(little(&[1.5, 2.5, 9.0, 9.0]));
    row.extend(0.25_f32.to_le_bytes());
    let head = "{'descr': [('shape', '|S3'), ('x', '<f8'), ('y', '<f8'), ('v', '<f8', (2,)), ('m', '<f4')], 'fortran_order': False, 'shape': (2,), }";
    let columns = read(&npy(1, head, &row.repeat(2))).unwrap();
    assert_eq!(columns.numbers["x"], [1.5; 2]);
    assert_eq!(columns.numbers["y"], [2.5; 2]);
    assert_eq!(columns.numbers["m"], [0.25; 2]);
    assert_eq!(columns.numbers.len(), 3);
    for (from, to, part) in [
        ("(2,), }", "(3,), }", "cut off"),
        ("(2,), }", "(2, 1), }", "numpy.ravel"),
        ("'|S3'", "'|O'", "type that is not read"),
        ("('x', '<f8')", "('x' '<f8')", "not understood"),
    ] {
        let message = read(&npy(1, &head.replacen(from, to, 1), &row.repeat(2))).unwrap_err();
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[test]
fn what_is_refused() {
    let good = npy(
        1,
        &head("<f8", false, "(2, 2)"),
        &little(&[1.0, 2.0, 3.0, 4.0]),
    );
    for (bytes, part) in [
        (&b"x,y\n1,2\n"[..], "no NPY file"),
        (&good[..40], "no readable head"),
        (&good[..good.len() - 1], "cut off"),
    ] {
        let message = read(bytes).unwrap_err();
        assert!(
            message.contains(part) && message.starts_with("p.npy"),
            "{message} lacks {part}"
        );
    }
    for (kind, shape, part) in [
        ("<f8", "(4,)", "the shape (4,)"),
        ("<f8", "(1, 4)", "(n, 2) or (n, 3)"),
        ("<f8", "()", "the shape ()"),
        ("<c16", "(2, 2)", "\"<c16\""),
        ("|O", "(2, 2)", "float64"),
        // Sizes that are only claimed.
        ("<f8", "(1000000000000, 2)", "cut off"),
        ("<f8", "(9223372036854775807, 3)", "cut off"),
        ("<f8", "(99999999999999999999, 3)", "no readable head"),
    ] {
        for is_fortran in [false, true] {
            let message = read(&npy(1, &head(kind, is_fortran, shape), &[0; 32])).unwrap_err();
            assert!(message.contains(part), "{message} lacks {part}");
        }
    }
    // Any byte may be wrong.
    for at in 0..good.len() {
        for byte in [0, b'(', b'\'', b'9', 0xff] {
            let mut bad = good.clone();
            bad[at] = byte;
            let _ = read(&bad);
        }
    }
}
