//! Particles as a data file of LAMMPS, atom style sph.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::arrays::place;
use super::shortest::Short;
use crate::table::Table;
use sphpack_packing::Kind;
use sphpack_separation::Side;

/// The largest number of an atom, where LAMMPS is built as usual.
const LAST_ATOM: u64 = i32::MAX as u64;

/// More types than this are no types.
const MOST_TYPES: usize = 256;

/// Writes particles as LAMMPS's command `read_data` reads them with `atom_style sph` (`atom_vec_sph.cpp`): a row `id type rho esph cv x y z`
/// each, ids from 1 (a particle's own and 1), energy 0, heat capacity 1; velocities are 0, which is what LAMMPS takes where a file has none.
/// There is a type for every kind of particles of a body, and of the fluid, that has a mass of its own; the comment behind its
/// mass says which: `# boundary solid wing`, `# free fluid`. The box is the domain and all particles; in 2-D z is 0,
/// half a spacing from its sides. Lengths are scene units, densities the scene's; any units of LAMMPS that agree will do.
/// Volumes, smoothing lengths and normals are not in it.
///
/// # Errors
/// Those of `to`; before anything is written, where a number is not finite, a mass is not positive, masses are more than types can
/// have, or an id is beyond 2³¹ − 2.
pub fn write_lammps(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    super::validate::check(table)?;
    let types = Types::of(table)?;
    let refuse = |message: String| Err(io::Error::new(io::ErrorKind::InvalidData, message));
    if let Some(id) = (table.id.iter()).find(|&&id| u64::from(id) + 1 > LAST_ATOM) {
        return refuse(format!(
            "particle {id} has a number that LAMMPS cannot give to an atom: {LAST_ATOM} is its last"
        ));
    }
    writeln!(
        to,
        "# particles of sphpack, atom style sph: id type rho esph cv x y z"
    )?;
    writeln!(to, "\n{} atoms", table.len())?;
    writeln!(to, "{} atom types\n", types.all.len())?;
    let [low, high] = sides(table);
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let (from, until) = (Short(low[axis]), Short(high[axis]));
        writeln!(to, "{from} {until} {name}lo {name}hi")?;
    }
    if table.is_empty() {
        return Ok(());
    }
    writeln!(to, "\nMasses\n")?;
    for (key, number) in &types.all {
        let mass = Short(f64::from_bits(key.mass));
        write!(to, "{number} {mass} # {} {}", key.kind(), key.side())?;
        let body = usize::try_from(key.body).ok();
        match body.and_then(|body| table.bodies.get(body)) {
            Some(name) => writeln!(to, " {name}")?,
            None => writeln!(to)?,
        }
    }
    writeln!(to, "\nAtoms # sph\n")?;
    for i in 0..table.len() {
        let [x, y, z] = table.position[i].map(Short);
        writeln!(
            to,
            "{} {} {} 0 1 {x} {y} {z}",
            u64::from(table.id[i]) + 1,
            types.all[&Key::of(table, i)],
            Short(table.density_of(i)),
        )?;
    }
    Ok(())
}

/// The sides of the box: none of them may be 0 long.
fn sides(table: &Table) -> [[f64; 3]; 2] {
    let [mut low, mut high] = table.bounds();
    let spacing = if table.is_empty() {
        table.shared.spacing
    } else {
        table.spacing_of(0)
    };
    let half = if spacing > 0.0 { 0.5 * spacing } else { 0.5 };
    for axis in 0..3 {
        // Where nobody says the domain, that of the particles' room.
        if low[axis] >= high[axis] || table.shared.domain.is_none() {
            low[axis] -= half;
            high[axis] += half;
        }
    }
    [low, high]
}

/// What particles of one type have in common.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    /// The place of the body; −1 for none.
    body: i32,
    side: u8,
    kind: u8,
    /// The bits of the mass.
    mass: u64,
}

impl Key {
    fn of(table: &Table, i: usize) -> Self {
        Self {
            body: table.body[i].map_or(-1, i32::from),
            side: place(&Side::ALL, table.side[i]),
            kind: place(&Kind::ALL, table.kind[i]),
            mass: table.mass[i].to_bits(),
        }
    }

    fn kind(&self) -> &'static str {
        Kind::ALL[usize::from(self.kind)].name()
    }

    fn side(&self) -> &'static str {
        Side::ALL[usize::from(self.side)].name()
    }
}

/// The types of a table's particles, numbered from 1.
struct Types {
    all: BTreeMap<Key, usize>,
}

impl Types {
    fn of(table: &Table) -> io::Result<Self> {
        let refuse = |message: String| Err(io::Error::new(io::ErrorKind::InvalidData, message));
        let mut all = BTreeMap::new();
        for i in 0..table.len() {
            if table.mass[i] <= 0.0 {
                return refuse(format!(
                    "the mass of particle {} is {}; LAMMPS takes none that is not positive",
                    table.id[i], table.mass[i]
                ));
            }
            all.insert(Key::of(table, i), 0);
            if all.len() > MOST_TYPES {
                return refuse(format!(
                    "LAMMPS has one mass per type of atoms, and these particles have more than {MOST_TYPES} masses; write packing.masses = \"equal\" and neither [refinement] nor fluid.hydrostatic, or choose another format"
                ));
            }
        }
        for (number, (_, place)) in (1..).zip(all.iter_mut()) {
            *place = number;
        }
        Ok(Self { all })
    }
}
