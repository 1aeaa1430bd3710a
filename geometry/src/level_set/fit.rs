//! The point that is nearest to a few planes.

use sphpack_neighbors::point;

/// Directions in which the planes' normals have less than this part of their sum of squares count as undecided: below
/// a turn of some 15° the surface is smooth.
const SMOOTH: f64 = 0.02;

/// The points with the least sum of squared distances from planes, of those the nearest to `middle`; with as many
/// directions decided by the planes as they tell, then with fewer. Planes are (unit normal, normal · x).
pub(super) fn candidates(
    planes: &[([f64; 3], f64)],
    middle: [f64; 3],
) -> impl Iterator<Item = [f64; 3]> {
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
    let decided = axes.iter().filter(|axis| axis.0 > least).count().max(1);
    (1..=decided).rev().map(move |count| {
        let mut x = middle;
        for &(weight, axis) in &axes[..count] {
            if weight > 0.0 {
                x = point::add_scaled(x, point::dot(axis, right) / weight, axis);
            }
        }
        x
    })
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
            let found: Vec<_> = candidates(&planes, [0.0; 3]).collect();
            // Where all directions are decided that is the point, else it is on all planes but nearly parallel ones.
            if found.len() == 3 {
                prop_assert!(point::distance(found[0], tip) < 1e-9, "{:?}", found);
            }
            prop_assert!(point::norm(found[0]) < point::norm(tip) * (1.0 + 1e-9) || found.len() == 3);
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
