//! Closed meshes.

use std::f64::consts::PI;

use super::Point;

/// Triangles that face outward.
#[derive(Debug, Clone)]
pub(super) struct Triangles {
    triangles: Vec<[Point; 3]>,
}

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

fn plus(a: Point, s: f64, b: Point) -> Point {
    std::array::from_fn(|k| a[k] + s * b[k])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Distance squared from a line's part.
fn from_side(p: Point, a: Point, b: Point) -> f64 {
    let (ab, ap) = (minus(b, a), minus(p, a));
    let t = (dot(ap, ab) / dot(ab, ab).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let d = minus(p, plus(a, t, ab));
    dot(d, d)
}

/// Distance squared from a triangle.
fn from_triangle(p: Point, [a, b, c]: [Point; 3]) -> f64 {
    let normal = cross(minus(b, a), minus(c, a));
    let is_over = [[a, b], [b, c], [c, a]]
        .iter()
        .all(|&[from, to]| dot(cross(minus(to, from), minus(p, from)), normal) >= 0.0);
    if is_over {
        let height = dot(minus(p, a), normal);
        height * height / dot(normal, normal)
    } else {
        from_side(p, a, b)
            .min(from_side(p, b, c))
            .min(from_side(p, c, a))
    }
}

/// The solid angle of a triangle (van Oosterom and Strackee).
fn solid_angle(p: Point, t: [Point; 3]) -> f64 {
    let [a, b, c] = t.map(|q| minus(q, p));
    let [la, lb, lc] = [a, b, c].map(|v| dot(v, v).sqrt());
    let above = dot(a, cross(b, c));
    let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    2.0 * above.atan2(below)
}

impl Triangles {
    pub(super) fn new(points: Vec<Point>, triangles: Vec<[usize; 3]>) -> Self {
        Self {
            triangles: triangles
                .into_iter()
                .map(|t| t.map(|k| points[k]))
                .collect(),
        }
    }

    pub(super) fn distance(&self, p: Point) -> f64 {
        let mut nearest = f64::INFINITY;
        let mut angle = 0.0;
        for &t in &self.triangles {
            nearest = nearest.min(from_triangle(p, t));
            angle += solid_angle(p, t);
        }
        if angle > 2.0 * PI {
            -nearest.sqrt()
        } else {
            nearest.sqrt()
        }
    }

    pub(super) fn volume(&self) -> f64 {
        let Some(&[o, _, _]) = self.triangles.first() else {
            return 0.0;
        };
        let six: f64 = self
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|q| minus(q, o));
                dot(a, cross(b, c))
            })
            .sum();
        six / 6.0
    }

    pub(super) fn bounds(&self) -> [Point; 2] {
        let mut all = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for p in self.triangles.iter().flatten() {
            for k in 0..3 {
                all[0][k] = all[0][k].min(p[k]);
                all[1][k] = all[1][k].max(p[k]);
            }
        }
        all
    }
}
