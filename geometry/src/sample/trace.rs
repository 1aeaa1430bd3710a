//! Closed polylines along any curve in the plane.

use std::collections::HashMap;

use sphpack_neighbors::{Bounds, point};

use super::curve::Ring;
use crate::surface::Closest;

/// Sides of the polyline per point that is wanted, about.
const SIDES_PER_SPACING: f64 = 4.0;

/// Sides per size of the curve, at least: a circle's polyline is then some 10⁻⁵ of its radius off at most.
const SIDES_PER_SIZE: f64 = 512.0;

/// A side of the grid, by its lower end and its axis.
type Side = ([i64; 2], usize);

/// The curve as seen from the points of a grid.
struct Grid<'a, const D: usize, F> {
    near: &'a F,
    /// Beyond this there may be other curves, which are not asked for.
    bounds: Bounds<D>,
    origin: [f64; D],
    cell: f64,
    /// Signed distance at points of the grid.
    height: HashMap<[i64; 2], f64>,
    /// Number of the crossing on each side that is crossed.
    crossing: HashMap<Side, usize>,
    points: Vec<[f64; D]>,
    /// Up to two neighbours of each crossing.
    joined: Vec<Vec<usize>>,
}

/// Closed polylines with their points on the curve that `near` answers for (its signed distance at any place), found by
/// marching squares in the boxes that the curve passes; `corners` are taken in where they are nearest.
pub(super) fn rings<const D: usize>(
    bounds: &Bounds<D>,
    near: &impl Fn([f64; D]) -> Closest<D>,
    corners: &[[f64; D]],
    spacing: f64,
) -> Vec<Ring<D>> {
    let size = bounds.size().iter().copied().fold(0.0, f64::max);
    let cell = (spacing / SIDES_PER_SPACING).min(size / SIDES_PER_SIZE);
    let mut levels = 1;
    while cell * 2.0_f64.powi(levels) < 1.1 * size && levels < 40 {
        levels += 1;
    }
    let width = 1_i64 << levels;
    // Off the middle, so that straight sides do not run along the grid.
    let shift = (0.5 * width as f64 + 0.37) * cell;
    let mut grid = Grid {
        near,
        bounds: *bounds,
        origin: bounds.center().map(|x| x - shift),
        cell,
        height: HashMap::new(),
        crossing: HashMap::new(),
        points: Vec::new(),
        joined: Vec::new(),
    };
    grid.search([0, 0], width);
    let mut rings = grid.rings();
    for &corner in corners {
        insert(&mut rings, corner);
    }
    rings
}

impl<const D: usize, F: Fn([f64; D]) -> Closest<D>> Grid<'_, D, F> {
    fn place(&self, x: f64, y: f64) -> [f64; D] {
        point::add_scaled(self.origin, self.cell, point::of_slice(&[x, y]))
    }

    /// Looks for the curve in the square of `width` cells.
    fn search(&mut self, low: [i64; 2], width: i64) {
        let half = 0.5 * width as f64;
        let center = self.place(low[0] as f64 + half, low[1] as f64 + half);
        if !self
            .bounds
            .grown(half * self.cell * (1.0 + 1e-9))
            .contains(center)
        {
            return;
        }
        let reach = half * self.cell * std::f64::consts::SQRT_2 * (1.0 + 1e-9);
        if (self.near)(center).distance.abs() > reach {
            return;
        }
        if width == 1 {
            self.march(low);
            return;
        }
        let half = width / 2;
        for (x, y) in [(0, 0), (half, 0), (0, half), (half, half)] {
            self.search([low[0] + x, low[1] + y], half);
        }
    }

    fn height(&mut self, at: [i64; 2]) -> f64 {
        let p = self.place(at[0] as f64, at[1] as f64);
        *self
            .height
            .entry(at)
            .or_insert_with(|| (self.near)(p).distance)
    }

    /// Joins the crossings of one cell's sides.
    fn march(&mut self, [x, y]: [i64; 2]) {
        // Around the cell, each side with whether the curve leaves the body there.
        let around = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
        let outside = around.map(|at| self.height(at) >= 0.0);
        let sides = [([x, y], 0), ([x + 1, y], 1), ([x, y + 1], 0), ([x, y], 1)];
        let crossed: Vec<usize> = (0..4)
            .filter(|&k| outside[k] != outside[(k + 1) % 4])
            .collect();
        let pairs: &[[usize; 2]] = match crossed.len() {
            2 => &[[0, 1]],
            // A saddle: the middle says which corners belong together.
            4 => {
                let middle = self.place(x as f64 + 0.5, y as f64 + 0.5);
                let middle_outside = (self.near)(middle).distance >= 0.0;
                if middle_outside == outside[0] {
                    &[[0, 1], [2, 3]]
                } else {
                    &[[3, 0], [1, 2]]
                }
            }
            _ => &[],
        };
        for pair in pairs {
            let [a, b] = pair.map(|k| self.crossing_on(sides[crossed[k]]));
            self.joined[a].push(b);
            self.joined[b].push(a);
        }
    }

    /// The number of the crossing on a side.
    fn crossing_on(&mut self, side: Side) -> usize {
        if let Some(&known) = self.crossing.get(&side) {
            return known;
        }
        let (low, axis) = side;
        let mut high = low;
        high[axis] += 1;
        let (from, to) = (self.height(low), self.height(high));
        let mut at = low.map(|x| x as f64);
        at[axis] += (from / (from - to)).clamp(0.0, 1.0);
        let number = self.points.len();
        self.points
            .push((self.near)(self.place(at[0], at[1])).point);
        self.joined.push(Vec::new());
        self.crossing.insert(side, number);
        number
    }

    /// The crossings, chained.
    fn rings(self) -> Vec<Ring<D>> {
        let mut seen = vec![false; self.points.len()];
        let mut rings = Vec::new();
        for start in 0..self.points.len() {
            let mut points = Vec::new();
            let mut next = Some(start);
            while let Some(i) = next.filter(|&i| !seen[i]) {
                seen[i] = true;
                points.push(self.points[i]);
                next = self.joined[i].iter().copied().find(|&j| !seen[j]);
            }
            if points.len() > 2 {
                rings.push(Ring {
                    corner: vec![false; points.len()],
                    points,
                    is_open: false,
                });
            }
        }
        rings
    }
}

/// Takes `corner` in as a point of the ring that passes nearest.
fn insert<const D: usize>(rings: &mut [Ring<D>], corner: [f64; D]) {
    let mut best = (f64::INFINITY, 0, 0);
    for (number, ring) in rings.iter().enumerate() {
        for (i, &a) in ring.points.iter().enumerate() {
            let b = ring.points[(i + 1) % ring.points.len()];
            let (side, from) = (point::sub(b, a), point::sub(corner, a));
            let part = point::dot(from, side) / point::norm_squared(side).max(f64::MIN_POSITIVE);
            let q = point::add_scaled(a, part.clamp(0.0, 1.0), side);
            let distance = point::distance_squared(corner, q);
            if distance < best.0 {
                best = (distance, number, i);
            }
        }
    }
    let (distance, number, i) = best;
    if distance.is_finite() {
        rings[number].points.insert(i + 1, corner);
        rings[number].corner.insert(i + 1, true);
    }
}
