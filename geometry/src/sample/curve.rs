//! Points spread along curves in the plane, corners first.

use std::collections::BinaryHeap;

use super::features::thinned;
use super::polyline::Polyline;
use super::ranked::Ranked;
use crate::surface::{Closest, Feature, Surface};

/// Corners nearer than this many spacings along the curve share one point.
const CROWDED: f64 = 0.5;

/// A closed polyline on or near a curve.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ring<const D: usize> {
    /// Its points, the first not repeated at the end.
    pub(crate) points: Vec<[f64; D]>,
    /// Which of them are corners.
    pub(crate) corner: Vec<bool>,
}

/// A piece of a ring between two corners, or all of a smooth ring: where it starts and how long it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    ring: usize,
    pub(super) start: f64,
    pub(super) length: f64,
    from_corner: bool,
}

/// `count` points evenly along `rings`, put onto `surface`: corners first, of which those nearer than half a spacing
/// share one; then the runs between them in turn. A run gets the number of intervals that its length
/// asks for, at least one where it joins corners. Where there are fewer points than corners, evenly taken corners.
pub(crate) fn along<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    rings: &[Ring<D>],
    count: usize,
) -> Vec<Closest<D>> {
    let closed: Vec<Polyline<D>> = rings
        .iter()
        .map(|ring| {
            Polyline::new(
                ring.points
                    .iter()
                    .chain(ring.points.first())
                    .copied()
                    .collect(),
            )
        })
        .collect();
    let length: f64 = closed.iter().map(Polyline::length).sum();
    if count == 0 || closed.is_empty() || length.is_nan() {
        return Vec::new();
    }
    let least = CROWDED * length / count as f64;
    let runs: Vec<Run> = (0..rings.len())
        .flat_map(|ring| runs_of(ring, &rings[ring], &closed[ring], least))
        .collect();
    let place = |run: &Run, way: f64, feature: Feature| {
        let line = &closed[run.ring];
        let way = run.start + way;
        let way = if way > line.length() {
            way - line.length()
        } else {
            way
        };
        Closest {
            distance: 0.0,
            feature,
            ..surface.closest(line.at(way).0)
        }
    };
    let corners: Vec<Closest<D>> = runs
        .iter()
        .filter(|run| run.from_corner)
        .map(|run| place(run, 0.0, Feature::Corner))
        .collect();
    if corners.len() >= count {
        return thinned(corners, count);
    }
    let mut sites = corners;
    for (run, intervals) in runs.iter().zip(shares(&runs, count)) {
        for i in usize::from(run.from_corner)..intervals {
            let way = run.length * i as f64 / intervals as f64;
            sites.push(place(run, way, Feature::Smooth));
        }
    }
    sites
}

/// The runs of a ring, its corners at least `least` apart along it.
pub(super) fn runs_of<const D: usize>(
    number: usize,
    ring: &Ring<D>,
    line: &Polyline<D>,
    least: f64,
) -> Vec<Run> {
    let mut starts: Vec<f64> = Vec::new();
    for (i, _) in ring
        .corner
        .iter()
        .enumerate()
        .filter(|(_, corner)| **corner)
    {
        let way = line.way(i);
        let apart = |other: &f64| way - other >= least;
        let around = |other: &f64| line.length() - way + other >= least;
        if starts.last().is_none_or(apart) && starts.first().is_none_or(around) {
            starts.push(way);
        }
    }
    let run = |start: f64, end: f64, from_corner: bool| Run {
        ring: number,
        start,
        length: end - start,
        from_corner,
    };
    let Some(&first) = starts.first() else {
        return vec![run(0.0, line.length(), false)];
    };
    let ends = starts[1..].iter().copied().chain([first + line.length()]);
    starts
        .iter()
        .zip(ends)
        .map(|(&start, end)| run(start, end, true))
        .collect()
}

/// How many of `count` intervals each run gets: as its length asks, so that the intervals' lengths differ least (their
/// sum of squares Σ L²/n is smallest, which the next interval lowers by L²/n(n + 1); for short runs that is not the
/// same as largest remainders), and at least one where it starts at a corner (of which there are at most `count`).
fn shares(runs: &[Run], count: usize) -> Vec<usize> {
    let total: f64 = runs.iter().map(|run| run.length).sum();
    let quota = |i: usize| runs[i].length / total * count as f64;
    let fewest = |i: usize| usize::from(runs[i].from_corner);
    let mut shares: Vec<usize> = (0..runs.len())
        .map(|i| (quota(i).floor() as usize).max(fewest(i)))
        .collect();
    let mut given: usize = shares.iter().sum();
    // One interval at a time to the run that gains most …
    let lack = |index: usize, share: usize| Ranked {
        // A loop without corners that has none gets its first from seven tenths of an interval on.
        rank: quota(index).powi(2) / (share as f64 * (share + 1) as f64).max(0.5),
        index,
    };
    let mut lacking: BinaryHeap<Ranked> = (0..runs.len()).map(|i| lack(i, shares[i])).collect();
    while given < count {
        let Some(Ranked { index: i, .. }) = lacking.pop() else {
            break;
        };
        shares[i] += 1;
        given += 1;
        lacking.push(lack(i, shares[i]));
    }
    // … or from the one that loses least, where many short runs took one each.
    let excess = |index: usize, share: usize| Ranked {
        rank: -quota(index).powi(2) / (share as f64 * (share as f64 - 1.0)).max(0.5),
        index,
    };
    let mut rich: BinaryHeap<Ranked> = (0..runs.len())
        .filter(|&i| shares[i] > fewest(i))
        .map(|i| excess(i, shares[i]))
        .collect();
    while given > count {
        let Some(Ranked { index: i, .. }) = rich.pop() else {
            break;
        };
        shares[i] -= 1;
        given -= 1;
        if shares[i] > fewest(i) {
            rich.push(excess(i, shares[i]));
        }
    }
    shares
}
