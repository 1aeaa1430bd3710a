//! Curves into closed loops of straight sides.

use kurbo::{BezPath, PathEl, Point, Rect};

use crate::GeometryError;
use crate::read::lines::whole;

/// How far the sides that stand for a curve of a drawing may be from it, in parts of the drawing's size (the diagonal
/// of the box around all that is painted).
pub const FLATTENING_OVER_SIZE: f64 = 1e-6;

/// A path whose ends are this near, in parts of the drawing's size, is closed.
const CLOSED_OVER_SIZE: f64 = 1e-6;

/// Points that any drawing may have, and those for each of its bytes: a few of them cannot ask for much memory.
const MOST_POINTS: (usize, usize) = (1_000_000, 4);

/// Makes loops of paths.
pub(super) struct Flattener {
    middle: Point,
    size: f64,
    /// How many more points there may be.
    room: usize,
    loops: Vec<Vec<[f64; 2]>>,
    current: Vec<[f64; 2]>,
    /// How wide the gap of each path was that was open.
    pub(super) gaps: Vec<f64>,
}

impl Flattener {
    /// For a drawing within `bounds`, in a file of `file_size` bytes.
    pub(super) fn new(bounds: Rect, file_size: usize) -> Self {
        Self {
            middle: bounds.center(),
            size: bounds.width().hypot(bounds.height()),
            room: MOST_POINTS.0 + MOST_POINTS.1 * file_size,
            loops: Vec::new(),
            current: Vec::new(),
            gaps: Vec::new(),
        }
    }

    /// The size of the drawing.
    pub(super) fn size(&self) -> f64 {
        self.size
    }

    /// The loops of a path, every part of it closed.
    pub(super) fn loops(&mut self, path: &BezPath) -> Result<Vec<Vec<[f64; 2]>>, GeometryError> {
        let mut now = Point::ORIGIN;
        for &element in path.elements() {
            match element {
                PathEl::MoveTo(to) => {
                    self.end();
                    self.current.push([to.x, to.y]);
                    now = to;
                }
                PathEl::LineTo(to) => {
                    self.current.push([to.x, to.y]);
                    now = to;
                }
                PathEl::QuadTo(_, to) | PathEl::CurveTo(_, _, to) => {
                    self.curve(now, element, to);
                    now = to;
                }
                PathEl::ClosePath => self.keep(),
            }
            if self.current.len() > self.room {
                return Err(too_many_points());
            }
        }
        self.end();
        Ok(std::mem::take(&mut self.loops))
    }

    /// Ends a path that is not closed explicitly: paint fills it all the same.
    fn end(&mut self) {
        if let [first, _, .., last] = self.current.as_slice() {
            let gap = (first[0] - last[0]).hypot(first[1] - last[1]);
            if gap > CLOSED_OVER_SIZE * self.size {
                self.gaps.push(gap);
            }
        }
        self.keep();
    }

    /// Takes the path as a loop; one of two points has no inside.
    fn keep(&mut self) {
        let path = std::mem::take(&mut self.current);
        self.room = self.room.saturating_sub(path.len());
        if path.len() > 2 {
            self.loops.push(path);
        }
    }

    /// Adds the points of a curve, worked out for a drawing of size 1 about the origin; its end exactly.
    fn curve(&mut self, from: Point, curve: PathEl, to: Point) {
        if self.size == 0.0 {
            return;
        }
        let (middle, size) = (self.middle, self.size);
        let unit = |p: Point| ((p - middle) / size).to_point();
        let curve = match curve {
            PathEl::QuadTo(a, b) => PathEl::QuadTo(unit(a), unit(b)),
            PathEl::CurveTo(a, b, c) => PathEl::CurveTo(unit(a), unit(b), unit(c)),
            other => other,
        };
        let path = [PathEl::MoveTo(unit(from)), curve];
        kurbo::flatten(path, FLATTENING_OVER_SIZE, |side| {
            if let PathEl::LineTo(p) = side {
                let p = middle + p.to_vec2() * size;
                self.current.push([p.x, p.y]);
            }
        });
        if let Some(last) = self.current.last_mut() {
            *last = [to.x, to.y];
        }
    }
}

pub(super) fn too_many_points() -> GeometryError {
    whole(
        "the drawing has more curves than its size lets expect, and would need too many points; simplify its paths",
    )
}
