//! Particle files there and back again.

use std::path::Path;

use proptest::prelude::*;
use sphpack_packing::Kind;
use sphpack_separation::Side;

use super::*;
use crate::table::Table;

/// Any finite number, from the smallest to the largest.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO,
        -10.0..10.0_f64
    ]
}

fn tables() -> impl Strategy<Value = Table> {
    let row = (
        any::<u32>(),
        prop::array::uniform3(number()),
        prop::sample::select(Kind::ALL.to_vec()),
        prop::sample::select(Side::ALL.to_vec()),
        prop::option::of(0..3_u16),
        prop::array::uniform4(number()),
        prop::array::uniform3(number()),
    );
    (2..4_usize, prop::collection::vec(row, 0..40)).prop_map(|(dimension, rows)| {
        let mut table = Table {
            dimension,
            stop_reason: "converged".into(),
            bodies: vec![
                "wing".into(),
                "a, \"quoted\" name".into(),
                "flap & <Ω>".into(),
            ],
            ..Table::default()
        };
        let flat = |[x, y, z]: [f64; 3]| [x, y, if dimension == 2 { 0.0 } else { z }];
        for (id, position, kind, side, body, [volume, mass, gamma, residual], normal) in rows {
            table.id.push(id);
            table.position.push(flat(position));
            table.kind.push(kind);
            table.side.push(side);
            table.body.push(body);
            table.volume.push(volume);
            table.mass.push(mass);
            table.gamma.push(gamma);
            table.residual.push(residual);
            table.normal.push(flat(normal));
        }
        table
    })
}

/// The columns must be the table's, to the bit.
fn agree(columns: &Columns, table: &Table) -> Result<(), TestCaseError> {
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    let axis = |of: &[[f64; 3]], k: usize| of.iter().map(|p| p[k]).collect::<Vec<_>>();
    let mut expected = vec![
        ("id", table.id.iter().map(|&id| f64::from(id)).collect()),
        ("x", axis(&table.position, 0)),
        ("y", axis(&table.position, 1)),
        ("volume", table.volume.clone()),
        ("mass", table.mass.clone()),
        ("gamma", table.gamma.clone()),
        ("residual", table.residual.clone()),
        ("nx", axis(&table.normal, 0)),
        ("ny", axis(&table.normal, 1)),
    ];
    if table.dimension == 3 {
        expected.push(("z", axis(&table.position, 2)));
        expected.push(("nz", axis(&table.normal, 2)));
    }
    for (name, values) in expected {
        prop_assert_eq!(bits(&columns.numbers[name]), bits(&values), "{}", name);
    }
    let words = |name: &str| columns.words.get(name).cloned().unwrap_or_default();
    let kinds: Vec<&str> = table.kind.iter().map(|kind| kind.name()).collect();
    let sides: Vec<&str> = table.side.iter().map(|side| side.name()).collect();
    let bodies: Vec<&str> = (table.body.iter())
        .map(|body| body.map_or("", |b| table.bodies[usize::from(b)].as_str()))
        .collect();
    prop_assert_eq!(words("kind"), kinds);
    prop_assert_eq!(words("side"), sides);
    prop_assert_eq!(words("body"), bodies);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn csv_round_trip(table in tables()) {
        let mut bytes = Vec::new();
        write_csv(&table, &mut bytes).unwrap();
        agree(&read_csv(&bytes, Path::new("p.csv")).unwrap(), &table)?;
    }

    #[test]
    fn vtu_round_trip(table in tables()) {
        let mut bytes = Vec::new();
        write_vtu(&table, &mut bytes).unwrap();
        agree(&read_vtu(&bytes, Path::new("p.vtu")).unwrap(), &table)?;
    }

    #[test]
    fn damaged_files_are_refused_or_read_but_never_panic(
        table in tables(),
        cut in 0.0..1.0_f64,
        place in 0.0..1.0_f64,
        byte in any::<u8>(),
    ) {
        let mut vtu = Vec::new();
        write_vtu(&table, &mut vtu).unwrap();
        let mut csv = Vec::new();
        write_csv(&table, &mut csv).unwrap();
        for bytes in [&mut vtu, &mut csv] {
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = byte;
            let end = (cut * bytes.len() as f64) as usize;
            for part in [&bytes[..], &bytes[..end]] {
                let _ = read_vtu(part, Path::new("p.vtu"));
                let _ = read_csv(part, Path::new("p.csv"));
            }
        }
    }
}

#[track_caller]
fn refuse(text: &str, parts: &[&str]) {
    let message = read_csv(text.as_bytes(), Path::new("p.csv"))
        .unwrap_err()
        .to_string();
    for part in parts {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[test]
fn csv_of_others() {
    let columns = read_csv(
        b"# made by hand\nX;Y;colour\n1;2;red\n\n3;4;blue\n",
        Path::new("p.csv"),
    )
    .unwrap();
    assert_eq!(columns.numbers["x"], [1.0, 3.0]);
    assert_eq!(columns.words["colour"], ["red", "blue"]);
    refuse("", &["p.csv", "empty"]);
    refuse("a,b\n1,2\n", &["p.csv:1", "no column \"x\""]);
    refuse("x,y,x\n1,2,3\n", &["called \"x\""]);
    refuse("x,y\n1,2\n3\n", &["p.csv:3", "1 fields"]);
    refuse("x,y\n1,2\n3,nan\n", &["p.csv:3", "y is \"nan\""]);
    refuse("x,y,volume\n1,2,big\n", &["p.csv:2", "volume"]);
}

#[test]
fn vtu_of_others() {
    let text = "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\
        <Piece NumberOfPoints=\"2\" NumberOfCells=\"0\"><PointData><DataArray type=\"Float32\" Name=\"volume\" format=\"ascii\">0.5 0.25</DataArray></PointData>\
        <Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">1 2 0 3 4 0</DataArray></Points></Piece></UnstructuredGrid></VTKFile>";
    let columns = read_vtu(text.as_bytes(), Path::new("p.vtu")).unwrap();
    assert_eq!(columns.numbers["x"], [1.0, 3.0]);
    assert_eq!(columns.numbers["volume"], [0.5, 0.25]);
    for (from, to, part) in [
        (
            "LittleEndian\"",
            "LittleEndian\" compressor=\"vtkZLibDataCompressor\"",
            "compressed",
        ),
        ("LittleEndian", "BigEndian", "big-endian"),
        ("UnstructuredGrid", "PolyData", "PolyData"),
        ("\"2\"", "\"9\"", "9 points"),
        ("0.25", "a quarter", "no number"),
        ("format=\"ascii\">1", "format=\"binary\">1", "binary"),
    ] {
        let message = read_vtu(text.replace(from, to).as_bytes(), Path::new("p.vtu"))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains(part) && message.starts_with("p.vtu"),
            "{message} lacks {part}"
        );
    }
}

#[test]
fn files_appear_together_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (folder.path().join("a.txt"), folder.path().join("b.txt"));
    let listing = || std::fs::read_dir(folder.path()).unwrap().count();

    let mut files = WholeFiles::new(false);
    files.write(&a, |to| to.write_all(b"first")).unwrap();
    assert!(!a.exists());
    let failed = files.write(&b, |_| Err(std::io::Error::other("full")));
    assert!(failed.unwrap_err().to_string().contains("full"));
    drop(files);
    assert_eq!(listing(), 0);

    let mut files = WholeFiles::new(false);
    files.write(&a, |to| to.write_all(b"second")).unwrap();
    files.finish().unwrap();
    assert_eq!(std::fs::read(&a).unwrap(), b"second");

    let mut files = WholeFiles::new(false);
    files.write(&a, |to| to.write_all(b"third")).unwrap();
    assert!(files.finish().is_err());
    assert_eq!(std::fs::read(&a).unwrap(), b"second");
    assert_eq!(listing(), 1);
}
