//! Points spread along curves in the plane, corners first.

use std::collections::BinaryHeap;

use super::features::thinned;
use super::polyline::Polyline;
use super::ranked::Ranked;
use crate::surface::{Closest, Feature, Surface};

/// Corners nearer than this many spacings along the curve share one point.
const CROWDED: f64 = 0.5;

/// A polyline on or near a curve, closed or from side to side of a box beyond which the curve goes on.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ring<const D: usize> {
    /// Its points; where it is closed the first is not repeated at the end.
    pub(crate) points: Vec<[f64; D]>,
    /// Which of them are corners; not the ends of an open one.
    pub(crate) corner: Vec<bool>,
    /// Whether it is not closed.
    pub(crate) is_open: bool,
}

impl<const D: usize> Ring<D> {
    /// From its first point to its last, or around to the first again.
    pub(super) fn line(&self) -> Polyline<D> {
        let again = self.points.first().filter(|_| !self.is_open);
        Polyline::new(self.points.iter().chain(again).copied().collect())
    }
}

/// A piece of a ring between two corners or ends, or all of a smooth closed ring: where it starts and how long it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    ring: usize,
    pub(super) start: f64,
    pub(super) length: f64,
    from_corner: bool,
    /// Whether it begins, or ends, where an open ring does: half an interval from there is its first, or last, point.
    is_open: [bool; 2],
}

impl Run {
    /// Intervals beyond its points: half a one before the first, less half a one behind the last.
    fn more(&self) -> f64 {
        0.5 * (f64::from(u8::from(self.is_open[0])) - f64::from(u8::from(self.is_open[1])))
    }

    /// The way along it to the `i`-th of so many points.
    fn way(&self, i: usize, points: usize) -> f64 {
        let lead = if self.is_open[0] { 0.5 } else { 0.0 };
        self.length * (i as f64 + lead) / (points as f64 + self.more())
    }
}

/// `count` points evenly along `rings`, put onto `surface`: corners first, of which those nearer than half a spacing
/// share one; then the runs between them in turn. A run gets the number of intervals that its length
/// asks for, at least one where it joins corners; at the ends of open rings half an interval is left, so that what goes on
/// beyond is as even. Where there are fewer points than corners, evenly taken corners.
pub(crate) fn along<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    rings: &[Ring<D>],
    count: usize,
) -> Vec<Closest<D>> {
    let lines: Vec<Polyline<D>> = rings.iter().map(Ring::line).collect();
    along_lines(surface, rings, &lines, count)
}

/// [`along`] with intervals of the same integral of a positive weight rather than of the same length. Rings must have points
/// wherever the weight changes.
pub(super) fn along_weighted<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    rings: &[Ring<D>],
    weight: &impl Fn([f64; D]) -> f64,
    count: usize,
) -> Vec<Closest<D>> {
    let line = |ring: &Ring<D>| {
        let points = ring.line().points().to_vec();
        let weights: Vec<f64> = points.iter().map(|&p| weight(p)).collect();
        Polyline::weighted(points, &weights)
    };
    let lines: Vec<Polyline<D>> = rings.iter().map(line).collect();
    along_lines(surface, rings, &lines, count)
}

/// [`along`] rings that are measured as `lines` are.
fn along_lines<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    rings: &[Ring<D>],
    lines: &[Polyline<D>],
    count: usize,
) -> Vec<Closest<D>> {
    let length: f64 = lines.iter().map(Polyline::length).sum();
    if count == 0 || lines.is_empty() || length.is_nan() {
        return Vec::new();
    }
    let least = CROWDED * length / count as f64;
    let runs: Vec<Run> = (0..rings.len())
        .flat_map(|ring| runs_of(ring, &rings[ring], &lines[ring], least))
        .collect();
    let place = |run: &Run, way: f64, feature: Feature| {
        let line = &lines[run.ring];
        let way = run.start + way;
        let way = if way > line.length() && !rings[run.ring].is_open {
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
    for (run, points) in runs.iter().zip(shares(&runs, count)) {
        for i in usize::from(run.from_corner)..points {
            sites.push(place(run, run.way(i, points), Feature::Smooth));
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
        let around = |other: &f64| ring.is_open || line.length() - way + other >= least;
        if starts.last().is_none_or(apart) && starts.first().is_none_or(around) {
            starts.push(way);
        }
    }
    let run = |start: f64, end: f64, from_corner: bool| Run {
        ring: number,
        start,
        length: end - start,
        from_corner,
        is_open: [false; 2],
    };
    let Some(&first) = starts.first() else {
        return vec![Run {
            is_open: [ring.is_open; 2],
            ..run(0.0, line.length(), false)
        }];
    };
    if ring.is_open {
        let before = Run {
            is_open: [true, false],
            ..run(0.0, first, false)
        };
        let ends = starts[1..].iter().copied().chain([line.length()]);
        let mut runs: Vec<Run> = std::iter::once(before)
            .chain(
                starts
                    .iter()
                    .zip(ends)
                    .map(|(&start, end)| run(start, end, true)),
            )
            .collect();
        if let Some(last) = runs.last_mut() {
            last.is_open[1] = true;
        }
        return runs;
    }
    let ends = starts[1..].iter().copied().chain([first + line.length()]);
    starts
        .iter()
        .zip(ends)
        .map(|(&start, end)| run(start, end, true))
        .collect()
}

/// How many of `count` intervals each run gets: as its length asks, so that the intervals' lengths differ least (their
/// sum of squares Σ L²/n is smallest, which the next interval lowers by L²/n(n + 1); for short runs that is not the
/// same as largest remainders), and at least one where it starts at a corner (of which there are at most `count`). At the
/// end of an open ring half an interval needs no point, or half a point no interval.
fn shares(runs: &[Run], count: usize) -> Vec<usize> {
    let total: f64 = runs.iter().map(|run| run.length).sum();
    let quota = |i: usize| (runs[i].length / total * count as f64 - runs[i].more()).max(0.0);
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
