//! Particles as the points of a BGEO file, version 5, as Houdini and SPlisHSPlasH read them.

use std::io::{self, Write};

use super::arrays::in_blocks;
use crate::table::Table;

/// Types of attributes.
const FLOAT: i32 = 0;
const INT: i32 = 1;
const VECTOR: i32 = 5;

/// Name, numbers in each row and type of what every point has besides its place.
const ATTRIBUTES: [(&str, u16, i32); 5] = [
    ("velocity", 3, VECTOR),
    ("pscale", 1, FLOAT),
    ("id", 1, INT),
    ("mass", 1, FLOAT),
    ("density", 1, FLOAT),
];

/// Writes particles as points, big-endian, all numbers in 32 bits (partio's `BGEO.cpp`): x, y, z (0 in 2-D) and 1; then `velocity`, which is 0,
/// `pscale`, the radius, which is half the spacing, `id`, `mass` and `density`. SPlisHSPlasH reads the place and velocity, and takes the
/// radius from the first point. Lengths are scene units. Which body a particle belongs to and normals are not in it.
///
/// # Errors
/// Those of `to`; before anything is written, where a number is not finite or too large for 32 bits, or particles are more than 2³¹ − 1.
pub fn write_bgeo(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    super::validate::check_single(table, |i| {
        let [x, y, z] = table.position[i];
        [
            ("x", x),
            ("y", y),
            ("z", z),
            ("spacing", table.spacing_of(i)),
            ("mass", table.mass[i]),
            ("density", table.density_of(i)),
        ]
    })?;
    let refuse = |message: &str| Err(io::Error::new(io::ErrorKind::InvalidData, message));
    let Ok(count) = i32::try_from(table.len()) else {
        return refuse("a BGEO file holds up to 2147483647 particles; use another format");
    };
    let mut head = b"BgeoV".to_vec();
    for number in [5, count, 0, 0, 0, ATTRIBUTES.len() as i32, 0, 0, 0] {
        head.extend(i32::to_be_bytes(number));
    }
    for (name, size, kind) in ATTRIBUTES {
        head.extend((name.len() as u16).to_be_bytes());
        head.extend(name.bytes());
        head.extend(size.to_be_bytes());
        head.extend(kind.to_be_bytes());
        // What a point has that says nothing.
        head.extend(std::iter::repeat_n(0, 4 * usize::from(size)));
    }
    to.write_all(&head)?;
    in_blocks(table.len(), to, |i, block| {
        let mut put = |number: f64| block.extend((number as f32).to_be_bytes());
        table.position[i].into_iter().for_each(&mut put);
        put(1.0);
        [0.0; 3].into_iter().for_each(&mut put);
        put(0.5 * table.spacing_of(i));
        block.extend(table.id[i].to_be_bytes());
        for number in [table.mass[i], table.density_of(i)] {
            block.extend((number as f32).to_be_bytes());
        }
    })?;
    to.write_all(&[0x00, 0xff])
}
