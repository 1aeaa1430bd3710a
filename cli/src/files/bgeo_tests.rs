//! BGEO files, byte by byte.

use std::path::Path;

use super::solver_tests::some;
use super::tests::written;
use super::*;

/// Takes a file apart from its front.
struct Bytes(Vec<u8>);

impl Bytes {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let rest = self.0.split_off(N);
        std::mem::replace(&mut self.0, rest).try_into().unwrap()
    }

    fn int(&mut self) -> i32 {
        i32::from_be_bytes(self.take())
    }

    fn float(&mut self) -> f32 {
        f32::from_be_bytes(self.take())
    }
}

#[test]
fn a_file_is_as_partio_writes_it() {
    for dimension in [2, 3] {
        let table = some(dimension, 23);
        let mut bytes = Bytes(written(ParticleFormat::Bgeo, &table));
        assert_eq!(&bytes.take::<5>(), b"BgeoV");
        let head: Vec<i32> = (0..9).map(|_| bytes.int()).collect();
        assert_eq!(head, [5, 23, 0, 0, 0, 5, 0, 0, 0]);
        for (name, size, kind) in [
            ("velocity", 3, 5),
            ("pscale", 1, 0),
            ("id", 1, 1),
            ("mass", 1, 0),
            ("density", 1, 0),
        ] {
            assert_eq!(u16::from_be_bytes(bytes.take()), name.len() as u16);
            let letters: Vec<u8> = name.bytes().map(|_| bytes.take::<1>()[0]).collect();
            assert_eq!(letters, name.as_bytes());
            assert_eq!(u16::from_be_bytes(bytes.take()), size);
            assert_eq!(bytes.int(), kind);
            (0..size).for_each(|_| assert_eq!(bytes.int(), 0));
        }
        for i in 0..23 {
            let row: Vec<f32> = (0..8).map(|_| bytes.float()).collect();
            let [x, y, z] = table.position[i].map(|number| number as f32);
            assert_eq!(row, [x, y, z, 1.0, 0.0, 0.0, 0.0, 0.05]);
            assert_eq!(bytes.int(), table.id[i] as i32);
            assert_eq!(bytes.float(), table.mass[i] as f32);
            assert_eq!(bytes.float(), table.density_of(i) as f32);
        }
        assert_eq!(bytes.0, [0x00, 0xff]);
    }
}

#[test]
fn what_is_too_large_or_damaged() {
    let mut table = some(3, 3);
    table.position[1][2] = 1e39;
    let mut bytes = Vec::new();
    let message = write_bgeo(&table, &mut bytes).unwrap_err().to_string();
    assert!(
        message.contains("z of particle 14 is 1e39, too large"),
        "{message}"
    );
    assert!(bytes.is_empty());
    let good = written(ParticleFormat::Bgeo, &some(3, 3));
    let read = |bytes: &[u8]| read_bgeo(bytes, Path::new("p.bgeo"));
    for end in 0..good.len() {
        assert!(read(&good[..end]).is_err());
    }
    for (at, byte, part) in [
        (4, b'A', "no BGEO file"),
        (8, 6, "of version 6"),
        (9, 255, "negative"),
        (9, 127, "cut off"),
        (25, 127, "cut off"),
        (56, 4, "type 4"),
    ] {
        let mut bad = good.clone();
        bad[at] = byte;
        let message = read(&bad).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
}
