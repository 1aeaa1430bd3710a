//! The evenest subset of many candidates, by taking the most crowded away.

use std::collections::BinaryHeap;

use sphpack_neighbors::{Bounds, CellList, Domain, point};

use super::candidates::Candidates;
use super::ranked::Ranked;
use crate::surface::Closest;

/// Candidates nearer than this many spacings crowd each other: the nearest distance of a perfect hexagonal lattice.
const REACH: f64 = 1.07;

/// The places of `keep` candidates that are spread evenly between themselves and the held sites (weighted sample
/// elimination: Yuksel, "Sample elimination for generating Poisson disk sample sets", Computer Graphics Forum 34,
/// 2015). O(n log n).
pub(super) fn keep_evenest<const D: usize>(
    candidates: &Candidates<D>,
    held: &[Closest<D>],
    keep: usize,
    spacing: f64,
) -> Vec<usize> {
    let count = candidates.point.len();
    let mut points = candidates.point.clone();
    let mut normals = candidates.normal.clone();
    points.extend(held.iter().map(|site| site.point));
    normals.extend(held.iter().map(|site| site.normal));
    let near = neighbors(&points, &normals, REACH * spacing);
    let weight = |i: usize, j: usize| {
        let gap = 1.0 - point::distance(points[i], points[j]) / (REACH * spacing);
        gap.max(0.0).powi(8)
    };
    let mut crowding: Vec<f64> = (0..count)
        .map(|i| near[i].iter().map(|&j| weight(i, j as usize)).sum())
        .collect();
    let mut heap: BinaryHeap<Ranked> = (0..count)
        .map(|index| Ranked {
            rank: crowding[index],
            index,
        })
        .collect();
    let mut gone = vec![false; count];
    let mut left = count;
    while left > keep {
        let Some(Ranked { rank, index: i }) = heap.pop() else {
            break;
        };
        // Crowding only ever falls: what has fallen since goes back to its place.
        if crowding[i] < rank {
            heap.push(Ranked {
                rank: crowding[i],
                index: i,
            });
            continue;
        }
        gone[i] = true;
        left -= 1;
        for &j in &near[i] {
            let j = j as usize;
            if j < count && !gone[j] {
                crowding[j] -= weight(i, j);
            }
        }
    }
    (0..count).filter(|&i| !gone[i]).collect()
}

/// For each point those within `reach` of it on the same side of the body.
fn neighbors<const D: usize>(
    points: &[[f64; D]],
    normals: &[[f64; D]],
    reach: f64,
) -> Vec<Vec<u32>> {
    let bounds = Bounds::of(points);
    let mut list = CellList::new(&Domain::new(bounds.min, bounds.max), reach);
    list.update(points, |_| true);
    let particle = list.target_particles();
    let mut by_slot: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    list.for_each_block(&mut by_slot, |block, out| {
        for (lane, found) in out.iter_mut().enumerate() {
            let i = particle[block.first_slot + lane] as usize;
            found.extend(block.sources().map(|slot| particle[slot]).filter(|&j| {
                let j = j as usize;
                j != i
                    && point::distance_squared(points[i], points[j]) < reach * reach
                    && point::dot(normals[i], normals[j]) >= 0.0
            }));
        }
    });
    let mut near = vec![Vec::new(); points.len()];
    for (slot, found) in by_slot.into_iter().enumerate() {
        near[particle[slot] as usize] = found;
    }
    near
}
