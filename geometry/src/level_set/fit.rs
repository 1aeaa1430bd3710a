//! The point that is nearest to a few planes.

use sphpack_neighbors::point;

/// Directions in which the planes' normals have less than this part of their sum of squares count as undecided: below
/// a turn of some 15° the surface is smooth.
const SMOOTH: f64 = 0.02;

/// Steps between the box and the nearest points, at most.
const STEPS: usize = 30;

/// The points with the least sum of squared distances from planes: one, a line, or a plane.
#[derive(Debug)]
pub(super) struct Fit {
    middle: [f64; 3],
    /// Directions that the planes decide, the best decided first, and how far along them the points are from the middle.
    axes: Vec<([f64; 3], f64)>,
}

impl Fit {
    /// Of planes (unit normal, normal · x), around `middle`.
    pub(super) fn new(planes: &[([f64; 3], f64)], middle: [f64; 3]) -> Self {
        let mut matrix = [[0.0; 3]; 3];
        let mut right = [0.0; 3];
        for (normal, offset) in planes {
            let height = offset - point::dot(*normal, middle);
            for i in 0..3 {
                for j in 0..3 {
                    matrix[i][j] += normal[i] * normal[j];
                }
                right[i] += normal[i] * height;
            }
        }
        let mut axes = principal(matrix);
        axes.sort_by(|a, b| b.0.total_cmp(&a.0));
        let least = SMOOTH * planes.len() as f64;
        Self {
            middle,
            axes: axes
                .into_iter()
                .filter(|axis| axis.0 > least)
                .map(|(weight, axis)| (axis, point::dot(axis, right) / weight))
                .collect(),
        }
    }

    /// The nearest point to `x` of those decided by the first `count` directions.
    fn nearest(&self, count: usize, x: [f64; 3]) -> [f64; 3] {
        let away = point::sub(x, self.middle);
        self.axes[..count].iter().fold(x, |y, &(axis, place)| {
            point::add_scaled(y, place - point::dot(axis, away), axis)
        })
    }

    /// Such a point in a box that `clamp` leads into, near the middle, to `tolerance`: of all directions that are
    /// decided if there is one, else of fewer.
    pub(super) fn within(&self, clamp: impl Fn([f64; 3]) -> [f64; 3], tolerance: f64) -> [f64; 3] {
        let mut found = clamp(self.middle);
        for count in (1..=self.axes.len()).rev() {
            let mut x = self.middle;
            for _ in 0..STEPS {
                let on = self.nearest(count, x);
                x = clamp(on);
                if point::distance(x, on) <= tolerance {
                    return x;
                }
            }
            found = x;
        }
        found
    }
}

/// Eigenvalues and unit eigenvectors of a symmetric matrix, by Jacobi's rotations.
fn principal(mut m: [[f64; 3]; 3]) -> [(f64, [f64; 3]); 3] {
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // The off-diagonal shrinks quadratically: five rounds reach rounding.
    for _ in 0..8 {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            if m[i][j] == 0.0 {
                continue;
            }
            let half = 0.5 * (m[j][j] - m[i][i]) / m[i][j];
            let tan = half.signum() / (half.abs() + half.hypot(1.0));
            let cos = 1.0 / tan.hypot(1.0);
            let sin = tan * cos;
            for row in &mut m {
                let (a, b) = (row[i], row[j]);
                (row[i], row[j]) = (cos * a - sin * b, sin * a + cos * b);
            }
            for k in 0..3 {
                let (a, b) = (m[i][k], m[j][k]);
                (m[i][k], m[j][k]) = (cos * a - sin * b, sin * a + cos * b);
                let (a, b) = (axes[i][k], axes[j][k]);
                (axes[i][k], axes[j][k]) = (cos * a - sin * b, sin * a + cos * b);
            }
        }
    }
    std::array::from_fn(|k| (m[k][k], axes[k]))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn unit() -> impl Strategy<Value = [f64; 3]> {
        [-1.0..1.0, -1.0..1.0, -1.0..1.0].prop_filter_map("no direction", point::unit)
    }

    proptest! {
        #[test]
        fn planes_through_a_point_meet_there(
            normals in prop::collection::vec(unit(), 3..12),
            tip in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
        ) {
            let planes: Vec<_> = normals.iter().map(|&n| (n, point::dot(n, tip))).collect();
            let fit = Fit::new(&planes, [0.0; 3]);
            let found = fit.within(|x| x, 1e-9);
            let bound = point::norm(tip) * (1.0 + 1e-9);
            prop_assert!(point::norm(found) <= bound, "{:?}", found);
            prop_assert!(fit.axes.len() < 3 || point::distance(found, tip) < 1e-9, "{:?}", found);
            // On a line or plane that passes a box, a point in the box.
            if fit.axes.len() < 3 {
                let corner = point::add_scaled([0.0; 3], 2.0, tip);
                let clamp = |x: [f64; 3]| std::array::from_fn(|k| {
                    let (a, b) = (tip[k].min(corner[k]), tip[k].max(corner[k]));
                    x[k].clamp(a, b)
                });
                let found = fit.within(clamp, 1e-3);
                let on = fit.nearest(fit.axes.len(), found);
                prop_assert!(point::distance(clamp(found), found) < 1e-12);
                prop_assert!(point::distance(on, found) < 0.3, "{:?} {:?}", on, found);
            }
        }

        #[test]
        fn eigenvectors(a in unit(), b in unit(), c in unit(), s in [0.1..2.0, 0.1..2.0, 0.1..2.0]) {
            let vectors = [a, b, c];
            let m: [[f64; 3]; 3] = std::array::from_fn(|i| {
                std::array::from_fn(|j| (0..3).map(|k| s[k] * vectors[k][i] * vectors[k][j]).sum())
            });
            for (value, axis) in principal(m) {
                prop_assert!((point::norm(axis) - 1.0).abs() < 1e-12);
                let image = m.map(|row| point::dot(row, axis));
                prop_assert!(point::distance(image, point::scale(axis, value)) < 1e-12);
            }
        }
    }
}
