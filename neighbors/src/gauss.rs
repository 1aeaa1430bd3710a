//! Gauss's rule for integrals, of five points.

/// Places in −1 … 1 and their weights: ∫ f(x) dx over −1 … 1 is Σ weight · f(place), exactly for polynomials of degree nine
/// (Abramowitz and Stegun, Handbook of Mathematical Functions, 1964, table 25.4). Without unit.
pub const FIVE: [(f64, f64); 5] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_up_to_the_ninth_are_exact_and_the_tenth_is_not() {
        for power in 0..=10 {
            let sum: f64 = (FIVE.iter())
                .map(|(x, weight)| weight * x.powi(power))
                .sum();
            let exact = if power % 2 == 0 {
                2.0 / f64::from(power + 1)
            } else {
                0.0
            };
            assert_eq!((sum - exact).abs() < 4e-16, power < 10, "{power}: {sum}");
        }
    }
}
