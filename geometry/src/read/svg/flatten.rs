//! Paths into closed loops of straight sides.

use kurbo::{PathEl, Point, Rect};

use super::Drawn;
use crate::GeometryError;
use crate::read::lines::{row, whole};

/// How far the sides that stand for a curve of a drawing may be from it, in parts of the drawing's size (the diagonal
/// of the box around all its paths).
pub const FLATTENING_OVER_SIZE: f64 = 1e-6;

/// A path whose ends are this near, in parts of the drawing's size, is closed.
const CLOSED_OVER_SIZE: f64 = 1e-6;

/// Points that any drawing may have, and those for each of its bytes: a few of them cannot ask for much memory.
const MOST_POINTS: (usize, usize) = (1_000_000, 4);

/// The closed loops of all paths, for a file of `size` bytes.
pub(super) fn loops(shapes: &[Drawn], size: usize) -> Result<Vec<Vec<[f64; 2]>>, GeometryError> {
    let mut bounds: Option<Rect> = None;
    for shape in shapes {
        for point in shape.path.elements().iter().flat_map(points) {
            if !(point.to_vec2().hypot2() * 16.0).is_finite() {
                return Err(row(
                    shape.line,
                    "a path has coordinates that are too large; scale the drawing down",
                ));
            }
            let here = Rect::from_points(point, point);
            bounds = Some(bounds.map_or(here, |b| b.union(here)));
        }
    }
    let Some(bounds) = bounds else {
        return Ok(Vec::new());
    };
    let mut flattener = Flattener {
        middle: bounds.center(),
        size: bounds.width().hypot(bounds.height()),
        room: MOST_POINTS.0 + MOST_POINTS.1 * size,
        loops: Vec::new(),
        current: Vec::new(),
    };
    for shape in shapes {
        flattener.add(shape)?;
    }
    Ok(flattener.loops)
}

fn points(element: &PathEl) -> impl Iterator<Item = Point> + use<> {
    let (all, count) = match *element {
        PathEl::MoveTo(a) | PathEl::LineTo(a) => ([a; 3], 1),
        PathEl::QuadTo(a, b) => ([a, b, b], 2),
        PathEl::CurveTo(a, b, c) => ([a, b, c], 3),
        PathEl::ClosePath => ([Point::ORIGIN; 3], 0),
    };
    all.into_iter().take(count)
}

struct Flattener {
    middle: Point,
    size: f64,
    /// How many more points there may be.
    room: usize,
    loops: Vec<Vec<[f64; 2]>>,
    current: Vec<[f64; 2]>,
}

impl Flattener {
    fn add(&mut self, shape: &Drawn) -> Result<(), GeometryError> {
        let mut now = Point::ORIGIN;
        for &element in shape.path.elements() {
            match element {
                PathEl::MoveTo(to) => {
                    self.end(shape.line)?;
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
                return Err(whole(
                    "the drawing has more curves than its size lets expect, and would need too many points; simplify its paths",
                ));
            }
        }
        self.end(shape.line)
    }

    /// Ends a path that is not closed explicitly.
    fn end(&mut self, line: usize) -> Result<(), GeometryError> {
        let path = &self.current;
        let [first, .., last] = path.as_slice() else {
            // A start that nothing is drawn from is no path.
            self.current.clear();
            return Ok(());
        };
        let gap = (first[0] - last[0]).hypot(first[1] - last[1]);
        if gap > CLOSED_OVER_SIZE * self.size || path.len() < 3 {
            return Err(row(
                line,
                format!(
                    "a path is not closed: it starts at ({}, {}) and ends at ({}, {}) (y up); close it, or delete it from the drawing",
                    first[0], first[1], last[0], last[1]
                ),
            ));
        }
        self.keep();
        Ok(())
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
