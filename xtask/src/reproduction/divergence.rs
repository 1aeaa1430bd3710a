//! Surface particles found by the divergence of positions, ∇·r < d − 0.625, as the paper on moving bodies (003) finds those of its airfoils.

use sphpack::Solution;
use sphpack_packing::Kind;

/// How far the divergence falls short of d at the surface.
const SHORT: f64 = 0.625;

/// How many surface particles are not found, and how many others are, over the number of surface particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Found {
    pub(crate) missed: f64,
    pub(crate) false_ones: f64,
}

/// Of the solid particles of a packing in the plane; `None` where there are none on a surface.
pub(crate) fn found(solution: &Solution<2>) -> Option<Found> {
    let particles = &solution.packed.particles;
    let solid: Vec<usize> = (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen && solution.labels.body[i].is_some())
        .collect();
    let places: Vec<[f64; 2]> = solid.iter().map(|&i| particles.position[i]).collect();
    let volumes: Vec<f64> = solid.iter().map(|&i| particles.volume[i]).collect();
    let is_on_surface: Vec<bool> = (solid.iter())
        .map(|&i| particles.kind[i].is_on_surface())
        .collect();
    let h = solution.problem.smoothing_length();
    told(&divergences(&places, &volumes, h), &is_on_surface)
}

fn told(divergence: &[f64], is_on_surface: &[bool]) -> Option<Found> {
    let count = |found: bool, on_surface: bool| {
        let is = |(value, on): &(&f64, &bool)| (**value < 2.0 - SHORT, **on) == (found, on_surface);
        divergence.iter().zip(is_on_surface).filter(is).count() as f64
    };
    let (missed, false_ones) = (count(false, true), count(true, false));
    let all = missed + count(true, true);
    (all > 0.0).then(|| Found {
        missed: missed / all,
        false_ones: false_ones / all,
    })
}

/// ∇·r_i = Σ_j V_j (r_j − r_i)·∇W_ij over all pairs, by the quintic kernel as it is printed: its slope is written out here so that no loop
/// or kernel of ours is trusted.
fn divergences(places: &[[f64; 2]], volumes: &[f64], h: f64) -> Vec<f64> {
    let sigma = 7.0 / (478.0 * std::f64::consts::PI * h * h);
    let slope = |q: f64| {
        let part = |reach: f64| (reach - q).max(0.0).powi(4);
        -5.0 * sigma * (part(3.0) - 6.0 * part(2.0) + 15.0 * part(1.0))
    };
    let of = |p: &[f64; 2]| -> f64 {
        (places.iter().zip(volumes))
            .filter_map(|(q, volume)| {
                let [x, y] = [q[0] - p[0], q[1] - p[1]];
                let square = x * x + y * y;
                // (r_j − r_i)·∇W = −r dW/dr.
                (square < 9.0 * h * h).then(|| {
                    let q = square.sqrt() / h;
                    -volume * q * slope(q)
                })
            })
            .sum()
    };
    places.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of a square lattice: d deep within, less at its sides; of the rule exactly its outermost layer is found.
    #[test]
    fn a_lattice_shows_its_outermost_layer() {
        let n = 16;
        let places: Vec<[f64; 2]> = (0..n * n)
            .map(|i| [f64::from(i % n), f64::from(i / n)])
            .collect();
        let divergence = divergences(&places, &vec![1.0; places.len()], 1.2);
        let middle = divergence[(n / 2 * n + n / 2) as usize];
        assert!((middle - 2.0).abs() < 0.02, "{middle}");
        let on_side: Vec<bool> = (0..n * n)
            .map(|i| [i % n, i / n].iter().any(|&k| k == 0 || k == n - 1))
            .collect();
        let expected = Found {
            missed: 0.0,
            false_ones: 0.0,
        };
        assert_eq!(told(&divergence, &on_side), Some(expected));
    }

    #[test]
    fn missed_and_false_ones_are_counted() {
        let found = told(&[1.0, 1.0, 2.0, 2.0], &[true, false, true, false]);
        assert_eq!(
            found,
            Some(Found {
                missed: 0.5,
                false_ones: 0.5
            })
        );
        assert_eq!(told(&[1.0], &[false]), None);
    }
}
