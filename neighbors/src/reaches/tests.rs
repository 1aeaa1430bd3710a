//! Lists of particles that look differently far, against all pairs and images.

use proptest::prelude::*;

use crate::{CellList, Domain, SHELLS, point};

/// Points of the unit box with a support each: random, graded along an axis, of two sizes; up to 50 : 1.
fn sets<const D: usize>() -> impl Strategy<Value = (Vec<[f64; D]>, Vec<f64>)> {
    let points = prop::collection::vec(prop::array::uniform::<_, D>(0.0..1.0_f64), 1..160);
    (points, 0.005..0.06_f64, 1.0..50.0_f64, 0..3_usize).prop_map(|(points, least, ratio, kind)| {
        let support = |(i, p): (usize, &[f64; D])| {
            let part = match kind {
                0 => (i as f64 * 0.618_033_988_749).fract(),
                1 => p[0],
                _ => f64::from(u8::from(i.is_multiple_of(5))),
            };
            least * ratio.powf(part)
        };
        let supports = points.iter().enumerate().map(support).collect();
        (points, supports)
    })
}

/// Every pair of target `i` that may see each other, by particle and the way to it.
fn all_pairs<const D: usize>(
    domain: &Domain<D>,
    points: &[[f64; D]],
    supports: &[f64],
    i: usize,
) -> Vec<(usize, [f64; D])> {
    let size = domain.bounds.size();
    let farthest = supports.iter().copied().fold(0.0, f64::max);
    let away = (farthest / size[0]).ceil() as i32 + 1;
    let steps = 2 * away + 1;
    let mut found = Vec::new();
    for (j, &q) in points.iter().enumerate() {
        let base = point::sub(domain.wrap(points[i]), domain.wrap(q));
        for code in 0..steps.pow(D as u32) {
            let step: [i32; D] = std::array::from_fn(|k| code / steps.pow(k as u32) % steps - away);
            if (0..D).any(|k| !domain.periodic[k] && step[k] != 0) || (j == i && step == [0; D]) {
                continue;
            }
            let way: [f64; D] = std::array::from_fn(|k| base[k] + f64::from(step[k]) * size[k]);
            if point::norm(way) <= supports[i].max(supports[j]) * (1.0 - 1e-9) {
                found.push((j, way));
            }
        }
    }
    found
}

/// In a scene whose box is `scene_unit` long: no support is then of the size of a skin, which has no unit.
fn check<const D: usize>(
    (points, supports): &(Vec<[f64; D]>, Vec<f64>),
    periodic: [bool; D],
    scene_unit: f64,
) -> Result<(), TestCaseError> {
    let points: &Vec<[f64; D]> = &(points.iter())
        .map(|&p| point::scale(p, scene_unit))
        .collect();
    let supports: &Vec<f64> = &supports.iter().map(|s| s * scene_unit).collect();
    let domain = Domain::new([0.0; D], [scene_unit; D]).with_periodic(periodic);
    let skin = 0.2;
    let shells = [0.2, 1.0 / 3.0, 2.0 / 3.0];
    let mut list = CellList::new(&domain, 0.0)
        .with_skin(skin)
        .with_shells(shells);
    let is_target = |i: usize| i % 4 != 3;
    prop_assert!(list.update_each(points, supports, is_target));
    // Moved and grown, both by a little less than the skin allows.
    let wave = |i: usize| 0.5 + 0.5 * (7.0 * i as f64).sin();
    let later: Vec<[f64; D]> = (points.iter().zip(supports).enumerate())
        .map(|(i, (&p, support))| {
            let step = 0.499 * skin * support * wave(i);
            point::add_scaled(
                p,
                step / (D as f64).sqrt(),
                [if i % 2 == 0 { 1.0 } else { -1.0 }; D],
            )
        })
        .collect();
    let grown: Vec<f64> = (supports.iter().enumerate())
        .map(|(i, support)| support * (1.0 + 0.499 * skin * (1.0 - wave(i))))
        .collect();
    prop_assert!(!list.update_each(&later, &grown, is_target));
    for (points, supports) in [(points, supports), (&later, &grown)] {
        let mut slots = Vec::new();
        list.gather(points, supports, 1.0, &mut slots);
        let mut shell_of = vec![Vec::new(); list.targets()];
        list.blocks().for_each(&mut shell_of, |block, out| {
            for out in out {
                for are_targets in [true, false] {
                    for shell in 0..SHELLS {
                        let full = block.full(shell, are_targets).as_flattened();
                        out.extend(full.iter().map(|&slot| (slot, shell)));
                    }
                }
            }
        });
        for i in 0..points.len() {
            let found: Vec<(usize, [f64; D])> = (list.neighbors(i))
                .map(|(j, shift)| (j, point::sub(points[i], point::add(points[j], shift))))
                .collect();
            if !is_target(i) {
                prop_assert!(found.is_empty());
                continue;
            }
            for (j, way) in all_pairs(&domain, points, supports, i) {
                let same = |(k, other): &&(usize, [f64; D])| {
                    *k == j && point::distance(*other, way) < 1e-9 * scene_unit
                };
                prop_assert_eq!(
                    found.iter().filter(same).count(),
                    1,
                    "{} {} {:?}",
                    i,
                    j,
                    way
                );
            }
            // What is in a shell is as far away as it begins, in parts of the greater support.
            let here = list.slot_of(i).expect("a target");
            for &(slot, shell) in &shell_of[here] {
                let slot = slots[slot as usize];
                if shell > 0 && slot[3] > 0.0 {
                    let at: [f64; D] = std::array::from_fn(|k| slot[k]);
                    let own: [f64; D] = std::array::from_fn(|k| slots[here][k]);
                    let begin = shells[shell - 1] * supports[i].max(slot[3]);
                    let apart = point::distance(at, own);
                    prop_assert!(apart >= begin * (1.0 - 1e-9), "{apart} {begin}");
                }
            }
        }
    }
    // A little more than the skin allows.
    let mut far = points.clone();
    far[0] = point::add_scaled(
        far[0],
        0.51 * skin * supports[0] / (D as f64).sqrt(),
        [1.0; D],
    );
    prop_assert!(list.update_each(&far, supports, is_target));
    let mut wider = supports.clone();
    wider[0] *= 1.0 + 0.51 * skin;
    prop_assert!(list.update_each(&far, &wider, is_target));
    // Of one support the skin is a length.
    let mut list = list.with_skin(skin * scene_unit);
    prop_assert!(list.update_some(&far, is_target), "another kind of reach");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn each_its_own_reach_2d(
        set in sets::<2>(),
        periodic in prop::array::uniform2(any::<bool>()),
        scene_unit in prop::sample::select(&[1.0, 2e-4, 7e5]),
    ) {
        check(&set, periodic, scene_unit)?;
    }

    #[test]
    fn each_its_own_reach_3d(
        set in sets::<3>(),
        periodic in prop::array::uniform3(any::<bool>()),
        scene_unit in prop::sample::select(&[1.0, 2e-4, 7e5]),
    ) {
        let points: Vec<[f64; 3]> = set.0.into_iter().take(60).collect();
        let supports = set.1[..points.len()].iter().map(|s| s.min(1.0)).collect();
        check(&(points, supports), periodic, scene_unit)?;
    }

    /// Blocks of several chunks, which must find their particles' reaches again.
    #[test]
    fn long_lists_know_how_far_every_particle_looks(
        points in prop::collection::vec(prop::array::uniform2(0.0..1.0_f64), 300..600),
        ratio in 1.0..15.0_f64,
    ) {
        let support = |i: usize| 0.01 * ratio.powf((i as f64 * 0.618_033_988_749).fract());
        let supports: Vec<f64> = (0..points.len()).map(support).collect();
        let mut list = CellList::new(&Domain::new([0.0; 2], [1.0; 2]), 0.0);
        list.update_each(&points, &supports, |i| i % 7 != 0);
        prop_assert_eq!(list.support(), supports.iter().copied().fold(0.0, f64::max));
        for i in (0..points.len()).filter(|i| i % 7 != 0) {
            let near = |&j: &usize| {
                j != i && point::distance(points[i], points[j]) <= supports[i].max(supports[j])
            };
            let expected: Vec<usize> = (0..points.len()).filter(near).collect();
            prop_assert_eq!(list.of(i, &points), expected, "particle {}", i);
        }
    }
}
