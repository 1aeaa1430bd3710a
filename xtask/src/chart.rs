//! Charts as SVG: points or lines over two axes.

use std::fmt::Write as _;

use sphpack::picture::text_width;

use crate::axes::Frame;
pub(crate) use crate::axes::{Axis, Scale};
use crate::drawing::{self, CIRCLE, DIAMOND, DOWN, SQUARE, UP};

/// A curve or a cloud of points, and its name in the legend.
pub(crate) struct Series {
    pub(crate) name: String,
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) joined: bool,
}

impl Series {
    /// A curve.
    pub(crate) fn curve(name: &str, points: Vec<[f64; 2]>) -> Self {
        Self {
            name: name.to_owned(),
            points,
            joined: true,
        }
    }
}

/// A chart.
pub(crate) struct Chart {
    pub(crate) title: &'static str,
    pub(crate) axes: [Axis; 2],
    pub(crate) series: Vec<Series>,
}

/// Size of the drawing and the room around the axes: left, right (with the legend), top, bottom.
const SIZE: [f64; 2] = [820.0, 480.0];
const ROOM: [f64; 4] = [78.0, 170.0, 40.0, 56.0];

/// Told apart also by who does not see red or green (Okabe and Ito's palette), in print by their marks; then with hollow ones.
const COLOURS: [&str; 7] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555",
];

const MARKS: [&str; 5] = [CIRCLE, SQUARE, UP, DIAMOND, DOWN];

impl Chart {
    /// The numbers, a line each: series, x, y.
    pub(crate) fn csv(&self) -> String {
        let mut out = format!("series,{},{}\n", self.axes[0].title, self.axes[1].title);
        for series in &self.series {
            for [x, y] in &series.points {
                // Writing to a string cannot fail.
                let _ = writeln!(out, "\"{}\",{x},{y}", series.name);
            }
        }
        out
    }

    /// The drawing. What is not finite, or not positive on a logarithmic axis, is left out.
    pub(crate) fn svg(&self) -> String {
        let [left, right, top, bottom] = ROOM;
        let [width, height] = SIZE;
        let names = self.series.iter().map(|s| text_width(&s.name, 13.0));
        let right = right.max(36.0 + names.fold(0.0, f64::max));
        let points: Vec<[f64; 2]> = (self.series.iter())
            .flat_map(|series| series.points.iter().copied())
            .collect();
        let (end, floor) = (width - right, height - bottom);
        let frame = Frame::new(&self.axes, [left, top, end, floor], &points);
        let mut out = drawing::begin(width, height);
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<text x=\"{left}\" y=\"24\" font-size=\"16\">{}</text>",
            self.title
        );
        frame.draw(&mut out);
        for (i, series) in self.series.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            let fill = if i < COLOURS.len() { colour } else { "white" };
            let mark = MARKS[i % MARKS.len()];
            let places: Vec<[f64; 2]> = (series.points.iter())
                .map(|&point| frame.at(point))
                .filter(|p| p.iter().all(|v| v.is_finite()))
                .collect();
            if series.joined {
                let way: Vec<String> = places
                    .iter()
                    .map(|p| format!("{:.1} {:.1}", p[0], p[1]))
                    .collect();
                let _ = writeln!(
                    out,
                    "<path d=\"M{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>",
                    way.join("L")
                );
            }
            let legend = [end + 16.0, top + 10.0 + 22.0 * i as f64];
            let marks = if series.joined {
                apart(&places)
            } else {
                places
            };
            for p in marks.iter().chain([&legend]) {
                let _ = writeln!(
                    out,
                    "<path transform=\"translate({:.1} {:.1})\" d=\"{mark}\" fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>",
                    p[0], p[1]
                );
            }
            let _ = writeln!(
                out,
                "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                legend[0] + 12.0,
                legend[1] + 4.5,
                series.name
            );
        }
        out.push_str("</svg>\n");
        out
    }
}

/// Of places along a curve those that are so far from the one before, pixels, that marks do not hide the curve.
fn apart(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    const STEP: f64 = 10.0;
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for &[x, y] in places {
        if kept
            .last()
            .is_none_or(|p| (x - p[0]).hypot(y - p[1]) >= STEP)
        {
            kept.push([x, y]);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(points: Vec<[f64; 2]>, joined: bool) -> String {
        let axis = |title| Axis {
            title,
            scale: Scale::Linear,
        };
        let name = "a name that is longer than the room for it".to_owned();
        Chart {
            title: "title",
            axes: [axis("x"), axis("y")],
            series: vec![Series {
                name,
                points,
                joined,
            }],
        }
        .svg()
    }

    #[test]
    fn legends_end_on_the_sheet() {
        let svg = chart(vec![[0.0, 1.0]], false);
        let document = roxmltree::Document::parse(&svg).unwrap();
        let legend = document.descendants().find(|node| {
            node.text()
                .is_some_and(|text| text.starts_with("a name that"))
        });
        let legend = legend.unwrap();
        let at: f64 = legend.attribute("x").unwrap().parse().unwrap();
        assert!(at + text_width(legend.text().unwrap(), 13.0) <= SIZE[0]);
    }

    #[test]
    fn marks_of_a_curve_stand_apart() {
        let points: Vec<[f64; 2]> = (0..=1000).map(|k| [f64::from(k), 0.0]).collect();
        let count = |joined| chart(points.clone(), joined).matches(CIRCLE).count();
        assert_eq!(count(false), 1001 + 1);
        assert!((10..60).contains(&count(true)), "{}", count(true));
    }
}
