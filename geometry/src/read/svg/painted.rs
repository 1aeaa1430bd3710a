//! What of a resolved drawing is painted: fills and strokes that can be seen, within what clips them.

use kurbo::{Affine, BezPath, Cap, Join, Point, Rect, Shape, Stroke, StrokeOpts};
use usvg::tiny_skia_path::PathSegment;
use usvg::{ClipPath, FillRule, Group, LineCap, LineJoin, Node, Tree};

use super::Drawing;
use super::flatten::{FLATTENING_OVER_SIZE, Flattener, too_many_points};
use super::region::{Region, boundary};
use crate::read::lines::whole;
use crate::{GeometryError, OutlineRepair};

/// Dashes of one stroke, at most.
const MOST_DASHES: f64 = 1e5;

/// Numbers of a resolved drawing have 24 bits. A drawing this many times its size from its origin would have lost
/// places to 10⁻⁴ of that.
const FARTHEST_OVER_SIZE: f64 = 1500.0;

/// Something painted.
enum Layer {
    Fill {
        path: BezPath,
        is_odd: bool,
    },
    /// A path in coordinates of its own, to be drawn with a pen there.
    Line {
        path: BezPath,
        pen: Stroke,
        place: Affine,
    },
    /// What is seen of some through others.
    Clipped {
        layers: Vec<Self>,
        by: Vec<Vec<Self>>,
    },
}

/// Everything painted, y up.
pub(super) struct Painted {
    layers: Vec<Layer>,
    bounds: Option<Rect>,
    fills: usize,
    strokes: usize,
    widest: f64,
    /// Masks and filters, which are not applied.
    effects: usize,
}

impl Painted {
    /// All layers of a drawing; `origin` is where its own origin was moved from.
    pub(super) fn of(tree: &Tree, origin: [f64; 2]) -> Self {
        let mut painted = Self {
            layers: Vec::new(),
            bounds: None,
            fills: 0,
            strokes: 0,
            widest: 0.0,
            effects: 0,
        };
        let place = Affine::FLIP_Y * Affine::translate((origin[0], origin[1]));
        painted.layers = painted.within(tree.root(), place);
        painted
    }

    fn within(&mut self, group: &Group, place: Affine) -> Vec<Layer> {
        let mut layers = Vec::new();
        if group.opacity().get() == 0.0 {
            return layers;
        }
        let place = place * affine(group.transform());
        self.effects += usize::from(group.mask().is_some()) + group.filters().len();
        for child in group.children() {
            match child {
                Node::Group(group) => layers.append(&mut self.within(group, place)),
                Node::Path(path) if path.is_visible() => self.add(path, place, &mut layers),
                Node::Path(_) | Node::Image(_) | Node::Text(_) => {}
            }
        }
        match group.clip_path() {
            Some(clip) if !layers.is_empty() => vec![Layer::Clipped {
                layers,
                by: clips(clip, place),
            }],
            _ => layers,
        }
    }

    fn add(&mut self, path: &usvg::Path, place: Affine, layers: &mut Vec<Layer>) {
        let drawn = curve(path.data());
        if let Some(fill) = path.fill().filter(|fill| fill.opacity().get() > 0.0) {
            let path = place * drawn.clone();
            self.reach(&path, 0.0);
            self.fills += 1;
            layers.push(Layer::Fill {
                path,
                is_odd: fill.rule() == FillRule::EvenOdd,
            });
        }
        if let Some(stroke) = path.stroke().filter(|stroke| stroke.opacity().get() > 0.0) {
            let pen = pen(stroke);
            let width = pen.width * place.determinant().abs().sqrt();
            self.reach(&(place * drawn.clone()), 0.5 * width);
            self.strokes += 1;
            self.widest = self.widest.max(width);
            layers.push(Layer::Line {
                path: drawn,
                pen,
                place,
            });
        }
    }

    fn reach(&mut self, path: &BezPath, beyond: f64) {
        let bounds = path.control_box().inflate(beyond, beyond);
        self.bounds = Some(self.bounds.map_or(bounds, |b| b.union(bounds)));
    }

    /// The boundary of all of it, for a file of `size` bytes, and what was done to paths.
    pub(super) fn outline(&self, size: usize) -> Result<Drawing, GeometryError> {
        let Some(bounds) = self.bounds else {
            return Ok(<_>::default());
        };
        let mut flattener = Flattener::new(bounds, size);
        let far = (bounds.x0.abs().max(bounds.x1.abs())).max(bounds.y0.abs().max(bounds.y1.abs()));
        if far > FARTHEST_OVER_SIZE * flattener.size() && flattener.size() > 0.0 {
            return Err(whole(format!(
                "the drawing is {} wide but up to {far} away from its origin, where drawings keep too few digits; move it nearer",
                flattener.size()
            )));
        }
        let regions = flattened(&self.layers, &mut flattener)?;
        let mut done = Vec::new();
        if let Some(widest) = flattener.gaps.iter().copied().reduce(f64::max) {
            done.push(OutlineRepair::ClosedPaths {
                paths: flattener.gaps.len(),
                widest,
            });
        }
        Ok((boundary(regions)?, done))
    }

    /// What there is to say about how it is painted.
    pub(super) fn remarks(&self) -> impl Iterator<Item = OutlineRepair> {
        let stroked = OutlineRepair::Stroked {
            strokes: self.strokes,
            widest: self.widest,
            is_all: self.fills == 0,
        };
        let effects = OutlineRepair::LeftOutEffects(self.effects);
        [
            (self.strokes > 0).then_some(stroked),
            (self.effects > 0).then_some(effects),
        ]
        .into_iter()
        .flatten()
    }
}

fn flattened(layers: &[Layer], flattener: &mut Flattener) -> Result<Vec<Region>, GeometryError> {
    let mut regions = Vec::new();
    for layer in layers {
        match layer {
            Layer::Fill { path, is_odd } => regions.push(Region {
                loops: flattener.loops(path)?,
                is_odd: *is_odd,
            }),
            Layer::Line { path, pen, place } => {
                let loops = line(path, pen, *place, flattener)?;
                regions.push(Region {
                    loops,
                    is_odd: false,
                });
            }
            Layer::Clipped { layers, by } => {
                let mut whole = flattened(layers, flattener)?;
                for clip in by {
                    let gaps = flattener.gaps.len();
                    let clip = flattened(clip, flattener)?;
                    flattener.gaps.truncate(gaps);
                    whole = Region::within(whole, clip);
                }
                regions.append(&mut whole);
            }
        }
    }
    Ok(regions)
}

/// The loops around a line.
fn line(
    path: &BezPath,
    pen: &Stroke,
    place: Affine,
    flattener: &mut Flattener,
) -> Result<Vec<Vec<[f64; 2]>>, GeometryError> {
    // Where the place stretches, its larger factor counts.
    let [a, b, c, d, ..] = place.as_coeffs();
    let scale = a.hypot(b).max(c.hypot(d));
    let size = flattener.size() / scale;
    if !(size.is_finite() && size > 0.0) {
        return Ok(Vec::new());
    }
    // Worked out at size 1 about the origin.
    let middle = path.control_box().center();
    let unit = Affine::scale(1.0 / size) * Affine::translate(-middle.to_vec2());
    let mut pen = pen.clone();
    pen.width /= size;
    pen.dash_offset /= size;
    pen.dash_pattern.iter_mut().for_each(|dash| *dash /= size);
    let drawn = unit * path.clone();
    let period: f64 = pen.dash_pattern.iter().sum();
    if !pen.dash_pattern.is_empty() && drawn.perimeter(0.01) > MOST_DASHES * period {
        return Err(whole(
            "a stroke of the drawing has too many dashes; draw it without them",
        ));
    }
    let around = kurbo::stroke(drawn, &pen, &StrokeOpts::default(), FLATTENING_OVER_SIZE);
    if around.elements().iter().any(|element| !element.is_finite()) {
        return Err(too_many_points());
    }
    flattener.loops(&(place * unit.inverse() * around))
}

/// What a group is seen through: all of these.
fn clips(clip: &ClipPath, place: Affine) -> Vec<Vec<Layer>> {
    let mut all = match clip.clip_path() {
        Some(outer) => clips(outer, place),
        None => Vec::new(),
    };
    let place = place * affine(clip.transform());
    // What is only seen through does not count as painted.
    let mut aside = Painted {
        layers: Vec::new(),
        bounds: None,
        fills: 0,
        strokes: 0,
        widest: 0.0,
        effects: 0,
    };
    all.push(aside.within(clip.root(), place));
    all
}

fn pen(stroke: &usvg::Stroke) -> Stroke {
    let cap = match stroke.linecap() {
        LineCap::Butt => Cap::Butt,
        LineCap::Round => Cap::Round,
        LineCap::Square => Cap::Square,
    };
    let join = match stroke.linejoin() {
        LineJoin::Miter | LineJoin::MiterClip => Join::Miter,
        LineJoin::Round => Join::Round,
        LineJoin::Bevel => Join::Bevel,
    };
    let pen = Stroke::new(short(stroke.width().get()))
        .with_caps(cap)
        .with_join(join)
        .with_miter_limit(short(stroke.miterlimit().get()));
    match stroke.dasharray() {
        Some(dashes) if dashes.iter().sum::<f32>() > 0.0 => pen.with_dashes(
            short(stroke.dashoffset()),
            dashes.iter().copied().map(short).collect::<Vec<f64>>(),
        ),
        _ => pen,
    }
}

fn curve(path: &usvg::tiny_skia_path::Path) -> BezPath {
    let at = |p: usvg::tiny_skia_path::Point| Point::new(short(p.x), short(p.y));
    let mut curve = BezPath::new();
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(a) => curve.move_to(at(a)),
            PathSegment::LineTo(a) => curve.line_to(at(a)),
            PathSegment::QuadTo(a, b) => curve.quad_to(at(a), at(b)),
            PathSegment::CubicTo(a, b, c) => curve.curve_to(at(a), at(b), at(c)),
            PathSegment::Close => curve.close_path(),
        }
    }
    curve
}

fn affine(by: usvg::Transform) -> Affine {
    Affine::new([by.sx, by.ky, by.kx, by.sy, by.tx, by.ty].map(short))
}

/// The shortest decimal that a number of 24 bits can have come from, which is what stands in the file.
fn short(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(f64::from(x))
}
