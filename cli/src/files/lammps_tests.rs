//! LAMMPS's data files, word for word.

use std::path::Path;

use super::solver_tests::some;
use super::tests::written;
use super::*;

#[test]
fn a_file_says_what_lammps_reads() {
    let table = some(2, 5);
    let text = String::from_utf8(written(ParticleFormat::Lammps, &table)).unwrap();
    let expected = "\
# particles of sphpack, atom style sph: id type rho esph cv x y z

5 atoms
4 atom types

-1 1.4333333333333333 xlo xhi
-2 2 ylo yhi
-0.05 0.05 zlo zhi

Masses

1 10 # free fluid
2 0.025 # free solid  wing #1, \"quoted\" 'name' \n\
3 0.02425 # fixed solid  wing #1, \"quoted\" 'name' \n\
4 9.7e-6 # boundary solid flap & <Ω> 翼/\\>

Atoms # sph

36 1 1000 0 1 0.1 -0 0
29 4 0.001 0 1 0.43333333333333335 -0.2 0
22 2 2.5 0 1 0.7666666666666666 -0.4 0
15 3 2.5 0 1 1.1 -0.6000000000000001 0
8 1 1000 0 1 1.4333333333333333 -0.8 0
";
    for (is, instead) in text.lines().zip(expected.lines()) {
        assert_eq!(is, instead);
    }
    assert_eq!(text.lines().count(), expected.lines().count());
}

#[test]
fn masses_that_all_differ_are_refused() {
    let mut table = some(3, 300);
    for (i, mass) in table.mass.iter_mut().enumerate() {
        *mass = 1.0 + i as f64;
    }
    let refusal = |table: &Table| {
        let mut bytes = Vec::new();
        let error = write_lammps(table, &mut bytes).unwrap_err().to_string();
        assert!(bytes.is_empty());
        error
    };
    for part in ["more than 256 masses", "packing.masses = \"equal\""] {
        assert!(refusal(&table).contains(part));
    }
    let mut table = some(3, 2);
    table.mass[1] = 0.0;
    assert!(refusal(&table).contains("the mass of particle 7 is 0"));
    let mut table = some(3, 1);
    table.id[0] = i32::MAX as u32;
    assert!(refusal(&table).contains("particle 2147483647 has a number"));
}

#[test]
fn files_of_others_and_damaged_ones() {
    let text = "\
LAMMPS data file via write_data, version 2 Aug 2023

2 atoms
1 atom types
0 1 xlo xhi
0 1 ylo yhi
-.5 .5 zlo zhi

Masses

1 0.5

Pair Coeffs # sph/taitwater

1 1000 100 1

Atoms # sph

2 1 1000 0 1 .5 .25 0 0 0 0
1 1 1001 0 1 .125 1e-1 0 0 0 0

Velocities

1 0 0 0
2 0 0 0
";
    let read = |text: &str| read_lammps(text.as_bytes(), Path::new("p.data"));
    let columns = read(text).unwrap();
    assert_eq!(columns.numbers["x"], [0.5, 0.125]);
    assert_eq!(columns.numbers["y"], [0.25, 0.1]);
    assert_eq!(columns.numbers["id"], [1.0, 0.0]);
    assert_eq!(columns.numbers["density"], [1000.0, 1001.0]);
    assert_eq!(columns.numbers["mass"], [0.5, 0.5]);
    assert!(columns.words.is_empty());
    for (from, to, part) in [
        ("2 atoms", "3 atoms", "2 atoms instead of 3"),
        ("2 atoms", "", "no data file of LAMMPS"),
        (
            "2 atoms",
            "99999999999999999999 atoms",
            "the number of atoms",
        ),
        ("# sph\n\n2", "# atomic\n\n2", "style atomic"),
        ("1 1 1001", "1 9 1001", "type 9 has no mass"),
        ("1 1 1001 0", "1 1 1001", "10 numbers"),
        ("1e-1", "1e-", "p.data:20: \"1e-\" is no finite number"),
        (".125", "nan", "no finite number"),
        ("1 0.5", "1", "a mass is a type and a number"),
    ] {
        let message = read(&text.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
}
