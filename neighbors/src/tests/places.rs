//! Vectors, boxes and domains against what they are defined to be.

use proptest::prelude::*;

use crate::{Bounds, Domain, point};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// Periods of 0.7, 1 and 1.3, so that reaches take in several images.
    #[test]
    fn images_are_all_those_within_reach_of_the_box(
        p in prop::array::uniform3(-2.0..3.0_f64),
        reach in 0.0..2.0_f64,
        periodic in prop::array::uniform3(any::<bool>()),
    ) {
        let domain = Domain::new([-0.4, 0.25, 0.0], [0.3, 1.25, 1.3]).with_periodic(periodic);
        prop_assert_eq!(domain.is_periodic(), periodic.iter().any(|&is| is));
        let images: Vec<[f64; 3]> = domain.images(p, reach).collect();
        prop_assert_eq!(images[0], domain.wrap(p), "the one in the box comes first");
        let near = domain.bounds.grown(reach);
        let mut expected = 0;
        for code in 0..15_i32.pow(3) {
            let step: [i32; 3] = std::array::from_fn(|k| code / 15_i32.pow(k as u32) % 15 - 7);
            if (0..3).any(|k| !periodic[k] && step[k] != 0) {
                continue;
            }
            let size = domain.bounds.size();
            let image: [f64; 3] = std::array::from_fn(|k| p[k] + f64::from(step[k]) * size[k]);
            // Along an axis that is open every place counts.
            if (0..3).all(|k| !periodic[k] || (near.min[k] <= image[k] && image[k] <= near.max[k])) {
                expected += 1;
                let found = images.iter().filter(|&&q| point::distance(q, image) < 1e-9).count();
                prop_assert_eq!(found, 1, "{:?}", image);
            }
        }
        prop_assert_eq!(images.len(), expected);
    }

    #[test]
    fn differences_go_to_the_nearest_image_and_places_out_of_the_box_to_its_side(
        a in prop::array::uniform2(-3.0..3.0_f64),
        b in prop::array::uniform2(-3.0..3.0_f64),
        periodic in prop::array::uniform2(any::<bool>()),
    ) {
        let (min, max) = ([-0.5, 0.25], [0.25, 2.0]);
        let domain = Domain::new(min, max).with_periodic(periodic);
        let (difference, carried, held) = (domain.difference(a, b), domain.whole_periods(a), domain.clamp(a));
        for k in 0..2 {
            let size = max[k] - min[k];
            if periodic[k] {
                let nearest = (-20..=20)
                    .map(|n| a[k] - b[k] + f64::from(n) * size)
                    .min_by(|x, y| x.abs().total_cmp(&y.abs()))
                    .expect("some image");
                prop_assert!((difference[k].abs() - nearest.abs()).abs() < 1e-12);
                let periods = (difference[k] - (a[k] - b[k])) / size;
                prop_assert!((periods - periods.round()).abs() < 1e-12);
                prop_assert!((a[k] + carried[k] - domain.wrap(a)[k]).abs() < 1e-12);
                prop_assert_eq!(held[k], a[k]);
            } else {
                prop_assert_eq!(difference[k], a[k] - b[k]);
                prop_assert_eq!(carried[k], 0.0);
                prop_assert_eq!(domain.wrap(a)[k], a[k]);
                let side = if a[k] < min[k] { min[k] } else if a[k] > max[k] { max[k] } else { a[k] };
                prop_assert_eq!(held[k], side);
            }
        }
    }

    #[test]
    fn boxes_hold_what_lies_between_their_corners(
        a in prop::array::uniform3(-2.0..2.0_f64),
        b in prop::array::uniform3(-2.0..2.0_f64),
        p in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let bounds = Bounds::of(&[a, b]);
        for k in 0..3 {
            prop_assert_eq!((bounds.min[k], bounds.max[k]), (a[k].min(b[k]), a[k].max(b[k])));
            prop_assert!((bounds.center()[k] - 0.5 * (a[k] + b[k])).abs() < 1e-15);
        }
        let edges: [f64; 3] = std::array::from_fn(|k| (a[k] - b[k]).abs());
        prop_assert_eq!(bounds.size(), edges);
        prop_assert!((bounds.diagonal() - point::distance(a, b)).abs() < 1e-12);
        prop_assert!((bounds.volume() - edges[0] * edges[1] * edges[2]).abs() < 1e-12);
        // The nearest place of the box is the point with every coordinate held within it.
        let nearest = Domain { bounds, periodic: [false; 3] }.clamp(p);
        prop_assert!((bounds.distance_squared(p) - point::distance_squared(p, nearest)).abs() < 1e-12);
        prop_assert_eq!(bounds.contains(p), nearest == p);
        prop_assert!(bounds.contains(a) && bounds.contains(b) && !bounds.is_empty());
        // One axis that is turned round is enough.
        for k in 0..3 {
            let mut turned = bounds;
            turned.min[k] = bounds.max[k] + 1e-3;
            prop_assert!(turned.is_empty() && !turned.contains(bounds.center()));
            let mut point = bounds;
            point.min[k] = bounds.max[k];
            prop_assert!(!point.is_empty());
        }
        let both = bounds.union(Bounds::new(p, p));
        prop_assert_eq!(both, Bounds::of(&[a, b, p]));
        prop_assert!(both.contains_box(&bounds));
        prop_assert_eq!(bounds.contains_box(&both), bounds.contains(p));
        let wider = bounds.grown(0.5);
        for k in 0..3 {
            prop_assert_eq!((wider.min[k], wider.max[k]), (bounds.min[k] - 0.5, bounds.max[k] + 0.5));
        }
    }

    #[test]
    fn vectors_add_multiply_and_turn_as_their_coordinates_do(
        a in prop::array::uniform3(-2.0..2.0_f64),
        b in prop::array::uniform3(-2.0..2.0_f64),
        s in -3.0..3.0_f64,
    ) {
        for k in 0..3 {
            prop_assert_eq!(point::add(a, b)[k], a[k] + b[k]);
            prop_assert_eq!(point::sub(a, b)[k], a[k] - b[k]);
            prop_assert_eq!(point::scale(a, s)[k], s * a[k]);
            prop_assert_eq!(point::add_scaled(a, s, b)[k], a[k] + s * b[k]);
        }
        prop_assert_eq!(point::of_slice::<3>(&a[..2]), [a[0], a[1], 0.0]);
        prop_assert_eq!(point::of_slice::<2>(&a), [a[0], a[1]]);
        let product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        prop_assert!((point::dot(a, b) - product).abs() < 1e-12);
        let square = a.iter().map(|x| x * x).sum::<f64>();
        prop_assert!((point::norm_squared(a) - square).abs() < 1e-12);
        prop_assert!((point::norm(a) - square.sqrt()).abs() < 1e-12);
        let apart = a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>();
        prop_assert!((point::distance_squared(a, b) - apart).abs() < 1e-12);
        prop_assert!((point::distance(a, b) - apart.sqrt()).abs() < 1e-12);
        // a × b is perpendicular to both, |a × b|² + (a · b)² = |a|² |b|², and x × y = z.
        let cross = point::cross(a, b);
        prop_assert!(point::dot(cross, a).abs() < 1e-12 && point::dot(cross, b).abs() < 1e-12);
        let both = point::norm_squared(cross) + product * product;
        prop_assert!((both - square * point::norm_squared(b)).abs() < 1e-9);
        prop_assert_eq!(point::cross([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        let n = point::unit(b).expect("not zero");
        prop_assert!((point::norm(n) - 1.0).abs() < 1e-12 && point::dot(n, b) > 0.0);
        let across = point::reject(a, n);
        prop_assert!(point::dot(across, n).abs() < 1e-12);
        prop_assert!(point::norm(point::cross(point::sub(a, across), n)) < 1e-12);
    }

    #[test]
    fn wrapping_brings_every_point_home(x in -1e3..1e3_f64, min in -5.0..5.0_f64, size in 0.1..5.0_f64) {
        let domain = Domain::new([min], [min + size]).with_periodic([true]);
        let [y] = domain.wrap([x]);
        prop_assert!(y >= min && y < min + size);
        let periods = (x - y) / size;
        prop_assert!((periods - periods.round()).abs() < 1e-9);
    }
}
