//! Charts as SVG: points or lines over two axes.

use std::fmt::Write as _;

/// A curve or a cloud of points, and its name in the legend.
pub(crate) struct Series {
    pub(crate) name: String,
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) joined: bool,
}

/// How numbers become places on an axis.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Scale {
    Linear,
    Logarithmic,
}

/// An axis: its title, its scale.
pub(crate) struct Axis {
    pub(crate) title: &'static str,
    pub(crate) scale: Scale,
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

/// Told apart also by who does not see red or green (Okabe and Ito's palette), then with hollow marks.
const COLOURS: [&str; 7] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555",
];

impl Axis {
    /// The numbers that the axis spans, ends at ticks.
    pub(crate) fn span(&self, values: impl Iterator<Item = f64>) -> ([f64; 2], Vec<f64>) {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|v| v.is_finite() && (*v > 0.0 || self.scale == Scale::Linear)) {
            low = low.min(value);
            high = high.max(value);
        }
        if low > high {
            (low, high) = (1.0, 10.0);
        }
        match self.scale {
            Scale::Logarithmic => {
                let (from, to) = (low.log10().floor(), high.log10().ceil());
                let to = to.max(from + 1.0);
                let ticks = (from as i32..=to as i32).map(|e| 10.0_f64.powi(e));
                ([10.0_f64.powf(from), 10.0_f64.powf(to)], ticks.collect())
            }
            Scale::Linear => {
                let rough = ((high - low) / 5.0).max(1e-12);
                let power = 10.0_f64.powf(rough.log10().floor());
                let step = power
                    * [1.0, 2.0, 5.0, 10.0]
                        .into_iter()
                        .find(|s| s * power >= rough)
                        .unwrap_or(10.0);
                let (from, to) = ((low / step).floor(), (high / step).ceil());
                let ticks = (from as i64..=to as i64).map(|i| i as f64 * step);
                ([from * step, to.max(from + 1.0) * step], ticks.collect())
            }
        }
    }

    /// How far along the axis a number is, 0 … 1.
    pub(crate) fn part(&self, value: f64, [from, to]: [f64; 2]) -> f64 {
        match self.scale {
            Scale::Linear => (value - from) / (to - from),
            Scale::Logarithmic => (value / from).ln() / (to / from).ln(),
        }
    }
}

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
        let all = |k: usize| {
            self.series
                .iter()
                .flat_map(move |s| s.points.iter().map(move |p| p[k]))
        };
        let [(xs, x_ticks), (ys, y_ticks)] = [0, 1].map(|k| self.axes[k].span(all(k)));
        let x = |value: f64| left + (width - left - right) * self.axes[0].part(value, xs);
        let y =
            |value: f64| height - bottom - (height - top - bottom) * self.axes[1].part(value, ys);
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"13\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n\
             <text x=\"{left}\" y=\"24\" font-size=\"16\">{}</text>\n",
            self.title
        );
        let (end, floor) = (width - right, height - bottom);
        // Writing to a string cannot fail.
        for tick in x_ticks {
            let at = x(tick);
            let _ = writeln!(
                out,
                "<path d=\"M{at:.1} {top}V{floor}\" stroke=\"#ddd\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                floor + 18.0,
                number(tick)
            );
        }
        for tick in y_ticks {
            let at = y(tick);
            let _ = writeln!(
                out,
                "<path d=\"M{left} {at:.1}H{end}\" stroke=\"#ddd\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                left - 8.0,
                at + 4.0,
                number(tick)
            );
        }
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate(20 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            0.5 * (left + end),
            height - 14.0,
            self.axes[0].title,
            0.5 * (top + floor),
            self.axes[1].title
        );
        for (i, series) in self.series.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            let fill = if i < COLOURS.len() { colour } else { "white" };
            let places: Vec<[f64; 2]> = (series.points.iter())
                .map(|p| [x(p[0]), y(p[1])])
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
            for p in places.iter().chain([&legend]) {
                let _ = writeln!(
                    out,
                    "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"4.5\" fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>",
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

/// A tick's number.
pub(crate) fn number(value: f64) -> String {
    if value != 0.0 && (value.abs() < 1e-2 || value.abs() >= 1e5) {
        format!("{value:.0e}")
    } else {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}
