//! The kernels by their textbook formulas: nothing of the product's own.

use std::f64::consts::PI;

/// A smoothing kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kernel {
    Cubic,
    Quintic,
    WendlandC2,
    WendlandC4,
    WendlandC6,
}

impl Kernel {
    pub(super) const ALL: [Self; 5] = [
        Self::Cubic,
        Self::Quintic,
        Self::WendlandC2,
        Self::WendlandC4,
        Self::WendlandC6,
    ];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Cubic => "cubic",
            Self::Quintic => "quintic",
            Self::WendlandC2 => "wendland-c2",
            Self::WendlandC4 => "wendland-c4",
            Self::WendlandC6 => "wendland-c6",
        }
    }

    /// How far it reaches, in h.
    pub(super) fn support(self) -> f64 {
        match self {
            Self::Quintic => 3.0,
            _ => 2.0,
        }
    }

    /// W h^D and its slope in q = r/h, without the factor that makes the integral 1.
    fn plain(self, q: f64) -> (f64, f64) {
        let spline = |power: i32, terms: &[(f64, f64)]| {
            terms.iter().fold((0.0, 0.0), |(w, slope), &(c, end)| {
                let t = (end - q).max(0.0);
                (
                    w + c * t.powi(power),
                    slope - c * f64::from(power) * t.powi(power - 1),
                )
            })
        };
        let wendland = |power: i32, p: f64, slope: f64| {
            let t = (1.0 - 0.5 * q).max(0.0);
            (
                t.powi(power) * p,
                t.powi(power) * slope - 0.5 * f64::from(power) * t.powi(power - 1) * p,
            )
        };
        match self {
            Self::Cubic => spline(3, &[(0.25, 2.0), (-1.0, 1.0)]),
            Self::Quintic => spline(5, &[(1.0, 3.0), (-6.0, 2.0), (15.0, 1.0)]),
            Self::WendlandC2 => wendland(4, 1.0 + 2.0 * q, 2.0),
            Self::WendlandC4 => {
                wendland(6, 1.0 + 3.0 * q + 35.0 / 12.0 * q * q, 3.0 + 35.0 / 6.0 * q)
            }
            Self::WendlandC6 => wendland(
                8,
                1.0 + 4.0 * q + 6.25 * q * q + 4.0 * q * q * q,
                4.0 + 12.5 * q + 12.0 * q * q,
            ),
        }
    }

    fn factor(self, dimension: usize) -> f64 {
        let [plane, space] = match self {
            Self::Cubic => [10.0 / 7.0, 1.0],
            Self::Quintic => [7.0 / 478.0, 1.0 / 120.0],
            Self::WendlandC2 => [7.0 / 4.0, 21.0 / 16.0],
            Self::WendlandC4 => [9.0 / 4.0, 495.0 / 256.0],
            Self::WendlandC6 => [39.0 / 14.0, 1365.0 / 512.0],
        };
        if dimension == 2 {
            plane / PI
        } else {
            space / PI
        }
    }

    /// W and dW/dr at distance r.
    pub(super) fn at(self, r: f64, h: f64, dimension: usize) -> (f64, f64) {
        let (w, slope) = self.plain(r / h);
        let factor = self.factor(dimension) / h.powi(dimension as i32);
        (factor * w, factor * slope / h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_are_one_and_slopes_are_slopes() {
        for kernel in Kernel::ALL {
            for dimension in [2, 3] {
                let h = 0.7;
                let steps = 100_000;
                let dr = kernel.support() * h / f64::from(steps);
                let sum: f64 = (0..steps)
                    .map(|k| {
                        let r = (f64::from(k) + 0.5) * dr;
                        let shell = if dimension == 2 {
                            2.0 * PI * r
                        } else {
                            4.0 * PI * r * r
                        };
                        kernel.at(r, h, dimension).0 * shell * dr
                    })
                    .sum();
                assert!((sum - 1.0).abs() < 1e-8, "{kernel:?} {dimension} {sum}");
                for r in [0.1, 0.5, 0.9, 1.3] {
                    let slope = kernel.at(r, h, dimension).1;
                    let [a, b] = [r - 1e-6, r + 1e-6].map(|r| kernel.at(r, h, dimension).0);
                    assert!(((b - a) / 2e-6 - slope).abs() < 1e-6, "{kernel:?} {r}");
                }
            }
        }
    }
}
