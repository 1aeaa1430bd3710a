//! How one figure grows with another.

/// y = c x^exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Power {
    pub(super) exponent: f64,
    /// Of the exponent, as the points scatter about the line.
    pub(super) standard_error: f64,
    /// c.
    pub(super) factor: f64,
}

impl Power {
    /// The power law through points by least squares of their logarithms; `None` for fewer than three different x, of which nobody
    /// knows how well they fit.
    pub(super) fn through(points: &[[f64; 2]]) -> Option<Self> {
        let logs: Vec<[f64; 2]> = (points.iter())
            .filter(|p| p.iter().all(|x| *x > 0.0 && x.is_finite()))
            .map(|p| p.map(f64::ln))
            .collect();
        if logs.len() < 3 {
            return None;
        }
        let n = logs.len() as f64;
        let mean = [0, 1].map(|k| logs.iter().map(|p| p[k]).sum::<f64>() / n);
        let sum = |of: &dyn Fn([f64; 2]) -> f64| -> f64 {
            (logs.iter())
                .map(|p| of([p[0] - mean[0], p[1] - mean[1]]))
                .sum()
        };
        let square = sum(&|[x, _]| x * x);
        if square <= 0.0 {
            return None;
        }
        let exponent = sum(&|[x, y]| x * y) / square;
        let left = sum(&|[x, y]| (y - exponent * x).powi(2));
        Some(Self {
            exponent,
            standard_error: (left / (n - 2.0) / square).sqrt(),
            factor: (mean[1] - exponent * mean[0]).exp(),
        })
    }

    /// y at x.
    pub(super) fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_exact_power_law_comes_back() {
        let points = [1.0, 3.0, 10.0, 77.0].map(|x: f64| [x, 0.25 * x.powf(1.5)]);
        let law = Power::through(&points).unwrap();
        assert!((law.exponent - 1.5).abs() < 1e-12, "{law:?}");
        assert!((law.factor - 0.25).abs() < 1e-12, "{law:?}");
        assert!(law.standard_error < 1e-12, "{law:?}");
        assert!((law.at(4.0) - 2.0).abs() < 1e-11);
    }

    /// ln y = 0, 1, 0 at ln x = −1, 0, 1: slope 0, squares left ⅔, so √(⅔ / 1 / 2) is its error.
    #[test]
    fn the_error_is_that_of_the_textbook() {
        let e = std::f64::consts::E;
        let law = Power::through(&[[1.0 / e, 1.0], [1.0, e], [e, 1.0]]).unwrap();
        assert!(law.exponent.abs() < 1e-12, "{law:?}");
        let expected = (1.0_f64 / 3.0).sqrt();
        assert!((law.standard_error - expected).abs() < 1e-12, "{law:?}");
    }

    #[test]
    fn too_few_points_have_no_law() {
        assert_eq!(Power::through(&[[1.0, 1.0], [2.0, 2.0]]), None);
        assert_eq!(Power::through(&[[1.0, 1.0], [1.0, 2.0], [1.0, 3.0]]), None);
        assert_eq!(
            Power::through(&[[1.0, 1.0], [2.0, 2.0], [3.0, f64::NAN]]),
            None
        );
    }
}
