//! Bodies much larger than the box that they pass, alone or with a ball that cuts them or is cut by them.

use std::f64::consts::TAU;
use std::path::Path;

use sphpack::Outcome;
use sphpack_packing::Kind;

use super::drawn::{DEEP, Drawn, faults_of, is_deep};
use crate::scene_fuzz::random::Random;

/// Cells of ∆s in which one place each is counted, along each axis.
const CELLS: f64 = 8.0;

/// A shape that reaches far beyond the box, by its formula.
#[derive(Debug)]
enum Shape {
    /// An ellipse or ellipsoid along the axes.
    Round {
        center: [f64; 3],
        axes: [f64; 3],
    },
    Block {
        min: [f64; 3],
        max: [f64; 3],
    },
    Rod {
        start: [f64; 3],
        along: [f64; 3],
        length: f64,
        radius: f64,
    },
    Ring {
        center: [f64; 3],
        axis: [f64; 3],
        radii: [f64; 2],
    },
}

#[derive(Debug)]
struct Giant {
    dimension: usize,
    /// Edges of the box, from the origin; ∆s is 1.
    edges: [f64; 3],
    shape: Shape,
    /// A ball in the box, its centre and radius, and whether it keeps the room that both claim.
    ball: Option<([f64; 3], f64, bool)>,
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn on(a: [f64; 3], by: f64, along: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + by * along[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

/// A direction, in the plane across z.
fn direction(random: &mut Random, dimension: usize) -> [f64; 3] {
    let high = if dimension == 2 {
        0.0
    } else {
        random.between(-1.0, 1.0)
    };
    let flat = (1.0 - high * high).sqrt();
    let (sin, cos) = random.between(0.0, TAU).sin_cos();
    [flat * cos, flat * sin, high]
}

/// A direction across another one.
fn across(random: &mut Random, u: [f64; 3]) -> [f64; 3] {
    loop {
        let v = direction(random, 3);
        let v = on(v, -dot(u, v), u);
        let length = dot(v, v).sqrt();
        if length > 0.1 {
            return v.map(|x| x / length);
        }
    }
}

pub(super) fn draw(number: u64) -> Box<dyn Drawn> {
    let mut random = Random::new(6, number);
    let random = &mut random;
    let dimension = if random.chance(0.3) { 2 } else { 3 };
    let mut edges = [0.0; 3];
    for edge in &mut edges[..dimension] {
        *edge = random.between(7.0, 12.0);
    }
    // As large as 10 to 10⁵ ∆s; the surface passes this place.
    let size = 10.0_f64.powf(random.between(1.0, 5.0));
    let place = edges.map(|edge| edge * random.between(0.3, 0.7));
    let out = direction(random, dimension);
    let axes = |random: &mut Random| [0.0; 3].map(|_: f64| size * random.between(0.3, 1.0));
    let shape = match random.below(if dimension == 2 { 2 } else { 5 }) {
        0 => {
            let axes = axes(random);
            let center = std::array::from_fn(|k| place[k] - axes[k] * out[k]);
            Shape::Round { center, axes }
        }
        1 => {
            let (low, high) = (axes(random), axes(random));
            let mut max = high;
            let side = random.below(dimension);
            max[side] = place[side];
            Shape::Block {
                min: low.map(|x| -x),
                max,
            }
        }
        // A flat end in the box.
        2 => Shape::Rod {
            start: on(place, -size, out),
            along: out,
            length: size,
            radius: size * random.between(0.3, 1.0),
        },
        // Its round side.
        3 => {
            let along = across(random, out);
            let middle = on(place, -size, out);
            Shape::Rod {
                start: on(middle, -size, along),
                along,
                length: 2.0 * size,
                radius: size,
            }
        }
        _ => {
            let minor = size * random.between(0.1, 0.4);
            let axis = across(random, out);
            let (sin, cos) = random.between(0.0, TAU).sin_cos();
            let middle = on(on(place, -minor * cos, out), -minor * sin, axis);
            Shape::Ring {
                center: on(middle, -size, out),
                axis,
                radii: [size, minor],
            }
        }
    };
    let ball = random.chance(0.4).then(|| {
        let radius = random.between(2.0, 3.0);
        let center = edges.map(|edge| 0.5 * edge);
        (center, radius, random.chance(0.5))
    });
    Box::new(Giant {
        dimension,
        edges,
        shape,
        ball,
    })
}

impl Shape {
    fn holds(&self, p: [f64; 3], dimension: usize) -> bool {
        let axes = 0..dimension;
        match self {
            Self::Round { center, axes: e } => {
                axes.map(|k| ((p[k] - center[k]) / e[k]).powi(2))
                    .sum::<f64>()
                    < 1.0
            }
            Self::Block { min, max } => axes.into_iter().all(|k| min[k] < p[k] && p[k] < max[k]),
            Self::Rod {
                start,
                along,
                length,
                radius,
            } => {
                let from = sub(p, *start);
                let high = dot(from, *along);
                let flat = on(from, -high, *along);
                0.0 < high && high < *length && dot(flat, flat) < radius * radius
            }
            Self::Ring {
                center,
                axis,
                radii,
            } => {
                let from = sub(p, *center);
                let high = dot(from, *axis);
                let flat = on(from, -high, *axis);
                (dot(flat, flat).sqrt() - radii[0]).hypot(high) < radii[1]
            }
        }
    }

    fn text(&self, dimension: usize) -> String {
        let d = dimension;
        match self {
            Self::Round { center, axes } => {
                let name = if d == 2 { "ellipse" } else { "ellipsoid" };
                format!(
                    "{name} = {{ center = {:?}, semi_axes = {:?} }}",
                    &center[..d],
                    &axes[..d]
                )
            }
            Self::Block { min, max } => {
                format!("box = {{ min = {:?}, max = {:?} }}", &min[..d], &max[..d])
            }
            Self::Rod {
                start,
                along,
                length,
                radius,
            } => {
                let end = on(*start, *length, *along);
                format!("cylinder = {{ start = {start:?}, end = {end:?}, radius = {radius:?} }}")
            }
            Self::Ring {
                center,
                axis,
                radii: [major, minor],
            } => format!(
                "torus = {{ center = {center:?}, axis = {axis:?}, major = {major:?}, minor = {minor:?} }}"
            ),
        }
    }
}

impl Giant {
    /// Whether the ball holds a place, and whether either body does.
    fn holds(&self, p: [f64; 3]) -> [bool; 2] {
        let in_ball = self.ball.is_some_and(|(center, radius, _)| {
            let from = sub(p, center);
            let from = if self.dimension == 2 {
                [from[0], from[1], 0.0]
            } else {
                from
            };
            dot(from, from) < radius * radius
        });
        let in_giant = self.shape.holds(p, self.dimension);
        let keeps = self.ball.is_some_and(|(_, _, keeps)| keeps);
        [in_ball && (keeps || !in_giant), in_ball || in_giant]
    }

    /// What of the box the ball holds, and either: one place in each cell, anywhere in it.
    fn volumes(&self) -> [f64; 2] {
        let mut random = Random::new(1, 1);
        let counts = self
            .edges
            .map(|edge| ((edge * CELLS).ceil() as usize).max(1));
        let mut held = [0_usize; 2];
        for number in 0..counts.iter().product() {
            let cell = [
                number % counts[0],
                number / counts[0] % counts[1],
                number / counts[0] / counts[1],
            ];
            let p = std::array::from_fn(|k| {
                (cell[k] as f64 + random.unit()) / counts[k] as f64 * self.edges[k]
            });
            for (held, holds) in held.iter_mut().zip(self.holds(p)) {
                *held += usize::from(holds);
            }
        }
        let whole: f64 = self.edges[..self.dimension].iter().product();
        let all: usize = counts.iter().product();
        held.map(|held| whole * held as f64 / all as f64)
    }
}

impl Drawn for Giant {
    fn text(&self, _: &Path, _: u64) -> Result<String, String> {
        let d = self.dimension;
        let mut text = format!(
            "spacing = 1.0\n[domain]\nmin = {:?}\nmax = {:?}\n[[body]]\nname = \"giant\"\nshape = {{ {} }}\n",
            &[0.0; 3][..d],
            &self.edges[..d],
            self.shape.text(d)
        );
        if let Some((center, radius, keeps)) = self.ball {
            let name = if d == 2 { "circle" } else { "sphere" };
            let center = &center[..d];
            let ball = format!(
                "[[body]]\nname = \"ball\"\nshape = {{ {name} = {{ center = {center:?}, radius = {radius:?} }} }}\n"
            );
            if keeps {
                text += &ball;
                text += "precedence = 1\n";
            } else {
                text += "precedence = 1\n";
                text += &ball;
            }
        }
        Ok(text)
    }

    fn faults(&self, outcome: &Outcome) -> Vec<String> {
        let table = &outcome.table;
        let [mut strayed, mut sunk] = [0; 2];
        let mut held = [0.0; 2];
        for i in (0..table.len()).filter(|&i| table.kind[i] != Kind::Frozen) {
            let p = table.position[i];
            let is_deep = |body: usize| is_deep(self.dimension, DEEP, p, |p| self.holds(p)[body]);
            let is_out = |body: usize| is_deep_outside(self.dimension, p, |p| self.holds(p)[body]);
            if let Some(body) = table.body[i] {
                held[1] += table.volume[i];
                let is_ball = outcome.report.bodies[body as usize].name == "ball";
                held[0] += if is_ball { table.volume[i] } else { 0.0 };
                strayed += usize::from(is_out(1));
                sunk += usize::from(if is_ball { is_out(0) } else { is_deep(0) });
            } else {
                sunk += usize::from(is_deep(1));
            }
        }
        let exact = self.volumes();
        let mut faults = faults_of(
            outcome,
            &[
                (strayed, "particles of the bodies outside them"),
                (sunk, "particles in a body that is not theirs"),
            ],
            [held[1], exact[1]],
        );
        for fault in faults_of(outcome, &[], [held[0], exact[0]]) {
            if !faults.contains(&fault) {
                faults.push(fault);
            }
        }
        faults
    }
}

/// Whether nothing of what is asked for is as near to a place as a thousandth of ∆s.
fn is_deep_outside(dimension: usize, p: [f64; 3], holds: impl Fn([f64; 3]) -> bool) -> bool {
    is_deep(dimension, 1e-3, p, |p| !holds(p))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_are_those_of_halves() {
        let giant = Giant {
            dimension: 3,
            edges: [8.0, 10.0, 12.0],
            shape: Shape::Block {
                min: [-1e4; 3],
                max: [4.0, 1e4, 1e4],
            },
            ball: Some(([4.0, 5.0, 6.0], 3.0, true)),
        };
        let [ball, all] = giant.volumes();
        let exact = TAU * 18.0;
        assert!((ball - exact).abs() < 0.01 * exact, "{ball}");
        assert!((all - 480.0 - 0.5 * exact).abs() < 0.01 * all, "{all}");
        assert_eq!(giant.holds([3.0, 1.0, 1.0]), [false, true]);
        assert_eq!(giant.holds([6.0, 5.0, 6.0]), [true, true]);
    }
}
