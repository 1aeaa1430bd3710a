//! Numbers at the nodes of a grid, stored in blocks where a surface is near.

use std::cmp::Ordering;

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, place_of, point};

use super::field::{Boolean, Field};
use crate::{GeometryError, ParameterError};

/// Nodes of a block along each axis.
const SIDE: i32 = 8;

/// Blocks at most: half a gibibyte in 3-D.
const MAX_BLOCKS: usize = 1 << 17;

/// Nodes further from the origin than this have no number.
const MAX_NODE: f64 = (1 << 28) as f64;

/// How far the nodes are from multiples of the cell, in cells: bodies whose sides lie on round numbers do not then
/// pass through nodes.
const SHIFT: [f64; 3] = [0.381_966_0, 0.236_067_9, 0.414_213_5];

/// Signed values at the nodes of a regular grid, of size `band` at most, stored in blocks of 8^D nodes: those in which
/// some value is less. A block that is not stored has one sign throughout, that of the stored block before it in its
/// row along x, and is outside where there is none.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Blocks<const D: usize> {
    pub(super) cell: f64,
    pub(super) band: f64,
    /// Sorted, the last axis first.
    keys: Vec<[i32; D]>,
    /// Block after block, x fastest.
    values: Vec<f64>,
}

fn in_order<const D: usize>(a: &[i32; D], b: &[i32; D]) -> Ordering {
    a.iter().rev().cmp(b.iter().rev())
}

impl<const D: usize> Blocks<D> {
    /// Nodes of a block.
    pub(super) const NODES: usize = (SIDE as usize).pow(D as u32);

    /// The values of `field` near a surface within `bounds`. `near(p)` is at most the distance of `p` from it.
    pub(super) fn near(
        (cell, band): (f64, f64),
        bounds: &Bounds<D>,
        near: impl Fn([f64; D]) -> f64 + Sync,
        field: &dyn Field<D>,
    ) -> Result<Self, GeometryError> {
        let mut blocks = Self {
            cell,
            band,
            keys: Vec::new(),
            values: Vec::new(),
        };
        let range = bounds.grown(band);
        let far = range.min.iter().chain(&range.max);
        if far.fold(0.0_f64, |a, x| a.max(x.abs())) >= MAX_NODE * cell {
            return Err(too_fine(cell));
        }
        let first = blocks.below(range.min).0.map(|i| i.div_euclid(SIDE));
        let last = blocks.below(range.max).0.map(|i| i.div_euclid(SIDE));
        let most = (0..D).map(|k| last[k] - first[k] + 1).max().unwrap_or(1);
        let mut size = most.max(1).unsigned_abs().next_power_of_two() as i32;
        let mut cubes = vec![first];
        loop {
            // Cubes of so many blocks that the surface may pass, or its band.
            let half = 0.5 * f64::from(size * SIDE) * cell;
            let reach = half * (D as f64).sqrt() + band;
            cubes = cubes
                .into_par_iter()
                .filter(|&key| {
                    let corner = blocks.place(key.map(|b| b * SIDE));
                    near(corner.map(|x| x + half)) <= reach
                })
                .collect();
            if cubes.len() > MAX_BLOCKS {
                return Err(too_fine(cell));
            }
            if size == 1 {
                break;
            }
            size /= 2;
            let part = |key: &[i32; D], bits: usize| {
                std::array::from_fn(|k| key[k] + size * (bits >> k & 1) as i32)
            };
            cubes = (cubes.iter())
                .flat_map(|key| (0..1 << D).map(move |bits| part(key, bits)))
                .filter(|key| (0..D).all(|k| key[k] <= last[k]))
                .collect();
        }
        cubes.sort_by(in_order);
        blocks.values = blocks.filled(&cubes, field);
        blocks.keys = cubes;
        Ok(blocks.pruned())
    }

    /// The same with the blocks that the band of the zero set reaches from those that are there.
    pub(super) fn grown(mut self, field: &dyn Field<D>) -> Result<Self, GeometryError> {
        loop {
            let mut more: Vec<[i32; D]> = (self.keys.par_iter().enumerate())
                .flat_map_iter(|(b, &key)| {
                    let values = self.of(b);
                    (0..2 * D).filter_map(move |side| {
                        let (axis, upper) = (side / 2, side % 2 == 1);
                        let mut there = key;
                        there[axis] += if upper { 1 } else { -1 };
                        let stride = (SIDE as usize).pow(axis as u32);
                        let layer = if upper { SIDE as usize - 1 } else { 0 };
                        let mut on_side = (0..Self::NODES)
                            .filter(|n| n / stride % SIDE as usize == layer)
                            .map(|n| values[n]);
                        on_side.any(|v| v.abs() < self.band).then_some(there)
                    })
                })
                .filter(|key| self.find(key).is_err())
                .collect();
            more.sort_by(in_order);
            more.dedup();
            let count = self.keys.len() + more.len();
            let far = more.iter().flatten().any(|b| b.abs() > (1 << 27) / SIDE);
            if count > MAX_BLOCKS || far {
                return Err(too_fine(self.cell));
            }
            let values = self.filled(&more, field);
            let is_done = !values.iter().any(|v| v.abs() < self.band);
            let mut all: Vec<([i32; D], &[f64])> = (self.keys.iter().copied())
                .zip(self.values.chunks_exact(Self::NODES))
                .chain(more.iter().copied().zip(values.chunks_exact(Self::NODES)))
                .collect();
            all.sort_by(|a, b| in_order(&a.0, &b.0));
            let merged = all.iter().flat_map(|one| one.1.iter().copied()).collect();
            self.keys = all.iter().map(|one| one.0).collect();
            self.values = merged;
            if is_done {
                return Ok(self.pruned());
            }
        }
    }

    /// Both made one, node by node.
    pub(super) fn with(&self, other: &Self, how: Boolean) -> Self {
        let mut keys = [self.keys.as_slice(), &other.keys].concat();
        keys.sort_by(in_order);
        keys.dedup();
        let values = keys
            .par_iter()
            .flat_map_iter(|key| {
                let [a, b] = [self, other].map(|blocks| blocks.block(key));
                (0..Self::NODES).map(move |n| how.of(a(n), b(n)))
            })
            .collect();
        Self {
            keys,
            values,
            ..*self
        }
        .pruned()
    }

    /// The values of the block `key`, whether it is stored or not.
    fn block<'a>(&'a self, key: &[i32; D]) -> Box<dyn Fn(usize) -> f64 + 'a> {
        match self.find(key) {
            Ok(b) => {
                let values = self.of(b);
                Box::new(move |n| values[n])
            }
            Err(place) => {
                let value = self.unstored(place, key, [0; D]);
                Box::new(move |_| value)
            }
        }
    }

    fn filled(&self, keys: &[[i32; D]], field: &dyn Field<D>) -> Vec<f64> {
        keys.par_iter()
            .flat_map_iter(|&key| {
                (0..Self::NODES).map(move |n| {
                    let value = field.at(self.place(Self::node_of(key, n))).0;
                    value.clamp(-self.band, self.band)
                })
            })
            .collect()
    }

    /// Without the blocks that lie beyond the band.
    fn pruned(self) -> Self {
        let is_near = |block: &[f64]| block.iter().any(|v| v.abs() < self.band);
        let (mut keys, mut values) = (Vec::new(), Vec::new());
        for (&key, block) in self.keys.iter().zip(self.values.chunks_exact(Self::NODES)) {
            if is_near(block) {
                keys.push(key);
                values.extend_from_slice(block);
            }
        }
        values.shrink_to_fit();
        Self {
            keys,
            values,
            ..self
        }
    }

    pub(super) fn count(&self) -> usize {
        self.keys.len()
    }

    pub(super) fn all_values(&self) -> &[f64] {
        &self.values
    }

    fn of(&self, b: usize) -> &[f64] {
        &self.values[b * Self::NODES..(b + 1) * Self::NODES]
    }

    fn find(&self, key: &[i32; D]) -> Result<usize, usize> {
        self.keys.binary_search_by(|k| in_order(k, key))
    }

    /// Node `n` of the block `key`.
    fn node_of(key: [i32; D], n: usize) -> [i32; D] {
        let local = place_of(n, [SIDE as usize; D]);
        std::array::from_fn(|k| key[k] * SIDE + local[k] as i32)
    }

    fn number_of(local: [i32; D]) -> usize {
        (0..D)
            .rev()
            .fold(0, |n, k| n * SIDE as usize + local[k] as usize)
    }

    /// The nodes of block `b`, each with its value.
    pub(super) fn nodes(&self, b: usize) -> impl Iterator<Item = ([i32; D], f64)> + '_ {
        let key = self.keys[b];
        (self.of(b).iter().enumerate()).map(move |(n, &value)| (Self::node_of(key, n), value))
    }

    /// The value at node `i`.
    pub(super) fn at(&self, i: [i32; D]) -> f64 {
        let key = i.map(|x| x.div_euclid(SIDE));
        let local = i.map(|x| x.rem_euclid(SIDE));
        match self.find(&key) {
            Ok(b) => self.of(b)[Self::number_of(local)],
            Err(place) => self.unstored(place, &key, local),
        }
    }

    /// The value in a block that is not stored and would be at `place`.
    fn unstored(&self, place: usize, key: &[i32; D], mut local: [i32; D]) -> f64 {
        let before = place.checked_sub(1).map(|b| (b, self.keys[b]));
        match before {
            Some((b, k)) if k[1..] == key[1..] => {
                local[0] = SIDE - 1;
                self.band.copysign(self.of(b)[Self::number_of(local)])
            }
            _ => self.band,
        }
    }

    /// Where node `i` is, scene units.
    pub(super) fn place(&self, i: [i32; D]) -> [f64; D] {
        std::array::from_fn(|k| (f64::from(i[k]) + SHIFT[k % 3]) * self.cell)
    }

    /// The node below `p` along every axis, and how far `p` is from it, in cells.
    pub(super) fn below(&self, p: [f64; D]) -> ([i32; D], [f64; D]) {
        let u: [f64; D] = std::array::from_fn(|k| {
            (p[k] / self.cell - SHIFT[k % 3]).clamp(-2.0 * MAX_NODE, 2.0 * MAX_NODE)
        });
        let i = u.map(f64::floor);
        (i.map(|x| x as i32), point::sub(u, i))
    }
}

fn too_fine(cell: f64) -> GeometryError {
    ParameterError::OutOfRange {
        of: "level set",
        name: "cell",
        value: cell,
        needs: "larger, so that the grid near the surface takes less than half a gibibyte",
    }
    .into()
}
