//! The evenest subset of many candidates, by taking the most crowded away.

use std::collections::BinaryHeap;

use sphpack_neighbors::{Bounds, CellList, Domain, point};

use super::candidates::Candidates;
use super::local::{Local, Spot, apart, greatest, have_units};
use super::ranked::Ranked;
use crate::surface::Closest;

/// Candidates nearer than this many spacings crowd each other: the nearest distance of a perfect hexagonal lattice.
const REACH: f64 = 1.07;

/// Levels of crowding that are told apart, per pair at no distance.
const LEVELS: f64 = 1e6;

/// Cosine of the angle between two normals up to which points are on the same side of the body.
const SAME_SIDE: f64 = 0.0;

/// The places of `keep` candidates that are spread as evenly as is wanted of them, between themselves and the held
/// sites (weighted sample elimination: Yuksel, "Sample elimination for generating Poisson disk sample sets", Computer
/// Graphics Forum 34, 2015). `locals` is of the held sites and then of the candidates. Across the periodic sides of a
/// `window` candidates crowd each other too. O(n log n).
pub(crate) fn keep_evenest<const D: usize>(
    candidates: &Candidates<D>,
    held: &[Closest<D>],
    keep: usize,
    locals: &[Local],
    window: Option<&Domain<D>>,
) -> Vec<usize> {
    let count = candidates.point.len();
    let both = candidates.point.iter().zip(&candidates.normal);
    let mut spots: Vec<Spot<D>> = both
        .zip(&locals[held.len()..])
        .map(|((&p, &n), &local)| (p, n, local))
        .collect();
    let first = held.iter().zip(locals);
    spots.extend(first.map(|(site, &local)| (site.point, site.normal, local)));
    let near = neighbors(&spots, window);
    let weight = |i: usize, j: usize| {
        let reach = REACH * apart(&spots[i], &spots[j], SAME_SIDE).unwrap_or(0.0);
        let gap = 1.0 - point::norm(difference(spots[i].0, spots[j].0, window)) / reach;
        gap.max(0.0).powi(8)
    };
    let mut crowding: Vec<f64> = (0..count)
        .map(|i| near[i].iter().map(|&j| weight(i, j as usize)).sum())
        .collect();
    let ranked = |index: usize, crowding: f64| Ranked {
        rank: level(crowding),
        index,
    };
    let mut heap: BinaryHeap<Ranked> = (0..count).map(|i| ranked(i, crowding[i])).collect();
    let mut gone = vec![false; count];
    let mut left = count;
    while left > keep {
        let Some(Ranked { rank, index: i }) = heap.pop() else {
            break;
        };
        // Crowding only ever falls: what has fallen since goes back to its place.
        if level(crowding[i]) < rank {
            heap.push(ranked(i, crowding[i]));
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

/// Crowding as it counts: to one part in a million of the greatest that a pair can have. Candidates along a straight
/// side are equally crowded, and which of them goes first is not for rounding to say.
fn level(crowding: f64) -> f64 {
    (LEVELS * crowding).round()
}

/// `a − b`, to the nearest image of `b` in a window.
fn difference<const D: usize>(a: [f64; D], b: [f64; D], window: Option<&Domain<D>>) -> [f64; D] {
    window.map_or_else(|| point::sub(a, b), |window| window.difference(a, b))
}

/// The box in which points have neighbours: periodic where the window is.
pub(super) fn around<const D: usize>(points: &[[f64; D]], window: Option<&Domain<D>>) -> Domain<D> {
    let mut bounds = Bounds::of(points);
    let periodic = window.map_or([false; D], |window| window.periodic);
    if let Some(window) = window {
        for k in (0..D).filter(|&k| periodic[k]) {
            (bounds.min[k], bounds.max[k]) = (window.bounds.min[k], window.bounds.max[k]);
        }
    }
    Domain { bounds, periodic }
}

/// For each spot those that it crowds.
fn neighbors<const D: usize>(spots: &[Spot<D>], window: Option<&Domain<D>>) -> Vec<Vec<u32>> {
    let points: Vec<[f64; D]> = spots.iter().map(|spot| spot.0).collect();
    let reach = REACH * greatest(spots.iter().map(|spot| spot.2));
    let mut list = CellList::new(&around(&points, window), reach);
    if have_units(spots.iter().map(|spot| spot.2)) {
        let reaches: Vec<f64> = (spots.iter())
            .map(|spot| REACH * greatest([spot.2]))
            .collect();
        list.update_each(&points, &reaches, |_| true);
    } else {
        list.update(&points);
    }
    let particle: Vec<u32> = list.sources().map(|(i, _)| i as u32).collect();
    let mut by_slot: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    list.blocks().for_each(&mut by_slot, |block, out| {
        for (lane, found) in out.iter_mut().enumerate() {
            let i = particle[block.first_slot + lane] as usize;
            let crowded = |j: u32| {
                let j = j as usize;
                let squared = point::norm_squared(difference(points[i], points[j], window));
                j != i
                    && squared < reach * reach
                    && apart(&spots[i], &spots[j], SAME_SIDE)
                        .is_some_and(|gap| squared < (REACH * gap) * (REACH * gap))
            };
            let others = block.sources().map(|slot| particle[slot]);
            found.extend(others.filter(|&j| crowded(j)));
            if window.is_some() {
                // In a narrow box an image too.
                found.sort_unstable();
                found.dedup();
            }
        }
    });
    let mut near = vec![Vec::new(); points.len()];
    for (slot, found) in by_slot.into_iter().enumerate() {
        near[particle[slot] as usize] = found;
    }
    near
}
