//! An outline as a grid of distances sees it: what is thinner than a cell may be lost, differently for every origin.

use std::collections::BTreeMap;

use sphpack_geometry::{GeometryError, Outline, Surface};

/// A side of a cell: its lower node, and its axis.
type Side = (usize, usize, usize);

/// The zero set of the distances from `outline`, taken at the nodes of a grid with cells of size `cell` (scene units)
/// that has a node at `origin`, linear between them. Of several pieces the largest: "some geometric information will be
/// discarded based on the resolution" (004 §2.2).
pub(crate) fn parsed(
    outline: &Outline,
    cell: f64,
    origin: [f64; 2],
) -> Result<Outline, GeometryError> {
    let bounds = outline.bounds().grown(2.0 * cell);
    let first = [0, 1].map(|k| ((bounds.min[k] - origin[k]) / cell).floor());
    let count = [0, 1].map(|k| ((bounds.max[k] - origin[k]) / cell - first[k]).ceil() as usize + 1);
    let node = |i: usize, j: usize| {
        [i as f64, j as f64]
            .into_iter()
            .zip([0, 1])
            .fold([0.0; 2], |mut p, (n, k)| {
                p[k] = origin[k] + cell * (first[k] + n);
                p
            })
    };
    let values: Vec<f64> = (0..count[0] * count[1])
        .map(|n| outline.closest(node(n % count[0], n / count[0])).distance)
        .collect();
    let value = |i: usize, j: usize| values[i + count[0] * j];
    let place = |(i, j, axis): Side| {
        let (a, b) = (value(i, j), value(i + 1 - axis, j + axis));
        let mut p = node(i, j);
        p[axis] += cell * a / (a - b);
        p
    };

    // Going round a cell counter-clockwise, the curve leaves where the inside ends and comes back where it begins.
    let mut next: BTreeMap<Side, Side> = BTreeMap::new();
    for j in 0..count[1] - 1 {
        for i in 0..count[0] - 1 {
            let corners =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| value(i, j));
            let sides: [Side; 4] = [(i, j, 0), (i + 1, j, 1), (i, j + 1, 0), (i, j, 1)];
            let is_joined = corners.iter().sum::<f64>() < 0.0;
            for k in 0..4 {
                if !(corners[k] < 0.0 && corners[(k + 1) % 4] >= 0.0) {
                    continue;
                }
                let begins = |n: &usize| corners[*n] >= 0.0 && corners[(n + 1) % 4] < 0.0;
                let ahead = (1..4).map(|step| (k + step) % 4).find(begins);
                let behind = (1..4).map(|step| (k + 4 - step) % 4).find(begins);
                if let Some(other) = if is_joined { ahead } else { behind } {
                    next.insert(sides[k], sides[other]);
                }
            }
        }
    }
    let mut loops: Vec<Vec<[f64; 2]>> = Vec::new();
    while let Some((start, mut side)) = next.pop_first() {
        let mut points = vec![place(start)];
        while side != start {
            points.push(place(side));
            match next.remove(&side) {
                Some(following) => side = following,
                None => break,
            }
        }
        loops.push(points);
    }
    let area = |points: &Vec<[f64; 2]>| {
        (points.iter().zip(points.iter().cycle().skip(1)))
            .map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0]))
            .sum::<f64>()
    };
    let largest = (loops.iter())
        .max_by(|a, b| area(a).total_cmp(&area(b)))
        .map_or(&[][..], Vec::as_slice);
    Outline::polygon(largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coarse_grid_keeps_a_square_and_loses_a_thin_tail() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let square = Outline::polygon(&square).expect("a square");
        let seen = parsed(&square, 0.1, [0.03, 0.04]).expect("an outline");
        assert!((seen.volume() - 1.0).abs() < 0.02, "{}", seen.volume());
        let tail = [
            [0.0, 0.0],
            [1.0, 0.45],
            [2.0, 0.45],
            [2.0, 0.46],
            [1.0, 0.46],
            [0.0, 1.0],
        ];
        let tail = Outline::polygon(&tail).expect("a body with a tail");
        let seen = parsed(&tail, 0.1, [0.0, 0.0]).expect("an outline");
        assert!(seen.bounds().max[0] < 1.1, "{:?}", seen.bounds());
    }
}
