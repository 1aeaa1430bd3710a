//! Reading what [`super::write_vtk`] writes, for tests.

use std::collections::BTreeMap;

use super::Columns;
use super::number_type::{ByteOrder, NumberType};

/// The columns of a file that must be as it is written here.
pub(super) fn read_vtk(bytes: &[u8]) -> Columns {
    let mut rest = bytes;
    let mut columns = Columns::default();
    for expected in [
        "# vtk DataFile Version 3.0",
        "particles of sphpack",
        "BINARY",
        "DATASET UNSTRUCTURED_GRID",
    ] {
        assert_eq!(line(&mut rest), expected);
    }
    let mut names = BTreeMap::new();
    for _ in 0..count(&line(&mut rest), "FIELD FieldData") {
        let head = line(&mut rest);
        let words: Vec<&str> = head.split(' ').collect();
        assert_eq!(words[3], "string");
        let number: usize = words[2].parse().unwrap();
        let all: Vec<String> = (0..number).map(|_| string(&mut rest)).collect();
        assert_eq!(line(&mut rest), "");
        names.insert(words[0].to_owned(), all);
    }
    let n = count(&line(&mut rest), "POINTS");
    let points = numbers(&mut rest, NumberType::F64, 3 * n);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let values = points.iter().skip(axis).step_by(3).copied().collect();
        columns.numbers.insert(name.to_owned(), values);
    }
    assert_eq!(line(&mut rest), format!("CELLS {n} {}", 2 * n));
    let cells = numbers(&mut rest, NumberType::I32, 2 * n);
    assert!(
        cells
            .chunks(2)
            .enumerate()
            .all(|(i, cell)| *cell == [1.0, i as f64])
    );
    assert_eq!(count(&line(&mut rest), "CELL_TYPES"), n);
    assert!(
        numbers(&mut rest, NumberType::I32, n)
            .iter()
            .all(|&kind| kind == 1.0)
    );
    assert_eq!(count(&line(&mut rest), "POINT_DATA"), n);
    for _ in 0..count(&line(&mut rest), "FIELD FieldData") {
        let head = line(&mut rest);
        let words: Vec<&str> = head.split(' ').collect();
        assert_eq!(words[1..3], ["1", &n.to_string()]);
        let kind = match words[3] {
            "double" => NumberType::F64,
            "int" => NumberType::I32,
            "unsigned_int" => NumberType::U32,
            "unsigned_char" => NumberType::U8,
            other => panic!("{other}"),
        };
        let values = numbers(&mut rest, kind, n);
        columns.numbers.insert(words[0].to_owned(), values);
    }
    assert!(rest.is_empty());
    for column in ["kind", "side", "body"] {
        let none = Vec::new();
        let names: &Vec<String> = names.get(&format!("{column}_names")).unwrap_or(&none);
        columns.name(column, |code| names.get(code).cloned());
    }
    columns
}

fn line(rest: &mut &[u8]) -> String {
    let end = rest.iter().position(|&byte| byte == b'\n').unwrap();
    let line = String::from_utf8(rest[..end].to_vec()).unwrap();
    *rest = &rest[end + 1..];
    line
}

/// The number after the words that a line must begin with.
fn count(line: &str, words: &str) -> usize {
    let after = line
        .strip_prefix(words)
        .unwrap_or_else(|| panic!("{line}: no {words}"));
    after.split_whitespace().next().unwrap().parse().unwrap()
}

/// A string shorter than 2¹⁴ bytes.
fn string(rest: &mut &[u8]) -> String {
    let first = usize::from(rest[0]);
    let (head, length) = match first >> 6 {
        0b11 => (1, first & 0x3f),
        0b10 => (2, (first & 0x3f) << 8 | usize::from(rest[1])),
        other => panic!("a string of kind {other}"),
    };
    let text = String::from_utf8(rest[head..head + length].to_vec()).unwrap();
    *rest = &rest[head + length..];
    text
}

/// Numbers and the end of their line.
fn numbers(rest: &mut &[u8], kind: NumberType, count: usize) -> Vec<f64> {
    let size = count * kind.size();
    let numbers = kind.numbers(ByteOrder::Big, &rest[..size]);
    assert_eq!(rest[size], b'\n');
    *rest = &rest[size + 1..];
    numbers
}
