//! Random bodies that pass the sides of a box, lie on them or meet their images across them.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use sphpack::{Options, Outcome, Scene, run as pack};
use sphpack_packing::{Kind, Silent};

use super::shapes::Shape;
use super::{CLOSEST, LINF, Row};
use crate::scene_fuzz::random::Random;

/// Boxes of each kind, and in the short form.
pub(super) const WALLS: usize = 200;
pub(super) const CELLS: usize = 300;
const QUICK: usize = 10;

/// Cells along an axis by which volumes are counted, in the plane and in space.
const RASTER: [usize; 2] = [1200, 150];

/// Steps of a sequence that covers the unit cube evenly.
const STEPS: [f64; 3] = [0.819_172_513_396, 0.671_043_606_703, 0.549_700_477_901];

/// A fluid particle is in a solid where it is deeper than this, in ∆s.
const DEEP: f64 = 0.12;

/// Pairs nearer than this, in ∆s, are wrong.
const COINCIDENT: f64 = 0.5;

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

    fn text(&self) -> String {
        let list = |values: &[f64; 3]| format!("{:?}", &values[..self.dimension]);
        format!(
            "spacing = {:?}\n[domain]\nmin = {}\nmax = {}\nperiodic = {:?}\n[[body]]\nname = \"body\"\nshape = {{ {} }}\n",
            self.spacing,
            list(&[0.0; 3]),
            list(&self.max),
            &self.periodic[..self.dimension],
            self.shape.words(self.dimension)
        )
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

    /// What is wrong with a packing that says it is right.
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
                sunk += usize::from(self.is_deep(p));
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

    fn is_deep(&self, p: [f64; 3]) -> bool {
        let far = DEEP * self.spacing;
        self.holds(p)
            && (0..60).all(|n| {
                let angle = TAU * f64::from(n) * 0.618_034;
                let high = if self.dimension == 2 {
                    0.0
                } else {
                    f64::from(n) / 29.5 - 1.0
                };
                let flat = (1.0 - high * high).sqrt();
                self.holds([
                    p[0] + far * flat * angle.cos(),
                    p[1] + far * flat * angle.sin(),
                    p[2] + far * high,
                ])
            })
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

/// Boxes of one kind.
#[derive(Debug, Clone, Copy)]
pub(super) struct BoxKind {
    pub(super) name: &'static str,
    is_cell: bool,
    count: usize,
}

/// Boxes with open sides, and with periodic ones.
pub(super) const KINDS: [BoxKind; 2] = [
    BoxKind {
        name: "walls",
        is_cell: false,
        count: WALLS,
    },
    BoxKind {
        name: "periodic cells",
        is_cell: true,
        count: CELLS,
    },
];

/// Packs and judges boxes of a kind.
pub(super) fn row(kind: BoxKind, folder: &Path, is_quick: bool) -> Result<Row, String> {
    let mut row = Row::new(kind.name);
    for number in 0..if is_quick { QUICK } else { kind.count } {
        let boxed = Boxed::random(u64::from(kind.is_cell), number as u64, kind.is_cell);
        judge(&boxed, number, folder, &mut row)?;
    }
    Ok(row)
}

fn judge(boxed: &Boxed, number: usize, folder: &Path, row: &mut Row) -> Result<(), String> {
    row.scenes += 1;
    let text = boxed.text();
    let path = folder.join(format!("{}-{number}.toml", row.name.replace(' ', "-")));
    std::fs::write(&path, &text).map_err(|error| format!("{}: {error}", path.display()))?;
    let scene = Scene::parse(&text, &path).map_err(|error| error.to_string())?;
    let outcome = match pack(&scene, &Options::default(), &mut Silent) {
        Ok(outcome) => outcome,
        Err(error) => {
            row.refused += 1;
            eprintln!("{} {number}: refused: {error}", row.name);
            return Ok(());
        }
    };
    let report = &outcome.report;
    if !(report.converged && report.audit.passed) {
        row.said += 1;
        eprintln!(
            "{} {number}: {}: {:?}",
            row.name, report.stop_reason, report.audit.messages
        );
        return Ok(());
    }
    let faults = boxed.faults(&outcome);
    let closest = report.closest_pair_over_spacing;
    row.right += usize::from(faults.is_empty());
    row.even += usize::from(report.density.linf <= LINF && closest >= CLOSEST);
    if !(report.density.linf <= LINF && closest >= CLOSEST) {
        eprintln!(
            "{} {number}: L∞ {:.2e}, closest pair {closest:.3}",
            row.name, report.density.linf
        );
    }
    row.worst[1] = row.worst[1].max(report.density.linf);
    row.worst[2] = row.worst[2].min(closest);
    if !faults.is_empty() {
        let mut words = format!("{} {number}:", row.name);
        for fault in faults {
            let _ = write!(words, " {fault};");
        }
        row.wrong.push(words);
    }
    Ok(())
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
        assert!(boxed.is_deep([0.2, 0.2, 0.0]) && !boxed.is_deep([0.495, 0.2, 0.0]));
    }
}
