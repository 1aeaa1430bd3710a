//! Scale, rotation and translation of a body.

use super::super::case::Body;
use super::Point;

/// Scale first, then rotation, then translation.
#[derive(Debug, Clone)]
pub(super) struct Place {
    scale: f64,
    /// Rows of the rotation.
    turn: [Point; 3],
    shift: Point,
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Place {
    pub(super) fn of(body: &Body) -> Self {
        let mut turn = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        if let Some((axis, degrees)) = body.rotate {
            let length = dot(axis, axis).sqrt();
            let u = axis.map(|x| x / length);
            let (sin, cos) = degrees.to_radians().sin_cos();
            let cross = [[0.0, -u[2], u[1]], [u[2], 0.0, -u[0]], [-u[1], u[0], 0.0]];
            turn = std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let one = if i == j { 1.0 } else { 0.0 };
                    cos * one + sin * cross[i][j] + (1.0 - cos) * u[i] * u[j]
                })
            });
        }
        let mut shift = [0.0; 3];
        for (to, from) in shift.iter_mut().zip(body.translate.iter().flatten()) {
            *to = *from;
        }
        Self {
            scale: body.scale,
            turn,
            shift,
        }
    }

    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// From the shape's own coordinates to the scene's.
    pub(super) fn out(&self, p: Point) -> Point {
        std::array::from_fn(|k| self.scale * dot(self.turn[k], p) + self.shift[k])
    }

    /// From the scene's coordinates to the shape's own.
    pub(super) fn back(&self, p: Point) -> Point {
        let q: Point = std::array::from_fn(|k| (p[k] - self.shift[k]) / self.scale);
        std::array::from_fn(|k| (0..3).map(|i| self.turn[i][k] * q[i]).sum())
    }

    /// A box around a box.
    pub(super) fn bounds(&self, [min, max]: [Point; 2]) -> [Point; 2] {
        let mut all = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for corner in 0..8 {
            let p = self.out(std::array::from_fn(|k| {
                if corner >> k & 1 == 0 { min[k] } else { max[k] }
            }));
            for k in 0..3 {
                all[0][k] = all[0][k].min(p[k]);
                all[1][k] = all[1][k].max(p[k]);
            }
        }
        all
    }
}
