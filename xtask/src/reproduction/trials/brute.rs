//! Densities over all pairs, by the quintic kernel as Negi & Ramachandran (2021), eq. 14 print it.
//!
//! Slow and plain on purpose: it judges what the library's lists, vectors and kernels have done.

use std::f64::consts::PI;

/// W at distance `r`, in `D` dimensions.
pub(super) fn quintic<const D: usize>(r: f64, h: f64) -> f64 {
    let part = |reach: f64| (reach - r / h).max(0.0).powi(5);
    sigma::<D>(h) * (part(3.0) - 6.0 * part(2.0) + 15.0 * part(1.0))
}

fn sigma<const D: usize>(h: f64) -> f64 {
    match D {
        2 => 7.0 / (478.0 * PI * h * h),
        _ => 1.0 / (120.0 * PI * h * h * h),
    }
}

/// Γ of every particle in a periodic box of these edges, of which all have the same volume.
pub(super) fn periodic_gamma<const D: usize>(
    positions: &[[f64; D]],
    edges: [f64; D],
    h: f64,
) -> Vec<f64> {
    let volume = edges.iter().product::<f64>() / positions.len() as f64;
    let of = |p: &[f64; D]| {
        let all = positions.iter().map(|q| {
            let square: f64 = (0..D).map(|k| nearest(p[k] - q[k], edges[k]).powi(2)).sum();
            quintic::<D>(square.sqrt(), h)
        });
        volume * all.sum::<f64>()
    };
    positions.iter().map(of).collect()
}

/// Γ of the first `targets` particles, of which all have the same volume.
pub(super) fn gamma<const D: usize>(
    positions: &[[f64; D]],
    targets: usize,
    volume: f64,
    h: f64,
) -> Vec<f64> {
    let of = |p: &[f64; D]| {
        let all = positions.iter().map(|q| {
            let square: f64 = (0..D).map(|k| (p[k] - q[k]).powi(2)).sum();
            quintic::<D>(square.sqrt(), h)
        });
        volume * all.sum::<f64>()
    };
    positions.iter().take(targets).map(of).collect()
}

/// dW/dr at distance `r`.
pub(super) fn quintic_slope<const D: usize>(r: f64, h: f64) -> f64 {
    let part = |reach: f64| (reach - r / h).max(0.0).powi(4);
    -5.0 / h * sigma::<D>(h) * (part(3.0) - 6.0 * part(2.0) + 15.0 * part(1.0))
}

/// ∇Γ of the particles `targets`, summed over all.
pub(super) fn gradients<const D: usize>(
    positions: &[[f64; D]],
    volumes: &[f64],
    targets: &[usize],
    h: f64,
) -> Vec<[f64; D]> {
    let of = |&i: &usize| {
        let mut sum = [0.0; D];
        for (q, volume) in positions.iter().zip(volumes) {
            let way: [f64; D] = std::array::from_fn(|k| positions[i][k] - q[k]);
            let r = way.iter().map(|x| x * x).sum::<f64>().sqrt();
            if r > 0.0 && r < 3.0 * h {
                let slope = volume * quintic_slope::<D>(r, h) / r;
                for k in 0..D {
                    sum[k] += slope * way[k];
                }
            }
        }
        sum
    };
    targets.iter().map(of).collect()
}

/// The shortest way between images.
pub(super) fn nearest(way: f64, edge: f64) -> f64 {
    way - edge * (way / edge).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernel's integral over its support is 1, by the midpoint rule.
    #[test]
    fn the_kernel_is_normalised() {
        let steps = 20_000;
        let dr = 3.0 / f64::from(steps);
        let (mut plane, mut space) = (0.0, 0.0);
        for i in 0..steps {
            let r = (f64::from(i) + 0.5) * dr;
            plane += 2.0 * PI * r * quintic::<2>(r, 1.0) * dr;
            space += 4.0 * PI * r * r * quintic::<3>(r, 1.0) * dr;
        }
        assert!((plane - 1.0).abs() < 1e-7, "{plane}");
        assert!((space - 1.0).abs() < 1e-7, "{space}");
    }

    #[test]
    fn the_slope_is_that_of_the_kernel() {
        for r in [0.3, 1.1, 2.4, 3.5] {
            let step = 1e-5;
            let [low, high] = [r - step, r + step].map(|r| quintic::<2>(r, 1.2));
            let slope = quintic_slope::<2>(r, 1.2);
            assert!(
                (slope - 0.5 * (high - low) / step).abs() < 1e-8,
                "{r}: {slope}"
            );
        }
    }

    /// A pair pushes each other apart along the way between them, the nearer the heavier the other.
    #[test]
    fn a_pair_has_opposite_gradients() {
        let places = [[0.0, 0.0], [0.6, 0.8]];
        let found = gradients(&places, &[1.0, 2.0], &[0, 1], 1.0);
        let slope = quintic_slope::<2>(1.0, 1.0);
        assert!((found[0][0] + 2.0 * slope * 0.6).abs() < 1e-15, "{found:?}");
        assert!((found[1][1] - slope * 0.8).abs() < 1e-15, "{found:?}");
    }

    #[test]
    fn a_square_lattice_is_even_and_sees_its_images() {
        let sites: Vec<[f64; 2]> = (0..100)
            .map(|i| [f64::from(i % 10), f64::from(i / 10)])
            .collect();
        let gamma = periodic_gamma(&sites, [10.0; 2], 1.2);
        for value in &gamma {
            assert!((value - gamma[0]).abs() < 1e-12, "{value}");
            assert!((value - 1.0).abs() < 0.01, "{value}");
        }
    }
}
