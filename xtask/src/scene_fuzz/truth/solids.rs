//! Bodies of space by formula.

use std::f64::consts::PI;

use super::Point;

/// A body in its own coordinates.
#[derive(Debug, Clone)]
pub(super) enum Smooth {
    Ellipsoid {
        center: Point,
        semi_axes: Point,
    },
    Cuboid {
        min: Point,
        max: Point,
    },
    Cylinder {
        start: Point,
        end: Point,
        radius: f64,
    },
    Torus {
        center: Point,
        axis: Point,
        major: f64,
        minor: f64,
    },
}

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Distance along and from an axis through `from`.
fn along_and_across(p: Point, from: Point, axis: Point) -> (f64, f64) {
    let length = dot(axis, axis).sqrt();
    let q = minus(p, from);
    let along = dot(q, axis) / length;
    let across: Point = std::array::from_fn(|k| q[k] - along * axis[k] / length);
    (along, dot(across, across).sqrt())
}

/// Distance from a rectangle about 0, negative inside; of any dimension.
fn from_box<const N: usize>(q: [f64; N], half: [f64; N]) -> f64 {
    let mut outside = 0.0;
    let mut inside = f64::NEG_INFINITY;
    for k in 0..N {
        let d = q[k].abs() - half[k];
        outside += d.max(0.0).powi(2);
        inside = inside.max(d);
    }
    if inside > 0.0 {
        f64::sqrt(outside)
    } else {
        inside
    }
}

/// Distance from an ellipsoid about 0 along the axes, by bisection (Eberly).
fn from_ellipsoid(p: Point, a: Point) -> f64 {
    if a[0] == a[1] && a[1] == a[2] {
        return dot(p, p).sqrt() - a[0];
    }
    let y: Point = std::array::from_fn(|k| p[k].abs().max(1e-13 * a[k]));
    let sum = |t: f64| {
        (0..3)
            .map(|k| (a[k] * y[k] / (t + a[k] * a[k])).powi(2))
            .sum::<f64>()
    };
    let smallest = a.iter().copied().fold(f64::INFINITY, f64::min);
    let mut low = -smallest * smallest;
    let mut high = dot(a, a).sqrt() * dot(y, y).sqrt();
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if sum(middle) > 1.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let t = 0.5 * (low + high);
    let foot: Point = std::array::from_fn(|k| a[k] * a[k] * y[k] / (t + a[k] * a[k]));
    let d = minus(foot, y);
    let distance = dot(d, d).sqrt();
    if t < 0.0 { -distance } else { distance }
}

impl Smooth {
    /// Distance from the surface, negative inside.
    pub(super) fn distance(&self, p: Point) -> f64 {
        match *self {
            Self::Ellipsoid { center, semi_axes } => from_ellipsoid(minus(p, center), semi_axes),
            Self::Cuboid { min, max } => from_box(
                std::array::from_fn::<_, 3, _>(|k| p[k] - 0.5 * (min[k] + max[k])),
                std::array::from_fn(|k| 0.5 * (max[k] - min[k])),
            ),
            Self::Cylinder { start, end, radius } => {
                let axis = minus(end, start);
                let half = 0.5 * dot(axis, axis).sqrt();
                let (along, across) = along_and_across(p, start, axis);
                from_box([along - half, across], [half, radius])
            }
            Self::Torus {
                center,
                axis,
                major,
                minor,
            } => {
                let (along, across) = along_and_across(p, center, axis);
                along.hypot(across - major) - minor
            }
        }
    }

    pub(super) fn volume(&self) -> f64 {
        match *self {
            Self::Ellipsoid {
                semi_axes: [a, b, c],
                ..
            } => 4.0 / 3.0 * PI * a * b * c,
            Self::Cuboid { min, max } => (0..3).map(|k| max[k] - min[k]).product(),
            Self::Cylinder { start, end, radius } => {
                let axis = minus(end, start);
                PI * radius * radius * dot(axis, axis).sqrt()
            }
            Self::Torus { major, minor, .. } => 2.0 * PI * PI * major * minor * minor,
        }
    }

    /// A box around it, not the smallest.
    pub(super) fn bounds(&self) -> [Point; 2] {
        let grown = |a: Point, b: Point, by: Point| {
            [
                std::array::from_fn(|k| a[k].min(b[k]) - by[k]),
                std::array::from_fn(|k| a[k].max(b[k]) + by[k]),
            ]
        };
        match *self {
            Self::Ellipsoid { center, semi_axes } => grown(center, center, semi_axes),
            Self::Cuboid { min, max } => [min, max],
            Self::Cylinder { start, end, radius } => {
                let axis = minus(end, start);
                let length2 = dot(axis, axis);
                let by = std::array::from_fn(|k| {
                    radius * (1.0 - axis[k] * axis[k] / length2).max(0.0).sqrt()
                });
                grown(start, end, by)
            }
            Self::Torus {
                center,
                major,
                minor,
                ..
            } => grown(center, center, [major + minor; 3]),
        }
    }
}
