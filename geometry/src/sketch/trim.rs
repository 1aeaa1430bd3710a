//! What can be left out of a loop without changing what it bounds: points that repeat, and spikes.

use sphpack_neighbors::{Bounds, point};

use crate::outline::SAME_POINT;
use crate::segment::cross;

/// A spike is no thicker than this, in parts of the loop's size.
const SPIKE: f64 = 1e-12;

/// A loop without what adds nothing.
#[derive(Debug, Clone, Default)]
pub(super) struct Trimmed {
    /// What is left; empty where the loop bounds nothing.
    pub(super) points: Vec<[f64; 2]>,
    /// How many different points it has, one after another.
    pub(super) different: usize,
    /// How many points repeat the one before, and the first of them; the last may repeat the first of the loop.
    pub(super) repeats: (usize, [f64; 2]),
    /// How many spikes there are, and the tip of the first.
    pub(super) spikes: (usize, [f64; 2]),
}

impl Trimmed {
    /// Whether it has points enough, but on one line.
    pub(super) fn is_flat(&self) -> bool {
        self.points.is_empty() && self.different >= 3
    }
}

/// Takes out repeated points, then spikes, O(n).
pub(super) fn trim(given: &[[f64; 2]]) -> Trimmed {
    let size = Bounds::of(given).diagonal();
    let same = |a: [f64; 2], b: [f64; 2]| point::distance(a, b) <= SAME_POINT * size;
    let mut trimmed = Trimmed::default();
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(given.len());
    for &p in given {
        if kept.last().is_some_and(|&last| same(last, p)) {
            count(&mut trimmed.repeats, p);
        } else {
            kept.push(p);
        }
    }
    while kept.len() > 1 && same(kept[0], kept[kept.len() - 1]) {
        kept.pop();
    }
    trimmed.different = kept.len();
    let (points, spikes) = without_spikes(&kept, size);
    let sides = Bounds::of(&points).size();
    if points.len() >= 3 && sides.iter().all(|&side| side > 0.0) {
        trimmed.points = points;
        trimmed.spikes = spikes;
    }
    trimmed
}

fn count(tally: &mut (usize, [f64; 2]), place: [f64; 2]) {
    if tally.0 == 0 {
        tally.1 = place;
    }
    tally.0 += 1;
}

type Spikes = (usize, [f64; 2]);

/// What is left when every tip is taken out, and then the tip that is left by it, until there is none.
fn without_spikes(points: &[[f64; 2]], size: f64) -> (Vec<[f64; 2]>, Spikes) {
    let turns_back = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        let (into, out_of) = (point::sub(b, a), point::sub(c, b));
        let longer = point::norm(into).max(point::norm(out_of));
        point::dot(into, out_of) < 0.0 && cross(into, out_of).abs() <= SPIKE * size * longer
    };
    let same = |a: [f64; 2], b: [f64; 2]| point::distance(a, b) <= SAME_POINT * size;
    let mut spikes = (0, [0.0; 2]);
    // A spike of several points is one: its tip.
    let mut is_in_spike = false;
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for &p in points {
        let mut found = false;
        while let [.., a, b] = kept[..] {
            if same(b, p) {
                break;
            }
            if !turns_back(a, b, p) {
                break;
            }
            if !is_in_spike && !found {
                count(&mut spikes, b);
            }
            found = true;
            kept.pop();
        }
        if kept.last().is_some_and(|&last| same(last, p)) {
            // The spike went out and came back to where it began.
            is_in_spike |= found;
            continue;
        }
        is_in_spike = found;
        kept.push(p);
    }
    // The loop's beginning follows its end.
    let mut start = 0;
    while kept.len() >= start + 3 {
        let n = kept.len();
        let (before, last, first, second) =
            (kept[n - 2], kept[n - 1], kept[start], kept[start + 1]);
        if same(last, first) {
            kept.pop();
        } else if turns_back(before, last, first) {
            count(&mut spikes, last);
            kept.pop();
        } else if turns_back(last, first, second) {
            count(&mut spikes, first);
            start += 1;
        } else {
            break;
        }
    }
    kept.drain(..start);
    (kept, spikes)
}
