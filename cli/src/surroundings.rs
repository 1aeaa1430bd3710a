//! What files hold of a packing; and the lattice around its domain, out to a larger box (Negi & Ramachandran 2021, fig. 3).

use sphpack_neighbors::{Bounds, point};
use sphpack_packing::{Kind, Packed};
use sphpack_separation::Side;

use crate::run::Outcome;
use crate::scene::{Scene, Surroundings};
use crate::solution::Packing;
use crate::table::Table;

impl Outcome {
    /// What files hold: those of the table's particles whose kind the scene includes, and the surroundings that it asks for.
    #[must_use]
    pub fn included(&self, table: Table, scene: &Scene) -> Table {
        let kinds = table.kind.clone();
        let rows = table.kept(|i| scene.includes(kinds[i]));
        drop(kinds);
        match &scene.output.surroundings {
            Some(box_around) => surrounded(rows, self, scene, box_around),
            None => rows,
        }
    }
}

/// The particles of `rows` and, in place of the frozen ones, their lattice on to the sides of the larger box: fluid that
/// never moved.
fn surrounded(mut rows: Table, outcome: &Outcome, scene: &Scene, around: &Surroundings) -> Table {
    if rows.kind.contains(&Kind::Frozen) {
        rows = rows.filtered(|i| rows.kind[i] != Kind::Frozen);
    }
    match &outcome.packing {
        Packing::Plane(solution) => add(&mut rows, &solution.packed, scene, around),
        Packing::Space(solution) => add(&mut rows, &solution.packed, scene, around),
    }
    rows
}

fn add<const D: usize>(rows: &mut Table, packed: &Packed<D>, scene: &Scene, around: &Surroundings) {
    let outer = Bounds::new(point::of_slice(&around.min), point::of_slice(&around.max));
    let lattice = packed.frozen_lattice;
    let volume = lattice.volume_per_site();
    let mut id = packed
        .particles
        .id
        .iter()
        .copied()
        .chain(rows.id.iter().copied())
        .max()
        .map_or(0, |last| last + 1);
    let has_distances = !rows.distance.is_empty();
    lattice.visit_beyond(outer, |p| {
        rows.id.push(id);
        rows.position.push(point::of_slice(&p));
        rows.kind.push(Kind::Frozen);
        rows.side.push(Side::Fluid);
        rows.body.push(None);
        rows.volume.push(volume);
        let mut density = scene.fluid.density;
        if let Some(hydrostatic) = &scene.fluid.hydrostatic {
            let rest = hydrostatic.at(point::of_slice(&p), density);
            density = rest.density;
            rows.pressure.push(rest.pressure);
            rows.density.push(density);
        }
        rows.mass.push(density * volume);
        if has_distances {
            rows.distance.push(f64::NAN);
        }
        rows.gamma.push(f64::NAN);
        rows.residual.push(f64::NAN);
        id += 1;
    });
}
