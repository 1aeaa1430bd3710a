//! Files for solvers: what they say, there and back again, and what they refuse.

use std::path::Path;

use proptest::prelude::*;
use sphpack_packing::Kind;
use sphpack_separation::Side;

use super::tests::{compared, what_lacks_is_found, written};
use super::*;
use crate::table::Shared;

/// Names as awkward as scenes let them be.
const NAMES: [&str; 3] = [
    " wing #1, \"quoted\" 'name' ",
    "flap & <Ω> 翼/\\>",
    "fluid's 1 # free fluid",
];

/// Two bodies with walls and insides, and fluid around them, by turns; the third body has nobody.
pub(super) fn some(dimension: usize, count: u32) -> Table {
    let flat = |[x, y, z]: [f64; 3]| [x, y, if dimension == 2 { 0.0 } else { z }];
    let mut table = Table {
        dimension,
        stop_reason: "converged".into(),
        bodies: NAMES.map(str::to_owned).to_vec(),
        shared: Shared {
            spacing: 0.1,
            smoothing_length: 0.12,
            density: vec![2.5, 1e-3, 7.8, 1e3],
            domain: Some([flat([-1.0, -2.0, -3.0]), flat([1.0, 2.0, 3.0])]),
            inset: vec![0.05, 0.0, 0.025],
            periodic: [false; 3],
        },
        ..Table::default()
    };
    for number in 0..count {
        let i = f64::from(number);
        let (kind, body) = [
            (Kind::Free, None),
            (Kind::Boundary, Some(1)),
            (Kind::Free, Some(0)),
            (Kind::Fixed, Some(0)),
            (Kind::Free, None),
        ][number as usize % 5];
        // Numbers with gaps, the highest first.
        let id = 7 * (count - number);
        table.id.push(id);
        table
            .position
            .push(flat([0.1 + i / 3.0, -0.2 * i, 1e-7 * i - 0.5]));
        table.kind.push(kind);
        table.side.push(body.map_or(Side::Fluid, |_| Side::Solid));
        table.body.push(body);
        let volume = match kind {
            Kind::Free => 0.01,
            _ => 0.0097,
        };
        table.volume.push(volume);
        table.mass.push(volume * table.shared.density_of(body));
        table.gamma.push(1.0 + 1e-3 * i);
        table.residual.push(0.0);
        if kind != Kind::Free {
            table.normals.insert(id, flat([0.6, -0.8, 0.0]));
        }
    }
    table
}

fn parsed(format: ParticleFormat, bytes: &[u8]) -> Result<Columns, Error> {
    Columns::parse(format, bytes, Path::new("p"))
}

fn refusal(table: &Table, format: ParticleFormat) -> String {
    let mut bytes = Vec::new();
    let error = format.write(table, &mut bytes).unwrap_err();
    assert!(bytes.is_empty());
    error.to_string()
}

#[test]
fn what_was_written_is_what_was_computed() {
    for dimension in [2, 3] {
        for count in [0, 1, 2, 23] {
            let table = some(dimension, count);
            for (format, ending) in SOLVER_FORMATS {
                let bytes = written(format, &table);
                assert_eq!(compared(&table, format, &bytes), Ok(true), "{ending}");
            }
        }
        let nothing = Table {
            dimension,
            ..Table::default()
        };
        for (format, ending) in SOLVER_FORMATS {
            let bytes = written(format, &nothing);
            assert_eq!(compared(&nothing, format, &bytes), Ok(true), "{ending}");
        }
    }
}

/// Each format's columns, changed in one particle: another file must be found to differ.
#[test]
fn any_column_that_differs_is_named() {
    type Change = fn(&mut Table);
    let changes: [(&str, Change); 9] = [
        ("id", |t| t.id[3] += 1),
        ("x", |t| t.position[3][0] *= 1.0 + 1e-6),
        ("y", |t| t.position[3][1] *= 1.0 + 1e-6),
        ("z", |t| t.position[3][2] += 1e-6),
        ("volume", |t| t.volume[3] *= 1.0 + 1e-6),
        ("mass", |t| t.mass[3] *= 1.0 + 1e-6),
        ("density", |t| t.shared.density[0] *= 1.0 + 1e-6),
        ("kind", |t| t.kind[3] = Kind::Boundary),
        ("body", |t| t.body[3] = Some(1)),
    ];
    let good = some(3, 7);
    for (format, ending) in SOLVER_FORMATS {
        let carried = format.carried().unwrap();
        let mut numbers = carried.numbers.iter().map(|(name, _)| *name);
        let mut words = carried.words.iter().copied();
        for (column, change) in changes {
            if !numbers
                .clone()
                .chain(words.clone())
                .any(|name| name == column)
            {
                continue;
            }
            let mut other = good.clone();
            change(&mut other);
            let message = compared(&good, format, &written(format, &other)).unwrap_err();
            assert!(message.starts_with("read again, "), "{ending}: {message}");
            assert!(
                message.contains(" of particle "),
                "{ending} {column}: {message}"
            );
        }
        assert!(numbers.any(|name| name == "x") && words.all(|name| name != "x"));
        what_lacks_is_found(&good, format, ending);
        let message = compared(&good, format, &written(format, &some(3, 8))).unwrap_err();
        assert!(
            message.contains("8 particles instead of 7"),
            "{ending}: {message}"
        );
    }
}

#[test]
fn what_no_file_may_hold() {
    for (format, ending) in SOLVER_FORMATS {
        let mut table = some(3, 5);
        table.position[4][1] = f64::INFINITY;
        let message = refusal(&table, format);
        assert!(
            message.contains("y of particle 7 is inf"),
            "{ending}: {message}"
        );
        let mut table = some(3, 5);
        table.volume[0] = f64::NAN;
        assert!(refusal(&table, format).contains("volume of particle 35"));
        let mut table = some(3, 5);
        table.bodies[0] = "a\nb".into();
        assert!(refusal(&table, format).contains("control character"));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn damaged_files_are_refused_or_read_but_never_panic(
        dimension in 2..4_usize,
        count in 0..20_u32,
        cut in 0.0..1.0_f64,
        places in prop::collection::vec((0.0..1.0_f64, any::<u8>()), 1..4),
    ) {
        let table = some(dimension, count);
        for (format, _) in SOLVER_FORMATS {
            let mut bytes = written(format, &table);
            for (place, byte) in &places {
                let at = (place * bytes.len() as f64) as usize;
                bytes[at] = *byte;
            }
            let end = (cut * bytes.len() as f64) as usize;
            for part in [&bytes[..], &bytes[..end]] {
                for (reader, _) in SOLVER_FORMATS.into_iter().chain(PARTICLE_FORMATS) {
                    let _ = parsed(reader, part);
                }
            }
        }
    }
}
