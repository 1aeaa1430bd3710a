//! Outlines moved inward or outward, with their corners resolved.
//!
//! Every side sweeps a strip as it moves. What is left of the body inside (or what it grows to outside) is the body
//! minus (plus) all strips and the wedges between neighbours that move apart. Where no strip is shorter than it must
//! be and the moved sides do not meet, they bound that already; else all that is swept is joined first.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use sphpack_neighbors::{Bounds, point};

use super::{Outline, check::first_meeting, engine};
use crate::segment::{cross, signed_area};
use crate::{GeometryError, InsetError, ParameterError};

/// Mitres longer than this many offsets are cut off (bevelled).
pub const MITRE_LIMIT: f64 = 4.0;

/// Points nearer than this, in parts of the outline's size, are one: the engine's crossings of nearly parallel sides.
pub(super) const MERGE: f64 = 1e-11;

/// Pieces with less area than this × offset², or narrower than this × offset, are dropped: no particle fits, and of a strip as
/// thick as two offsets rounding alone would leave or take its two sides.
const CRUMB: f64 = 1e-6;

impl Outline {
    /// The outline moved outward by `distance` (inward where negative), scene units, O(n log n) for any ratio of the
    /// distance to the sides' lengths.
    ///
    /// Where sides approach each other (convex corners inward, reflex ones outward) the corner is their exact
    /// intersection. Where they part it is mitred up to [`MITRE_LIMIT`] × the distance and bevelled beyond.
    /// Self-intersections are cut; loops may split, merge or vanish.
    ///
    /// # Errors
    /// [`InsetError::Vanished`] where nothing is left, [`GeometryError::Parameter`] where `distance` is not
    /// finite, [`InsetError::TooTangled`] where what the sides sweep would have 64 times the outline's points.
    pub fn offset(&self, distance: f64) -> Result<Self, GeometryError> {
        ParameterError::check_finite("offset", "distance", [distance])?;
        if distance == 0.0 {
            return Ok(self.clone());
        }
        let vanished = InsetError::Vanished {
            depth: distance.abs(),
        }
        .into();
        let size = Bounds::of(&self.points).size();
        if -distance >= 0.5 * size[0].min(size[1]) {
            return Err(vanished);
        }
        let mut simple = self.starts.len() == 2;
        let mut raw = Vec::with_capacity(self.starts.len());
        for range in self.starts.windows(2) {
            let (points, all_mitred) = self.moved(range[0], range[1], distance);
            simple &= all_mitred;
            raw.push(points);
        }
        if raw.iter().flatten().any(|p| !point::is_finite(*p)) {
            return Err(ParameterError::OutOfRange {
                of: "offset",
                name: "distance",
                value: distance,
                needs: "small enough to compute with",
            }
            .into());
        }
        if simple {
            let candidate = Self::assemble(raw.clone());
            let counts = candidate.area > 0.0 && !is_crumb(&candidate.points, distance);
            if counts && first_meeting(&candidate).is_none() {
                return Ok(candidate);
            }
        }
        let merge = MERGE * self.extent();
        let rest = self.cut_or_grown(distance)?;
        let loops: Vec<Vec<[f64; 2]>> = rest
            .into_iter()
            .map(|points| tidy(points, merge))
            .filter(|points| points.len() >= 3 && !is_crumb(points, distance))
            .collect();
        if loops.is_empty() {
            return Err(vanished);
        }
        Ok(Self::from_clean(loops))
    }

    /// The loops of the body without what its sides sweep inward, or with what they sweep outward.
    fn cut_or_grown(&self, distance: f64) -> Result<Vec<Vec<[f64; 2]>>, GeometryError> {
        let rule = if distance < 0.0 {
            OverlayRule::Difference
        } else {
            OverlayRule::Union
        };
        let loops: Vec<Vec<[f64; 2]>> = self.loops().map(<[_]>::to_vec).collect();
        let swept = self.swept(distance)?;
        let left = engine::overlay(&loops, &swept, rule, FillRule::NonZero);
        Ok(left.into_iter().flatten().collect())
    }

    /// The raw offset of the loop `start..end`, and whether every side keeps its direction.
    fn moved(&self, start: usize, end: usize, distance: f64) -> (Vec<[f64; 2]>, bool) {
        let mut out = Vec::with_capacity(end - start);
        let mut all_mitred = true;
        for i in start..end {
            let before = if i > start { i - 1 } else { end - 1 };
            let turn = self.turn([before, i], distance);
            all_mitred &= matches!(turn, Turn::Mitred(_));
            out.extend_from_slice(turn.path(self.points[i]).as_slice());
        }
        (out, all_mitred)
    }

    /// What the outline's corner at the end of the first side and the start of the second becomes.
    pub(super) fn turn(&self, [before, i]: [usize; 2], distance: f64) -> Turn {
        let (into, out_of) = (&self.sides[before], &self.sides[i]);
        let vertex = self.points[i];
        let (sin, cos) = (
            cross(into.normal, out_of.normal),
            point::dot(into.normal, out_of.normal),
        );
        // |m| = 1 / cos(turn/2), along the bisector.
        let mitre = point::scale(
            point::add(into.normal, out_of.normal),
            1.0 / (1.0 + cos).max(f64::MIN_POSITIVE),
        );
        let mitred = Turn::Mitred(point::add_scaled(vertex, distance, mitre));
        let ends = [into, out_of].map(|side| point::add_scaled(vertex, distance, side.normal));
        if sin * distance > 0.0 || (sin == 0.0 && cos < 0.0) {
            // The sides part.
            if 2.0 <= MITRE_LIMIT * MITRE_LIMIT * (1.0 + cos) {
                mitred
            } else {
                Turn::Bevelled(ends)
            }
        } else {
            // They approach: each loses |distance| tan(turn/2) of its length here.
            let loss = distance.abs() * sin.abs() / (1.0 + cos).max(f64::MIN_POSITIVE);
            if loss <= 0.5 * into.length().min(out_of.length()) {
                mitred
            } else {
                Turn::Crossed(ends)
            }
        }
    }
}

/// Whether a loop is too small or too narrow to count beside an offset.
fn is_crumb(points: &[[f64; 2]], distance: f64) -> bool {
    let area = signed_area(points).abs();
    let ends = points.iter().zip(points.iter().cycle().skip(1));
    let around: f64 = ends.map(|(&a, &b)| point::distance(a, b)).sum();
    let least = CRUMB * distance.abs();
    area <= least * distance.abs() || 2.0 * area <= least * around
}

/// What becomes of a corner when the sides beside it are moved.
#[derive(Debug, Clone, Copy)]
pub(super) enum Turn {
    /// The moved sides meet here.
    Mitred([f64; 2]),
    /// The sides part too far: the end of the one before and the start of the one after.
    Bevelled([[f64; 2]; 2]),
    /// The sides approach and are too short to meet: both ends, beyond each other.
    Crossed([[f64; 2]; 2]),
}

impl Turn {
    /// The raw offset's way round the corner at `vertex`.
    pub(super) fn path(self, vertex: [f64; 2]) -> Path {
        match self {
            Self::Mitred(p) => Path([p; 3], 1),
            Self::Bevelled([a, b]) => Path([a, b, b], 2),
            Self::Crossed([a, b]) => Path([a, vertex, b], 3),
        }
    }
}

/// One to three points.
pub(super) struct Path([[f64; 2]; 3], usize);

impl Path {
    pub(super) fn as_slice(&self) -> &[[f64; 2]] {
        &self.0[..self.1]
    }
}

/// Without points that repeat their neighbours or lie on the line between them.
pub(super) fn tidy(points: Vec<[f64; 2]>, merge: f64) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for p in points {
        if kept
            .last()
            .is_none_or(|&last| point::distance(last, p) > merge)
        {
            kept.push(p);
        }
    }
    while kept.len() > 1 && point::distance(kept[0], kept[kept.len() - 1]) <= merge {
        kept.pop();
    }
    let n = kept.len();
    let on_line = |i: usize| {
        let (a, b, c) = (kept[(i + n - 1) % n], kept[i], kept[(i + 1) % n]);
        let (u, v) = (point::sub(b, a), point::sub(c, b));
        let width = point::norm(point::sub(c, a));
        point::dot(u, v) > 0.0 && cross(u, v).abs() <= 1e-15 * width * width
    };
    let keep: Vec<bool> = (0..n).map(|i| !on_line(i)).collect();
    let mut keep = keep.into_iter();
    kept.retain(|_| keep.next().unwrap_or(true));
    kept
}
