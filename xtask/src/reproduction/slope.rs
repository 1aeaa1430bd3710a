//! The slope of a line through points in logarithms, and how sure it is.

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;

/// y grows as x to this power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slope {
    pub(crate) slope: f64,
    /// By the spread of the points about the line.
    pub(crate) standard_error: f64,
}

/// Least squares in logarithms, by a QR factorisation; `None` for fewer than three points, for some that are not positive and
/// finite, and where all have one x.
pub(crate) fn slope(points: &[[f64; 2]]) -> Option<Slope> {
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
    let (height, slope) = (found[(0, 0)], found[(1, 0)]);
    let left: f64 = (0..n)
        .map(|i| (logarithm(i, 1) - height - slope * (logarithm(i, 0) - middle)).powi(2))
        .sum();
    Some(Slope {
        slope,
        standard_error: (left / (n - 2) as f64 / spread).sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_power_and_no_error() {
        let points = [0.1, 0.05, 0.02, 0.01].map(|x: f64| [x, 3.0 * x.powf(2.5)]);
        let found = slope(&points).unwrap();
        assert!((found.slope - 2.5).abs() < 1e-12, "{found:?}");
        assert!(found.standard_error < 1e-12, "{found:?}");
    }

    /// ln y = 0, 1, 0 at ln x = 0, 1, 2: a level line through 1/3, and √(2/3 / 1 / 2).
    #[test]
    fn the_error_is_that_of_the_textbook() {
        let e = std::f64::consts::E;
        let found = slope(&[[1.0, 1.0], [e, e], [e * e, 1.0]]).unwrap();
        assert!(found.slope.abs() < 1e-12, "{found:?}");
        let error = (2.0_f64 / 3.0 / 2.0).sqrt();
        assert!((found.standard_error - error).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn what_has_no_slope_has_none() {
        assert_eq!(slope(&[[1.0, 1.0], [2.0, 2.0]]), None);
        assert_eq!(slope(&[[1.0, 1.0], [2.0, 0.0], [3.0, 1.0]]), None);
        assert_eq!(slope(&[[2.0, 1.0], [2.0, 2.0], [2.0, 3.0]]), None);
    }
}
