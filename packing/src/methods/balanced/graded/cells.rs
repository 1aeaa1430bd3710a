//! The box in cells as fine as the field of spacings, finer at surfaces: what of them is in which region.

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, place_of, point};

use super::bisection::Piece;
use crate::depths::{Seen, around};
use crate::problem::Problem;

/// Cells along a spacing at a surface, in the plane and in space; elsewhere one.
const AT_SURFACE: [f64; 2] = [8.0, 4.0];

/// A node that has no children.
const LEAF: u32 = u32::MAX;

/// Layers of surface particles: how far they reach beyond every part's true surface, into it and out of it.
#[derive(Debug)]
pub(super) struct Layers {
    /// In spacings.
    pub(super) inner: Vec<f64>,
    pub(super) outer: Vec<f64>,
    /// The spacing at every part's surface, scene units; where that varies the field is asked.
    pub(super) spacing: Vec<Option<f64>>,
    /// The coarsest.
    pub(super) coarsest: f64,
}

impl Layers {
    /// The layer of a part's surface at its nearest place, scene units.
    fn at<const D: usize>(
        &self,
        problem: &Problem<D>,
        part: usize,
        place: [f64; D],
        seen: &Seen<D>,
    ) -> [f64; 2] {
        let spacing =
            self.spacing[part].unwrap_or_else(|| problem.resolution.at(seen.nearest(place)).value);
        [self.inner[part] * spacing, self.outer[part] * spacing]
    }

    /// The thickest, scene units.
    fn thickest(&self) -> f64 {
        (0..self.inner.len()).fold(0.0, |most: f64, part| {
            let spacing = self.spacing[part].unwrap_or(self.coarsest);
            most.max(spacing * self.inner[part].max(self.outer[part]))
        })
    }
}

/// A cell that is not divided.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaf<const D: usize> {
    pub(super) bounds: Bounds<D>,
    /// The spacing at its middle.
    spacing: f64,
    /// How far its middle is from the nearest body, negative inside.
    pub(super) distance: f64,
}

/// Part of a leaf that is in a region: a part's core, or, with the number of parts, the fluid.
#[derive(Debug, Clone, Copy)]
struct Share {
    leaf: u32,
    region: u32,
    part: f64,
}

/// The cells of a box: a tree below every cell of a coarse grid.
#[derive(Debug)]
pub(super) struct Cells<const D: usize> {
    bounds: Bounds<D>,
    count: [usize; D],
    /// First child, of which there are 2^D in a row, and leaf of every node.
    nodes: Vec<[u32; 2]>,
    pub(super) leaves: Vec<Leaf<D>>,
    shares: Vec<Share>,
    parts: usize,
}

/// One root's nodes, leaves and shares, in numbers of their own.
#[derive(Debug)]
struct Branch<const D: usize> {
    nodes: Vec<[u32; 2]>,
    leaves: Vec<Leaf<D>>,
    shares: Vec<Share>,
}

impl<const D: usize> Cells<D> {
    /// The cells of a problem whose bodies are parts. Some queries of surfaces and of the field for every cell.
    pub(super) fn of(problem: &Problem<D>, layers: &Layers) -> Self {
        let bounds = problem.domain.bounds;
        let size = bounds.size();
        let coarsest = problem.resolution.range()[1];
        let count: [usize; D] =
            std::array::from_fn(|k| (size[k] / (2.0 * coarsest)).ceil().max(1.0) as usize);
        let edge: [f64; D] = std::array::from_fn(|k| size[k] / count[k] as f64);
        let all: Vec<u16> = (0..problem.bodies.len() as u16).collect();
        let roots = count.iter().product::<usize>();
        let branches: Vec<Branch<D>> = (0..roots)
            .into_par_iter()
            .map(|number| {
                let cell = place_of(number, count);
                let min: [f64; D] =
                    std::array::from_fn(|k| bounds.min[k] + edge[k] * cell[k] as f64);
                let mut branch = Branch {
                    nodes: vec![[LEAF; 2]],
                    leaves: Vec::new(),
                    shares: Vec::new(),
                };
                let root = Bounds::new(min, point::add(min, edge));
                branch.grow(problem, layers, 0, root, &all);
                branch
            })
            .collect();
        let mut cells = Self {
            bounds,
            count,
            nodes: vec![[LEAF; 2]; roots],
            leaves: Vec::new(),
            shares: Vec::new(),
            parts: problem.bodies.len(),
        };
        for (root, branch) in branches.into_iter().enumerate() {
            // The root itself is in its place; its other nodes follow all roots.
            let (first, leaf) = (cells.nodes.len() as u32 - 1, cells.leaves.len() as u32);
            let mut nodes = branch.nodes.into_iter().map(|node| match node {
                [LEAF, own] => [LEAF, own + leaf],
                [child, own] => [child + first, own],
            });
            if let Some(own) = nodes.next() {
                cells.nodes[root] = own;
            }
            cells.nodes.extend(nodes);
            cells.leaves.extend(branch.leaves);
            cells
                .shares
                .extend(branch.shares.into_iter().map(|share| Share {
                    leaf: share.leaf + leaf,
                    ..share
                }));
        }
        cells
    }

    /// The leaf that holds a place of the box, or is nearest to it along the axes.
    pub(super) fn at(&self, place: [f64; D]) -> usize {
        let size = self.bounds.size();
        let edge: [f64; D] = std::array::from_fn(|k| size[k] / self.count[k] as f64);
        let mut number = 0;
        let mut min = self.bounds.min;
        for k in (0..D).rev() {
            // The cast saturates at 0.
            let i = ((place[k] - self.bounds.min[k]) / edge[k]) as usize;
            let i = i.min(self.count[k] - 1);
            number = number * self.count[k] + i;
            min[k] += edge[k] * i as f64;
        }
        let mut cell = Bounds::new(min, point::add(min, edge));
        let mut node = number;
        while self.nodes[node][0] != LEAF {
            let center = cell.center();
            let mut child = 0;
            for k in 0..D {
                if place[k] >= center[k] {
                    child |= 1 << k;
                    cell.min[k] = center[k];
                } else {
                    cell.max[k] = center[k];
                }
            }
            node = self.nodes[node][0] as usize + child;
        }
        self.nodes[node][1] as usize
    }

    /// The pieces of every region: the parts' cores, and the pockets of fluid, of which `pocket` tells each leaf's.
    pub(super) fn pieces(&self, pocket: &[u32], regions: usize) -> Vec<Vec<Piece<D>>> {
        let mut pieces = vec![Vec::new(); regions];
        for share in &self.shares {
            let leaf = &self.leaves[share.leaf as usize];
            let region = match share.region as usize {
                fluid if fluid == self.parts => self.parts + pocket[share.leaf as usize] as usize,
                part => part,
            };
            pieces[region].push(Piece {
                bounds: leaf.bounds,
                density: share.part / leaf.spacing.powi(D as i32),
            });
        }
        pieces
    }

    /// What the fluid is in the pockets of: volume, and how many particles it asks for.
    pub(super) fn contents(&self, pocket: &[u32], pockets: usize) -> Vec<[f64; 2]> {
        let mut contents = vec![[0.0; 2]; pockets];
        for share in self
            .shares
            .iter()
            .filter(|s| s.region as usize == self.parts)
        {
            let leaf = &self.leaves[share.leaf as usize];
            let volume = share.part * leaf.bounds.volume();
            let sums = &mut contents[pocket[share.leaf as usize] as usize];
            *sums = point::add(*sums, [volume, volume / leaf.spacing.powi(D as i32)]);
        }
        contents
    }

    /// The volume of a part's core, by cells.
    pub(super) fn volume_of(&self, part: usize) -> f64 {
        (self.shares.iter())
            .filter(|share| share.region as usize == part)
            .map(|share| share.part * self.leaves[share.leaf as usize].bounds.volume())
            .sum()
    }
}

impl<const D: usize> Branch<D> {
    /// Divides a node's cell as far as needed. `bodies` are those that may be near.
    fn grow(
        &mut self,
        problem: &Problem<D>,
        layers: &Layers,
        node: usize,
        cell: Bounds<D>,
        bodies: &[u16],
    ) {
        let (center, radius) = (cell.center(), 0.5 * cell.diagonal());
        let slack = 2.0 * (radius + layers.thickest());
        let seen = around(&problem.bodies, bodies, center, slack);
        let layered: Vec<(usize, f64, [f64; 2])> = (seen.iter())
            .map(|(body, seen)| {
                let body = usize::from(*body);
                (body, seen.distance, layers.at(problem, body, center, seen))
            })
            .collect();
        let spacing = problem.resolution.at(center).value;
        let edge = cell.size().into_iter().fold(0.0, f64::max);
        let is_at_surface = layered.iter().any(|&(_, distance, [inner, outer])| {
            (distance + inner).abs() < radius || (distance - outer).abs() < radius
        });
        let finest = if is_at_surface {
            spacing / AT_SURFACE[usize::from(D == 3)]
        } else {
            spacing
        };
        if edge > finest * 1.001 {
            let listed: Vec<u16> = seen.iter().map(|(body, _)| *body).collect();
            let first = self.nodes.len();
            self.nodes[node] = [first as u32, LEAF];
            self.nodes.resize(first + (1 << D), [LEAF; 2]);
            for child in 0..1_usize << D {
                let mut part = cell;
                for k in 0..D {
                    if child >> k & 1 == 1 {
                        part.min[k] = center[k];
                    } else {
                        part.max[k] = center[k];
                    }
                }
                self.grow(problem, layers, first + child, part, &listed);
            }
            return;
        }
        let leaf = self.leaves.len() as u32;
        self.nodes[node][1] = leaf;
        self.leaves.push(Leaf {
            bounds: cell,
            spacing,
            distance: (seen.iter())
                .fold(f64::INFINITY, |least, (_, seen)| least.min(seen.distance)),
        });
        let parts = problem.bodies.len();
        let of_bodies = seen.iter().map(|(body, _)| usize::from(*body));
        for region in of_bodies.chain([parts]) {
            let depth = depth(&layered, region);
            let part = (0.5 + depth / edge).clamp(0.0, 1.0);
            if part > 0.0 {
                self.shares.push(Share {
                    leaf,
                    region: region as u32,
                    part,
                });
            }
        }
    }
}

/// How deep a place is in a region without the layers of surface particles; negative outside. Of bodies: their numbers, signed
/// distances and layers.
fn depth(bodies: &[(usize, f64, [f64; 2])], region: usize) -> f64 {
    let mut depth = f64::INFINITY;
    for &(body, distance, [inner, outer]) in bodies {
        if body < region {
            depth = depth.min(distance - outer);
        } else if body == region {
            depth = depth.min(-distance - inner);
        }
    }
    depth
}
