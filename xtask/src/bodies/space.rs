//! Bodies in space: boxes and balls beside each other, as triangles.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::{Case, Particle, Region};

pub(super) type Triangle = [[f64; 3]; 3];

/// Solids that do not touch.
struct Solids {
    name: &'static str,
    size: f64,
    solids: Vec<Vec<Triangle>>,
}

/// All of them.
pub(super) fn cases() -> Vec<Box<dyn Case>> {
    let balls = (0..27)
        .map(|k: u32| {
            let at = [k % 3, k / 3 % 3, k / 9].map(f64::from);
            ball(at, 0.35 + 0.03 * f64::from(k * 7 % 4))
        })
        .collect();
    let bed = vec![
        cuboid([0.0; 3], [0.5, 0.5, 0.2]),
        cuboid([0.7, 0.0, 0.0], [1.1, 0.2, 0.4]),
        cuboid([0.0, 0.7, 0.0], [0.25, 1.1, 0.45]),
        cuboid([0.7, 0.7, 0.0], [0.9, 0.9, 0.5]),
    ];
    let posts = (0..4)
        .map(|k: u32| {
            let at = [0.4 * f64::from(k % 2), 0.4 * f64::from(k / 2), 0.0];
            cuboid(at, [at[0] + 0.2, at[1] + 0.2, 0.5])
        })
        .chain([cuboid([0.75, 0.0, 0.0], [0.85, 0.6, 0.5])])
        .collect();
    let case = |name, size, solids| Box::new(Solids { name, size, solids }) as Box<dyn Case>;
    vec![
        case("27 balls", 0.7, balls),
        case("printer bed", 0.2, bed),
        case("posts beside a sheet", 0.2, posts),
    ]
}

pub(super) fn cuboid(min: [f64; 3], max: [f64; 3]) -> Vec<Triangle> {
    let corner = |k: usize| std::array::from_fn(|a| if k >> a & 1 == 1 { max[a] } else { min[a] });
    [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ]
    .into_iter()
    .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
    .map(|corners| corners.map(corner))
    .collect()
}

/// By rings of latitude.
fn ball(center: [f64; 3], radius: f64) -> Vec<Triangle> {
    const RINGS: u32 = 16;
    let at = |ring: u32, place: u32| {
        let (polar, around) = (
            PI * f64::from(ring) / f64::from(RINGS),
            PI * f64::from(place % (2 * RINGS)) / f64::from(RINGS),
        );
        let flat = if ring == 0 || ring == RINGS {
            0.0
        } else {
            polar.sin()
        };
        let unit = [flat * around.cos(), flat * around.sin(), polar.cos()];
        std::array::from_fn(|k| center[k] + radius * unit[k])
    };
    let mut triangles = Vec::new();
    for ring in 0..RINGS {
        for place in 0..2 * RINGS {
            let [a, b] = [at(ring, place), at(ring + 1, place)];
            let [c, d] = [at(ring + 1, place + 1), at(ring, place + 1)];
            if ring + 1 < RINGS {
                triangles.push([a, b, c]);
            }
            if ring > 0 {
                triangles.push([a, c, d]);
            }
        }
    }
    triangles
}

/// By the divergence theorem.
pub(super) fn volume(triangles: &[Triangle]) -> f64 {
    let six: f64 = (triangles.iter())
        .map(|[a, b, c]| determinant(*a, *b, *c))
        .sum();
    six.abs() / 6.0
}

fn determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Whether the triangles are seen under more than half of all directions from a point (Van Oosterom and Strackee, 1983).
fn winds(triangles: &[Triangle], p: [f64; 3]) -> bool {
    let mut sum = 0.0;
    for triangle in triangles {
        let [a, b, c] = triangle.map(|q| std::array::from_fn(|k| q[k] - p[k]));
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let [la, lb, lc] = [a, b, c].map(|u| dot(u, u).sqrt());
        let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        sum += 2.0 * determinant(a, b, c).atan2(below);
    }
    (sum / (4.0 * PI)).abs() > 0.5
}

/// As OBJ, which keeps all digits.
pub(super) fn write(triangles: &[Triangle], path: &Path) -> Result<(), String> {
    let mut text = String::new();
    for (number, [x, y, z]) in triangles.iter().flatten().enumerate() {
        let _ = writeln!(text, "v {x:?} {y:?} {z:?}");
        if number % 3 == 2 {
            let _ = writeln!(text, "f {} {} {}", number - 1, number, number + 1);
        }
    }
    fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

impl Case for Solids {
    fn name(&self) -> &'static str {
        self.name
    }

    fn dimension(&self) -> usize {
        3
    }

    fn size(&self) -> f64 {
        self.size
    }

    fn write(&self, folder: &Path) -> Result<String, String> {
        write(&self.solids.concat(), &folder.join("body.obj"))?;
        Ok("body.obj".to_owned())
    }

    fn regions(&self) -> Vec<Region> {
        (self.solids.iter().enumerate())
            .map(|(number, triangles)| Region {
                name: format!("part {number}"),
                volume: volume(triangles),
            })
            .collect()
    }

    fn region(&self, particle: &Particle) -> Option<usize> {
        if !particle.is_solid {
            return None;
        }
        (0..self.solids.len()).find(|&number| winds(&self.solids[number], particle.place))
    }
}
