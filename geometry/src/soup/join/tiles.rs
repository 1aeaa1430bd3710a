//! Triangles over a part of a plane.

use super::sheet::Sheet;

/// Parts with more points than this are cut into triangles ear by ear.
const MOST_SEARCHED: usize = 128;

/// Triangles over a cycle of points, counter-clockwise as it is.
///
/// No new side runs between points of one straight line, where the triangles on both sides of a cut might choose the
/// same.
pub(super) fn over(sheet: &Sheet, cycle: &[u32]) -> Vec<[u32; 3]> {
    if cycle.len() <= MOST_SEARCHED
        && let Some(triangles) = compact(sheet, cycle)
    {
        return triangles;
    }
    ears(sheet, cycle)
}

/// The triangles of best shape, by dynamic programming. All of them turn the same way, exactly, so that none overlap.
fn compact(sheet: &Sheet, cycle: &[u32]) -> Option<Vec<[u32; 3]>> {
    let n = cycle.len();
    // Of the part from i to j, closed by the straight line: least cost, and the third corner on that line.
    let mut best = vec![0.0_f64; n * n];
    let mut corner = vec![usize::MAX; n * n];
    for length in 2..n {
        for i in 0..n - length {
            let j = i + length;
            let mut least = (f64::INFINITY, usize::MAX);
            if length == n - 1 || !sheet.share_line(cycle[i], cycle[j]) {
                for k in i + 1..j {
                    let sum = best[i * n + k] + best[k * n + j];
                    if sum < least.0 {
                        let shape = sheet.shape([cycle[i], cycle[k], cycle[j]]);
                        if shape > 0.0 && sum + 1.0 / shape < least.0 {
                            least = (sum + 1.0 / shape, k);
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
        if j >= i + 2 {
            let k = corner[i * n + j];
            triangles.push([cycle[i], cycle[k], cycle[j]]);
            parts.extend([(i, k), (k, j)]);
        }
    }
    Some(triangles)
}

/// Ear by ear: one that holds no other point, or the largest.
fn ears(sheet: &Sheet, cycle: &[u32]) -> Vec<[u32; 3]> {
    let mut left = cycle.to_vec();
    let mut triangles = Vec::new();
    while left.len() > 3 {
        let n = left.len();
        let ear = |k: usize| [left[(k + n - 1) % n], left[k], left[(k + 1) % n]];
        let is_free = |k: usize| {
            let [a, b, c] = ear(k);
            sheet.turn(a, b, c) > 0.0
                && !sheet.share_line(a, c)
                && left.iter().all(|&v| {
                    [a, b, c].contains(&v)
                        || sheet.turn(a, b, v) < 0.0
                        || sheet.turn(b, c, v) < 0.0
                        || sheet.turn(c, a, v) < 0.0
                })
        };
        let size = |k: usize| {
            let [a, b, c] = ear(k);
            sheet.turn(a, b, c)
        };
        let best = (0..n)
            .find(|&k| is_free(k))
            .or_else(|| (0..n).max_by(|&i, &j| size(i).total_cmp(&size(j))))
            .unwrap_or(0);
        triangles.push(ear(best));
        left.remove(best);
    }
    triangles.push([left[0], left[1], left[2]]);
    triangles
}
