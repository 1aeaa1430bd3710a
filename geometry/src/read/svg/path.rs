//! The data of SVG paths.

use kurbo::{Arc, BezPath, PathEl, Point, SvgArc, Vec2};

use super::scan::Scan;

/// How far the cubic pieces of an arc may be from it, in parts of its larger radius.
const ARC_OVER_RADIUS: f64 = 1e-7;

/// A short arc whose radius is larger than this, over the distance of its ends, is a straight line for every purpose.
const FLAT: f64 = 1e6;

/// A long arc of such a radius would be a circle that no number of 64 bits can close.
const CIRCLE: f64 = 1e9;

/// Reads the value of an attribute `d`. Anything that is not of the grammar is an error, at the end too; no number of
/// the path can ask for many pieces.
pub(super) fn parse(data: &str) -> Result<BezPath, String> {
    let mut reader = Reader {
        scan: Scan::new(data),
        path: BezPath::new(),
        start: Point::ORIGIN,
        now: Point::ORIGIN,
        handle: None,
        is_relative: false,
    };
    match reader.run() {
        Ok(()) => Ok(reader.path),
        Err(wanted) => Err(format!(
            "character {} of a path's data: {wanted} is needed here; save the drawing again",
            reader.scan.place() + 1
        )),
    }
}

struct Reader<'a> {
    scan: Scan<'a>,
    path: BezPath,
    /// Of the subpath.
    start: Point,
    now: Point,
    /// The last control point of the last curve, and whether that curve was cubic.
    handle: Option<(Point, bool)>,
    is_relative: bool,
}

impl Reader<'_> {
    fn run(&mut self) -> Result<(), &'static str> {
        let mut command = None;
        let mut is_drawn = false;
        loop {
            self.scan.skip_space();
            let Some(byte) = self.scan.peek() else {
                return Ok(());
            };
            let letter = if byte.is_ascii_alphabetic() {
                self.scan.take(byte);
                self.scan.skip_space();
                byte
            } else {
                // Numbers alone repeat the command; those of a start are lines.
                self.scan.skip_separator();
                match command {
                    Some(b'm') => b'l',
                    Some(b'M') => b'L',
                    Some(b'z' | b'Z') | None => return Err("a command"),
                    Some(letter) => letter,
                }
            };
            command = Some(letter);
            self.is_relative = letter.is_ascii_lowercase();
            let kind = letter.to_ascii_uppercase();
            match kind {
                b'M' => {
                    self.now = self.point()?;
                    self.start = self.now;
                    self.handle = None;
                    is_drawn = true;
                    self.path.move_to(self.now);
                }
                _ if !is_drawn => return Err("a start (M x y)"),
                b'Z' => {
                    self.path.close_path();
                    self.now = self.start;
                    self.handle = None;
                }
                _ => {
                    if matches!(self.path.elements().last(), Some(PathEl::ClosePath)) {
                        self.path.move_to(self.start);
                    }
                    self.draw(kind)?;
                }
            }
        }
    }

    fn draw(&mut self, kind: u8) -> Result<(), &'static str> {
        match kind {
            b'L' => {
                let to = self.point()?;
                self.line(to);
            }
            b'H' => {
                let from = if self.is_relative { self.now.x } else { 0.0 };
                let to = Point::new(from + self.number()?, self.now.y);
                self.line(to);
            }
            b'V' => {
                let from = if self.is_relative { self.now.y } else { 0.0 };
                let to = Point::new(self.now.x, from + self.number()?);
                self.line(to);
            }
            b'C' | b'S' => {
                let first = if kind == b'C' {
                    self.point()?
                } else {
                    self.mirrored(true)
                };
                let (second, to) = (self.point()?, self.point()?);
                self.path.curve_to(first, second, to);
                self.now = to;
                self.handle = Some((second, true));
            }
            b'Q' | b'T' => {
                let middle = if kind == b'Q' {
                    self.point()?
                } else {
                    self.mirrored(false)
                };
                let to = self.point()?;
                self.path.quad_to(middle, to);
                self.now = to;
                self.handle = Some((middle, false));
            }
            b'A' => {
                let radii = Vec2::new(self.number()?, self.number()?);
                let x_rotation = self.number()?.to_radians();
                let (large_arc, sweep) = (self.flag()?, self.flag()?);
                let to = self.point()?;
                arc(
                    &mut self.path,
                    SvgArc {
                        from: self.now,
                        to,
                        radii,
                        x_rotation,
                        large_arc,
                        sweep,
                    },
                );
                self.now = to;
                self.handle = None;
            }
            _ => return Err("one of the commands M L H V C S Q T A Z"),
        }
        Ok(())
    }

    fn line(&mut self, to: Point) {
        self.path.line_to(to);
        self.now = to;
        self.handle = None;
    }

    /// The last control point mirrored, where the last curve was of the same kind.
    fn mirrored(&self, is_cubic: bool) -> Point {
        match self.handle {
            Some((handle, kind)) if kind == is_cubic => self.now + (self.now - handle),
            _ => self.now,
        }
    }

    fn number(&mut self) -> Result<f64, &'static str> {
        let number = self.scan.number().ok_or("a number")?;
        self.scan.skip_separator();
        Ok(number)
    }

    fn flag(&mut self) -> Result<bool, &'static str> {
        let flag = self.scan.flag().ok_or("a flag, 0 or 1,")?;
        self.scan.skip_separator();
        Ok(flag)
    }

    fn point(&mut self) -> Result<Point, &'static str> {
        let read = Vec2::new(self.number()?, self.number()?);
        Ok(if self.is_relative {
            self.now + read
        } else {
            read.to_point()
        })
    }
}

/// Adds an elliptical arc as cubic pieces. It is worked out for ends that are 1 apart, where no number over- or
/// underflows.
pub(super) fn arc(path: &mut BezPath, arc: SvgArc) {
    let chord = arc.to - arc.from;
    let size = chord.hypot();
    let radii = arc.radii / size;
    let most = if arc.large_arc { CIRCLE } else { FLAT };
    let fits = |radius: f64| radius.abs() < most;
    let is_curved = size > 0.0 && size.is_finite() && fits(radii.x) && fits(radii.y);
    let unit = SvgArc {
        from: Point::ORIGIN,
        to: (chord / size).to_point(),
        radii,
        ..arc
    };
    let Some(curve) = is_curved.then(|| Arc::from_svg_arc(&unit)).flatten() else {
        path.line_to(arc.to);
        return;
    };
    let back = |p: Point| arc.from + p.to_vec2() * size;
    let tolerance = ARC_OVER_RADIUS * curve.radii.x.max(curve.radii.y);
    let mut pieces = Vec::new();
    curve.to_cubic_beziers(tolerance, |a, b, c| pieces.push((a, b, c)));
    let last = pieces.len().saturating_sub(1);
    for (k, (a, b, c)) in pieces.into_iter().enumerate() {
        // The next command starts exactly here.
        let end = if k == last { arc.to } else { back(c) };
        path.curve_to(back(a), back(b), end);
    }
}
