//! Every structure answers as brute force does, on every kind of point set.

use proptest::prelude::*;

use crate::{Bounds, CellList, Domain, KdTree, KdTreeError, LANES, SHELLS, point};

/// Point sets that break neighbour searches: random, lattice, clustered, coincident, near the boundary.
fn point_sets<const D: usize>() -> impl Strategy<Value = Vec<[f64; D]>> {
    let coordinate = 0.0..1.0_f64;
    let random = prop::collection::vec(prop::array::uniform(coordinate.clone()), 0..200);
    let lattice = (2..6_usize, Just(())).prop_map(|(n, ())| {
        (0..n.pow(D as u32))
            .map(|i| std::array::from_fn(|k| (i / n.pow(k as u32) % n) as f64 / n as f64))
            .collect()
    });
    let clustered = prop::collection::vec(
        (0..3_usize, prop::array::uniform(coordinate.clone())),
        0..150,
    )
    .prop_map(|members| {
        members
            .into_iter()
            .map(|(cluster, p): (usize, [f64; D])| p.map(|x| 0.25 * cluster as f64 + 0.02 * x))
            .collect()
    });
    let coincident =
        (prop::array::uniform(coordinate.clone()), 1..60_usize).prop_map(|(p, n)| vec![p; n]);
    let boundary = prop::collection::vec(prop::array::uniform(coordinate), 0..150).prop_map(
        |points: Vec<[f64; D]>| {
            points
                .into_iter()
                .map(|p| {
                    p.map(|x| {
                        if x < 0.5 {
                            x * 1e-3
                        } else {
                            1.0 - (1.0 - x) * 1e-3
                        }
                    })
                })
                .collect()
        },
    );
    prop_oneof![random, lattice, clustered, coincident, boundary]
}

fn brute_force<const D: usize>(
    domain: &Domain<D>,
    points: &[[f64; D]],
    i: usize,
    radius: f64,
) -> Vec<usize> {
    let size = domain.bounds.size();
    let mut found = Vec::new();
    for (j, &q) in points.iter().enumerate() {
        let base = point::sub(domain.wrap(q), domain.wrap(points[i]));
        // Every image up to three periods away.
        for code in 0..7_i32.pow(D as u32) {
            let step: [i32; D] = std::array::from_fn(|k| code / 7_i32.pow(k as u32) % 7 - 3);
            if (0..D).any(|k| !domain.periodic[k] && step[k] != 0) || (j == i && step == [0; D]) {
                continue;
            }
            let d: [f64; D] = std::array::from_fn(|k| base[k] + f64::from(step[k]) * size[k]);
            if point::norm_squared(d) <= radius * radius {
                found.push(j);
            }
        }
    }
    found
}

/// Positions moved by less than half the skin, the same way every time.
fn moved<const D: usize>(points: &[[f64; D]], distance: f64) -> Vec<[f64; D]> {
    let step = distance / (D as f64).sqrt();
    points
        .iter()
        .enumerate()
        .map(|(i, &p)| std::array::from_fn(|k| p[k] + step * ((i * 7 + k * 3) as f64).sin()))
        .collect()
}

fn check_cell_list<const D: usize>(
    points: &[[f64; D]],
    radius: f64,
    periodic: [bool; D],
) -> Result<(), TestCaseError> {
    let domain = Domain::new([0.0; D], [1.0; D]).with_periodic(periodic);
    let skin = 0.3 * radius;
    let mut list = CellList::new(&domain, radius).with_skin(skin);
    // Every third particle is only a source, as frozen ones are.
    let is_target = |i: usize| !i.is_multiple_of(3) || !points.len().is_multiple_of(2);
    prop_assert!(list.update_some(points, is_target));
    let later = moved(points, 0.499 * skin);
    prop_assert!(!list.update_some(&later, is_target) || points.is_empty());
    for (positions, what) in [(points, "at once"), (&later[..], "within the skin")] {
        for i in 0..positions.len() {
            let expected = if is_target(i) {
                brute_force(&domain, positions, i, radius)
            } else {
                Vec::new()
            };
            let found = list.of(i, positions);
            // A pair at the radius to the last digit may fall either way when an image is computed.
            if found != expected {
                let edge = |r: f64| brute_force(&domain, positions, i, r);
                prop_assert!(
                    is_target(i)
                        && found
                            .iter()
                            .all(|j| edge(radius * (1.0 + 1e-12)).contains(j))
                        && edge(radius * (1.0 - 1e-12))
                            .iter()
                            .all(|j| found.contains(j)),
                    "{what}: particle {i} has {found:?}, not {expected:?}"
                );
            }
        }
    }
    let far = moved(points, 2.0 * skin);
    if far
        .iter()
        .zip(points)
        .any(|(&a, &b)| point::distance(a, b) > 0.5 * skin)
    {
        prop_assert!(list.update_some(&far, is_target), "too far for the skin");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn cell_list_2d(points in point_sets::<2>(), radius in 0.01..0.6_f64, periodic in prop::array::uniform2(any::<bool>())) {
        check_cell_list(&points, radius, periodic)?;
    }

    #[test]
    fn cell_list_3d(points in point_sets::<3>(), radius in 0.02..0.6_f64, periodic in prop::array::uniform3(any::<bool>())) {
        check_cell_list(&points, radius, periodic)?;
    }

    #[test]
    fn kd_tree(points in point_sets::<3>(), p in prop::array::uniform3(-0.2..1.2_f64), radius in 0.0..0.5_f64) {
        let tree = KdTree::new(&points).expect("finite points");
        let mut distances: Vec<f64> = points.iter().map(|&q| point::distance(p, q)).collect();
        let within: Vec<usize> = tree.within(p, radius).into_iter().map(|hit| hit.index).collect();
        let expected: Vec<usize> = (0..points.len()).filter(|&i| point::distance_squared(p, points[i]) <= radius * radius).collect();
        prop_assert_eq!(within, expected);
        let nearest = tree.nearest(p);
        prop_assert_eq!(nearest.is_none(), points.is_empty());
        let few: Vec<f64> = tree.nearest_n(p, 5).into_iter().map(|hit| hit.distance).collect();
        distances.sort_by(f64::total_cmp);
        distances.truncate(5);
        prop_assert_eq!(few.len(), distances.len());
        for (a, b) in few.iter().zip(&distances) {
            prop_assert!((a - b).abs() < 1e-12);
        }
        if let Some(hit) = nearest {
            prop_assert!((hit.distance - distances[0]).abs() < 1e-12);
            prop_assert!((point::distance(points[hit.index], p) - hit.distance).abs() < 1e-12);
        }
    }

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

    /// Over several chunks of blocks.
    #[test]
    fn a_list_says_what_is_in_its_slots(
        points in prop::collection::vec(prop::array::uniform2(-0.5..1.5_f64), 0..700),
        is_periodic in any::<bool>(),
    ) {
        let domain = Domain::new([0.0; 2], [1.0; 2]).with_periodic([is_periodic, false]);
        let mut list = CellList::new(&domain, 0.1);
        let is_target = |i: usize| i % 5 != 3;
        prop_assert!(list.update_some(&points, is_target));
        prop_assert_eq!((list.support(), list.builds()), (0.1, 1));
        prop_assert_eq!(list.reference(), &points[..]);
        let targets: Vec<usize> = list.target_particles().iter().map(|&i| i as usize).collect();
        prop_assert_eq!(targets.len(), (0..points.len()).filter(|&i| is_target(i)).count());
        prop_assert!(targets.iter().enumerate().all(|(slot, &i)| is_target(i) && list.slot_of(i) == Some(slot)));
        prop_assert!((0..points.len()).all(|i| list.slot_of(i).is_some() == is_target(i)));

        let sources: Vec<(usize, [f64; 2])> = list.sources().collect();
        prop_assert!(sources.iter().zip(&targets).all(|(source, target)| source.0 == *target));
        let weights: Vec<f64> = (0..points.len()).map(|i| 1.0 + i as f64).collect();
        let mut slots = Vec::new();
        list.gather(&points, &weights, 4.0, &mut slots);
        prop_assert_eq!(slots.len(), sources.len() + 1);
        for (slot, &(i, shift)) in slots.iter().zip(&sources) {
            let at = point::add(points[i], shift);
            prop_assert_eq!(*slot, [4.0 * at[0], 4.0 * at[1], 0.0, weights[i]]);
            let periods = point::sub(shift, domain.whole_periods(points[i]));
            prop_assert!((periods[0] - periods[0].round()).abs() < 1e-9 && periods[1] == 0.0);
        }
        let twice: Vec<f64> = weights.iter().map(|w| 2.0 * w).collect();
        list.weigh(&twice, &mut slots);
        prop_assert!(slots.iter().zip(&sources).all(|(slot, source)| slot[3] == twice[source.0]));

        // Every target has its place in one block.
        prop_assert_eq!(list.blocks().targets(), targets.len());
        let mut seen = vec![usize::MAX; targets.len()];
        list.blocks().for_each(&mut seen, |block, seen| {
            assert_eq!(block.len, seen.len());
            for (lane, seen) in seen.iter_mut().enumerate() {
                let slot = block.first_slot + lane;
                *seen = if block.sources().any(|other| other == slot) { slot } else { usize::MAX };
            }
            // A target's image stands for the target.
            for are_targets in [true, false] {
                let full = (0..SHELLS).flat_map(|shell| block.full(shell, are_targets).as_flattened());
                for &slot in full.chain(block.split(are_targets).as_flattened()) {
                    let source = sources.get(slot as usize);
                    assert!(source.is_none_or(|source| is_target(source.0) == are_targets));
                }
            }
        });
        prop_assert!(seen.iter().enumerate().all(|(slot, &seen)| slot == seen));

        prop_assert!(!list.update_some(&points, is_target), "nothing has moved");
        prop_assert_eq!(list.builds(), 1);
        list.invalidate();
        prop_assert!(list.reference().is_empty() && list.builds() == 0);
        prop_assert!(list.update_some(&points, is_target));
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

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let points: Vec<[f64; 3]> = (0..20_000)
        .map(|i| std::array::from_fn(|k| ((i * (k + 3) + k) as f64 * 0.618_033_988_749).fract()))
        .collect();
    let in_pool = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a thread pool");
        pool.install(|| {
            let mut list = CellList::new(&Domain::new([0.0; 3], [1.0; 3]), 0.06).with_skin(0.01);
            list.update_some(&points, |i| i % 5 != 0);
            let mut slots = Vec::new();
            list.gather(&points, &vec![1.0; points.len()], 1.0, &mut slots);
            let mut sums = vec![0.0; list.targets()];
            list.blocks().for_each(&mut sums, |block, out| {
                for (lane, sum) in out.iter_mut().enumerate() {
                    let here = slots[block.first_slot + lane];
                    *sum = block
                        .candidates
                        .iter()
                        .map(|&c| slots[c as usize][0] - here[0])
                        .sum::<f64>();
                }
            });
            (list.target_particles().to_vec(), sums)
        })
    };
    let one = in_pool(1);
    assert_eq!(one, in_pool(2));
    assert_eq!(one, in_pool(5));
}

#[test]
fn blocks_of_a_lattice_are_compact() {
    // 16³ sites: blocks of 2 × 2 × 2, so that a list is at most three times the neighbours.
    let n = 16;
    let points: Vec<[f64; 3]> = (0..n * n * n)
        .map(|i| [(i / n / n) as f64, (i / n % n) as f64, (i % n) as f64])
        .collect();
    let mut list = CellList::new(&Domain::new([-0.5; 3], [15.5; 3]), 3.0);
    list.update(&points);
    assert_eq!(list.targets(), n * n * n);
    let pairs: usize = (0..points.len())
        .map(|i| list.of(i, &points).len() + 1)
        .sum();
    assert!(
        list.blocks().lane_pairs() < 3 * pairs,
        "{} lanes for {pairs} pairs",
        list.blocks().lane_pairs()
    );
    assert_eq!(list.blocks().lane_pairs() % LANES, 0);
}

#[test]
fn shells_and_halves_keep_their_promises() {
    let n = 20;
    let points: Vec<[f64; 3]> = (0..n * n * n)
        .map(|i| {
            let site = [i / n / n, i / n % n, i % n];
            std::array::from_fn(|k| site[k] as f64 + 0.2 * ((i * (k + 2)) as f64).sin())
        })
        .collect();
    let (support, skin, radii) = (3.0, 0.3, [0.8, 1.0, 2.0]);
    let domain = Domain::new([-1.0; 3], [n as f64; 3]);
    let mut list = CellList::new(&domain, support)
        .with_skin(skin)
        .with_shells(radii);
    list.update_some(&points, |i| i % 7 != 0);
    let later = moved(&points, 0.499 * skin);
    assert!(!list.update_some(&later, |i| i % 7 != 0));
    let mut slots = Vec::new();
    list.gather(&later, &vec![1.0; later.len()], 1.0, &mut slots);
    let at = |slot: u32| -> [f64; 3] { std::array::from_fn(|k| slots[slot as usize][k]) };
    let targets = list.targets();
    let mut counts = vec![(0, 0, 0); targets];
    list.blocks().for_each(&mut counts, |block, counts| {
        let here = |lane: usize| at((block.first_slot + lane) as u32);
        for (lane, (full, split, all)) in counts.iter_mut().enumerate() {
            let near = |slot: u32| point::distance(at(slot), here(lane)) <= support;
            for are_targets in [true, false] {
                for shell in 0..SHELLS {
                    for &slot in block.full(shell, are_targets).as_flattened() {
                        let away = shell.checked_sub(1).map_or(0.0, |s| radii[s]);
                        assert!(point::distance(at(slot), here(lane)) >= away);
                        assert!(
                            ((slot as usize) < targets) == are_targets
                                || slots[slot as usize][3] == 0.0
                        );
                        *full += usize::from(near(slot));
                    }
                }
                for (place, &slot) in block.split(are_targets).as_flattened().iter().enumerate() {
                    let is_mine = place % 2 == lane / (LANES / 2);
                    assert!(is_mine || !near(slot), "the other half is out of reach");
                    assert!(!is_mine || point::distance(at(slot), here(lane)) >= radii[2]);
                    *split += usize::from(is_mine && near(slot));
                }
            }
            *all = (0..later.len())
                .filter(|&i| point::distance(later[i], here(lane)) <= support)
                .count();
        }
    });
    assert!(counts.iter().all(|(full, split, all)| full + split == *all));
    assert!(
        counts.iter().any(|&(_, split, _)| split > 0),
        "some are split"
    );
    // The padding slot weighs nothing and is out of everybody's reach.
    let padding = slots.last().expect("a padding slot");
    let padding_at: [f64; 3] = std::array::from_fn(|k| padding[k]);
    assert_eq!((slots.len(), padding[3]), (points.len() + 1, 0.0));
    assert!(Bounds::of(&later).distance_squared(padding_at) > support * support);
}

#[test]
fn not_finite_is_refused() {
    let refused = KdTree::new(&[[0.0, 0.0], [f64::NAN, 0.0]]).expect_err("refused");
    assert_eq!(refused, KdTreeError::NotFinite { index: 1 });
    assert!(refused.to_string().contains("point 1 has"), "{refused}");
    assert!(point::is_finite([0.0, -1e308]) && !point::is_finite([0.0, f64::INFINITY]));
    assert_eq!(point::unit([0.0; 2]), None);
    assert_eq!(point::unit([f64::INFINITY, 0.0]), None);
}

#[cfg(feature = "serde")]
#[test]
fn domains_are_written_and_read() {
    let domain = Domain::new([0.0, -1.0], [0.1, 2.0]).with_periodic([true, false]);
    let text = serde_json::to_string(&domain).expect("finite numbers");
    assert_eq!(
        text,
        r#"{"bounds":{"min":[0.0,-1.0],"max":[0.1,2.0]},"periodic":[true,false]}"#
    );
    assert_eq!(serde_json::from_str::<Domain<2>>(&text).ok(), Some(domain));
}
