//! Random bodies that pass the sides of a box, lie on them or meet their images across them.

use std::f64::consts::TAU;
use std::path::Path;

use sphpack::Outcome;
use sphpack_packing::Kind;

use super::drawn::{COINCIDENT, DEEP, Drawn, is_deep};
use super::shapes::Shape;
use crate::scene_fuzz::random::Random;

/// Cells along an axis by which volumes are counted, in the plane and in space.
const RASTER: [usize; 2] = [1200, 150];

/// Steps of a sequence that covers the unit cube evenly.
const STEPS: [f64; 3] = [0.819_172_513_396, 0.671_043_606_703, 0.549_700_477_901];

/// A body in a box.
#[derive(Debug, Clone)]
struct Boxed {
    dimension: usize,
    spacing: f64,
    max: [f64; 3],
    periodic: [bool; 3],
    shape: Shape,
    /// From the box to where the body's images are that reach into it.
    shifts: Vec<[f64; 3]>,
}

impl Boxed {
    /// One of a seed; `is_cell` has periodic sides.
    fn random(seed: u64, number: u64, is_cell: bool) -> Self {
        let mut random = Random::new(seed, number);
        let dimension = if random.chance(0.6) { 2 } else { 3 };
        let spacing = random.between(0.07, 0.13);
        let size = if dimension == 2 { 3.0 } else { 1.6 };
        let mut max = [0.0; 3];
        let mut periodic = [false; 3];
        for k in 0..dimension {
            max[k] = size * random.between(0.7, 1.3);
            periodic[k] = is_cell && random.chance(0.5);
        }
        if is_cell && periodic == [false; 3] {
            periodic[random.below(dimension)] = true;
        }
        let shape = if dimension == 2 {
            flat(&mut random, max, periodic)
        } else {
            solid(&mut random, max, periodic)
        };
        Self::new(dimension, spacing, (max, periodic), shape)
    }

    fn new(
        dimension: usize,
        spacing: f64,
        (max, periodic): ([f64; 3], [bool; 3]),
        shape: Shape,
    ) -> Self {
        let [low, high] = shape.ends();
        let steps = |k: usize| if periodic[k] { 2_i32 } else { 0 };
        let mut shifts = Vec::new();
        for i in -steps(0)..=steps(0) {
            for j in -steps(1)..=steps(1) {
                for k in -steps(2)..=steps(2) {
                    let step = [i, j, k];
                    let shift: [f64; 3] = std::array::from_fn(|a| f64::from(step[a]) * max[a]);
                    let reaches = |a: usize| {
                        low[a] - shift[a] <= 1.1 * max[a] && high[a] - shift[a] >= -0.1 * max[a]
                    };
                    if (0..dimension).all(reaches) {
                        shifts.push(shift);
                    }
                }
            }
        }
        Self {
            dimension,
            spacing,
            max,
            periodic,
            shape,
            shifts,
        }
    }

    /// Whether the body or an image of it holds a place.
    fn holds(&self, p: [f64; 3]) -> bool {
        (self.shifts.iter()).any(|shift| self.shape.holds(std::array::from_fn(|k| p[k] + shift[k])))
    }

    /// What of the box the body has.
    fn volume(&self) -> f64 {
        let count = RASTER[self.dimension - 2];
        let layers = if self.dimension == 2 { 1 } else { count };
        let step: [f64; 3] = std::array::from_fn(|k| self.max[k] / count as f64);
        let mut held = 0_u64;
        let mut number = 0.0;
        for i in 0..count {
            for j in 0..count {
                for k in 0..layers {
                    let cell = [i, j, k];
                    // Not in the middle of every cell, where faces along the axes would be seen all or not at all.
                    number += 1.0;
                    let mut p: [f64; 3] = std::array::from_fn(|a| {
                        (cell[a] as f64 + (number * STEPS[a]).fract()) * step[a]
                    });
                    if self.dimension == 2 {
                        p[2] = 0.0;
                    }
                    held += u64::from(self.holds(p));
                }
            }
        }
        let cell: f64 = step[..self.dimension].iter().product();
        held as f64 * cell
    }
}

impl Drawn for Boxed {
    fn text(&self, _folder: &Path, _number: u64) -> Result<String, String> {
        let list = |values: &[f64; 3]| format!("{:?}", &values[..self.dimension]);
        Ok(format!(
            "spacing = {:?}\n[domain]\nmin = {}\nmax = {}\nperiodic = {:?}\n[[body]]\nname = \"body\"\nshape = {{ {} }}\n",
            self.spacing,
            list(&[0.0; 3]),
            list(&self.max),
            &self.periodic[..self.dimension],
            self.shape.words(self.dimension)
        ))
    }

    fn faults(&self, outcome: &Outcome) -> Vec<String> {
        let table = &outcome.table;
        let mut faults = Vec::new();
        let mut volume = 0.0;
        let inner: Vec<usize> = (0..table.len())
            .filter(|&i| table.kind[i] != Kind::Frozen)
            .collect();
        let (mut out, mut strayed, mut sunk) = (0, 0, 0);
        for &i in &inner {
            let p = table.position[i];
            out += usize::from(
                (0..self.dimension)
                    .any(|k| p[k] < -1e-9 * self.max[k] || p[k] > (1.0 + 1e-9) * self.max[k]),
            );
            if table.body[i].is_some() {
                volume += table.volume[i];
                strayed += usize::from(!self.holds(p));
            } else {
                sunk += usize::from(is_deep(self.dimension, DEEP * self.spacing, p, |p| {
                    self.holds(p)
                }));
            }
        }
        for (count, what) in [
            (out, "outside the box"),
            (strayed, "of the body outside it"),
            (sunk, "of fluid in the body"),
        ] {
            if count > 0 {
                faults.push(format!("{count} particles {what}"));
            }
        }
        let exact = self.volume();
        let each = self.spacing.powi(self.dimension as i32);
        let off = (volume - exact).abs();
        // What counting cells misses is a tenth of a particle at most.
        if off > (0.6 * each).max(0.01 * exact) {
            faults.push(format!("the body's volume is {volume:.5}, not {exact:.5}"));
        }
        let mut least = f64::INFINITY;
        for (n, &i) in inner.iter().enumerate() {
            for &j in &inner[n + 1..] {
                let (p, q) = (table.position[i], table.position[j]);
                let square: f64 = (0..self.dimension)
                    .map(|k| {
                        let d = (p[k] - q[k]).abs();
                        let d = if self.periodic[k] {
                            d.min(self.max[k] - d)
                        } else {
                            d
                        };
                        d * d
                    })
                    .sum();
                least = least.min(square);
            }
        }
        let least = least.sqrt() / self.spacing;
        if least < COINCIDENT {
            faults.push(format!("two particles are {least:.3} apart"));
        }
        let said = outcome.report.closest_pair_over_spacing;
        // Beside open sides there are frozen ones, too.
        let is_closed = self.periodic[..self.dimension] == [true; 3][..self.dimension];
        if is_closed && (least - said).abs() > 1e-6 * said {
            faults.push(format!("the closest pair is {least}, said is {said}"));
        }
        faults
    }
}

/// A body in the plane, mostly one that passes a side.
fn flat(random: &mut Random, max: [f64; 3], periodic: [bool; 3]) -> Shape {
    let across = usize::from(!periodic[0]);
    let along = if periodic[0] {
        0
    } else {
        usize::from(periodic[1])
    };
    match random.below(5) {
        0 => {
            let center = [0, 1, 2].map(|k| max[k] * random.between(-0.1, 1.1));
            Shape::Ball(center, random.between(0.35, 0.8))
        }
        1 => {
            let center = [0, 1].map(|k| max[k] * random.between(0.0, 1.0));
            let count = random.whole(5, 40);
            let (base, turn) = (random.between(0.5, 0.9), random.between(0.0, TAU));
            Shape::Polygon(
                (0..count)
                    .map(|k| {
                        let angle = turn + TAU * k as f64 / count as f64;
                        let radius = base * random.between(0.85, 1.15);
                        [
                            center[0] + radius * angle.cos(),
                            center[1] + radius * angle.sin(),
                        ]
                    })
                    .collect(),
            )
        }
        2 => {
            // A floor, even or as high at both ends, beginning anywhere where it is endless.
            let base = max[1 - along] * random.between(0.25, 0.6);
            let wave = random.between(0.0, 0.2);
            let periods = random.whole(1, 2) as f64;
            let phase = random.between(0.0, TAU);
            let shift = if periodic[along] {
                random.between(-1.0, 1.0)
            } else {
                0.0
            };
            let count = 120;
            let mut points = Vec::new();
            for k in 0..=count {
                let t = f64::from(k) / f64::from(count);
                let high = base + wave * (TAU * periods * t + phase).sin();
                points.push([max[along] * (t + shift), high]);
            }
            let low = if periodic[1 - along] { 0.1 } else { 0.0 };
            points.push([max[along] * (1.0 + shift), low]);
            points.push([max[along] * shift, low]);
            if along == 1 {
                points.iter_mut().for_each(|p| p.swap(0, 1));
            }
            Shape::Polygon(points)
        }
        3 => {
            let mut low = [0, 1, 2].map(|k| max[k] * random.between(0.1, 0.4));
            let mut high = [0, 1, 2].map(|k| low[k] + max[k] * random.between(0.3, 0.5));
            // On one side, or from side to side.
            if random.chance(0.5) {
                low[across] = 0.0;
            } else {
                high[across] = max[across];
            }
            if random.chance(0.5) {
                (low[along], high[along]) = (0.0, max[along]);
            }
            (low[2], high[2]) = (-1.0, 1.0);
            Shape::Block(low, high)
        }
        _ => {
            // A leaning bar through one side, or two.
            let half = random.between(0.25, 0.5);
            let lean = random.between(-0.5, 0.5);
            let foot = max[0] * random.between(0.3, 0.7);
            let high = if random.chance(0.5) {
                1.6 * max[1]
            } else {
                0.6 * max[1]
            };
            let deep = -0.6 * max[1];
            let at = |y: f64| foot + lean * y;
            Shape::Polygon(vec![
                [at(deep) - half, deep],
                [at(deep) + half, deep],
                [at(high) + half, high],
                [at(high) - half, high],
            ])
        }
    }
}

/// A body in space.
fn solid(random: &mut Random, max: [f64; 3], periodic: [bool; 3]) -> Shape {
    let along = (0..3)
        .find(|&k| periodic[k])
        .unwrap_or_else(|| random.below(3));
    match random.below(4) {
        0 => {
            let center = [0, 1, 2].map(|k| max[k] * random.between(-0.1, 1.1));
            Shape::Ball(center, random.between(0.3, 0.6))
        }
        1 => {
            // A pipe of the box's length, or a pile through one side.
            let middle = [0, 1, 2].map(|k| max[k] * random.between(0.4, 0.6));
            let (mut from, mut to) = (middle, middle);
            (from[along], to[along]) = if random.chance(0.6) {
                (0.0, max[along])
            } else {
                (-0.3 * max[along], 0.6 * max[along])
            };
            Shape::Rod(from, to, random.between(0.25, 0.4))
        }
        2 => {
            let mut low = [0.0; 3];
            let mut high = max;
            // A floor, a wall, or a bar along an edge of the box.
            for k in (0..3).filter(|&k| k != along) {
                if random.chance(0.7) {
                    high[k] = max[k] * random.between(0.3, 0.6);
                    if periodic[k] {
                        low[k] = 0.1;
                        high[k] += 0.1;
                    }
                }
            }
            Shape::Block(low, high)
        }
        _ => {
            let low = [0, 1, 2].map(|k| max[k] * random.between(-0.3, 0.3));
            let high = [0, 1, 2].map(|k| low[k] + max[k] * random.between(0.4, 0.6));
            Shape::Block(low, high)
        }
    }
}

/// A box with open sides, and one with periodic ones.
pub(super) fn wall(number: u64) -> Box<dyn Drawn> {
    Box::new(Boxed::random(0, number, false))
}

pub(super) fn cell(number: u64) -> Box<dyn Drawn> {
    Box::new(Boxed::random(1, number, true))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_are_counted() {
        let shape = Shape::Block([1.5, -1.0, -1.0], [2.5, 0.5, 1.0]);
        let sides = ([2.0, 1.0, 0.0], [true, false, false]);
        let boxed = Boxed::new(2, 0.1, sides, shape);
        assert!((boxed.volume() - 0.5).abs() < 1e-9);
        assert!(boxed.holds([0.2, 0.2, 0.0]) && !boxed.holds([0.8, 0.2, 0.0]));
        let deep = |p| is_deep(2, 0.012, p, |p| boxed.holds(p));
        assert!(deep([0.2, 0.2, 0.0]) && !deep([0.495, 0.2, 0.0]));
    }
}
