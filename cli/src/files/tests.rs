//! Particle files there and back again.

use std::path::Path;

use proptest::prelude::*;
use sphpack_packing::Kind;
use sphpack_separation::Side;

use super::legacy::read_vtk;
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
            table.normals.insert(id, flat(normal));
        }
        table
    })
}

fn axis(of: &[[f64; 3]], k: usize) -> Vec<f64> {
    of.iter().map(|p| p[k]).collect()
}

/// The columns must be the table's, to the bit.
fn agree(columns: &Columns, table: &Table) -> Result<(), TestCaseError> {
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    let normals: Vec<[f64; 3]> = (0..table.len()).map(|i| table.normal(i)).collect();
    let mut expected = vec![
        ("id", table.id.iter().map(|&id| f64::from(id)).collect()),
        ("x", axis(&table.position, 0)),
        ("y", axis(&table.position, 1)),
        ("volume", table.volume.clone()),
        ("mass", table.mass.clone()),
        ("gamma", table.gamma.clone()),
        ("residual", table.residual.clone()),
        ("nx", axis(&normals, 0)),
        ("ny", axis(&normals, 1)),
    ];
    if table.dimension == 3 {
        expected.push(("z", axis(&table.position, 2)));
        expected.push(("nz", axis(&normals, 2)));
    }
    if !table.pressure.is_empty() {
        expected.push(("pressure", table.pressure.clone()));
        expected.push(("density", table.density.clone()));
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
    fn round_trips(table in tables()) {
        for (format, ending) in PARTICLE_FORMATS {
            let bytes = written(format, &table);
            let columns = read_back(format, &bytes).map_err(|e| TestCaseError::fail(format!("{ending}: {e}")))?;
            agree(&columns, &table)?;
        }
    }

    #[test]
    fn damaged_files_are_refused_or_read_but_never_panic(
        table in tables(),
        cut in 0.0..1.0_f64,
        place in 0.0..1.0_f64,
        byte in any::<u8>(),
    ) {
        for (format, _) in PARTICLE_FORMATS {
            let mut bytes = written(format, &table);
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = byte;
            let end = (cut * bytes.len() as f64) as usize;
            for part in [&bytes[..], &bytes[..end]] {
                for (reader, _) in PARTICLE_FORMATS.iter().filter(|(f, _)| *f != ParticleFormat::Vtk) {
                    let _ = read_back(*reader, part);
                }
            }
        }
    }
}

fn written(format: ParticleFormat, table: &Table) -> Vec<u8> {
    let mut bytes = Vec::new();
    format.write(table, &mut bytes).unwrap();
    bytes
}

fn read_back(format: ParticleFormat, bytes: &[u8]) -> Result<Columns, Error> {
    let path = Path::new("p");
    match format {
        ParticleFormat::Csv => read_csv(bytes, path),
        ParticleFormat::Vtu | ParticleFormat::Vtp => read_vtu(bytes, path),
        ParticleFormat::Npz => read_npz(bytes, path),
        ParticleFormat::Ply => read_ply(bytes, path),
        ParticleFormat::Vtk => Ok(read_vtk(bytes)),
    }
}

/// A body whose name is as awkward as a scene lets it be.
const AWKWARD: &str =
    " \u{2003}left; \"wing\" #1, 'öl' & <Ω> 翼 a name of more than sixty-four bytes ";

fn one_particle(dimension: usize) -> Table {
    let flat = |[x, y, z]: [f64; 3]| [x, y, if dimension == 2 { 0.0 } else { z }];
    Table {
        dimension,
        stop_reason: "interrupted".into(),
        bodies: vec!["other".into(), AWKWARD.into()],
        id: vec![u32::MAX],
        position: vec![flat([0.1, -0.2, 1.0 / 3.0])],
        kind: vec![Kind::Boundary],
        side: vec![Side::Solid],
        body: vec![Some(1)],
        volume: vec![1e-30],
        mass: vec![5e-324],
        gamma: vec![1.0],
        residual: vec![0.0],
        normals: [(u32::MAX, flat([0.6, -0.0, 0.8]))].into(),
        pressure: vec![-1e-9],
        density: vec![1e3],
    }
}

#[test]
fn no_particle_and_one() {
    for dimension in [2, 3] {
        let one = one_particle(dimension);
        let none = one.filtered(|_| false);
        let nothing = Table {
            dimension,
            ..Table::default()
        };
        for (format, ending) in PARTICLE_FORMATS {
            for table in [&one, &none, &nothing] {
                let columns = read_back(format, &written(format, table));
                let columns = columns.unwrap_or_else(|e| panic!("{ending}: {e}"));
                agree(&columns, table).unwrap_or_else(|e| panic!("{ending}: {e}"));
                let z = columns.numbers.get("z");
                match format {
                    ParticleFormat::Csv | ParticleFormat::Npz => {
                        assert_eq!(z.is_some(), dimension == 3);
                    }
                    // Formats of three coordinates.
                    _ => assert_eq!(*z.unwrap(), axis(&table.position, 2), "{ending}"),
                }
                assert_eq!(
                    columns.numbers.contains_key("nz"),
                    dimension == 3 || format == ParticleFormat::Ply
                );
            }
        }
    }
}

#[test]
fn what_no_file_may_hold() {
    let refuse = |table: &Table, part: &str| {
        for (format, ending) in PARTICLE_FORMATS {
            let mut bytes = Vec::new();
            let error = format.write(table, &mut bytes).unwrap_err().to_string();
            assert!(error.contains(part), "{ending}: {error}");
            assert!(bytes.is_empty(), "{ending}");
        }
    };
    let with = |change: fn(&mut Table)| {
        let mut table = one_particle(3);
        change(&mut table);
        table
    };
    refuse(
        &with(|t| t.gamma[0] = f64::NAN),
        "gamma of particle 4294967295 is NaN",
    );
    refuse(&with(|t| t.mass[0] = f64::INFINITY), "mass");
    refuse(&with(|t| t.position[0][2] = f64::NAN), "z of particle");
    let spoil = |t: &mut Table| {
        t.normals.insert(t.id[0], [0.0, f64::NAN, 0.0]);
    };
    refuse(&with(spoil), "ny of particle");
    refuse(&with(|t| t.bodies[0] = "a\nb".into()), "control character");
}

#[test]
fn a_writer_that_fails_leaves_nothing() {
    /// A disk with room for so many bytes.
    struct Full(usize);
    impl std::io::Write for Full {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0 = self
                .0
                .checked_sub(bytes.len())
                .ok_or_else(|| std::io::Error::other("full"))?;
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let table = one_particle(3);
    for (format, ending) in PARTICLE_FORMATS {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(format!("p.{ending}"));
        let size = written(format, &table).len();
        for room in [0, size / 2, size - 1] {
            // Errors come through at any place …
            assert!(format.write(&table, &mut Full(room)).is_err(), "{ending}");
            // … and no file is left, under any name.
            let mut files = WholeFiles::new(true);
            let failed = files.write(&path, |to| {
                format.write(&table, to)?;
                format.write(&table, &mut Full(room))
            });
            assert!(failed.unwrap_err().to_string().contains("full"));
            drop(files);
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        }
        std::fs::write(&path, "precious").unwrap();
        let mut files = WholeFiles::new(false);
        files.write(&path, |to| format.write(&table, to)).unwrap();
        assert!(files.finish().is_err());
        assert_eq!(std::fs::read(&path).unwrap(), b"precious");
    }
}

#[test]
fn archives_beyond_32_bits() {
    let table = one_particle(3);
    for limit in [0, 1, 129, 300, 1000] {
        let mut bytes = Vec::new();
        let mut archive = zip::Zip::with_limit(&mut bytes, limit);
        npz::write(&table, &mut archive).unwrap();
        archive.finish("").unwrap();
        agree(&read_back(ParticleFormat::Npz, &bytes).unwrap(), &table).unwrap();
    }
}

#[test]
fn npz_of_others() {
    // numpy.savez_compressed of x (32 bits), y (whole numbers), an array of two axes and one of another length.
    let columns = read_npz(include_bytes!("others.npz"), Path::new("p.npz")).unwrap();
    assert_eq!(columns.numbers["x"], [0.5, 1.5, -2.0]);
    assert_eq!(columns.numbers["y"], [1.0, 2.0, 3.0]);
    assert_eq!(columns.words["kind"], ["free", "frozen", "é"]);
    assert_eq!(columns.numbers.len() + columns.words.len(), 3);
    let good = written(ParticleFormat::Npz, &one_particle(3));
    let mut bad = good.clone();
    bad[140] ^= 1;
    for (bytes, part) in [
        (&b"PK"[..], "no NPZ file"),
        (&good[..good.len() - 60], "no NPZ file"),
        (&bad[..], "checksum"),
    ] {
        let message = read_npz(bytes, Path::new("p.npz")).unwrap_err().to_string();
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[test]
fn ply_of_others() {
    let text = "ply\r\nformat ascii 1.0\ncomment by hand\nelement thing 1\nproperty list uchar int all\nelement vertex 2\n\
        property float x\nproperty float y\nproperty uchar kind\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n\
        3 0 1 2\n1 2 0\n3 4 3\n";
    let columns = read_ply(text.as_bytes(), Path::new("p.ply")).unwrap();
    assert_eq!(columns.numbers["x"], [1.0, 3.0]);
    assert_eq!(columns.numbers["kind"], [0.0, 3.0]);
    for (from, to, part) in [
        ("ply", "PLY!", "no PLY file"),
        ("end_header", "end", "no PLY file"),
        ("vertex 2", "vertex 9", "fewer than 9"),
        ("3 4 3", "3 four 3", "3 four 3"),
        ("float y", "real y", "type of y"),
        ("ascii", "binary_big_endian", "lists"),
        ("element vertex", "element point", "no vertices"),
    ] {
        let message = read_ply(text.replacen(from, to, 1).as_bytes(), Path::new("p.ply"))
            .unwrap_err()
            .to_string();
        assert!(message.contains(part), "{message} lacks {part}");
    }
    let mut big = b"ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty short x\nproperty double y\nend_header\n".to_vec();
    big.extend((-7_i16).to_be_bytes());
    big.extend(0.25_f64.to_be_bytes());
    let columns = read_ply(&big, Path::new("p.ply")).unwrap();
    assert_eq!(
        [columns.numbers["x"][0], columns.numbers["y"][0]],
        [-7.0, 0.25]
    );
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
        ("UnstructuredGrid", "ImageData", "ImageData"),
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
