//! Reading BGEO files, version 5, as far as particles need it: points and their attributes.

use std::path::Path;

use super::Columns;
use super::number_type::{ByteOrder, NumberType};
use crate::Error;

/// Reads particles: `x`, `y`, `z`, and each attribute of one number by its name; `id` as written by sphpack counts beyond 2³¹. From `pscale`,
/// the radius, comes `spacing`, twice as much.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, or of another version.
pub fn read_bgeo(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    read(bytes).map_err(|message| Error::input(path, message))
}

fn damaged(what: &str) -> String {
    format!("the BGEO file is damaged: {what}; write it again")
}

/// One attribute of every point.
struct Attribute {
    name: String,
    size: usize,
    kind: NumberType,
}

/// What is left of a file.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) =
            (self.0.split_at_checked(count)).ok_or_else(|| damaged("it is cut off"))?;
        self.0 = rest;
        Ok(taken)
    }

    fn short(&mut self) -> Result<usize, String> {
        Ok(self
            .take(2)?
            .iter()
            .fold(0, |sum, &byte| 256 * sum + usize::from(byte)))
    }

    fn int(&mut self) -> Result<i32, String> {
        let bytes = self.take(4)?;
        Ok(bytes
            .iter()
            .fold(0, |sum, &byte| sum << 8 | i32::from(byte)))
    }

    fn attribute(&mut self) -> Result<Attribute, String> {
        let length = self.short()?;
        let name = String::from_utf8_lossy(self.take(length)?).into_owned();
        let size = self.short()?;
        let kind = match self.int()? {
            0 | 5 => NumberType::F32,
            1 if name == "id" => NumberType::U32,
            1 => NumberType::I32,
            other => {
                return Err(format!(
                    "attribute {name} of the BGEO file is of type {other}, which is not read; leave it out"
                ));
            }
        };
        self.take(4 * size)?;
        Ok(Attribute { name, size, kind })
    }
}

fn read(bytes: &[u8]) -> Result<Columns, String> {
    let mut rest = Rest(bytes);
    if !bytes.starts_with(b"BgeoV") {
        return Err("this is no BGEO file of version 5; one begins with \"BgeoV\"".into());
    }
    rest.take(5)?;
    let mut head = [0; 9];
    for number in &mut head {
        *number = rest.int()?;
    }
    let [version, points, .., point_attributes, _, _, _] = head;
    if version != 5 {
        return Err(format!(
            "this is a BGEO file of version {version}; save it as version 5"
        ));
    }
    let count = |number: i32| usize::try_from(number).map_err(|_| damaged("a number is negative"));
    let (points, point_attributes) = (count(points)?, count(point_attributes)?);
    let mut attributes = Vec::new();
    for _ in 0..point_attributes {
        attributes.push(rest.attribute()?);
    }
    let place = Attribute {
        name: String::new(),
        size: 4,
        kind: NumberType::F32,
    };
    attributes.insert(0, place);
    let row: usize = attributes.iter().map(|attribute| 4 * attribute.size).sum();
    let size = points
        .checked_mul(row)
        .ok_or_else(|| damaged("it is cut off"))?;
    let all = rest.take(size)?;
    // What ends a file.
    rest.take(2)?;
    let mut columns = Columns::default();
    let mut begin = 0;
    for attribute in &attributes {
        let mut insert = |name: &str, at: usize, factor: f64| {
            let numbers = (all.chunks_exact(row))
                .filter_map(|row| attribute.kind.number(ByteOrder::Big, &row[at..]))
                .map(|number| factor * number)
                .collect();
            columns.numbers.insert(name.to_owned(), numbers);
        };
        match attribute.name.as_str() {
            "" => (["x", "y", "z"].iter().zip([0, 4, 8]))
                .for_each(|(name, at)| insert(name, begin + at, 1.0)),
            "pscale" if attribute.size == 1 => insert("spacing", begin, 2.0),
            name if attribute.size == 1 => insert(name, begin, 1.0),
            _ => {}
        }
        begin += 4 * attribute.size;
    }
    Ok(columns)
}
