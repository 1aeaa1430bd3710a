//! Bodies in the plane: loops in loops and beside each other.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::{Case, Particle, Region};

type Loop = Vec<[f64; 2]>;

/// Loops that do not cross, holes inside solids inside holes.
struct Loops {
    name: &'static str,
    size: f64,
    loops: Vec<Loop>,
}

/// All of them.
pub(super) fn cases() -> Vec<Box<dyn Case>> {
    let squares: Vec<Loop> = (0..16)
        .map(|k| {
            let at = [f64::from(k % 4), f64::from(k / 4)];
            // Sizes and turns without a common measure.
            let edge = 0.4 + 0.3 * (f64::from(k) * 0.618).fract();
            block(at, [edge; 2], f64::from(k) * 0.37)
        })
        .collect();
    let strips = (0..5)
        .map(|k| {
            block(
                [0.0, 0.5 * f64::from(k)],
                [2.0, 0.1 + 0.05 * f64::from(k)],
                0.0,
            )
        })
        .collect();
    let window = (0..9)
        .map(|k| {
            block(
                [f64::from(k % 3) * 1.2, f64::from(k / 3) * 1.2],
                [0.6; 2],
                0.0,
            )
        })
        .chain([block([1.2; 2], [4.2; 2], 0.0)])
        .collect();
    let case = |name, size, loops| Box::new(Loops { name, size, loops }) as Box<dyn Case>;
    vec![
        case(
            "ring",
            0.2,
            vec![circle([0.0; 2], 1.0), circle([0.0; 2], 0.8)],
        ),
        case(
            "ring with an island",
            0.2,
            vec![
                circle([0.0; 2], 1.0),
                circle([0.0; 2], 0.8),
                circle([0.1, 0.0], 0.3),
            ],
        ),
        case(
            "target",
            0.15,
            (0..6)
                .map(|k| circle([0.0; 2], 1.0 - 0.15 * f64::from(k)))
                .collect(),
        ),
        case("sixteen squares", 0.4, squares),
        case("strips", 0.1, strips),
        case("window", 0.6, window),
        case(
            "blocks that face each other",
            1.0,
            vec![
                block([0.0, 0.0], [1.0; 2], 0.0),
                block([1.15, 0.0], [1.0; 2], 0.0),
                block([0.0, 1.25], [1.0; 2], 0.0),
            ],
        ),
    ]
}

fn circle(center: [f64; 2], radius: f64) -> Loop {
    let count = 240;
    (0..count)
        .map(|k| {
            let angle = TAU * f64::from(k) / f64::from(count);
            [
                center[0] + radius * angle.cos(),
                center[1] + radius * angle.sin(),
            ]
        })
        .collect()
}

fn block(center: [f64; 2], edges: [f64; 2], turn: f64) -> Loop {
    let (sin, cos) = turn.sin_cos();
    [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]
        .map(|[u, v]| [u * edges[0], v * edges[1]])
        .map(|[x, y]| [center[0] + x * cos - y * sin, center[1] + x * sin + y * cos])
        .to_vec()
}

/// By the shoelace formula.
fn area(points: &Loop) -> f64 {
    let mut twice = 0.0;
    for (k, [x, y]) in points.iter().enumerate() {
        let [u, v] = points[(k + 1) % points.len()];
        twice += x * v - u * y;
    }
    0.5 * twice.abs()
}

/// The angle that a loop turns around a point by, in full turns: not 0 inside.
fn winds(points: &Loop, p: [f64; 2]) -> bool {
    let mut sum = 0.0;
    for (k, [x, y]) in points.iter().enumerate() {
        let [u, v] = points[(k + 1) % points.len()];
        let (a, b) = ([x - p[0], y - p[1]], [u - p[0], v - p[1]]);
        sum += (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
    }
    (sum / TAU).abs() > 0.5
}

impl Loops {
    /// Loops around a loop.
    fn depth(&self, number: usize) -> usize {
        let first = self.loops[number][0];
        (0..self.loops.len())
            .filter(|&other| other != number && winds(&self.loops[other], first))
            .count()
    }
}

impl Case for Loops {
    fn name(&self) -> &'static str {
        self.name
    }

    fn dimension(&self) -> usize {
        2
    }

    fn size(&self) -> f64 {
        self.size
    }

    fn write(&self, folder: &Path) -> Result<String, String> {
        let mut text = String::new();
        for points in &self.loops {
            for [x, y] in points {
                let _ = writeln!(text, "{x:?},{y:?}");
            }
            text.push('\n');
        }
        let path = folder.join("body.csv");
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok("body.csv".to_owned())
    }

    fn regions(&self) -> Vec<Region> {
        (0..self.loops.len())
            .map(|number| {
                let depth = self.depth(number);
                let within: f64 = (0..self.loops.len())
                    .filter(|&other| {
                        self.depth(other) == depth + 1
                            && winds(&self.loops[number], self.loops[other][0])
                    })
                    .map(|other| area(&self.loops[other]))
                    .sum();
                let what = if depth.is_multiple_of(2) {
                    "part"
                } else {
                    "pocket"
                };
                Region {
                    name: format!("{what} {number}"),
                    volume: area(&self.loops[number]) - within,
                }
            })
            .collect()
    }

    fn region(&self, particle: &Particle) -> Option<usize> {
        let [x, y, _] = particle.place;
        (0..self.loops.len())
            .filter(|&number| {
                let is_solid = self.depth(number).is_multiple_of(2);
                is_solid == particle.is_solid && winds(&self.loops[number], [x, y])
            })
            .max_by_key(|&number| self.depth(number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_of_a_target() {
        let case = Loops {
            name: "target",
            size: 1.0,
            loops: vec![
                block([0.0; 2], [4.0; 2], 0.1),
                block([0.0; 2], [2.0; 2], 0.3),
                block([0.0; 2], [1.0; 2], 0.0),
            ],
        };
        let volumes: Vec<f64> = case.regions().iter().map(|region| region.volume).collect();
        for (found, exact) in volumes.iter().zip([12.0, 3.0, 1.0]) {
            assert!((found - exact).abs() < 1e-12, "{volumes:?}");
        }
        let at = |x: f64, is_solid| Particle {
            place: [x, 0.0, 0.0],
            is_solid,
            volume: 1.0,
        };
        assert_eq!(case.region(&at(1.5, true)), Some(0));
        assert_eq!(case.region(&at(0.7, false)), Some(1));
        assert_eq!(case.region(&at(0.2, true)), Some(2));
        assert_eq!(case.region(&at(9.0, false)), None);
    }
}
