//! How one figure grows with another.

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;

/// y = c x^exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PowerLaw {
    pub(crate) exponent: f64,
    /// Of the exponent, as the points scatter about the line.
    pub(crate) standard_error: f64,
    /// c.
    pub(crate) factor: f64,
}

impl PowerLaw {
    /// The law through points by least squares of their logarithms, by a QR factorisation; `None` for fewer than three points, of
    /// which nobody knows how well they fit, for some that are not positive and finite, and where all have one x.
    pub(crate) fn through(points: &[[f64; 2]]) -> Option<Self> {
        let is_sound = |p: &[f64; 2]| p.iter().all(|x| *x > 0.0 && x.is_finite());
        if points.len() < 3 || !points.iter().all(is_sound) {
            return None;
        }
        let n = points.len();
        let logarithm = |i: usize, k: usize| points[i][k].ln();
        let middle = (0..n).map(|i| logarithm(i, 0)).sum::<f64>() / n as f64;
        let spread: f64 = (0..n).map(|i| (logarithm(i, 0) - middle).powi(2)).sum();
        // Rounding alone leaves about as much.
        if spread < 1e-20 {
            return None;
        }
        let lines = Mat::from_fn(n, 2, |i, k| {
            if k == 0 {
                1.0
            } else {
                logarithm(i, 0) - middle
            }
        });
        let values = Mat::from_fn(n, 1, |i, _| logarithm(i, 1));
        let found = lines.qr().solve_lstsq(&values);
        let (height, exponent) = (found[(0, 0)], found[(1, 0)]);
        let left: f64 = (0..n)
            .map(|i| (logarithm(i, 1) - height - exponent * (logarithm(i, 0) - middle)).powi(2))
            .sum();
        Some(Self {
            exponent,
            standard_error: (left / (n - 2) as f64 / spread).sqrt(),
            factor: (height - exponent * middle).exp(),
        })
    }

    /// y at x.
    pub(crate) fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_exact_power_law_comes_back() {
        let points = [1.0, 3.0, 10.0, 77.0].map(|x: f64| [x, 0.25 * x.powf(1.5)]);
        let law = PowerLaw::through(&points).unwrap();
        assert!((law.exponent - 1.5).abs() < 1e-12, "{law:?}");
        assert!((law.factor - 0.25).abs() < 1e-12, "{law:?}");
        assert!(law.standard_error < 1e-12, "{law:?}");
        assert!((law.at(4.0) - 2.0).abs() < 1e-11);
    }

    /// ln y = 0, 1, 0 at ln x = −1, 0, 1: slope 0, squares left ⅔, so √(⅔ / 1 / 2) is its error.
    #[test]
    fn the_error_is_that_of_the_textbook() {
        let e = std::f64::consts::E;
        let law = PowerLaw::through(&[[1.0 / e, 1.0], [1.0, e], [e, 1.0]]).unwrap();
        assert!(law.exponent.abs() < 1e-12, "{law:?}");
        let expected = (1.0_f64 / 3.0).sqrt();
        assert!((law.standard_error - expected).abs() < 1e-12, "{law:?}");
    }

    #[test]
    fn what_has_no_law_has_none() {
        assert_eq!(PowerLaw::through(&[[1.0, 1.0], [2.0, 2.0]]), None);
        assert_eq!(
            PowerLaw::through(&[[2.0, 1.0], [2.0, 2.0], [2.0, 3.0]]),
            None
        );
        assert_eq!(
            PowerLaw::through(&[[1.0, 1.0], [2.0, 0.0], [3.0, 1.0]]),
            None
        );
        assert_eq!(
            PowerLaw::through(&[[1.0, 1.0], [2.0, 2.0], [3.0, f64::NAN]]),
            None
        );
    }
}
