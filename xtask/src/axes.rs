//! Axes of drawings: how numbers become places, and the lines and numbers that say so.

use std::fmt::Write as _;

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

impl Axis {
    /// One with even steps.
    pub(crate) fn linear(title: &'static str) -> Self {
        Self {
            title,
            scale: Scale::Linear,
        }
    }
}

impl Axis {
    /// The numbers that the axis spans, ends at ticks.
    fn span(&self, values: impl Iterator<Item = f64>) -> ([f64; 2], Vec<f64>) {
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
                // What is off a tick by rounding is on it.
                let (from, to) = ((low / step + 1e-9).floor(), (high / step - 1e-9).ceil());
                let ticks = (from as i64..=to as i64).map(|i| i as f64 * step);
                ([from * step, to.max(from + 1.0) * step], ticks.collect())
            }
        }
    }

    /// How far along the axis a number is, 0 … 1.
    fn part(&self, value: f64, [from, to]: [f64; 2]) -> f64 {
        match self.scale {
            Scale::Linear => (value - from) / (to - from),
            Scale::Logarithmic => (value / from).ln() / (to / from).ln(),
        }
    }
}

/// Two axes with room for points between them.
pub(crate) struct Frame<'a> {
    axes: &'a [Axis; 2],
    /// Pixels.
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
    spans: [[f64; 2]; 2],
    ticks: [Vec<f64>; 2],
}

impl<'a> Frame<'a> {
    /// Axes that span these points. `corners` are left, top, right and bottom of the room for them, in pixels.
    pub(crate) fn new(
        axes: &'a [Axis; 2],
        [left, top, right, bottom]: [f64; 4],
        points: &[[f64; 2]],
    ) -> Self {
        let of = |k: usize| axes[k].span(points.iter().map(|point| point[k]));
        let [(across, below), (up, beside)] = [of(0), of(1)];
        Self {
            axes,
            left,
            top,
            right,
            bottom,
            spans: [across, up],
            ticks: [below, beside],
        }
    }

    /// Where a point is drawn.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.left + (self.right - self.left) * self.axes[0].part(x, self.spans[0]),
            self.bottom - (self.bottom - self.top) * self.axes[1].part(y, self.spans[1]),
        ]
    }

    /// Draws lines and numbers at the ticks, and the titles.
    pub(crate) fn draw(&self, out: &mut String) {
        let Self {
            left,
            top,
            right,
            bottom,
            ..
        } = *self;
        // Writing to a string cannot fail.
        for &tick in &self.ticks[0] {
            let [at, _] = self.at([tick, self.spans[1][0]]);
            let _ = writeln!(
                out,
                "<path d=\"M{at:.1} {top:.1}V{bottom:.1}\" stroke=\"#ddd\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                bottom + 17.0,
                number(tick)
            );
        }
        for &tick in &self.ticks[1] {
            let [_, at] = self.at([self.spans[0][0], tick]);
            let _ = writeln!(
                out,
                "<path d=\"M{left:.1} {at:.1}H{right:.1}\" stroke=\"#ddd\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                left - 6.0,
                at + 4.0,
                number(tick)
            );
        }
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate({:.1} {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            0.5 * (left + right),
            bottom + 38.0,
            self.axes[0].title,
            left - 52.0,
            0.5 * (top + bottom),
            self.axes[1].title
        );
    }
}

/// A tick's number.
fn number(value: f64) -> String {
    let text = if value != 0.0 && (value.abs() < 1e-2 || value.abs() >= 1e5) {
        power_of_ten(&format!("{value:.0e}"))
    } else {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    text.replace('-', "−")
}

/// "2e-3" as people write it: 2·10⁻³, and 10⁻³ for "1e-3".
fn power_of_ten(text: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let Some((digit, power)) = text.split_once('e') else {
        return text.to_owned();
    };
    let raised = power.chars().map(|sign| match sign.to_digit(10) {
        Some(digit) => RAISED[digit as usize],
        None => '⁻',
    });
    let power = format!("10{}", raised.collect::<String>());
    match digit {
        "1" => power,
        "-1" => format!("-{power}"),
        _ => format!("{digit}·{power}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes() -> [Axis; 2] {
        [Scale::Linear, Scale::Logarithmic].map(|scale| Axis { title: "x", scale })
    }

    #[test]
    fn numbers_are_as_people_write_them() {
        let written = [0.0, -0.5, 12_000.0, 1e-3, -2e-10, 3e5].map(number);
        assert_eq!(written, ["0", "−0.5", "12000", "10⁻³", "−2·10⁻¹⁰", "3·10⁵"]);
    }

    #[test]
    fn points_lie_within_the_frame_and_ends_at_ticks() {
        let (axes, points) = (axes(), [[-1e-15, 2.0], [4.7, 3e4]]);
        let frame = Frame::new(&axes, [10.0, 20.0, 110.0, 220.0], &points);
        assert_eq!(frame.at([0.0, 1.0]), [10.0, 220.0]);
        assert_eq!(frame.at([5.0, 1e5]), [110.0, 20.0]);
        for point in points {
            let [x, y] = frame.at(point);
            assert!((9.9..=110.0).contains(&x) && (20.0..=220.0).contains(&y));
        }
        let mut out = String::new();
        frame.draw(&mut out);
        for text in [">0<", ">5<", ">1<", ">10⁵<"] {
            assert!(out.contains(text), "{out} lacks {text}");
        }
    }
}
