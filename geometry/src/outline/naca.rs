//! NACA sections of four and five digits, and their modified thickness.
//!
//! # References
//! Ladson, Brooks, Hill, Sproles: Computer Program To Obtain Ordinates for NACA Airfoils, NASA TM-4741, 1996. Thickness
//! is closed at the trailing edge here: 0 where the report has 1 % of it.

use std::f64::consts::{PI, TAU};

use crate::{GeometryError, ParameterError};

/// Mean lines of five digits for a lift coefficient of 0.3: greatest camber at so many twentieths of the chord, where the
/// parts meet, k₁.
const SIMPLE: [(f64, f64, f64); 5] = [
    (1.0, 0.0580, 361.4),
    (2.0, 0.1260, 51.64),
    (3.0, 0.2025, 15.957),
    (4.0, 0.2900, 6.643),
    (5.0, 0.3910, 3.230),
];

/// The same with a reflex, and k₂/k₁.
#[allow(
    clippy::approx_constant,
    reason = "0.3180 is the report's figure, not 1/π"
)]
const REFLEXED: [(f64, f64, f64, f64); 4] = [
    (2.0, 0.1300, 51.990, 0.000_764),
    (3.0, 0.2170, 15.793, 0.006_77),
    (4.0, 0.3180, 6.520, 0.0303),
    (5.0, 0.4410, 3.191, 0.1355),
];

/// Slope at the trailing edge of a modified thickness of 0.2, by the place of the greatest in tenths.
const SLOPES: [(f64, f64); 5] = [
    (2.0, 0.200),
    (3.0, 0.234),
    (4.0, 0.315),
    (5.0, 0.465),
    (6.0, 0.700),
];

/// A section of chord 1.
pub(super) struct NacaSection {
    mean: MeanLine,
    /// Greatest thickness.
    thickness: f64,
    shape: Thickness,
}

/// What the section is bent along.
enum MeanLine {
    Straight,
    /// Two parabolas that meet at the greatest camber.
    Parabolas {
        camber: f64,
        place: f64,
    },
    /// Two cubics that meet at `end`; k₂/k₁ is 0 without a reflex.
    Cubics {
        end: f64,
        k: f64,
        ratio: f64,
    },
}

/// Half the thickness of a section of thickness 0.2.
enum Thickness {
    Plain,
    /// Coefficients of √x, x, x², x³ up to `place`, and of 1 − x, (1 − x)², (1 − x)³ beyond.
    Modified {
        place: f64,
        fore: [f64; 4],
        aft: [f64; 3],
    },
}

impl NacaSection {
    /// The section of a name such as "2412", "23012" or "0012-64".
    pub(super) fn named(name: &str) -> Result<Self, GeometryError> {
        Self::parsed(name).ok_or_else(|| {
            ParameterError::BadNaca {
                digits: name.chars().take(40).collect(),
            }
            .into()
        })
    }

    fn parsed(name: &str) -> Option<Self> {
        let digits = |text: &str| -> Option<Vec<f64>> {
            let one = |c: char| c.to_digit(10).map(f64::from);
            text.chars().map(one).collect()
        };
        let (series, modified) = match name.split_once('-') {
            Some((series, modified)) => (series, Some(modified)),
            None => (name, None),
        };
        let (mean, tens, ones) = match *digits(series)? {
            [m, p, tens, ones] => (MeanLine::of_four(m, p)?, tens, ones),
            [l, p, q, tens, ones] => (MeanLine::of_five(l, p, q)?, tens, ones),
            _ => return None,
        };
        let shape = match modified {
            None => Thickness::Plain,
            Some(modified) => match *digits(modified)? {
                [nose, place] => Thickness::modified(nose, place)?,
                _ => return None,
            },
        };
        let thickness = (10.0 * tens + ones) / 100.0;
        (thickness > 0.0).then_some(Self {
            mean,
            thickness,
            shape,
        })
    }

    /// The outline at `angle`: 0 at the trailing edge, π at the leading edge, 2π at the trailing edge again, upper
    /// side first.
    pub(super) fn at(&self, angle: f64) -> [f64; 2] {
        // s = ±√x makes the nose smooth in the angle.
        let s = (0.5 * angle).cos();
        if angle == 0.0 || angle == TAU {
            return [1.0, 0.0];
        }
        if angle == PI {
            return [0.0, 0.0];
        }
        let x = s * s;
        let half = 5.0 * self.thickness * self.shape.half(s.abs());
        let (height, slope) = self.mean.at(x);
        let length = slope.hypot(1.0);
        let up = if s > 0.0 { half } else { -half };
        [x - up * slope / length, height + up / length]
    }
}

impl MeanLine {
    fn of_four(m: f64, p: f64) -> Option<Self> {
        if m == 0.0 {
            return Some(Self::Straight);
        }
        (p > 0.0).then_some(Self::Parabolas {
            camber: m / 100.0,
            place: p / 10.0,
        })
    }

    fn of_five(l: f64, p: f64, q: f64) -> Option<Self> {
        // The first digit is the lift coefficient in units of 0.15, the tables' is 2.
        let of = |end, k, ratio| Self::Cubics {
            end,
            k: 0.5 * l * k,
            ratio,
        };
        if l == 0.0 {
            None
        } else if q == 0.0 {
            let row = SIMPLE.iter().find(|row| row.0 == p);
            row.map(|&(_, end, k)| of(end, k, 0.0))
        } else if q == 1.0 {
            let row = REFLEXED.iter().find(|row| row.0 == p);
            row.map(|&(_, end, k, ratio)| of(end, k, ratio))
        } else {
            None
        }
    }

    /// Height and slope at `x`.
    fn at(&self, x: f64) -> (f64, f64) {
        match *self {
            Self::Straight => (0.0, 0.0),
            Self::Parabolas { camber, place } => {
                let p = place;
                let part = if x < p {
                    camber / (p * p)
                } else {
                    camber / ((1.0 - p) * (1.0 - p))
                };
                let start = if x < p { 0.0 } else { 1.0 - 2.0 * p };
                (part * (start + 2.0 * p * x - x * x), 2.0 * part * (p - x))
            }
            Self::Cubics { end, k, ratio } if ratio > 0.0 => {
                let (r, rest) = (end.powi(3), ratio * (1.0 - end).powi(3));
                let bend = if x < end { 1.0 } else { ratio };
                let line = r - (rest + r) * x;
                (
                    k / 6.0 * (bend * (x - end).powi(3) + line),
                    k / 6.0 * (3.0 * bend * (x - end).powi(2) - rest - r),
                )
            }
            Self::Cubics { end, k, .. } if x < end => {
                let tangent = end * end * (3.0 - end);
                (
                    k / 6.0 * x * (x * (x - 3.0 * end) + tangent),
                    k / 6.0 * (x * (3.0 * x - 6.0 * end) + tangent),
                )
            }
            Self::Cubics { end, k, .. } => {
                let slope = k / 6.0 * end.powi(3);
                (slope * (1.0 - x), -slope)
            }
        }
    }
}

impl Thickness {
    fn modified(nose: f64, place: f64) -> Option<Self> {
        let &(_, slope) = SLOPES.iter().find(|row| row.0 == place)?;
        // 9 stands for three times the radius of 6.
        let radius = if nose == 9.0 {
            3.0_f64.sqrt()
        } else {
            nose / 6.0
        };
        let (m, rest) = (0.1 * place, 1.0 - 0.1 * place);
        let aft = [
            slope,
            (0.3 - 2.0 * rest * slope) / rest.powi(2),
            (rest * slope - 0.2) / rest.powi(3),
        ];
        // Half the curvature where the parts meet.
        let bend = (0.3 - rest * slope) / rest.powi(2);
        let a = 0.2969 * radius;
        let fore = [
            a,
            0.3 / m - 1.875 * a / m.sqrt() - m * bend,
            -0.3 / m.powi(2) + 1.25 * a / m.powf(1.5) + 2.0 * bend,
            0.1 / m.powi(3) - 0.375 * a / m.powf(2.5) - bend / m,
        ];
        Some(Self::Modified {
            place: m,
            fore,
            aft,
        })
    }

    /// Half the thickness at x, the square of `root`.
    fn half(&self, root: f64) -> f64 {
        let x = root * root;
        match self {
            Self::Plain => {
                root * 0.2969 + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x)))
            }
            Self::Modified { place, fore, .. } if x < *place => {
                root * fore[0] + x * (fore[1] + x * (fore[2] + x * fore[3]))
            }
            Self::Modified { aft, .. } => {
                let rest = 1.0 - x;
                rest * (aft[0] + rest * (aft[1] + rest * aft[2]))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean line at `x` of a name, by the definition that its tables are made for: greatest camber where it should be.
    #[test]
    fn mean_lines_peak_where_the_name_says() {
        for (name, place) in [
            ("21012", 0.05),
            ("22012", 0.10),
            ("23012", 0.15),
            ("24012", 0.20),
            ("25012", 0.25),
            ("22112", 0.10),
            ("23112", 0.15),
            ("24112", 0.20),
            ("25112", 0.25),
            ("2412", 0.4),
        ] {
            let section = NacaSection::named(name).unwrap();
            let peak = (0..=10_000)
                .map(|k| f64::from(k) * 1e-4)
                .max_by(|a, b| section.mean.at(*a).0.total_cmp(&section.mean.at(*b).0))
                .unwrap();
            assert!((peak - place).abs() < 2e-3, "{name}: {peak}");
            for x in [0.01, 0.05, 0.1, 0.3, 0.6, 0.99] {
                let (before, after) = (section.mean.at(x - 1e-6), section.mean.at(x + 1e-6));
                let slope = (after.0 - before.0) / 2e-6;
                assert!((slope - section.mean.at(x).1).abs() < 1e-5, "{name}, {x}");
            }
            assert_eq!(section.mean.at(0.0).0, 0.0);
            assert!(section.mean.at(1.0).0.abs() < 1e-6);
        }
        // Published ordinate of 230's mean line.
        let camber = NacaSection::named("23012").unwrap().mean.at(0.15).0;
        assert!((camber - 0.0184).abs() < 1e-4, "{camber}");
    }

    #[test]
    fn modified_thickness() {
        for nose in 0..=9 {
            for place in 2..=6 {
                let shape = Thickness::modified(f64::from(nose), f64::from(place)).unwrap();
                let m = 0.1 * f64::from(place);
                let at = |x: f64| shape.half(x.sqrt());
                assert!((at(m) - 0.1).abs() < 1e-12 && at(1.0) == 0.0);
                // Value, slope and curvature are those of the other side.
                let e = 1e-3;
                let slope = (at(m + e) - at(m - e)) / (2.0 * e);
                assert!(slope.abs() < 3e-4, "{nose}{place}: {slope}");
                assert!((at(m + e) - at(m - e)).abs() < 1e-6);
            }
        }
        // With the radius and the place of the plain series it is nearly that.
        let (plain, modified) = (Thickness::Plain, Thickness::modified(6.0, 3.0).unwrap());
        for k in 1..100 {
            let root = (0.01 * f64::from(k)).sqrt();
            let off = plain.half(root) - modified.half(root);
            assert!(off.abs() < 2.5e-3, "{k} %: {off}");
        }
    }

    #[test]
    fn names() {
        for name in ["0012", "23012", "23112-45", "0012-64", "6409-92"] {
            assert!(NacaSection::named(name).is_ok(), "{name}");
        }
        for name in [
            "", "012", "0000", "2012", "23200", "03012", "26012", "21112", "23212", "0012-",
            "0012-61", "0012-7", "0012-643", "00a2", "-0012", "0012--64",
        ] {
            assert!(NacaSection::named(name).is_err(), "{name}");
        }
    }
}
