//! Every structure answers as brute force does, on every kind of point set.

use proptest::prelude::*;

use crate::{Bounds, CellList, Domain, KdTree, KdTreeError, LANES, SHELLS, point};

mod places;

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

/// In a scene whose box is `scene_unit` long.
fn check_cell_list<const D: usize>(
    points: &[[f64; D]],
    radius: f64,
    periodic: [bool; D],
    scene_unit: f64,
) -> Result<(), TestCaseError> {
    let points: &[[f64; D]] = &(points.iter())
        .map(|&p| point::scale(p, scene_unit))
        .collect::<Vec<_>>();
    let radius = radius * scene_unit;
    let domain = Domain::new([0.0; D], [scene_unit; D]).with_periodic(periodic);
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
    fn cell_list_2d(
        points in point_sets::<2>(),
        radius in 0.01..0.6_f64,
        periodic in prop::array::uniform2(any::<bool>()),
        scene_unit in prop::sample::select(&[1.0, 2e-4, 7e5]),
    ) {
        check_cell_list(&points, radius, periodic, scene_unit)?;
    }

    #[test]
    fn cell_list_3d(
        points in point_sets::<3>(),
        radius in 0.02..0.6_f64,
        periodic in prop::array::uniform3(any::<bool>()),
        scene_unit in prop::sample::select(&[1.0, 2e-4, 7e5]),
    ) {
        check_cell_list(&points, radius, periodic, scene_unit)?;
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
