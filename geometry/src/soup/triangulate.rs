//! Triangles that close a loop of points in space.

use sphpack_neighbors::{Bounds, point};

use crate::mesh::triangle;

/// Loops of more points get a fan around their middle: the search grows with the cube.
pub(crate) const MOST_POINTS: usize = 300;

/// What a bad shape costs, in parts of the squared longest side, for each time that exceeds the area: just enough that
/// of all ways to fill a flat loop the one with compact triangles is taken.
const SHAPE: f64 = 1e-6;

/// A triangle with less area than this part of its squared longest side has none.
const FLAT: f64 = 1e-9;

/// The triangles over the loop `points`, three places in it each and in its direction, of the least area in all;
/// `None` where `is_taken` forbids all choices. `is_taken(i, j)`: whether no new side may run between two points.
/// O(n³); dynamic programming over the parts of the loop, after Barequet and Sharir, "Filling gaps in the boundary
/// of a polyhedron", CAGD 12, 1995.
pub(crate) fn least_area(
    points: &[[f64; 3]],
    is_taken: impl Fn(usize, usize) -> bool,
) -> Option<Vec<[usize; 3]>> {
    let n = points.len();
    if !(3..=MOST_POINTS).contains(&n) {
        return None;
    }
    // Triangles without area only where nothing else is left: they would cost more than all others together.
    let most = Bounds::of(points).diagonal().powi(2);
    let cost = |i: usize, j: usize, k: usize| {
        let t = [points[i], points[j], points[k]];
        let longest = (0..3)
            .map(|s| point::distance_squared(t[s], t[(s + 1) % 3]))
            .fold(0.0, f64::max);
        let area = triangle::area(&t);
        if area > FLAT * longest {
            area + SHAPE * longest * (longest / area).min(1e4)
        } else {
            most
        }
    };
    // Of the part from i to j, closed by the straight line: least cost, and the third corner on that line.
    let mut best = vec![0.0_f64; n * n];
    let mut corner = vec![usize::MAX; n * n];
    for length in 2..n {
        for i in 0..n - length {
            let j = i + length;
            let mut least = (f64::INFINITY, usize::MAX);
            // The whole loop's last line is one of its own sides.
            if length == n - 1 || !is_taken(i, j) {
                for k in i + 1..j {
                    let sum = best[i * n + k] + best[k * n + j];
                    if sum < least.0 {
                        let sum = sum + cost(i, k, j);
                        if sum < least.0 {
                            least = (sum, k);
                        }
                    }
                }
            }
            (best[i * n + j], corner[i * n + j]) = least;
        }
    }
    if !best[n - 1].is_finite() {
        return None;
    }
    let mut triangles = Vec::with_capacity(n - 2);
    let mut parts = vec![(0, n - 1)];
    while let Some((i, j)) = parts.pop() {
        if j < i + 2 {
            continue;
        }
        let k = corner[i * n + j];
        triangles.push([i, k, j]);
        parts.extend([(i, k), (k, j)]);
    }
    Some(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_loops_keep_their_area() {
        // An L with points along its sides.
        let l = [
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
            [0.0, 1.0],
        ]
        .map(|[x, y]| [x, y, 0.5]);
        let triangles = least_area(&l, |_, _| false).unwrap();
        assert_eq!(triangles.len(), 6);
        let corners = |t: &[usize; 3]| t.map(|i| l[i]);
        let area: f64 = triangles.iter().map(|t| triangle::area(&corners(t))).sum();
        assert!((area - 3.0).abs() < 1e-12);
        for t in &triangles {
            assert!(triangle::area_vector(&corners(t))[2] > 0.1, "{t:?}");
        }
    }

    #[test]
    fn forbidden_sides_are_not_used() {
        let square = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
        ];
        let diagonal = |i: usize, j: usize| i.min(j) == 0 && i.max(j) == 2;
        let triangles = least_area(&square, diagonal).unwrap();
        assert!(
            triangles
                .iter()
                .all(|t| !(t.contains(&0) && t.contains(&2)))
        );
        assert!(least_area(&square, |i, j| i.abs_diff(j) == 2).is_none());
        assert!(least_area(&square[..2], |_, _| false).is_none());
    }
}
