//! Reading cases of DualSPHysics, as far as particles need it: the binary part.

use std::collections::BTreeMap;
use std::path::Path;

use super::Columns;
use super::bi4_items::{
    ARRAY, BOOL, DOUBLE, DOUBLE3, FLOAT, FLOAT3, HEAD, INT, ITEM, TEXT, TITLE, UINT, ULONG, VALUES,
};
use super::number_type::{ByteOrder, NumberType};
use crate::Error;

/// Reads particles: `x`, `y`, `z`, the file's z being y where it says that it is of the plane; `id`, `rho`, `m` by the two masses, and
/// `to_surface_x` … from `BoundNor`, 0 for fluid; `side` as a word.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, big-endian, or has no particles' part.
pub fn read_bi4(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    read(bytes).map_err(|message| Error::input(path, message))
}

fn damaged(what: &str) -> String {
    format!("the BI4 file is damaged: {what}; write it again")
}

/// Items in items that are followed.
const DEEPEST: usize = 8;

/// What is left of a file, or of a part of it.
struct Rest<'a> {
    bytes: &'a [u8],
    is_wide: bool,
}

/// Numbers one after the other.
struct Array<'a> {
    kind: NumberType,
    /// Numbers in each row.
    components: usize,
    bytes: &'a [u8],
}

/// What a file holds, by name.
#[derive(Default)]
struct Found<'a> {
    values: BTreeMap<String, f64>,
    arrays: BTreeMap<String, Array<'a>>,
}

/// The numbers of a type, and how many there are.
fn numbers(kind: i32) -> Option<(NumberType, usize)> {
    Some(match kind {
        BOOL | INT => (NumberType::I32, 1),
        3 => (NumberType::I8, 1),
        4 => (NumberType::U8, 1),
        5 => (NumberType::I16, 1),
        6 => (NumberType::U16, 1),
        UINT => (NumberType::U32, 1),
        9 => (NumberType::I64, 1),
        ULONG => (NumberType::U64, 1),
        FLOAT => (NumberType::F32, 1),
        DOUBLE => (NumberType::F64, 1),
        20 => (NumberType::I32, 3),
        21 => (NumberType::U32, 3),
        FLOAT3 => (NumberType::F32, 3),
        DOUBLE3 => (NumberType::F64, 3),
        _ => return None,
    })
}

impl<'a> Rest<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) =
            (self.bytes.split_at_checked(count)).ok_or_else(|| damaged("it is cut off"))?;
        self.bytes = rest;
        Ok(taken)
    }

    /// A number of so many bytes.
    fn number(&mut self, width: usize) -> Result<usize, String> {
        let bytes = self.take(width)?;
        let number = bytes
            .iter()
            .rev()
            .fold(0_u64, |sum, &byte| sum << 8 | u64::from(byte));
        usize::try_from(number).map_err(|_| damaged("it is cut off"))
    }

    fn kind(&mut self) -> Result<i32, String> {
        let number = self.number(4)?;
        i32::try_from(number).map_err(|_| damaged("nobody knows a type of it"))
    }

    fn text(&mut self) -> Result<String, String> {
        let length = self.number(4)?;
        Ok(String::from_utf8_lossy(self.take(length)?).into_owned())
    }

    /// The part of as many bytes as come first, which begins with `mark`.
    fn definition(&mut self, mark: &str) -> Result<Self, String> {
        let length = self.number(4)?;
        let mut part = Rest {
            bytes: self.take(length)?,
            is_wide: self.is_wide,
        };
        if part.text()? != mark {
            return Err(damaged(&format!("a part does not begin with {:?}", mark)));
        }
        Ok(part)
    }

    fn item(&mut self, found: &mut Found<'a>, depth: usize) -> Result<(), String> {
        if depth > DEEPEST {
            return Err(damaged("its items are too many in each other"));
        }
        let mut definition = self.definition(ITEM)?;
        definition.text()?;
        definition.take(8)?;
        definition.text()?;
        definition.text()?;
        let [arrays, items, size] = [
            definition.number(4)?,
            definition.number(4)?,
            definition.number(4)?,
        ];
        if size > 0 {
            let mut values = Rest {
                bytes: self.take(size)?,
                is_wide: self.is_wide,
            };
            values.values(found)?;
        }
        for _ in 0..arrays {
            self.array(found)?;
        }
        for _ in 0..items {
            self.item(found, depth + 1)?;
        }
        Ok(())
    }

    fn values(&mut self, found: &mut Found<'a>) -> Result<(), String> {
        if self.text()? != VALUES {
            return Err(damaged("its values do not begin as such"));
        }
        for _ in 0..self.number(4)? {
            let name = self.text()?;
            let kind = self.kind()?;
            if kind == TEXT {
                self.text()?;
                continue;
            }
            let (number, count) =
                numbers(kind).ok_or_else(|| damaged("nobody knows a type of it"))?;
            let bytes = self.take(count * number.size())?;
            // Of three, the first: none of them is needed.
            if let Some(value) = number.number(ByteOrder::Little, bytes) {
                found.values.insert(name, value);
            }
        }
        Ok(())
    }

    fn array(&mut self, found: &mut Found<'a>) -> Result<(), String> {
        let mut definition = self.definition(ARRAY)?;
        let name = definition.text()?;
        definition.take(4)?;
        let kind = definition.kind()?;
        let width = if self.is_wide { 8 } else { 4 };
        let (count, size) = (definition.number(width)?, definition.number(width)?);
        let bytes = self.take(size)?;
        let Some((kind, components)) = numbers(kind) else {
            return Ok(());
        };
        if count.checked_mul(components * kind.size()) != Some(size) {
            return Err(damaged(&format!("array {name} has no whole rows")));
        }
        let array = Array {
            kind,
            components,
            bytes,
        };
        found.arrays.insert(name, array);
        Ok(())
    }
}

impl Array<'_> {
    fn column(&self, component: usize) -> Vec<f64> {
        let size = self.kind.size();
        (self.bytes.chunks_exact(size * self.components))
            .filter_map(|row| {
                self.kind
                    .number(ByteOrder::Little, &row[component * size..])
            })
            .collect()
    }
}

fn read(bytes: &[u8]) -> Result<Columns, String> {
    let head = bytes.get(..HEAD).filter(|head| head.starts_with(TITLE));
    let head = head.ok_or(
        "this is no file of particles of DualSPHysics; one begins with \"#FileJBD JPartDataBi4\"",
    )?;
    if head[60] % 10 != 0 {
        return Err("the BI4 file is big-endian, which is not read; save it little-endian".into());
    }
    let mut rest = Rest {
        bytes: &bytes[HEAD..],
        is_wide: head[61] == 1,
    };
    let mut found = Found::default();
    rest.item(&mut found, 0)?;
    let array = |name: &str, components: usize| {
        let array = found.arrays.get(name);
        array.filter(|array| array.components == components)
    };
    let needed = |name: &str, components| {
        array(name, components).ok_or_else(|| damaged(&format!("it has no array {name}")))
    };
    let (id, density) = (needed("Idp", 1)?.column(0), needed("Rhop", 1)?.column(0));
    let place = array("Posd", 3).map_or_else(|| needed("Pos", 3), Ok)?;
    let place = [0, 1, 2].map(|axis| place.column(axis));
    let rows = id.len();
    if density.len() != rows || place[0].len() != rows {
        return Err(damaged("its arrays are not of one length"));
    }
    let value = |name: &str| found.values.get(name).copied();
    let needed = |name: &str| value(name).ok_or_else(|| damaged(&format!("it has no {name}")));
    let bound = needed("CaseNp")? - needed("CaseNfluid")?;
    let masses = [needed("MassBound")?, needed("MassFluid")?];
    let mass = id.iter().map(|&id| masses[usize::from(id >= bound)]);
    let side = id
        .iter()
        .map(|&id| if id < bound { "solid" } else { "fluid" });
    let is_plane = value("Data2d") == Some(1.0);
    // Where the file has the axis.
    let axes = if is_plane { [0, 2, 1] } else { [0, 1, 2] };
    let mut columns = Columns::default();
    columns
        .words
        .insert("side".to_owned(), side.map(str::to_owned).collect());
    columns.numbers.insert("m".to_owned(), mass.collect());
    let way = array("BoundNor", 3);
    for (name, axis) in ["to_surface_x", "to_surface_y", "to_surface_z"]
        .into_iter()
        .zip(axes)
    {
        let mut along = way.map_or_else(Vec::new, |way| way.column(axis));
        along.resize(rows, 0.0);
        columns.numbers.insert(name.to_owned(), along);
    }
    columns.numbers.insert("id".to_owned(), id);
    columns.numbers.insert("rho".to_owned(), density);
    let [x, y, z] = place;
    let (y, z) = if is_plane { (z, y) } else { (y, z) };
    for (name, numbers) in [("x", x), ("y", y), ("z", z)] {
        columns.numbers.insert(name.to_owned(), numbers);
    }
    Ok(columns)
}
