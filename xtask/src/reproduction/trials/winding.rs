//! Winding numbers that nothing of ours has a part in: which points are truly inside.

use std::f64::consts::PI;

/// Coordinates below 8 become whole numbers by this: exact for those that are multiples of 2⁻⁵⁰, and products of their differences fit
/// 128 bits.
const UNITS: f64 = (1_u64 << 50) as f64;

/// How often loops wind around a point, counted in whole numbers, so without rounding; places are taken to 2⁻⁵⁰.
pub(super) fn winds_around(loops: &[Vec<[i128; 2]>], p: [i128; 2]) -> i32 {
    let mut turns = 0;
    for corners in loops {
        for (i, a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            // Positive where p is to the left of the way from a to b.
            let side = (b[0] - a[0]) * (p[1] - a[1]) - (p[0] - a[0]) * (b[1] - a[1]);
            if a[1] <= p[1] && b[1] > p[1] && side > 0 {
                turns += 1;
            }
            if a[1] > p[1] && b[1] <= p[1] && side < 0 {
                turns -= 1;
            }
        }
    }
    turns
}

/// A place in units of 2⁻⁵⁰.
pub(super) fn whole(p: [f64; 2]) -> [i128; 2] {
    p.map(|x| (x * UNITS).round() as i128)
}

/// The solid angle of a closed surface seen from a point, over 4π: 1 inside, 0 outside.
pub(super) fn solid_angle(triangles: &[[[f64; 3]; 3]], p: [f64; 3]) -> f64 {
    let sum: f64 = triangles.iter().map(|corners| angle(corners, p)).sum();
    sum / (4.0 * PI)
}

/// Van Oosterom & Strackee (1983), eq. 8, and its sign.
fn angle(corners: &[[f64; 3]; 3], p: [f64; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| minus(corner, p));
    let [x, y, z] = [a, b, c].map(|v| dot(v, v).sqrt());
    let volume = dot(a, cross(b, c));
    let below = x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y;
    2.0 * volume.atan2(below)
}

/// How many triangles the ray from `p` in the direction +x passes: odd inside (the preprint of Negi & Ramachandran, §2.7). Seen along x a
/// triangle is one in the plane, and the ray a point.
pub(super) fn passed_along_x(triangles: &[[[f64; 3]; 3]], p: [f64; 3]) -> usize {
    let passes = |corners: &&[[f64; 3]; 3]| {
        let [a, b, c] = corners.map(|corner| minus(corner, p));
        let area = |u: [f64; 3], v: [f64; 3]| u[1] * v[2] - u[2] * v[1];
        let [of_a, of_b, of_c] = [area(b, c), area(c, a), area(a, b)];
        let is_within = (of_a > 0.0) == (of_b > 0.0) && (of_b > 0.0) == (of_c > 0.0);
        let ahead = of_a * a[0] + of_b * b[0] + of_c * c[0];
        is_within && (ahead > 0.0) == (of_a > 0.0)
    };
    triangles.iter().filter(passes).count()
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_winds_around_what_is_in_it_to_the_last_unit() {
        let square = vec![
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                .map(whole)
                .to_vec(),
        ];
        let at = |x: f64, y: f64| winds_around(&square, whole([x, y]));
        assert_eq!(at(0.5, 0.5), 1);
        assert_eq!(at(1.5, 0.5), 0);
        let unit = 1.0 / UNITS;
        assert_eq!((at(unit, 0.5), at(-unit, 0.5)), (1, 0));
        // A vertex's height is no special place.
        assert_eq!((at(-1.0, 0.0), at(-1.0, 1.0)), (0, 0));
        let hole = vec![
            square[0].clone(),
            [[0.25, 0.25], [0.25, 0.75], [0.75, 0.75], [0.75, 0.25]]
                .map(whole)
                .to_vec(),
        ];
        assert_eq!(winds_around(&hole, whole([0.5, 0.5])), 0);
        assert_eq!(winds_around(&hole, whole([0.1, 0.5])), 1);
    }

    #[test]
    fn a_tetrahedron_by_both_ways() {
        let v = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ];
        let triangles =
            [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|t| t.map(|i: usize| v[i]));
        for (p, inside) in [
            ([0.2, 0.21, 0.22], true),
            ([0.01, 0.02, 0.9], true),
            ([-0.1, 0.2, 0.21], false),
            ([0.4, 0.41, 0.42], false),
        ] {
            let turns = solid_angle(&triangles, p);
            assert!(
                (turns - f64::from(u8::from(inside))).abs() < 1e-12,
                "{p:?}: {turns}"
            );
            assert_eq!(passed_along_x(&triangles, p) % 2 == 1, inside, "{p:?}");
        }
    }
}
