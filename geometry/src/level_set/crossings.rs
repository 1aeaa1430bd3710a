//! Where the edges of the grid pass through the surface, and the plane that touches it there.

use rayon::prelude::*;
use sphpack_neighbors::point;

use super::LevelSet;

/// Crossings keep so far from nodes, in cells.
pub(super) const MARGIN: f64 = 1e-3;

/// A place this near to the surface, in cells, is on it: the plane that touches it is taken from there.
const NEAR: f64 = 0.02;

/// Places tried on an edge, at most.
const TRIES: usize = 6;

/// An edge of the grid whose ends have different signs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    /// Its lower end.
    pub(super) node: [i32; 3],
    pub(super) axis: usize,
    /// Whether the lower end is inside.
    pub(super) leaves: bool,
    /// How far the surface is from the lower end, in cells.
    pub(super) part: f64,
    /// The same place, scene units.
    pub(super) point: [f64; 3],
    /// The unit normal of a plane that touches the surface near there.
    pub(super) normal: [f64; 3],
    /// normal · x on it.
    pub(super) offset: f64,
}

impl LevelSet<3> {
    /// All crossed edges, in the order of the blocks.
    pub(super) fn crossings(&self) -> Vec<Crossing> {
        let edges: Vec<([i32; 3], usize, [f64; 2])> = (0..self.blocks.count())
            .into_par_iter()
            .flat_map_iter(|b| {
                self.blocks.nodes(b).flat_map(move |(node, value)| {
                    (0..3).filter_map(move |axis| {
                        if value.abs() >= self.band() {
                            return None;
                        }
                        let mut next = node;
                        next[axis] += 1;
                        let there = self.blocks.at(next);
                        ((value < 0.0) != (there < 0.0)).then_some((node, axis, [value, there]))
                    })
                })
            })
            .collect();
        edges
            .into_par_iter()
            .map(|(node, axis, values)| self.crossing(node, axis, values))
            .collect()
    }

    /// The crossing of an edge whose ends have these `values`.
    fn crossing(&self, node: [i32; 3], axis: usize, values: [f64; 2]) -> Crossing {
        let start = self.blocks.place(node);
        let at = |part: f64| {
            let mut p = start;
            p[axis] += part * self.cell();
            p
        };
        // Between these parts of the edge the sign changes.
        let mut ends = [(0.0, values[0]), (1.0, values[1])];
        let mut tries = 0;
        loop {
            let [(a, fa), (b, fb)] = ends;
            // By the values, and every other time by halves, lest one end stays for ever.
            let share = if tries % 2 == 0 { fa / (fa - fb) } else { 0.5 };
            let part = (a + share * (b - a)).clamp(MARGIN, 1.0 - MARGIN);
            let point = at(part);
            let (value, normal) = self.field.at(point);
            tries += 1;
            if value.abs() <= NEAR * self.cell() || tries == TRIES {
                return Crossing {
                    node,
                    axis,
                    leaves: values[0] < 0.0,
                    part,
                    point,
                    normal,
                    offset: point::dot(normal, point) - value,
                };
            }
            ends[usize::from((value < 0.0) != (values[0] < 0.0))] = (part, value);
        }
    }
}
