//! A surface cut into small flat facets, for integrals over it.

use rayon::prelude::*;
use sphpack_geometry::{Closest, Surface};
use sphpack_neighbors::random::Congruential;
use sphpack_neighbors::{Bounds, point};

/// A flat piece of a surface: a segment in the plane, a triangle in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facet<const D: usize> {
    /// Its corners, on the surface.
    pub(crate) corners: [[f64; D]; D],
    /// Its normal, out of the body, as long as the facet is large (scene units to the power D − 1).
    pub(crate) area: [f64; D],
}

impl<const D: usize> Facet<D> {
    fn of(corners: [[f64; D]; D]) -> Self {
        Self {
            corners,
            area: area(&corners),
        }
    }

    /// The same facet seen from the other side.
    pub(crate) fn turned(mut self) -> Self {
        self.corners.swap(0, 1);
        self.area = point::scale(self.area, -1.0);
        self
    }

    pub(crate) fn center(&self) -> [f64; D] {
        let sum = self.corners.into_iter().fold([0.0; D], point::add);
        point::scale(sum, 1.0 / D as f64)
    }
}

/// To the right of a segment; by the right-hand rule of a triangle.
fn area<const D: usize>(corners: &[[f64; D]; D]) -> [f64; D] {
    let along = point::sub(corners[1], corners[0]);
    let mut area = [0.0; D];
    if D == 2 {
        (area[0], area[1]) = (along[1], -along[0]);
    } else {
        let other = point::sub(corners[2], corners[0]);
        for k in 0..3 {
            let (l, m) = ((k + 1) % 3, (k + 2) % 3);
            area[k] = 0.5 * (along[l] * other[m] - along[m] * other[l]);
        }
    }
    area
}

/// Cells whose sides turn by more than this (cosine) are cut again, [`FINER`] times at most.
const TURN: f64 = 0.97;
const FINER: u32 = 2;

/// Along the longest edge of a body's box, about as many cells at the start of the descent.
const COARSEST: f64 = 8.0;

/// Places at which it is looked how finely a surface is cut.
const PROBES: usize = 200;

/// How many cells a surface takes for one that it would take if nothing bent: about, by some places on it that are away from
/// sharp edges.
pub(crate) fn finer_by_bends<const D: usize>(surface: &dyn Surface<D>, size: f64) -> f64 {
    let mut places = surface.scatter(PROBES);
    let edges = surface.features().edges;
    places.retain(|hit| {
        let mut sides = edges.iter().flat_map(|edge| edge.windows(2));
        sides.all(|side| from_segment(hit.point, side[0], side[1]) > 2.0 * size)
    });
    if places.is_empty() {
        return 1.0;
    }
    let mut random = Congruential::new(1);
    let cells = |hit: &Closest<D>| {
        let within: [f64; D] = std::array::from_fn(|_| random.unit());
        let mut edge = size;
        let mut cells = 1.0;
        for _ in 0..FINER {
            let corners: Vec<Closest<D>> = (0..1_usize << D)
                .map(|corner| {
                    let of = |k: usize| (corner >> k & 1) as f64 - within[k];
                    surface.closest(std::array::from_fn(|k| hit.point[k] + edge * of(k)))
                })
                .collect();
            if !bends(corners.iter()) {
                break;
            }
            cells *= f64::from(1_u32 << (D - 1));
            edge *= 0.5;
        }
        cells
    };
    places.iter().map(cells).sum::<f64>() / places.len() as f64
}

/// How far a place is from a segment.
fn from_segment<const D: usize>(p: [f64; D], a: [f64; D], b: [f64; D]) -> f64 {
    let (along, to) = (point::sub(b, a), point::sub(p, a));
    let square = point::dot(along, along);
    let t = if square > 0.0 {
        (point::dot(to, along) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    point::distance(p, point::add_scaled(a, t, along))
}

/// Whether normals turn by more than a cell may have.
fn bends<'a, const D: usize>(mut hits: impl Iterator<Item = &'a Closest<D>>) -> bool {
    let first = hits.next().map_or([0.0; D], |hit| hit.normal);
    hits.any(|hit| point::dot(hit.normal, first) < TURN)
}

/// The facets of one cell, together.
pub(crate) type Patch<const D: usize> = Vec<Facet<D>>;

/// A grid of which only the cells that the surface runs through are ever visited.
struct Grid<'a, const D: usize> {
    surface: &'a dyn Surface<D>,
    origin: [f64; D],
    /// Edge of the smallest cell; all others are powers of two of it.
    edge: f64,
}

/// The facets of the surface, those in a cell of edge `size` (scene units) together: marching simplices, corners moved
/// onto the surface. Where the surface bends sharply the cells are a quarter as large. Cost and memory grow with the
/// surface. In parallel, always in the same order.
pub(crate) fn facets<const D: usize>(surface: &dyn Surface<D>, size: f64) -> Vec<Patch<D>> {
    // Off the surface's own symmetry planes.
    let bounds = surface.bounds().grown(0.618 * size);
    let longest = bounds.size().into_iter().fold(0.0, f64::max);
    let levels = (longest / COARSEST / size).log2().max(0.0).floor() as u32;
    let grid = Grid {
        surface,
        origin: bounds.min,
        edge: size / f64::from(1_u32 << FINER),
    };
    let width = 1_i64 << (levels + FINER);
    grid.roots(bounds, width)
        .into_par_iter()
        .map(|cell| {
            let mut patches = Vec::new();
            grid.descend(cell, width, &mut patches);
            patches
        })
        .flatten_iter()
        .collect()
}

impl<const D: usize> Grid<'_, D> {
    fn roots(&self, bounds: Bounds<D>, width: i64) -> Vec<[i64; D]> {
        let counts = bounds
            .size()
            .map(|size| (size / (self.edge * width as f64)).ceil().max(1.0) as i64);
        let all: i64 = counts.iter().product();
        (0..all)
            .map(|mut n| {
                counts.map(|count| {
                    let along = n % count;
                    n /= count;
                    along * width
                })
            })
            .collect()
    }

    fn at(&self, node: [i64; D]) -> [f64; D] {
        std::array::from_fn(|k| self.origin[k] + self.edge * node[k] as f64)
    }

    fn descend(&self, cell: [i64; D], width: i64, out: &mut Vec<Patch<D>>) {
        let edge = self.edge * width as f64;
        let middle = self.at(cell).map(|x| x + 0.5 * edge);
        let radius = 0.5 * edge * (D as f64).sqrt();
        if self.surface.closest_within(middle, radius).is_none() {
            return;
        }
        if width <= 1 << FINER {
            let nodes = self.corners(cell, width);
            if width == 1 || !bends(nodes.iter().map(|node| &node.1)) {
                let patch = self.march(&nodes);
                if !patch.is_empty() {
                    out.push(patch);
                }
                return;
            }
        }
        let half = width / 2;
        for corner in 0..1 << D {
            let child = std::array::from_fn(|k| cell[k] + half * (corner >> k & 1));
            self.descend(child, half, out);
        }
    }

    fn corners(&self, cell: [i64; D], width: i64) -> Vec<([f64; D], Closest<D>)> {
        (0..1 << D)
            .map(|corner: i64| {
                let node = std::array::from_fn(|k| cell[k] + width * (corner >> k & 1));
                let p = self.at(node);
                (p, self.surface.closest(p))
            })
            .collect()
    }

    /// Kuhn's simplices of a cell: one for every order of the axes.
    fn march(&self, nodes: &[([f64; D], Closest<D>)]) -> Patch<D> {
        const ORDERS: [[usize; 3]; 6] = [
            [0, 1, 2],
            [1, 0, 2],
            [0, 2, 1],
            [2, 0, 1],
            [1, 2, 0],
            [2, 1, 0],
        ];
        let mut patch = Vec::new();
        for order in &ORDERS[..if D == 2 { 2 } else { 6 }] {
            let (mut inner, mut outer) = (Vec::new(), Vec::new());
            let mut corner = 0;
            for step in 0..=D {
                let (p, hit) = &nodes[corner];
                let side = if hit.distance < 0.0 {
                    &mut inner
                } else {
                    &mut outer
                };
                side.push((*p, hit.distance));
                if step < D {
                    corner |= 1 << order[step];
                }
            }
            self.cut(&inner, &outer, &mut patch);
        }
        patch
    }

    /// The facets between the inner and the outer corners of a simplex.
    fn cut(&self, inner: &[([f64; D], f64)], outer: &[([f64; D], f64)], out: &mut Patch<D>) {
        let mut crossings: Vec<[f64; D]> = Vec::new();
        for (row, (p, inside)) in inner.iter().enumerate() {
            for column in 0..outer.len() {
                // Around the quadrilateral, not across it.
                let turned = if row % 2 == 1 {
                    outer.len() - 1 - column
                } else {
                    column
                };
                let (q, outside) = outer[turned];
                let t = inside / (inside - outside);
                crossings.push(point::add_scaled(*p, t, point::sub(q, *p)));
            }
        }
        let outward = match (inner.first(), outer.first()) {
            (Some(inner), Some(outer)) => point::sub(outer.0, inner.0),
            _ => return,
        };
        let on_surface: Vec<[f64; D]> = (crossings.iter())
            .map(|&p| self.surface.closest(p).point)
            .collect();
        for last in D - 1..crossings.len() {
            let pick = |points: &[[f64; D]]| -> [[f64; D]; D] {
                std::array::from_fn(|k| {
                    if k == 0 {
                        points[0]
                    } else {
                        points[last + 1 + k - D]
                    }
                })
            };
            let facet = Facet::of(pick(&on_surface));
            let is_outward = point::dot(area(&pick(&crossings)), outward) > 0.0;
            out.push(if is_outward { facet } else { facet.turned() });
        }
    }
}
