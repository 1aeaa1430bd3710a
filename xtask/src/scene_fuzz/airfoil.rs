//! NACA sections, by the textbook formula.

use std::f64::consts::PI;

/// Section `digits` of chord 1 with a closed trailing edge, from there over the upper side and back, `half` steps for
/// each side; the first point is not repeated.
pub(super) fn section(digits: &str, half: usize) -> Vec<[f64; 2]> {
    let number: u32 = digits.parse().unwrap_or(12);
    let (m, p, t) = (
        f64::from(number / 1000) / 100.0,
        f64::from(number / 100 % 10) / 10.0,
        f64::from(number % 100) / 100.0,
    );
    let side = |x: f64, up: f64| {
        let half = 5.0
            * t
            * (0.2969 * x.sqrt() - 0.1260 * x - 0.3516 * x * x + 0.2843 * x.powi(3)
                - 0.1036 * x.powi(4));
        let (camber, slope) = if m == 0.0 {
            (0.0, 0.0)
        } else if x < p {
            let c = m / (p * p);
            (c * (2.0 * p * x - x * x), 2.0 * c * (p - x))
        } else {
            let c = m / ((1.0 - p) * (1.0 - p));
            (c * (1.0 - 2.0 * p + 2.0 * p * x - x * x), 2.0 * c * (p - x))
        };
        let angle = slope.atan();
        [
            x - up * half * angle.sin(),
            camber + up * half * angle.cos(),
        ]
    };
    let x = |k: usize| 0.5 * (1.0 + (PI * k as f64 / half as f64).cos());
    let mut points = vec![[1.0, 0.0]];
    points.extend((1..half).map(|k| side(x(k), 1.0)));
    points.push([0.0, 0.0]);
    points.extend((1..half).rev().map(|k| side(x(k), -1.0)));
    points
}
