//! Nodes on smooth curves, dense where they bend.

use sphpack_neighbors::{Bounds, point};

/// How far a smooth curve may bulge beyond the straight side between two of its nodes, in parts of its size.
pub const SAGITTA_OVER_SIZE: f64 = 1e-7;

/// Intervals at which a curve is looked at before its nodes are placed.
const TABLE: usize = 1 << 14;

/// Sides per size of the curve where it is straight.
const SIDES_PER_SIZE: f64 = 200.0;

/// Nodes of the smooth curve `at(t)`, `t` from `start` to `end`, both ends included, so dense that the straight
/// sides between them are within [`SAGITTA_OVER_SIZE`] × `size` of the curve.
///
/// A side of length ℓ on a curve of curvature κ is ℓ²κ/8 off; the density of nodes is spread accordingly, and evenly
/// enough that node normals stay accurate to second order.
pub(crate) fn nodes(
    at: impl Fn(f64) -> [f64; 2],
    start: f64,
    end: f64,
    size: f64,
) -> Vec<[f64; 2]> {
    let parameter = |x: f64| start + (end - start) * x / TABLE as f64;
    let table: Vec<[f64; 2]> = (0..=TABLE).map(|i| at(parameter(i as f64))).collect();
    // Half the allowance leaves room for what the table and its interpolation miss.
    let allowance = 0.5 * SAGITTA_OVER_SIZE * size;
    let mut density = vec![0.0; TABLE + 1];
    for i in 1..TABLE {
        let (a, b, c) = (table[i - 1], table[i], table[i + 1]);
        let slope = point::scale(point::sub(c, a), 0.5);
        let bend = point::sub(point::add(a, c), point::scale(b, 2.0));
        let length = point::norm(slope).max(f64::MIN_POSITIVE);
        let across = (slope[0] * bend[1] - slope[1] * bend[0]).abs() / length;
        density[i] = (across / (8.0 * allowance)).sqrt() + length * SIDES_PER_SIZE / size;
    }
    density[0] = density[1];
    density[TABLE] = density[TABLE - 1];
    let mut sum = vec![0.0; TABLE + 1];
    for i in 0..TABLE {
        sum[i + 1] = sum[i] + 0.5 * (density[i] + density[i + 1]);
    }
    let count = (sum[TABLE].ceil() as usize).max(3);
    let mut points = Vec::with_capacity(count + 1);
    let mut i = 0;
    for k in 0..=count {
        let target = sum[TABLE] * k as f64 / count as f64;
        while i + 1 < TABLE && sum[i + 1] < target {
            i += 1;
        }
        let part = ((target - sum[i]) / (sum[i + 1] - sum[i])).clamp(0.0, 1.0);
        points.push(at(parameter(i as f64 + part)));
    }
    points[0] = table[0];
    points[count] = table[TABLE];
    points
}

/// The larger side of the box around the points.
pub(crate) fn extent(points: &[[f64; 2]]) -> f64 {
    let size = Bounds::of(points).size();
    size[0].max(size[1])
}
