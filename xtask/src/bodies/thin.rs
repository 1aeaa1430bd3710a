//! Strips and plates of any thickness at any angle.

use std::fmt::Write as _;
use std::path::Path;

use sphpack::Outcome;
use sphpack_packing::Kind;

use super::drawn::{DEEP, Drawn, faults_of};
use super::frame::{Frame, outside_block};
use super::space;
use crate::scene_fuzz::random::Random;

/// A hole in a watertight one is no wider than this, in ∆s: a strip's, between two neighbours.
const HOLE: f64 = 1.2;

/// A plate's, the same part more than in a square of four at ∆s, by its radius.
const PLATE_HOLE: f64 = 0.5 * HOLE * std::f64::consts::SQRT_2;

/// Places that are looked at, along a strip and along each side of a plate: a hundredth of ∆s apart, and a twentieth.
const STEPS: [usize; 2] = [3000, 300];

/// A strip or a plate.
#[derive(Debug)]
struct Plate {
    dimension: usize,
    spacing: f64,
    /// Half its edges, the thickness last.
    half: [f64; 3],
    frame: Frame,
    is_watertight: bool,
}

pub(super) fn draw(number: u64) -> Box<dyn Drawn> {
    let mut random = Random::new(2, number);
    let dimension = if random.chance(0.6) { 2 } else { 3 };
    let spacing = if dimension == 2 { 0.05 } else { 0.1 };
    let is_watertight = random.chance(0.4);
    // A watertight part that is thicker is as any other.
    let most = if is_watertight { 1.0 } else { 6.0 };
    let thick = match random.below(4) {
        0 => 1.0,
        1 => f64::min(0.5 * random.whole(1, 8) as f64, most),
        _ => 0.02 * (most / 0.02_f64).powf(random.unit()),
    };
    let mut half = [0.5; 3].map(|half| half * random.between(0.8, 1.3));
    half[dimension - 1] = 0.5 * thick * spacing;
    if dimension == 2 {
        half[2] = 0.0;
    }
    let frame = match random.below(4) {
        0 => Frame::upright(),
        1 => Frame::turned(&mut random, dimension, 0.25 * std::f64::consts::PI),
        _ => Frame::random(&mut random, dimension),
    };
    Box::new(Plate {
        dimension,
        spacing,
        half,
        frame,
        is_watertight,
    })
}

impl Plate {
    fn volume(&self) -> f64 {
        self.half[..self.dimension]
            .iter()
            .map(|h| 2.0 * h)
            .product()
    }

    /// Whether the solid leaves a hole in its middle.
    fn leaks(&self, solid: &[[f64; 3]]) -> bool {
        let far = if self.dimension == 2 {
            0.5 * HOLE
        } else {
            PLATE_HOLE
        } * self.spacing;
        let steps = STEPS[self.dimension - 2];
        let across = if self.dimension == 2 { 1 } else { steps };
        let at = |k: usize, count: usize| (k as f64 + 0.5) / count as f64 * 2.0 - 1.0;
        (0..steps).any(|i| {
            (0..across).any(|j| {
                let mut p = [at(i, steps) * self.half[0], 0.0, 0.0];
                if self.dimension == 3 {
                    p[1] = at(j, steps) * self.half[1];
                }
                !(solid.iter())
                    .any(|q| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>() <= far * far)
            })
        })
    }
}

impl Drawn for Plate {
    fn text(&self, folder: &Path, number: u64) -> Result<String, String> {
        let corner = |x: f64, y: f64| self.frame.place([x * self.half[0], y * self.half[1], 0.0]);
        let shape = if self.dimension == 2 {
            let mut points = String::new();
            for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                let [x, y, _] = corner(x, y);
                let _ = write!(points, "[{x:?}, {y:?}], ");
            }
            format!("polygon = {{ points = [{points}] }}")
        } else {
            let block = space::cuboid(self.half.map(|half| -half), self.half);
            let turned: Vec<_> = (block.iter())
                .map(|corners| corners.map(|p| self.frame.place(p)))
                .collect();
            let file = format!("thin-{number}.obj");
            space::write(&turned, &folder.join(&file))?;
            format!("file = {file:?}")
        };
        Ok(format!(
            "spacing = {:?}\n[domain]\nmargin = {:?}\n[[body]]\nname = \"plate\"\nthin = \"{}\"\nshape = {{ {shape} }}\n",
            self.spacing,
            6.0 * self.spacing,
            if self.is_watertight {
                "watertight"
            } else {
                "mass"
            }
        ))
    }

    fn faults(&self, outcome: &Outcome) -> Vec<String> {
        let table = &outcome.table;
        let (mut held, mut strayed, mut sunk) = (0.0, 0, 0);
        let mut solid = Vec::new();
        for i in (0..table.len()).filter(|&i| table.kind[i] != Kind::Frozen) {
            let own = self.frame.own(table.position[i]);
            let out = outside_block(self.half, own, self.dimension);
            if table.body[i].is_some() {
                held += table.volume[i];
                strayed += usize::from(out > 1e-6 * self.spacing);
                solid.push(own);
            } else {
                sunk += usize::from(out < -DEEP * self.spacing);
            }
        }
        // What is watertight weighs what it must.
        let exact = if self.is_watertight {
            held
        } else {
            self.volume()
        };
        let holes = usize::from(self.is_watertight && self.leaks(&solid));
        let counts = [
            (strayed, "particles of the body outside it"),
            (sunk, "particles of fluid in the body"),
            (holes, "hole at least"),
        ];
        faults_of(outcome, &counts, [held, exact])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_are_seen() {
        let strip = Plate {
            dimension: 2,
            spacing: 0.1,
            half: [0.5, 0.01, 0.0],
            frame: Frame::upright(),
            is_watertight: true,
        };
        let row = |apart: f64| -> Vec<[f64; 3]> {
            let count = (1.0 / apart).round();
            (0..count as u32)
                .map(|k| [(f64::from(k) + 0.5) / count - 0.5, 0.0, 0.0])
                .collect()
        };
        assert!(!strip.leaks(&row(0.1)) && strip.leaks(&row(0.125)));
        let plate = Plate {
            dimension: 3,
            half: [0.5, 0.5, 0.01],
            ..strip
        };
        let grid = |apart: f64| -> Vec<[f64; 3]> {
            let line = row(apart);
            (line.iter())
                .flat_map(|a| line.iter().map(|b| [a[0], b[0], 0.0]))
                .collect()
        };
        assert!(!plate.leaks(&grid(0.1)) && plate.leaks(&grid(0.125)));
    }
}
