//! What DualSPHysics is to know of particles: blocks, masses, densities, the way to the surface.

use std::io;
use std::rc::Rc;

use super::by_body::{by_body, place_of_body};
use super::columns::Entries;
use crate::table::Table;

/// How far masses may differ that are one, as a part of them: rounding does.
const SAME_MASS: f64 = 1e-6;

/// Particles of one body, or of the fluid.
pub(super) struct Block {
    /// The place of the body; that of the fluid is behind them all.
    pub(super) body: usize,
    /// The number of the first particle.
    pub(super) begin: usize,
    pub(super) count: usize,
}

/// Particles as a case: first those of bodies, which are fixed, then the fluid.
pub(super) struct Case<'t> {
    pub(super) table: &'t Table,
    /// The rows of the table in the order of the case.
    pub(super) order: Vec<u32>,
    pub(super) blocks: Vec<Block>,
    /// How many belong to bodies.
    pub(super) bound: usize,
    /// The fluid's density at rest.
    pub(super) density: f64,
    pub(super) mass_bound: f64,
    pub(super) mass_fluid: f64,
}

impl<'t> Case<'t> {
    /// The case of a table.
    ///
    /// # Errors
    /// Where the fluid has more than one mass, or an axis is periodic.
    pub(super) fn of(table: &'t Table) -> io::Result<Self> {
        let refuse = |message: String| Err(io::Error::new(io::ErrorKind::InvalidData, message));
        if table.shared.periodic.contains(&true) {
            return refuse(
                "DualSPHysics takes a period from where particles are, which is not the period of packed ones; use a domain that is not periodic, or another format"
                    .to_owned(),
            );
        }
        let order = by_body(table);
        let mut blocks: Vec<Block> = Vec::new();
        for (begin, &i) in order.iter().enumerate() {
            let body = place_of_body(table, i as usize);
            match blocks.last_mut().filter(|block| block.body == body) {
                Some(block) => block.count += 1,
                None => blocks.push(Block {
                    body,
                    begin,
                    count: 1,
                }),
            }
        }
        let fluid = blocks
            .last()
            .filter(|block| block.body == table.bodies.len());
        let bound = fluid.map_or(table.len(), |fluid| fluid.begin);
        // Tables of columns alone have no common ones.
        let first = order.get(bound).map(|&i| table.density_of(i as usize));
        let density = match table.shared.density_of(None) {
            0.0 => first.unwrap_or(0.0),
            common => common,
        };
        if !table.is_empty() && density <= 0.0 {
            return refuse(
                "nothing says the density of the fluid, which DualSPHysics gives to boundaries too; keep the fluid, or use another format"
                    .to_owned(),
            );
        }
        let mass_fluid = order.get(bound).map(|&i| table.mass[i as usize]);
        let is_same =
            |mass: f64| mass_fluid.is_none_or(|one| (mass - one).abs() <= SAME_MASS * one);
        if let Some(&i) = order[bound..]
            .iter()
            .find(|&&i| !is_same(table.mass[i as usize]))
        {
            return refuse(format!(
                "DualSPHysics has one mass for all of the fluid, and particle {} has {} where another has {}; write packing.masses = \"equal\", leave frozen particles and [refinement] out, or, where the fluid has several pockets, choose another format",
                table.id[i as usize],
                table.mass[i as usize],
                mass_fluid.unwrap_or_default()
            ));
        }
        let volume: f64 = order[..bound]
            .iter()
            .map(|&i| table.volume[i as usize])
            .sum();
        let mass_bound = (bound > 0).then(|| density * volume / bound as f64);
        Ok(Self {
            bound,
            density,
            mass_bound: mass_bound.or(mass_fluid).unwrap_or(0.0),
            mass_fluid: mass_fluid.or(mass_bound).unwrap_or(0.0),
            table,
            order,
            blocks,
        })
    }

    /// The spacing and the smoothing length.
    pub(super) fn lengths(&self) -> [f64; 2] {
        let (table, shared) = (self.table, &self.table.shared);
        if table.is_empty() {
            return [shared.spacing, shared.smoothing_length];
        }
        [table.spacing_of(0), table.smoothing_length_of(0)]
    }

    /// A place, or a vector, with DualSPHysics's axes: the plane has x and z.
    pub(super) fn axes(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        if self.table.dimension == 2 {
            [x, 0.0, y]
        } else {
            [x, y, z]
        }
    }

    /// The density that the solver is to begin with: walls have the fluid's.
    pub(super) fn density_of(&self, i: usize) -> f64 {
        match self.table.body_name(i) {
            Some(_) => self.density,
            None => self.table.density_of(i),
        }
    }

    /// The mass that the solver takes for particle `i`.
    pub(super) fn mass_of(&self, i: usize) -> f64 {
        match self.table.body_name(i) {
            Some(_) => self.mass_bound,
            None => self.mass_fluid,
        }
    }

    /// From a particle on the surface of a body to the true surface; 0 where nobody says, as inside.
    pub(super) fn to_surface(&self, i: usize) -> [f64; 3] {
        if self.table.is_wall(i) {
            let depth = -self.table.distance[i];
            return self.table.normal(i).map(|along| depth * along);
        }
        let inset = (self.table.body[i])
            .and_then(|body| self.table.shared.inset.get(usize::from(body)))
            .copied()
            .unwrap_or(0.0);
        self.table.normal(i).map(|along| inset * along)
    }
}

/// Numbers that a case makes of a table's, by name, for each of its rows; none of a table that is no case.
pub(super) fn derived(table: &Table) -> Vec<(&'static str, Entries<'_>)> {
    let Ok(case) = Case::of(table).map(Rc::new) else {
        return Vec::new();
    };
    let [mass, density] = [(); 2].map(|()| Rc::clone(&case));
    let mut all: Vec<(&'static str, Entries<'_>)> = vec![
        ("m", Box::new(move |i| mass.mass_of(i))),
        ("rho", Box::new(move |i| density.density_of(i))),
    ];
    for (axis, name) in ["to_surface_x", "to_surface_y", "to_surface_z"]
        .into_iter()
        .enumerate()
    {
        let case = Rc::clone(&case);
        let along = move |i: usize| match case.table.body_name(i) {
            Some(_) => case.to_surface(i)[axis],
            None => 0.0,
        };
        all.push((name, Box::new(along)));
    }
    all
}
