//! Which points are in a body, by the papers' ways and ours, beside exact winding numbers; and how long who is near whom takes.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use sphpack::Scene;
use sphpack::scene::Shape;
use sphpack_geometry::{Ball, Cuboid, Ellipsoid, GeometryError, Mesh, Outline, Surface, angle_sum};
use sphpack_neighbors::random::Congruential;
use sphpack_neighbors::{Bounds, CellList, Domain, KdTree};
use sphpack_separation::{Side, separate, separate_by_flood};

use super::winding::{passed_along_x, solid_angle, whole, winds_around};
use crate::reproduction::measure::Measure;
use crate::selection::Selection;
use crate::shipped::load;

/// Points about and in the body of a scene, not turned or moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Separated {
    pub(crate) scene: &'static str,
    pub(crate) points: usize,
}

/// The box is larger than the body's by this part of its longest edge.
const AROUND: f64 = 0.1;

/// A point in so many is this near to the surface, in parts of the body's longest edge; the others are anywhere.
const NEAR: usize = 4;
const HOW_NEAR: f64 = 1e-6;

/// Coordinates are multiples of it, so that whole numbers can hold them.
const GRID: f64 = 1.0 / (1_u64 << 40) as f64;

/// The reach of the flood, and of a neighbour search, in spacings.
const FLOOD: f64 = 2.0;
const REACH: f64 = 3.6;

impl Separated {
    pub(crate) fn words(&self) -> String {
        format!("{}, {} points", self.scene, self.points)
    }

    /// `None` where the body's file is not there.
    pub(crate) fn figures(
        &self,
        selection: &Selection,
    ) -> Result<Option<BTreeMap<Measure, f64>>, String> {
        let Some(scene) = load(self.scene, selection)? else {
            return Ok(None);
        };
        match &scene.body[0].shape {
            Shape::File(path) => {
                let mesh = Mesh::read(scene.resolve(path)).map_err(|error| error.to_string())?;
                self.in_space(&mesh).map(Some)
            }
            shape => match Formula::of(shape)? {
                Some(formula) => self.by_formula(&formula).map(Some),
                None => self.in_plane(&outline(&scene)?).map(Some),
            },
        }
    }

    fn in_plane(&self, body: &Outline) -> Result<BTreeMap<Measure, f64>, String> {
        let points = self.scattered(body);
        let loops: Vec<Vec<[i128; 2]>> = (body.loops())
            .map(|corners| corners.iter().map(|&p| whole(p)).collect())
            .collect();
        let truth: Vec<bool> = (points.iter())
            .map(|&p| winds_around(&loops, whole(p)) != 0)
            .collect();
        let mut figures = self.by_library(body, &points, &truth)?;
        // Of several loops holes turn the other way, so the sums add.
        let angles = |p: [f64; 2]| {
            let sum: f64 = body.loops().map(|corners| angle_sum(corners, p)).sum();
            sum > std::f64::consts::PI
        };
        let (wrong, seconds) = judged(&points, &truth, angles);
        figures.extend([
            (Measure::WrongByAngles, wrong),
            (Measure::SecondsByAngles, seconds),
        ]);
        Ok(figures)
    }

    fn in_space(&self, body: &Mesh) -> Result<BTreeMap<Measure, f64>, String> {
        let points = self.scattered(body);
        let triangles: Vec<[[f64; 3]; 3]> = (body.triangles().iter())
            .map(|corners| corners.map(|i| body.vertices()[i as usize]))
            .collect();
        let truth: Vec<bool> = (points.iter())
            .map(|&p| solid_angle(&triangles, p) > 0.5)
            .collect();
        let mut figures = self.by_library(body, &points, &truth)?;
        let (wrong, seconds) = judged(&points, &truth, |p| passed_along_x(&triangles, p) % 2 == 1);
        figures.extend([
            (Measure::WrongByRays, wrong),
            (Measure::SecondsByRays, seconds),
        ]);
        Ok(figures)
    }

    fn by_formula(&self, body: &Formula) -> Result<BTreeMap<Measure, f64>, String> {
        let points = self.scattered(body.surface.as_ref());
        let truth: Vec<bool> = points.iter().map(|&p| body.holds(p)).collect();
        self.by_library(body.surface.as_ref(), &points, &truth)
    }

    /// What is true of any body: its inside tests, the flood, and the two ways to neighbours.
    fn by_library<const D: usize>(
        &self,
        body: &dyn Surface<D>,
        points: &[[f64; D]],
        truth: &[bool],
    ) -> Result<BTreeMap<Measure, f64>, String> {
        let bounds = around(body);
        let spacing = (bounds.volume() / self.points as f64).powf(1.0 / D as f64);
        let start = Instant::now();
        let plain = separate(points, &[body]).map_err(|error| error.to_string())?;
        let by_test = start.elapsed().as_secs_f64();
        let nobody = vec![None; points.len()];
        let start = Instant::now();
        let flood = separate_by_flood(points, &nobody, &[body], FLOOD * spacing)
            .map_err(|error| error.to_string())?;
        let by_flood = start.elapsed().as_secs_f64();

        let reach = REACH * spacing;
        let start = Instant::now();
        let tree = KdTree::new(points).map_err(|error| error.to_string())?;
        // Each point finds itself too.
        let in_tree: Vec<usize> = points
            .iter()
            .map(|&p| tree.within(p, reach).len() - 1)
            .collect();
        let by_tree = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let mut list = CellList::new(&Domain::new(bounds.min, bounds.max), reach);
        list.update(points);
        let in_cells: Vec<usize> = (0..points.len())
            .map(|i| list.of(i, points).len())
            .collect();
        let by_cells = start.elapsed().as_secs_f64();
        let differ = in_tree
            .iter()
            .zip(&in_cells)
            .filter(|(a, b)| a != b)
            .count();
        Ok(BTreeMap::from([
            (Measure::WrongByTest, wrong(&plain.side, truth)),
            (Measure::SecondsByTest, by_test),
            (Measure::WrongByFlood, wrong(&flood.side, truth)),
            (Measure::SecondsByFlood, by_flood),
            (Measure::NeighboursDiffer, differ as f64),
            (Measure::SecondsByTree, by_tree),
            (Measure::SecondsByCells, by_cells),
        ]))
    }

    /// Anywhere in a box around the body, and some on either side of its surface.
    fn scattered<const D: usize>(&self, body: &dyn Surface<D>) -> Vec<[f64; D]> {
        let bounds = around(body);
        let size = bounds.size();
        let edge = size.iter().copied().fold(0.0, f64::max);
        let mut random = Congruential::new(7);
        let mut points = Vec::with_capacity(self.points);
        for number in 0..self.points {
            let mut p: [f64; D] = std::array::from_fn(|k| bounds.min[k] + size[k] * random.unit());
            if number % NEAR == 0 {
                let off = HOW_NEAR * edge * (2.0 * random.unit() - 1.0);
                let hit = body.closest(p);
                p = std::array::from_fn(|k| hit.point[k] + off * hit.normal[k]);
            }
            points.push(p.map(|x| (x / GRID).round() * GRID));
        }
        points
    }
}

fn around<const D: usize>(body: &dyn Surface<D>) -> Bounds<D> {
    let bounds = body.bounds();
    let edge = bounds.size().into_iter().fold(0.0, f64::max);
    bounds.grown(AROUND * edge)
}

/// How many points a way puts on the wrong side, and its seconds.
fn judged<const D: usize>(
    points: &[[f64; D]],
    truth: &[bool],
    is_inside: impl Fn([f64; D]) -> bool,
) -> (f64, f64) {
    let start = Instant::now();
    let found: Vec<bool> = points.iter().map(|&p| is_inside(p)).collect();
    let seconds = start.elapsed().as_secs_f64();
    let wrong = found.iter().zip(truth).filter(|(a, b)| a != b).count();
    (wrong as f64, seconds)
}

fn wrong(sides: &[Side], truth: &[bool]) -> f64 {
    let differs = |(side, truth): &(&Side, &bool)| (**side == Side::Solid) != **truth;
    sides.iter().zip(truth).filter(differs).count() as f64
}

/// A body of space whose inside is where the sum or the greatest of its coordinates' parts of the half axes is below 1.
struct Formula {
    surface: Arc<dyn Surface<3>>,
    center: [f64; 3],
    half: [f64; 3],
    is_box: bool,
}

impl Formula {
    /// `None` for a shape that is no such body.
    fn of(shape: &Shape) -> Result<Option<Self>, String> {
        let made = |surface: Result<Arc<dyn Surface<3>>, GeometryError>, center, half, is_box| {
            Ok(Some(Self {
                surface: surface.map_err(|error| error.to_string())?,
                center,
                half,
                is_box,
            }))
        };
        match shape {
            Shape::Sphere { center, radius } => {
                let center = triple(center)?;
                let ball = Ball::new(center, *radius);
                made(ball.map(|b| Arc::new(b) as _), center, [*radius; 3], false)
            }
            Shape::Ellipsoid { center, semi_axes } => {
                let (center, half) = (triple(center)?, triple(semi_axes)?);
                let ellipsoid = Ellipsoid::new(center, half);
                made(ellipsoid.map(|e| Arc::new(e) as _), center, half, false)
            }
            Shape::Box { min, max } if min.len() == 3 => {
                let (min, max) = (triple(min)?, triple(max)?);
                let cuboid = Cuboid::new(min, max);
                let center = std::array::from_fn(|k| 0.5 * (min[k] + max[k]));
                let half = std::array::from_fn(|k| 0.5 * (max[k] - min[k]));
                made(cuboid.map(|c| Arc::new(c) as _), center, half, true)
            }
            _ => Ok(None),
        }
    }

    fn holds(&self, p: [f64; 3]) -> bool {
        let parts: [f64; 3] =
            std::array::from_fn(|k| ((p[k] - self.center[k]) / self.half[k]).powi(2));
        if self.is_box {
            parts.iter().all(|part| *part < 1.0)
        } else {
            parts.iter().sum::<f64>() < 1.0
        }
    }
}

fn triple(numbers: &[f64]) -> Result<[f64; 3], String> {
    (numbers.try_into()).map_err(|_| "a place in space has three numbers".to_owned())
}

/// The body as a polygon, which all ways are asked about.
fn outline(scene: &Scene) -> Result<Outline, String> {
    let pair = |numbers: &[f64]| match numbers {
        [x, y] => Ok([*x, *y]),
        _ => Err(format!(
            "{}: a place in the plane has two numbers",
            scene.name
        )),
    };
    let made = match &scene.body[0].shape {
        Shape::Circle { center, radius } => Outline::ellipse(pair(center)?, [*radius; 2]),
        Shape::Box { min, max } => {
            let [[x, y], [right, top]] = [pair(min)?, pair(max)?];
            Outline::polygon(&[[x, y], [right, y], [right, top], [x, top]])
        }
        Shape::Polygon { points } => {
            let points: Result<Vec<[f64; 2]>, String> = points.iter().map(|p| pair(p)).collect();
            Outline::polygon(&points?)
        }
        Shape::Starfish {
            center,
            radius,
            amplitude,
            arms,
        } => Outline::starfish(pair(center)?, *radius, *amplitude, *arms),
        Shape::Naca { digits, chord } => Outline::naca(digits, *chord),
        other => return Err(format!("{}: {other:?} is no outline", scene.name)),
    };
    made.map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_is_on_the_wrong_side_is_counted() {
        let sides = [Side::Solid, Side::Fluid, Side::Solid, Side::Fluid];
        assert_eq!(wrong(&sides, &[true, false, true, false]), 0.0);
        assert_eq!(wrong(&sides, &[false, false, true, true]), 2.0);
        let points = [[0.5, 0.5], [1.5, 0.5]];
        // A way that says "inside" of all is wrong once.
        assert_eq!(judged(&points, &[true, false], |_| true).0, 1.0);
    }

    #[test]
    fn near_points_lie_on_both_sides() {
        let square = Outline::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).unwrap();
        let trial = Separated {
            scene: "square",
            points: 400,
        };
        let near: Vec<f64> = (trial.scattered(&square).into_iter())
            .map(|p| square.closest(p).distance)
            .filter(|distance| distance.abs() < 1e-5)
            .collect();
        assert!(near.len() >= 100, "{}", near.len());
        let inside = near.iter().filter(|distance| **distance < 0.0).count();
        assert!((30..near.len() - 30).contains(&inside), "{inside}");
    }
}
