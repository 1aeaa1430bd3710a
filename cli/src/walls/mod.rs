//! Bodies as walls: layers of particles along their surfaces in place of what fills them.

mod asked;
mod report;
#[cfg(test)]
mod tests;

use sphpack_geometry::{GeometryError, WallLayer, WallSide, wall_layers};
use sphpack_neighbors::point;
use sphpack_packing::{Kind, Packed};
use sphpack_separation::Side;

use crate::labels::Sorted;
use crate::scene::Scene;
use crate::table::Table;

pub(crate) use asked::{Layered, asked};
pub use report::{LayerReport, WallReport};

/// A body's wall, as it is in the table.
pub(crate) struct Wall<const D: usize> {
    pub(crate) of: Layered<D>,
    /// Those of its first layer that the packing had on the surface come first there.
    pub(crate) layers: Vec<WallLayer<D>>,
    /// How many they are.
    pub(crate) packed: usize,
    /// The rows of the layers' particles, in their order.
    pub(crate) rows: Vec<usize>,
}

impl<const D: usize> Wall<D> {
    /// Whether a place is in the room of the layers.
    pub(crate) fn is_within(&self, p: [f64; D]) -> bool {
        let distance = self.of.surface.closest(p).distance;
        let depth = match self.of.spec.side {
            WallSide::Inside => -distance,
            WallSide::Outside => distance,
        };
        depth > 0.0 && depth < self.of.spec.spacing * self.of.spec.layers as f64
    }

    /// The volume of all particles.
    pub(crate) fn volume(&self) -> f64 {
        (self.layers.iter())
            .map(|layer| layer.volume_each * layer.points.len() as f64)
            .sum()
    }
}

/// The wall of a container with layers is outside of it: the particles that its surface was packed with are the first of the fluid.
pub(crate) fn leave_to_fluid<const D: usize>(
    layered: &[Layered<D>],
    packed: &Packed<D>,
    has_fluid: bool,
    sorted: &mut Sorted,
) {
    for of in layered
        .iter()
        .filter(|of| of.spec.side == WallSide::Outside)
    {
        for i in 0..packed.particles.len() {
            let on = packed.particles.on_surface(i).map(usize::from);
            if on == Some(of.body) {
                sorted.labels.side[i] = Side::Fluid;
                sorted.labels.body[i] = None;
                sorted.keep[i] &= has_fluid;
            }
        }
    }
}

/// Puts the layers into the table, in place of what the packing has of their bodies; new particles are fixed, and numbered from `next` on.
pub(crate) fn build<const D: usize>(
    layered: Vec<Layered<D>>,
    scene: &Scene,
    mut next: u32,
    table: &mut Table,
) -> Result<Vec<Wall<D>>, (usize, GeometryError)> {
    if layered.is_empty() {
        return Ok(Vec::new());
    }
    let is_of = |table: &Table, i: usize, body: usize| table.body[i].map(usize::from) == Some(body);
    let is_layered = |table: &Table, i: usize, side: WallSide| {
        layered
            .iter()
            .any(|of| of.spec.side == side && is_of(table, i, of.body))
    };
    let filling: Vec<bool> = (0..table.len())
        .map(|i| table.kind[i] == Kind::Free && is_layered(table, i, WallSide::Inside))
        .collect();
    *table = std::mem::take(table).kept(|i| !filling[i]);
    if layered.iter().any(|of| of.spec.side == WallSide::Outside) {
        for i in 0..table.len() {
            if table.side[i] == Side::Fluid && table.kind[i].is_on_surface() {
                table.kind[i] = Kind::Free;
                table.normals.remove(&table.id[i]);
            }
        }
    }
    table.distance = vec![f64::NAN; table.len()];
    let mut walls = Vec::with_capacity(layered.len());
    for of in layered {
        let reach = of.spec.spacing * (of.spec.layers + 1) as f64;
        let around = of.surface.bounds().grown(reach);
        let place = |i: usize| -> [f64; D] { point::of_slice(&table.position[i]) };
        let mut rows: Vec<usize> = (0..table.len())
            .filter(|&i| is_of(table, i, of.body))
            .collect();
        // A body too small for a particle has none on its surface, and its room is left to the fluid.
        if rows.is_empty() && of.spec.side == WallSide::Inside {
            continue;
        }
        let first: Vec<[f64; D]> = rows.iter().map(|&i| place(i)).collect();
        let others: Vec<[f64; D]> = (0..table.len())
            .filter(|&i| !is_of(table, i, of.body) && around.contains(place(i)))
            .map(place)
            .collect();
        let given = (of.spec.side == WallSide::Inside).then_some(first.as_slice());
        let layers =
            wall_layers(&of.surface, &of.spec, given, &others).map_err(|error| (of.body, error))?;
        let packed = given.map_or(0, <[_]>::len);
        let density = scene.body[of.body].density;
        let all = (layers.iter()).flat_map(|layer| layer.points.iter().map(move |at| (layer, at)));
        for (n, (layer, at)) in all.enumerate() {
            if n >= packed {
                rows.push(table.len());
                push(table, next, of.body, point::of_slice(&at.point), density);
                next += 1;
            }
            let i = rows[n];
            table.volume[i] = layer.volume_each;
            table.mass[i] = density * layer.volume_each;
            table.gamma[i] = f64::NAN;
            table.residual[i] = f64::NAN;
            table.distance[i] = -at.depth;
            table
                .normals
                .insert(table.id[i], point::of_slice(&at.normal));
        }
        walls.push(Wall {
            of,
            layers,
            packed,
            rows,
        });
    }
    Ok(walls)
}

/// One more particle of a body; what differs by layer is set later.
fn push(table: &mut Table, id: u32, body: usize, position: [f64; 3], density: f64) {
    table.id.push(id);
    table.position.push(position);
    table.kind.push(Kind::Fixed);
    table.side.push(Side::Solid);
    table.body.push(u16::try_from(body).ok());
    table.volume.push(0.0);
    table.mass.push(0.0);
    table.gamma.push(f64::NAN);
    table.residual.push(f64::NAN);
    table.distance.push(f64::NAN);
    // Of fluid under gravity alone.
    if !table.pressure.is_empty() {
        table.pressure.push(0.0);
        table.density.push(density);
    }
}
