//! What makes a list of points an outline.

use sphpack_neighbors::{Bounds, point};

use super::{Outline, SAME_POINT};
use crate::segment::{cross, meeting, signed_area};
use crate::{LoopSide, OutlineError};

/// The loops without repeated consecutive points (the first at the end included).
pub(super) fn without_repeats(
    loops: Vec<Vec<[f64; 2]>>,
) -> Result<Vec<Vec<[f64; 2]>>, OutlineError> {
    if loops.is_empty() {
        return Err(OutlineError::TooFewPoints {
            loop_index: 0,
            count: 0,
        });
    }
    for (index, p) in loops.iter().flatten().enumerate() {
        // Squares must stay finite too, or every distance is infinite.
        if !point::norm_squared(*p).is_finite() {
            return Err(OutlineError::NotFinite { index });
        }
    }
    let mut clean = Vec::with_capacity(loops.len());
    for (loop_index, points) in loops.into_iter().enumerate() {
        let size = Bounds::of(&points).diagonal();
        let same = |a: [f64; 2], b: [f64; 2]| point::distance(a, b) <= SAME_POINT * size;
        let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
        for p in points {
            if kept.last().is_none_or(|&last| !same(last, p)) {
                kept.push(p);
            }
        }
        while kept.len() > 1 && same(kept[0], kept[kept.len() - 1]) {
            kept.pop();
        }
        if kept.len() < 3 {
            return Err(OutlineError::TooFewPoints {
                loop_index,
                count: kept.len(),
            });
        }
        if kept.len() == 3 && signed_area(&kept).abs() <= 1e-15 * size * size {
            return Err(OutlineError::NoArea { loop_index });
        }
        clean.push(kept);
    }
    Ok(clean)
}

/// Whether no two sides meet other than neighbours at their common point. O(n log n) for sides that spread out.
pub(super) fn no_meetings(outline: &Outline) -> Result<(), OutlineError> {
    for (loop_index, points) in outline.loops().enumerate() {
        let size = Bounds::of(points).size();
        if size[0] == 0.0 || size[1] == 0.0 {
            return Err(OutlineError::NoArea { loop_index });
        }
    }
    match first_meeting(outline) {
        None => {}
        Some((i, j, place)) => {
            let side = |i: usize| {
                let (loop_index, side) = outline.address(i);
                LoopSide { loop_index, side }
            };
            return Err(OutlineError::SelfIntersecting {
                first: side(i),
                second: side(j),
                place,
            });
        }
    }
    for (loop_index, points) in outline.loops().enumerate() {
        if signed_area(points) == 0.0 {
            return Err(OutlineError::NoArea { loop_index });
        }
    }
    Ok(())
}

/// The first pair of sides that meet where they must not, and where.
pub(super) fn first_meeting(outline: &Outline) -> Option<(usize, usize, [f64; 2])> {
    (0..outline.points.len()).find_map(|i| {
        let mut first: Option<(usize, [f64; 2])> = None;
        meetings_of(outline, i, |j, place| {
            if first.is_none_or(|(k, _)| j < k) {
                first = Some((j, place));
            }
        });
        first.map(|(j, place)| (i, j, place))
    })
}

/// The sides after side `i` that it meets where it must not, in any order, and where.
pub(crate) fn meetings_of(outline: &Outline, i: usize, mut found: impl FnMut(usize, [f64; 2])) {
    let end = |i: usize| outline.points[outline.next[i] as usize];
    let (a, b) = (outline.points[i], end(i));
    outline.bvh.overlapping(&Bounds::of(&[a, b]), |j| {
        if j <= i {
            return;
        }
        let (c, d) = (outline.points[j], end(j));
        let joined = if outline.next[i] as usize == j {
            Some((outline.sides[i].edge, outline.sides[j].edge, c))
        } else if outline.next[j] as usize == i {
            Some((outline.sides[j].edge, outline.sides[i].edge, a))
        } else {
            None
        };
        let place = match joined {
            // Neighbours meet elsewhere only where one folds back onto the other.
            Some((from, to, at)) => {
                (cross(from, to) == 0.0 && point::dot(from, to) < 0.0).then_some(at)
            }
            None => meeting(a, b, c, d),
        };
        if let Some(place) = place {
            found(j, place);
        }
    });
}
