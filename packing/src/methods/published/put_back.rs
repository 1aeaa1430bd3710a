//! Particles that came too near to a bound, or passed it, and go back.

/// Where `step`, from `place` on, has nothing more to change; in a corner, where it leads from one bound to the other, where it is
/// after so many `rounds`.
pub(crate) fn put_back<const D: usize>(
    mut place: [f64; D],
    rounds: usize,
    step: impl Fn([f64; D]) -> Option<[f64; D]>,
) -> [f64; D] {
    for _ in 0..rounds {
        match step(place) {
            Some(next) => place = next,
            None => break,
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use sphpack_geometry::{Ball, Closest, Cuboid, Surface};
    use sphpack_neighbors::point;

    use super::put_back;
    use crate::methods::published::fluid_side::{around_body, tightest, within_body};
    use crate::off_bound::off_bound;

    /// A box that holds the fluid, with a disc on its floor: the nook between them is acute.
    fn nook(p: [f64; 2]) -> Closest<2> {
        let tank = Cuboid::new([0.0; 2], [1.0; 2]).unwrap();
        let disc = Ball::new([0.25, 0.2], 0.2).unwrap();
        let walls = [
            within_body(p, tank.closest(p)),
            around_body(p, disc.closest(p), 0.0),
        ];
        tightest(p, walls.into_iter())
    }

    #[test]
    fn particles_go_straight_back_and_in_a_nook_by_turns() {
        let back = |p: [f64; 2]| put_back(p, 400, |p| off_bound(p, &nook(p), 0.01));
        assert_eq!(back([0.5, 0.5]), [0.5, 0.5]);
        // Too near, and beyond.
        for y in [0.995, 1.2] {
            let p = back([0.6, y]);
            assert!(point::distance(p, [0.6, 0.99]) < 1e-12, "{p:?}");
        }
        let p = back([0.2, 0.004]);
        assert!(nook(p).distance < -0.01 + 1e-12, "{p:?}: {:?}", nook(p));
        // Of few rounds the last place.
        let mut places = vec![[0.2, 0.004]];
        for rounds in 1..4 {
            let last = places[rounds - 1];
            let next = off_bound(last, &nook(last), 0.01).unwrap_or(last);
            places.push(next);
            let p = put_back(places[0], rounds, |p| off_bound(p, &nook(p), 0.01));
            assert_eq!(p, next);
        }
    }

    #[test]
    fn a_bound_around_a_body_is_its_offset() {
        let square = Cuboid::new([0.0; 2], [1.0; 2]).unwrap();
        let seen = |p: [f64; 2]| around_body(p, square.closest(p), 0.1);
        // Beside a side, in the ring between body and bound, and within the body.
        for (p, distance) in [([0.5, 1.5], -0.4), ([0.5, 1.05], 0.05), ([0.5, 0.9], 0.2)] {
            let bound = seen(p);
            assert!(
                (bound.distance - distance).abs() < 1e-15,
                "{p:?}: {bound:?}"
            );
            assert!(
                point::distance(bound.point, [0.5, 1.1]) < 1e-15,
                "{bound:?}"
            );
            assert_eq!(bound.normal, [0.0, -1.0]);
        }
        // Around a corner the bound is round.
        let bound = seen([4.0, 5.0]);
        assert!(
            point::distance(bound.point, [1.06, 1.08]) < 1e-15,
            "{bound:?}"
        );
        assert!((bound.distance + 4.9).abs() < 1e-15, "{bound:?}");
        // Without bodies there is none.
        assert_eq!(
            tightest([0.5; 2], std::iter::empty()).distance,
            f64::NEG_INFINITY
        );
    }
}
