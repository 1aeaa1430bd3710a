//! Particles as files and pictures see them: plain columns, two and three dimensions alike.

use std::collections::HashMap;

use sphpack_packing::Kind;
use sphpack_separation::Side;

/// One entry per particle in every column.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// 2 or 3.
    pub dimension: usize,
    /// Why the packing stopped ("converged", "interrupted", …); empty where nobody knows.
    pub stop_reason: String,
    /// The bodies' names.
    pub bodies: Vec<String>,
    /// A number that stays with the particle.
    pub id: Vec<u32>,
    /// Positions, scene units; z is 0 in 2-D.
    pub position: Vec<[f64; 3]>,
    /// How each particle may move.
    pub kind: Vec<Kind>,
    /// Solid or fluid.
    pub side: Vec<Side>,
    /// The place of its body in `bodies`.
    pub body: Vec<Option<u16>>,
    /// Volume (area in 2-D).
    pub volume: Vec<f64>,
    /// Density of its body or of the fluid × volume.
    pub mass: Vec<f64>,
    /// Γ; NaN where it is not judged, of frozen particles and of walls in layers.
    pub gamma: Vec<f64>,
    /// h |∇Γ|; likewise.
    pub residual: Vec<f64>,
    /// Outward unit normals of the particle surface by the ids of boundary and fixed particles: few of many. Of a wall in layers,
    /// those of the true surface, out of the wall.
    pub normals: HashMap<u32, [f64; 3]>,
    /// Hydrostatic pressure, 0 in solids; empty where the scene does not ask for it.
    pub pressure: Vec<f64>,
    /// Density at that pressure, solids' own; empty likewise.
    pub density: Vec<f64>,
    /// Signed distance of the particles of a wall in layers from the true surface, scene units: negative, in the wall. NaN of all
    /// others; empty where no body has layers.
    pub distance: Vec<f64>,
    /// The spacing of each, scene units; empty where all have one.
    pub spacing: Vec<f64>,
    /// The smoothing length of each, scene units, by which Γ was judged; empty likewise.
    pub smoothing_length: Vec<f64>,
    /// What particles have that are not told apart.
    pub shared: Shared,
}

/// What particles have in common.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shared {
    /// Spacing, scene units.
    pub spacing: f64,
    /// Smoothing length, scene units.
    pub smoothing_length: f64,
    /// Density of each body, and of the fluid last.
    pub density: Vec<f64>,
    /// How far inward of its true surface each body's surface particles are, scene units; 0 for containers, whose particles are the
    /// wall. Empty where nobody says.
    pub inset: Vec<f64>,
    /// Lower and upper corner of the box that was packed, scene units, z from 0 to 0 in 2-D; `None` where nobody says.
    pub domain: Option<[[f64; 3]; 2]>,
    /// Which of its axes wrap around.
    pub periodic: [bool; 3],
}

impl Shared {
    /// The density of a body, or of the fluid, at rest; 0 where nobody says.
    pub fn density_of(&self, body: Option<u16>) -> f64 {
        let fluid = self.density.len().saturating_sub(1);
        let place = body.map_or(fluid, usize::from);
        self.density.get(place).copied().unwrap_or(0.0)
    }
}

/// Entries that a column is to keep, in their order.
struct Picked<'a> {
    order: &'a [u32],
    is_sorted: bool,
}

impl Picked<'_> {
    fn of<T: Copy>(&self, column: &mut Vec<T>) {
        if column.is_empty() {
            return;
        }
        if !self.is_sorted {
            *column = self.order.iter().map(|&i| column[i as usize]).collect();
            return;
        }
        // None comes before its place.
        for (to, &from) in self.order.iter().enumerate() {
            column[to] = column[from as usize];
        }
        column.truncate(self.order.len());
    }
}

impl Table {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// The particles for which `keep` holds, in the same order.
    #[must_use]
    pub fn filtered(&self, keep: impl Fn(usize) -> bool) -> Self {
        self.clone().kept(keep)
    }

    /// [`Table::filtered`], of a table that is not needed any more.
    pub(crate) fn kept(self, keep: impl Fn(usize) -> bool) -> Self {
        let order: Vec<u32> = (0..self.id.len() as u32)
            .filter(|&i| keep(i as usize))
            .collect();
        self.in_order(&order)
    }

    /// The particles with a true entry in `keep`, by ascending id.
    #[must_use]
    pub(crate) fn kept_by_id(self, keep: &[bool]) -> Self {
        let mut order: Vec<u32> = (0..self.id.len() as u32)
            .filter(|&i| keep[i as usize])
            .collect();
        order.sort_unstable_by_key(|&i| self.id[i as usize]);
        self.in_order(&order)
    }

    /// Column by column, so that no more than one is there twice, and none where the order is what it was: then entries move up in
    /// their place.
    fn in_order(mut self, order: &[u32]) -> Self {
        let is_sorted = order.is_sorted();
        if order.len() == self.len() && is_sorted {
            return self;
        }
        let pick = Picked { order, is_sorted };
        pick.of(&mut self.id);
        pick.of(&mut self.position);
        pick.of(&mut self.kind);
        pick.of(&mut self.side);
        pick.of(&mut self.body);
        pick.of(&mut self.volume);
        pick.of(&mut self.mass);
        pick.of(&mut self.gamma);
        pick.of(&mut self.residual);
        pick.of(&mut self.pressure);
        pick.of(&mut self.density);
        pick.of(&mut self.distance);
        pick.of(&mut self.spacing);
        pick.of(&mut self.smoothing_length);
        self
    }

    /// Lower and upper corner of a box that holds the domain and all particles, scene units; 0 where there is neither.
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        let known = self.shared.domain.into_iter().flatten();
        let mut places = known.chain(self.position.iter().copied());
        let first = places.next().unwrap_or_default();
        places.fold([first; 2], |[low, high], place| {
            let axes = [0, 1, 2];
            [
                axes.map(|k| f64::min(low[k], place[k])),
                axes.map(|k| f64::max(high[k], place[k])),
            ]
        })
    }

    /// The name of the body of particle `i`; `None` where it belongs to none.
    pub fn body_name(&self, i: usize) -> Option<&str> {
        let body = self.body[i].and_then(|body| self.bodies.get(usize::from(body)));
        body.map(String::as_str)
    }

    /// The spacing of particle `i`, scene units.
    pub fn spacing_of(&self, i: usize) -> f64 {
        self.spacing.get(i).copied().unwrap_or(self.shared.spacing)
    }

    /// Its smoothing length, scene units.
    pub fn smoothing_length_of(&self, i: usize) -> f64 {
        let own = self.smoothing_length.get(i).copied();
        own.unwrap_or(self.shared.smoothing_length)
    }

    /// Whether particle `i` is of a wall in layers.
    pub fn is_wall(&self, i: usize) -> bool {
        self.distance
            .get(i)
            .is_some_and(|distance| !distance.is_nan())
    }

    /// Its density: at its pressure, or at rest; 0 where nobody says.
    pub fn density_of(&self, i: usize) -> f64 {
        let own = self.density.get(i).copied();
        own.unwrap_or_else(|| self.shared.density_of(self.body[i]))
    }

    /// The outward unit normal at particle `i`; 0 where it is on no surface.
    pub fn normal(&self, i: usize) -> [f64; 3] {
        self.normals.get(&self.id[i]).copied().unwrap_or_default()
    }

    /// Largest |Γ − 1| of the particles inside the domain.
    pub fn linf(&self) -> f64 {
        (self.gamma.iter().zip(&self.kind))
            .filter(|(_, kind)| **kind != Kind::Frozen)
            .fold(0.0, |most, (gamma, _)| f64::max(most, (gamma - 1.0).abs()))
    }

    /// |Γ − 1| that this part (0 … 1) of the particles inside the domain does not exceed; 0 where there are none.
    pub fn error_of_most(&self, part: f64) -> f64 {
        let mut errors: Vec<f64> = (self.gamma.iter().zip(&self.kind))
            .filter(|(gamma, kind)| **kind != Kind::Frozen && !gamma.is_nan())
            .map(|(gamma, _)| (gamma - 1.0).abs())
            .collect();
        errors.sort_by(f64::total_cmp);
        let place = (errors.len() as f64 * part) as usize;
        errors
            .get(place.min(errors.len().saturating_sub(1)))
            .copied()
            .unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(id: &[u32]) -> Table {
        Table {
            id: id.to_vec(),
            volume: id.iter().map(|&id| 0.5 * f64::from(id)).collect(),
            ..Table::default()
        }
    }

    #[test]
    fn rows_that_are_kept_stay_together_and_in_order() {
        let all = table(&[2, 3, 5, 7, 11]);
        let some = all.filtered(|i| i % 2 == 0);
        assert_eq!(some, table(&[2, 5, 11]));
        assert_eq!(all.filtered(|_| true), all);
        assert!(all.filtered(|_| false).is_empty());
        let mixed = table(&[7, 2, 11, 5, 3]);
        let keep = [true, true, false, true, true];
        assert_eq!(mixed.kept_by_id(&keep), table(&[2, 3, 5, 7]));
    }
}
