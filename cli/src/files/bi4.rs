//! Particles as a case of DualSPHysics: the binary part.

use std::io::{self, Write};

use super::arrays::in_blocks;
use super::bi4_case::Case;
use super::bi4_items::{DOUBLE3, FLOAT, FLOAT3, UINT, Value, array, head, item};
use crate::table::Table;

/// Writes particles as `CASE.bi4` of DualSPHysics (`JPartDataBi4.cpp`), which reads it beside `CASE.xml` ([`super::write_bi4_xml`]). Bodies come first, as
/// fixed boundaries, in the scene's order; then the fluid. Ids are places. Places are in 64 bits; velocity (0), density and the way from
/// boundary particles to the true surface (`BoundNor`) in 32. In 2-D the plane's y is the file's z, and its y is 0.
/// Units are SI: lengths in metres, densities in kg/m³. There is one mass for the fluid and one for boundaries: their mean
/// volume times the fluid's density, which boundaries have in this solver whatever bodies are made of. `BoundNor` is 0 inside bodies, on
/// containers and on exact surfaces.
///
/// # Errors
/// Those of `to`; before anything is written, where a number is not finite or too large for 32 bits, the fluid has more than one mass, or nobody says its density,
/// or an axis is periodic.
pub fn write_bi4(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    // The largest array has 24 bytes for each.
    let is_wide = 24 * table.len() as u64 > u64::from(u32::MAX);
    write(table, is_wide, to)
}

/// Of either width of sizes.
pub(super) fn write(table: &Table, is_wide: bool, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    let case = Case::of(table)?;
    super::validate::check_single(table, |i| {
        let [x, y, z] = case.to_surface(i);
        [
            ("density", case.density_of(i)),
            ("nx", x),
            ("ny", y),
            ("nz", z),
        ]
    })?;
    let count = table.len();
    let fixed = case.bound as u64;
    let [low, high] = table.bounds().map(|corner| case.axes(corner));
    let [spacing, smoothing_length] = case.lengths();
    let zero = [0.0; 3];
    let root = [
        ("Piece", Value::Uint(0)),
        ("Npiece", Value::Uint(1)),
        ("RunCode", Value::Text("")),
        ("Date", Value::Text("")),
        ("AppName", Value::Text("sphpack")),
        ("CaseName", Value::Text("")),
        ("Data2d", Value::Bool(table.dimension == 2)),
        ("Data2dPosY", Value::Double(0.0)),
        ("MapPosMin", Value::Double3(zero)),
        ("MapPosMax", Value::Double3(zero)),
        ("PeriMode", Value::Int(UNKNOWN_PERIODS)),
        ("PeriXinc", Value::Double3(zero)),
        ("PeriYinc", Value::Double3(zero)),
        ("PeriZinc", Value::Double3(zero)),
        ("AxisDiv", Value::Int(UNKNOWN_DIVISION)),
        ("CaseNp", Value::Ulong(count as u64)),
        ("CaseNfixed", Value::Ulong(fixed)),
        ("CaseNmoving", Value::Ulong(0)),
        ("CaseNfloat", Value::Ulong(0)),
        ("CaseNfluid", Value::Ulong(count as u64 - fixed)),
        ("CasePosMin", Value::Double3(low)),
        ("CasePosMax", Value::Double3(high)),
        ("NpDynamic", Value::Bool(false)),
        ("ReuseIds", Value::Bool(false)),
        ("Dp", Value::Double(spacing)),
        ("H", Value::Double(smoothing_length)),
        ("B", Value::Double(case.stiffness())),
        ("Rhop0", Value::Double(case.density)),
        ("Gamma", Value::Double(super::bi4_xml::GAMMA)),
        ("MassBound", Value::Double(case.mass_bound)),
        ("MassFluid", Value::Double(case.mass_fluid)),
    ];
    let part = [
        ("Cpart", Value::Uint(0)),
        ("TimeStep", Value::Double(0.0)),
        ("Npok", Value::Uint(count as u32)),
        ("Nout", Value::Uint(0)),
        ("Step", Value::Uint(0)),
        ("RunTime", Value::Double(0.0)),
        ("DomainMin", Value::Double3(low)),
        ("DomainMax", Value::Double3(high)),
    ];
    to.write_all(&head(is_wide))?;
    to.write_all(&item("JPartDataBi4", &root, 0, 1))?;
    let arrays = if case.bound > 0 { 5 } else { 4 };
    to.write_all(&item("PART_0000", &part, arrays, 0))?;
    let row = |place: usize| case.order[place] as usize;
    let floats = |numbers: [f64; 3], block: &mut Vec<u8>| {
        block.extend(numbers.iter().flat_map(|n| (*n as f32).to_le_bytes()));
    };
    to.write_all(&array("Idp", UINT, count, 4, is_wide))?;
    in_blocks(count, to, |place, block| {
        block.extend((place as u32).to_le_bytes());
    })?;
    to.write_all(&array("Posd", DOUBLE3, count, 24, is_wide))?;
    in_blocks(count, to, |place, block| {
        let axes = case.axes(table.position[row(place)]);
        block.extend(axes.iter().flat_map(|n| n.to_le_bytes()));
    })?;
    to.write_all(&array("Vel", FLOAT3, count, 12, is_wide))?;
    in_blocks(count, to, |_, block| floats(zero, block))?;
    to.write_all(&array("Rhop", FLOAT, count, 4, is_wide))?;
    in_blocks(count, to, |place, block| {
        block.extend((case.density_of(row(place)) as f32).to_le_bytes());
    })?;
    if case.bound == 0 {
        return Ok(());
    }
    to.write_all(&array("BoundNor", FLOAT3, case.bound, 12, is_wide))?;
    in_blocks(case.bound, to, |place, block| {
        floats(case.axes(case.to_surface(row(place))), block);
    })
}

/// The solver is to go by its parameters.
const UNKNOWN_PERIODS: i32 = 96;
const UNKNOWN_DIVISION: i32 = 99;
