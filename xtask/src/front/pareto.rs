//! Which of many is best at some price.

/// The points that no other beats in both coordinates, from the left: the less the better. What is not finite takes no part; of
/// points that coincide one is taken.
pub(super) fn front(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len())
        .filter(|&i| points[i].iter().all(|x| x.is_finite()))
        .collect();
    order.sort_by(|&i, &j| {
        let by = |k: usize| points[i][k].total_cmp(&points[j][k]);
        by(0).then(by(1))
    });
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let is_better = points[i][1] < least;
        least = least.min(points[i][1]);
        is_better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_nothing_beats_is_on_the_front() {
        let points = [
            [3.0, 1.0],
            [1.0, 3.0],
            [2.0, 2.0],
            // Beaten: in both, in one with the other equal, by coinciding.
            [2.5, 2.5],
            [2.0, 2.1],
            [3.5, 1.0],
            [1.0, 3.0],
            // No numbers.
            [0.5, f64::NAN],
            [f64::INFINITY, 0.5],
        ];
        assert_eq!(front(&points), [1, 2, 0]);
        assert_eq!(front(&[]), [0; 0]);
        assert_eq!(front(&[[1.0, 1.0]]), [0]);
    }

    /// Whatever the order of the points.
    #[test]
    fn everything_else_is_beaten() {
        let points: Vec<[f64; 2]> = (1..=90_u32)
            .map(|i| [f64::from(i * 37 % 101), f64::from(i * 53 % 97)])
            .collect();
        let front = front(&points);
        assert!(front.len() > 2, "{front:?}");
        let beats = |a: [f64; 2], b: [f64; 2]| a[0] <= b[0] && a[1] <= b[1] && a != b;
        for (i, &point) in points.iter().enumerate() {
            let is_beaten = points.iter().any(|&other| beats(other, point));
            let is_on = front.iter().any(|&k| points[k] == point);
            assert_eq!(is_beaten, !is_on, "{i}: {point:?}");
        }
    }
}
