//! One panel of a scene's sheet: points over two logarithmic axes, and what is best among them.

use std::fmt::Write as _;

use super::labels::{NAME, placed};
use super::pareto::front;
use crate::axes::{Axis, Frame, Scale};
use crate::drawing;
use crate::power_law::PowerLaw;

/// Size of a panel, and the room around its axes: left, right, top, bottom.
pub(super) const SIZE: [f64; 2] = [480.0, 340.0];
const ROOM: [f64; 4] = [66.0, 28.0, 12.0, 48.0];

/// What is so much better than the best that may be on the front would press all else together, and is not drawn: a clipped lattice
/// is at rest to rounding.
const FAR_BELOW: f64 = 1e-2;

/// A point, and how it is drawn.
#[derive(Debug, Clone)]
pub(super) struct Dot {
    pub(super) name: String,
    pub(super) at: [f64; 2],
    /// Its number among the shapes.
    pub(super) shape: usize,
    /// Whether it may be on the front.
    pub(super) is_candidate: bool,
}

/// What is drawn.
pub(super) struct Panel {
    pub(super) titles: [&'static str; 2],
    pub(super) dots: Vec<Dot>,
    /// Through all points, in place of a front.
    pub(super) law: Option<PowerLaw>,
}

/// The dots that nothing else beats among those that may be there.
pub(super) fn best(dots: &[Dot]) -> Vec<usize> {
    let places: Vec<[f64; 2]> = (dots.iter())
        .map(|dot| {
            if dot.is_candidate {
                dot.at
            } else {
                [f64::NAN; 2]
            }
        })
        .collect();
    front(&places)
}

impl Panel {
    /// Draws it with its upper left corner at `corner`; shapes are defined elsewhere, by the name of the scene and their number.
    pub(super) fn draw(&self, out: &mut String, corner: [f64; 2], scene: &str) {
        let [left, right, top, bottom] = ROOM;
        let (left, top) = (corner[0] + left, corner[1] + top);
        let (end, floor) = (corner[0] + SIZE[0] - right, corner[1] + SIZE[1] - bottom);
        let axes = self.titles.map(|title| Axis {
            title,
            scale: Scale::Logarithmic,
        });
        let least = (self.dots.iter().filter(|dot| dot.is_candidate))
            .map(|dot| dot.at[1])
            .fold(f64::INFINITY, f64::min);
        let is_drawable = |at: [f64; 2]| {
            at.iter().all(|v| *v > 0.0 && v.is_finite())
                && (at[1] >= FAR_BELOW * least || !least.is_finite())
        };
        let drawn: Vec<[f64; 2]> = (self.dots.iter())
            .map(|dot| dot.at)
            .filter(|&at| is_drawable(at))
            .collect();
        let frame = Frame::new(&axes, [left, top, end, floor], &drawn);
        frame.draw(out);
        let places: Vec<Option<[f64; 2]>> = (self.dots.iter())
            .map(|dot| is_drawable(dot.at).then(|| frame.at(dot.at)))
            .collect();
        let named: Vec<usize> = match &self.law {
            Some(law) => {
                let at = |value: f64| frame.at([value, law.at(value)]);
                let all = drawn.iter().map(|at| at[0]);
                let few = all.clone().fold(f64::INFINITY, f64::min);
                let many = all.fold(0.0, f64::max);
                line(out, &[at(few), at(many)]);
                (0..self.dots.len()).collect()
            }
            None => {
                let best = best(&self.dots);
                let way: Vec<[f64; 2]> = best.iter().filter_map(|&i| places[i]).collect();
                line(out, &way);
                best
            }
        };
        // The settings of the default first: methods lie on top of them.
        let mut order: Vec<usize> = (0..self.dots.len()).collect();
        order.sort_by_key(|&i| self.dots[i].shape);
        for i in order {
            if let Some([x, y]) = places[i] {
                let shape = self.dots[i].shape;
                let _ = writeln!(
                    out,
                    "<use href=\"#{scene}{shape}\" x=\"{x:.1}\" y=\"{y:.1}\"/>"
                );
            }
        }
        let names: Vec<(&str, [f64; 2])> = (named.iter())
            .filter_map(|&i| Some((self.dots[i].name.as_str(), places[i]?)))
            .collect();
        let marks: Vec<[f64; 2]> = places.iter().copied().flatten().collect();
        let labels = placed(&names, &marks, [left, top, end, floor]);
        for ((name, point), label) in names.iter().zip(labels) {
            if let Some([x, y]) = label.leader {
                let _ = writeln!(
                    out,
                    "<path d=\"M{:.1} {:.1}L{x:.1} {y:.1}\" stroke=\"#999\" stroke-width=\".6\"/>",
                    point[0], point[1]
                );
            }
            drawing::rimmed(out, label.at, NAME, name);
        }
    }
}

fn line(out: &mut String, way: &[[f64; 2]]) {
    let way: Vec<String> = (way.iter())
        .map(|[x, y]| format!("{x:.1} {y:.1}"))
        .collect();
    if way.len() > 1 {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<path d=\"M{}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.2\"/>",
            way.join("L")
        );
    }
}
