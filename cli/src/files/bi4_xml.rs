//! Particles as a case of DualSPHysics: the part that says what they are.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::bi4_case::Case;
use super::shortest::Short;
use super::vtk_xml::escaped;
use crate::table::Table;

/// The exponent of the state equation, as the solver has it.
pub(super) const GAMMA: f64 = 7.0;

/// The solver's own gravity, m/s².
const GRAVITY: f64 = 9.81;

/// The speed of sound over that of water that has fallen from the fluid's height, as the solver has it.
const SOUND_OVER_FALL: f64 = 20.0;

/// The solver's own part of the largest time step.
const COURANT: f64 = 0.2;

/// The first marks of boundaries and of fluids, as the solver's own tools give them.
const FIRST_BOUND: usize = 10;
const FIRST_FLUID: usize = 1;

impl Case<'_> {
    /// B of p = B ((ρ/ρ₀)^γ − 1), Pa, by the height of the fluid, along z of the file.
    pub(super) fn stiffness(&self) -> f64 {
        let heights = self.order[self.bound..]
            .iter()
            .map(|&i| self.axes(self.table.position[i as usize])[2]);
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
            (low.min(z), high.max(z))
        });
        let height = if low < high {
            high - low
        } else {
            self.lengths()[0]
        };
        SOUND_OVER_FALL * SOUND_OVER_FALL * GRAVITY * height * self.density / GAMMA
    }
}

/// Writes `CASE.xml`, which DualSPHysics reads beside `CASE.bi4` ([`super::write_bi4`]): constants, parameters, and which
/// particles are which, a body being `mkbound` by its place in the scene, from 0, with its name as a comment, and the fluid `mkfluid` 0.
/// Gravity (9.81 m/s² down), the speed of sound (20 √(g height of the fluid)), γ, Courant number and times are those that the solver's own tools
/// begin with: they are to be edited.
///
/// # Errors
/// Those of [`super::write_bi4`].
pub fn write_bi4_xml(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    let case = Case::of(table)?;
    to.write_all(text(&case).as_bytes())
}

fn text(case: &Case<'_>) -> String {
    let table = case.table;
    let (count, bound) = (table.len(), case.bound);
    let is_plane = table.dimension == 2;
    let [spacing, smoothing_length] = case.lengths();
    // Writing to a string cannot fail.
    let mut constants = format!("<data2d value=\"{is_plane}\"/>\n");
    if is_plane {
        constants += "<data2dposy value=\"0\" units_comment=\"m\"/>\n";
    }
    let _ = writeln!(
        constants,
        "<gravity x=\"0\" y=\"0\" z=\"{}\" units_comment=\"m/s^2\"/>",
        -GRAVITY
    );
    for (name, value, units) in [
        ("cflnumber", COURANT, ""),
        ("gamma", GAMMA, ""),
        ("rhop0", case.density, "kg/m^3"),
        ("dp", spacing, "m"),
        ("h", smoothing_length, "m"),
        ("b", case.stiffness(), "Pa"),
        ("massbound", case.mass_bound, "kg"),
        ("massfluid", case.mass_fluid, "kg"),
    ] {
        let value = Short(value);
        let _ = writeln!(
            constants,
            "<{name} value=\"{value}\" units_comment=\"{units}\"/>"
        );
    }
    let mut blocks = String::new();
    for block in &case.blocks {
        let (begin, count) = (block.begin, block.count);
        let _ = match table.bodies.get(block.body) {
            Some(name) => writeln!(
                blocks,
                "<fixed mkbound=\"{}\" mk=\"{}\" begin=\"{begin}\" count=\"{count}\" comment=\"{}\"/>",
                block.body,
                FIRST_BOUND + block.body,
                escaped(name)
            ),
            None => writeln!(
                blocks,
                "<fluid mkfluid=\"0\" mk=\"{FIRST_FLUID}\" begin=\"{begin}\" count=\"{count}\"/>"
            ),
        };
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<case app=\"sphpack\">\n<execution>\n<parameters>\n\
         <parameter key=\"TimeMax\" value=\"1\" units_comment=\"s\"/>\n\
         <parameter key=\"TimeOut\" value=\"0.01\" units_comment=\"s\"/>\n\
         </parameters>\n<constants>\n{constants}</constants>\n\
         <particles np=\"{count}\" nb=\"{bound}\" nbf=\"{bound}\" mkboundfirst=\"{FIRST_BOUND}\" mkfluidfirst=\"{FIRST_FLUID}\">\n\
         {blocks}</particles>\n</execution>\n</case>\n"
    )
}
