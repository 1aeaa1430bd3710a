//! Polygons with their corners on a curve in the plane.

use super::curve::runs_of;
use super::trace;
use crate::surface::{Closest, Surface};

/// Corners nearer than this many sides along the curve share one corner of the polygon.
const CROWDED: f64 = 0.5;

/// Closed polygons, one for each loop of a curve in the plane, with sides of about the given length (scene units) and
/// their corners on the curve, its own corners among them; the first point is not repeated. Loops smaller than a quarter
/// of a side may be lost. Empty unless `D` is 2. Some twelve queries of the surface per quarter of a side.
///
/// ```
/// use sphpack_geometry::{Ball, polygons};
/// let loops = polygons(&Ball::new([0.0, 0.0], 1.0)?, 0.1);
/// assert_eq!(loops.len(), 1);
/// assert_eq!(loops[0].len(), 63);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
pub fn polygons<const D: usize>(surface: &dyn Surface<D>, side: f64) -> Vec<Vec<[f64; D]>> {
    if D != 2 || !(side > 0.0 && side.is_finite()) {
        return Vec::new();
    }
    let near = |p| -> Closest<D> { surface.closest(p) };
    let corners = surface.features().corners;
    let rings = trace::rings(&surface.bounds(), &near, &corners, side);
    let polygon = |(number, ring): (usize, &super::Ring<D>)| {
        let line = ring.line();
        let mut points = Vec::new();
        for run in runs_of(number, ring, &line, CROWDED * side) {
            let sides = (run.length / side).round().max(1.0);
            for i in 0..sides as usize {
                let mut way = run.start + run.length * i as f64 / sides;
                if way > line.length() {
                    way -= line.length();
                }
                points.push(surface.closest(line.at(way).0).point);
            }
        }
        points
    };
    (rings.iter().enumerate().map(polygon))
        .filter(|points| points.len() > 2)
        .collect()
}
