//! Particle files there and back again.

use std::path::Path;

use proptest::prelude::*;
use sphpack_packing::Kind;
use sphpack_separation::Side;

use super::*;
use crate::table::{Shared, Table};

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
            shared: Shared {
                spacing: 0.1,
                smoothing_length: 0.12,
                density: vec![2.5, 1e-3, 7.8, 1e3],
                ..Shared::default()
            },
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
        (
            "density",
            (0..table.len()).map(|i| table.density_of(i)).collect(),
        ),
        (
            "h",
            (0..table.len())
                .map(|i| table.smoothing_length_of(i))
                .collect(),
        ),
        (
            "spacing",
            (0..table.len()).map(|i| table.spacing_of(i)).collect(),
        ),
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
                for (reader, _) in PARTICLE_FORMATS {
                    let _ = read_back(reader, part);
                }
            }
        }
    }
}

pub(super) fn written(format: ParticleFormat, table: &Table) -> Vec<u8> {
    let mut bytes = Vec::new();
    format.write(table, &mut bytes).unwrap();
    bytes
}

fn read_back(format: ParticleFormat, bytes: &[u8]) -> Result<Columns, Error> {
    Columns::parse(format, bytes, Path::new("p"))
}

/// A body whose name is as awkward as a scene lets it be.
const AWKWARD: &str =
    " \u{2003}left; \"wing\" #1, 'öl' & <Ω> 翼 a name of more than sixty-four bytes ";

pub(super) fn one_particle(dimension: usize) -> Table {
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
        distance: vec![-5e-4],
        density: vec![1e3],
        spacing: vec![1e-3],
        smoothing_length: vec![1.2e-3],
        shared: Shared::default(),
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
                let is_flat = matches!(format, ParticleFormat::Csv | ParticleFormat::Npz);
                assert_eq!(
                    columns.numbers.contains_key("nz"),
                    dimension == 3 || !is_flat
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
        // Of a wall in layers Γ may be NaN.
        table.distance.clear();
        change(&mut table);
        table
    };
    refuse(
        &with(|t| t.gamma[0] = f64::NAN),
        "gamma of particle 4294967295 is NaN",
    );
    refuse(&with(|t| t.mass[0] = f64::INFINITY), "mass");
    refuse(&with(|t| t.distance = vec![f64::INFINITY]), "distance");
    refuse(&with(|t| t.position[0][2] = f64::NAN), "z of particle");
    let spoil = |t: &mut Table| {
        t.normals.insert(t.id[0], [0.0, f64::NAN, 0.0]);
    };
    refuse(&with(spoil), "ny of particle");
    refuse(&with(|t| t.bodies[0] = "a\nb".into()), "control character");
}

#[test]
fn what_is_not_judged_is_nan_and_stays_so() {
    let mut table = one_particle(3);
    table.kind = vec![Kind::Frozen];
    table.gamma = vec![f64::NAN];
    table.residual = vec![f64::NAN];
    for (format, ending) in PARTICLE_FORMATS {
        let columns = read_back(format, &written(format, &table)).unwrap();
        assert!(columns.numbers["gamma"][0].is_nan(), "{ending}");
        assert!(columns.numbers["residual"][0].is_nan(), "{ending}");
    }
}

#[test]
fn sizes_and_densities_are_every_particles_own_or_what_all_share() {
    let mut table = one_particle(2);
    table.spacing = Vec::new();
    table.smoothing_length = Vec::new();
    table.density = Vec::new();
    table.pressure = Vec::new();
    table.shared = Shared {
        spacing: 0.25,
        smoothing_length: 0.3,
        density: vec![2.0, 3.0, 4.0],
        ..Shared::default()
    };
    for (body, density) in [(Some(0), 2.0), (Some(1), 3.0), (None, 4.0)] {
        table.body = vec![body];
        for (format, ending) in PARTICLE_FORMATS {
            let columns = read_back(format, &written(format, &table)).unwrap();
            let found = ["spacing", "h", "density"].map(|name| columns.numbers[name][0]);
            assert_eq!(found, [0.25, 0.3, density], "{ending}");
        }
    }
}

#[test]
fn a_writer_that_fails_leaves_nothing() {
    /// A disk with room for so many bytes.
    struct Full(usize);
    impl io::Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0 = self
                .0
                .checked_sub(bytes.len())
                .ok_or_else(|| io::Error::other("full"))?;
            Ok(bytes.len())
        }
        fn flush(&mut self) -> io::Result<()> {
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
            let mut files = AtomicFiles::new(true);
            let failed = files.write(&path, |to| {
                format.write(&table, to)?;
                format.write(&table, &mut Full(room))
            });
            assert!(failed.unwrap_err().to_string().contains("full"));
            drop(files);
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        }
        fs::write(&path, "precious").unwrap();
        let mut files = AtomicFiles::new(false);
        files.write(&path, |to| format.write(&table, to)).unwrap();
        let message = files.finish().unwrap_err().to_string();
        assert_eq!(fs::read(&path).unwrap(), b"precious");
        // What was computed is not lost with the name.
        let kept = folder.path().join(format!("p.rescued.{ending}"));
        assert!(message.contains(&kept.display().to_string()), "{message}");
        assert_eq!(fs::read(kept).unwrap(), written(format, &table));
    }
}

/// A file of a format, read by [`compare`].
pub(super) fn compared(
    table: &Table,
    format: ParticleFormat,
    bytes: &[u8],
) -> Result<bool, String> {
    let file = tempfile::NamedTempFile::new().unwrap();
    fs::write(file.path(), bytes).unwrap();
    compare(table, format, file.path())
}

#[test]
fn what_was_written_is_what_was_computed() {
    for dimension in [2, 3] {
        let good = one_particle(dimension);
        let no_bodies = Table {
            bodies: Vec::new(),
            body: vec![None],
            ..good.clone()
        };
        for table in [&good, &no_bodies, &good.filtered(|_| false)] {
            for (format, ending) in PARTICLE_FORMATS {
                let result = compared(table, format, &written(format, table));
                assert_eq!(result, Ok(true), "{ending}");
            }
        }
    }
}

#[test]
fn any_column_that_differs_is_named() {
    type Change = fn(&mut Table);
    let changes: [(&str, Change); 14] = [
        ("id", |t| t.id[0] -= 1),
        ("x", |t| t.position[0][0] = t.position[0][0].next_up()),
        ("y", |t| t.position[0][1] = t.position[0][1].next_up()),
        ("z", |t| t.position[0][2] = t.position[0][2].next_up()),
        ("volume", |t| t.volume[0] = t.volume[0].next_up()),
        ("mass", |t| t.mass[0] = 0.0),
        ("gamma", |t| t.gamma[0] = t.gamma[0].next_up()),
        ("residual", |t| t.residual[0] = -0.0),
        ("pressure", |t| t.pressure[0] = 0.0),
        ("density", |t| t.density[0] = t.density[0].next_down()),
        ("kind", |t| t.kind[0] = Kind::Free),
        ("side", |t| t.side[0] = Side::Fluid),
        ("body", |t| t.body[0] = Some(0)),
        ("body", |t| t.body[0] = None),
    ];
    let good = one_particle(3);
    for (format, ending) in PARTICLE_FORMATS {
        for (column, change) in changes {
            let mut other = good.clone();
            change(&mut other);
            // Normals are found by the number.
            let normals = good.normals.values();
            other.normals = normals.map(|n| (other.id[0], *n)).collect();
            let message = compared(&good, format, &written(format, &other)).unwrap_err();
            let start = format!("read again, {column} of particle 4294967295 is ");
            assert!(message.starts_with(&start), "{ending}: {message}");
        }
        let mut other = good.clone();
        other.normals.insert(u32::MAX, [0.6, 0.0, 0.8]);
        let message = compared(&good, format, &written(format, &other)).unwrap_err();
        assert!(
            message.contains("ny of particle 4294967295 is 0 instead of -0"),
            "{message}"
        );
        what_lacks_is_found(&good, format, ending);
    }
}

/// A file without rows, or cut off, is none of the table's.
pub(super) fn what_lacks_is_found(good: &Table, format: ParticleFormat, ending: &str) {
    let none = good.filtered(|_| false);
    let message = compared(good, format, &written(format, &none)).unwrap_err();
    let words = format!("0 particles instead of {}", good.len());
    assert!(message.contains(&words), "{ending}: {message}");
    let bytes = written(format, good);
    let message = compared(good, format, &bytes[..bytes.len() / 2]).unwrap_err();
    assert!(
        message.contains("cannot be read again"),
        "{ending}: {message}"
    );
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

/// More rows than are read at a time: 786,432 bytes of points, of numbers, and of the text before them.
#[test]
fn files_of_many_pieces_are_compared_to_the_end() {
    const ROWS: u32 = 100_001;
    let all = || 0..ROWS;
    let table = Table {
        dimension: 3,
        id: all().collect(),
        position: all()
            .map(|i| [f64::from(i), 0.5 * f64::from(i), 1.0])
            .collect(),
        kind: vec![Kind::Free; ROWS as usize],
        side: vec![Side::Fluid; ROWS as usize],
        body: vec![None; ROWS as usize],
        volume: all().map(|i| 1.0 + f64::from(i)).collect(),
        mass: vec![1.0; ROWS as usize],
        gamma: vec![1.0; ROWS as usize],
        residual: vec![0.0; ROWS as usize],
        ..Table::default()
    };
    let format = ParticleFormat::Vtu;
    let bytes = written(format, &table);
    assert_eq!(compared(&table, format, &bytes), Ok(true));
    let mark = b"<AppendedData";
    let at = (bytes.windows(mark.len()).position(|window| window == mark)).unwrap();
    // The mark itself lies across the end of a piece.
    let padding = vec![b' '; (24 << 15) - 5 - at];
    let padded = [&bytes[..at], &padding, &bytes[at..]].concat();
    assert_eq!(compared(&table, format, &padded), Ok(true));
    type Change = fn(&mut Table, usize);
    let changes: [(&str, Change); 3] = [
        ("z", |table, last| table.position[last][2] = 2.0),
        ("volume", |table, last| table.volume[last] = 0.0),
        ("kind", |table, last| table.kind[last] = Kind::Fixed),
    ];
    for (name, change) in changes {
        let mut other = table.clone();
        change(&mut other, ROWS as usize - 1);
        let found = compared(&other, format, &bytes).unwrap_err();
        assert!(
            found.contains(&format!("{name} of particle 100000")),
            "{found}"
        );
    }
    let cut = &bytes[..bytes.len() / 2];
    assert!(
        compared(&table, format, cut)
            .unwrap_err()
            .contains("cut off")
    );
}
