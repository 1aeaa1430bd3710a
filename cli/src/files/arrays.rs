//! The arrays that every binary particle file has, their numbers and names.

use std::io::{self, Write};

use sphpack_packing::Kind;
use sphpack_separation::Side;

use super::number_type::ByteOrder;
use crate::table::Table;

/// Rows that are turned into bytes at a time.
const BLOCK: usize = 2048;

/// One number, or one point, for every row.
pub(super) enum Values<'a> {
    Byte(Box<dyn Fn(usize) -> u8 + 'a>),
    Int(Box<dyn Fn(usize) -> i32 + 'a>),
    Unsigned(Box<dyn Fn(usize) -> u32 + 'a>),
    Long(Box<dyn Fn(usize) -> i64 + 'a>),
    Float(Box<dyn Fn(usize) -> f64 + 'a>),
    Point(Box<dyn Fn(usize) -> [f64; 3] + 'a>),
}

/// One array of a file.
pub(super) struct Array<'a> {
    pub(super) name: &'static str,
    pub(super) values: Values<'a>,
}

impl<'a> Array<'a> {
    pub(super) fn byte(name: &'static str, value: impl Fn(usize) -> u8 + 'a) -> Self {
        let values = Values::Byte(Box::new(value));
        Self { name, values }
    }

    pub(super) fn int(name: &'static str, value: impl Fn(usize) -> i32 + 'a) -> Self {
        let values = Values::Int(Box::new(value));
        Self { name, values }
    }

    pub(super) fn unsigned(name: &'static str, value: impl Fn(usize) -> u32 + 'a) -> Self {
        let values = Values::Unsigned(Box::new(value));
        Self { name, values }
    }

    pub(super) fn long(name: &'static str, value: impl Fn(usize) -> i64 + 'a) -> Self {
        let values = Values::Long(Box::new(value));
        Self { name, values }
    }

    pub(super) fn float(name: &'static str, value: impl Fn(usize) -> f64 + 'a) -> Self {
        let values = Values::Float(Box::new(value));
        Self { name, values }
    }

    pub(super) fn point(name: &'static str, value: impl Fn(usize) -> [f64; 3] + 'a) -> Self {
        let values = Values::Point(Box::new(value));
        Self { name, values }
    }

    /// Numbers in each row.
    pub(super) fn components(&self) -> usize {
        if matches!(self.values, Values::Point(_)) {
            3
        } else {
            1
        }
    }

    /// Bytes of one row.
    pub(super) fn size(&self) -> usize {
        match self.values {
            Values::Byte(_) => 1,
            Values::Int(_) | Values::Unsigned(_) => 4,
            Values::Long(_) | Values::Float(_) => 8,
            Values::Point(_) => 24,
        }
    }

    /// Appends the bytes of row `i`.
    pub(super) fn put(&self, i: usize, order: ByteOrder, to: &mut Vec<u8>) {
        macro_rules! put {
            ($number:expr) => {
                match order {
                    ByteOrder::Little => to.extend($number.to_le_bytes()),
                    ByteOrder::Big => to.extend($number.to_be_bytes()),
                }
            };
        }
        match &self.values {
            Values::Byte(value) => to.push(value(i)),
            Values::Int(value) => put!(value(i)),
            Values::Unsigned(value) => put!(value(i)),
            Values::Long(value) => put!(value(i)),
            Values::Float(value) => put!(value(i)),
            Values::Point(value) => {
                for number in value(i) {
                    put!(number);
                }
            }
        }
    }

    /// Writes `count` rows, a block at a time.
    pub(super) fn write(
        &self,
        count: usize,
        order: ByteOrder,
        to: &mut dyn Write,
    ) -> io::Result<()> {
        in_blocks(count, to, |i, block| self.put(i, order, block))
    }
}

/// Writes what `put` appends for each row, with the memory of one block.
pub(super) fn in_blocks(
    count: usize,
    to: &mut dyn Write,
    put: impl Fn(usize, &mut Vec<u8>),
) -> io::Result<()> {
    let mut block = Vec::new();
    for start in (0..count).step_by(BLOCK) {
        block.clear();
        for i in start..count.min(start + BLOCK) {
            put(i, &mut block);
        }
        to.write_all(&block)?;
    }
    Ok(())
}

/// The positions, with z = 0 in 2-D.
pub(super) fn points(table: &Table) -> Array<'_> {
    Array::point("Points", |i| table.position[i])
}

/// `kind`, `side` and `body` as places in their lists of names; a body's is −1 where there is none.
pub(super) fn codes(table: &Table) -> [Array<'_>; 3] {
    [
        Array::byte("kind", |i| place(&Kind::ALL, table.kind[i])),
        Array::byte("side", |i| place(&Side::ALL, table.side[i])),
        Array::int("body", |i| table.body[i].map_or(-1, i32::from)),
    ]
}

/// `volume` to `residual`, and `pressure` and `distance` where the table has them.
pub(super) fn measures(table: &Table) -> Vec<Array<'_>> {
    let mut all = vec![
        Array::float("volume", |i| table.volume[i]),
        Array::float("mass", |i| table.mass[i]),
        Array::float("density", |i| table.density_of(i)),
        Array::float("h", |i| table.smoothing_length_of(i)),
        Array::float("spacing", |i| table.spacing_of(i)),
        Array::float("gamma", |i| table.gamma[i]),
        Array::float("residual", |i| table.residual[i]),
    ];
    if !table.pressure.is_empty() {
        all.push(Array::float("pressure", |i| table.pressure[i]));
    }
    if !table.distance.is_empty() {
        all.push(Array::float("distance", |i| table.distance[i]));
    }
    all
}

/// `nx` to `nz`, `nz` only in 3-D.
pub(super) fn normals(table: &Table) -> Vec<Array<'_>> {
    ["nx", "ny", "nz"][..table.dimension.max(2)]
        .iter()
        .enumerate()
        .map(|(axis, name)| Array::float(name, move |i| table.normal(i)[axis]))
        .collect()
}

/// `normal` and `velocity`, which is 0, with three components each.
pub(super) fn vectors(table: &Table) -> [Array<'_>; 2] {
    [
        Array::point("normal", |i| table.normal(i)),
        Array::point("velocity", |_| [0.0; 3]),
    ]
}

/// What the codes stand for: the column, and its names in order.
pub(super) fn code_names(table: &Table) -> [(&'static str, Vec<&str>); 3] {
    [
        ("kind", Kind::ALL.map(Kind::name).to_vec()),
        ("side", Side::ALL.map(Side::name).to_vec()),
        ("body", table.bodies.iter().map(String::as_str).collect()),
    ]
}

/// The place of `one` in its list.
pub(super) fn place<T: PartialEq>(all: &[T], one: T) -> u8 {
    all.iter().position(|other| *other == one).unwrap_or(0) as u8
}
