//! The block loop says what a plain loop over all pairs says, for every kernel, point set and instruction set.

use fearless_simd::Level;
use proptest::prelude::*;
use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{CellList, Domain, point};
use sphpack_pairs::{
    DensitySum, Gathered, PackingSum, PackingSums, Repulsion, RepulsionSum, Shape,
};

mod each;
mod repulsion;
mod sized;
mod variation;

/// Point sets in the unit box: random, shaken lattice, lattice, coincident.
fn point_sets<const D: usize>() -> impl Strategy<Value = Vec<[f64; D]>> {
    let coordinate = 0.0..1.0_f64;
    let random = prop::collection::vec(prop::array::uniform(coordinate.clone()), 1..250);
    let coincident = (
        prop::array::uniform::<_, D>(coordinate.clone()),
        prop::array::uniform::<_, D>(coordinate),
        1..30_usize,
    )
        .prop_map(|(p, q, n)| {
            let mut points = vec![p; n];
            points.extend(vec![q; n / 2]);
            points
        });
    let lattice = (2..7_usize, 0.0..0.05_f64).prop_map(|(n, shake)| {
        (0..n.pow(D as u32))
            .map(|i| {
                std::array::from_fn(|k| {
                    let site = (i / n.pow(k as u32) % n) as f64 / n as f64;
                    site + shake * ((i * (k + 3)) as f64).sin()
                })
            })
            .collect()
    });
    prop_oneof![random, lattice.clone(), lattice, coincident]
}

/// Every instruction set that this machine can be held to.
fn levels() -> Vec<Level> {
    let best = Level::new();
    let mut levels = vec![best, Level::baseline()];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(best.as_sse4_2().map(Level::Sse4_2));
        levels.extend(best.as_avx2().map(Level::Avx2));
    }
    levels
}

/// A plain loop over all pairs and images.
struct Plain<'a, const D: usize> {
    domain: &'a Domain<D>,
    positions: &'a [[f64; D]],
    weights: &'a [f64],
    repulsion: Repulsion,
}

impl<const D: usize> Plain<'_, D> {
    fn is_target(i: usize) -> bool {
        i % 4 != 3
    }

    fn sums<K: Kernel<D>>(&self, kernel: K, i: usize) -> PackingSum {
        let size = self.domain.bounds.size();
        let (mut density, mut gradient) = (DensitySum::default(), [0.0; D]);
        let (mut repulsion, mut push) = (RepulsionSum::default(), [0.0; D]);
        for (j, &q) in self.positions.iter().enumerate() {
            for code in 0..5_i32.pow(D as u32) {
                let step: [i32; D] = std::array::from_fn(|k| code / 5_i32.pow(k as u32) % 5 - 2);
                if (0..D).any(|k| !self.domain.periodic[k] && step[k] != 0) {
                    continue;
                }
                let base = point::sub(self.domain.wrap(self.positions[i]), self.domain.wrap(q));
                let d: [f64; D] = std::array::from_fn(|k| base[k] + f64::from(step[k]) * size[k]);
                let r = point::norm(d);
                if r >= kernel.support().max(self.repulsion.reach()) {
                    continue;
                }
                // A target's image stands for the target.
                let is_other = !Self::is_target(j);
                let value = self.weights[j] * kernel.value(r);
                density.whole += value;
                if is_other {
                    density.of_others += value;
                }
                if r > 0.0 {
                    let slope = self.weights[j] * kernel.slope(r) / r;
                    gradient = point::add_scaled(gradient, slope, d);
                    push = point::add_scaled(push, self.repulsion.force(r) / r, d);
                    let share = if is_other { 1.0 } else { 0.5 };
                    repulsion.energy += share * self.repulsion.potential(r);
                }
            }
        }
        repulsion.acceleration[..D].copy_from_slice(&push);
        let mut padded = [0.0; 3];
        padded[..D].copy_from_slice(&gradient);
        (density, padded, repulsion)
    }
}

impl<const D: usize> WithKernel<D> for &Plain<'_, D> {
    type Output = Vec<PackingSum>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        (0..self.positions.len())
            .map(|i| self.sums(kernel, i))
            .collect()
    }
}

fn check<const D: usize>(
    positions: &[[f64; D]],
    kind: KernelKind,
    h: f64,
    periodic: [bool; D],
    scene_unit: f64,
) -> Result<(), TestCaseError> {
    let positions: Vec<[f64; D]> = positions
        .iter()
        .map(|&p| point::scale(p, scene_unit))
        .collect();
    let h = h * scene_unit;
    let domain = Domain::new([0.0; D], [scene_unit; D]).with_periodic(periodic);
    let weights: Vec<f64> = (0..positions.len())
        .map(|i| 0.01 * (1.0 + 0.3 * (i as f64).cos()) * scene_unit.powi(D as i32))
        .collect();
    check_with(&domain, &positions, &weights, kind, h, Repulsion::none())?;
    let repulsion = Repulsion::new(0.8 * h, Repulsion::STRENGTH);
    check_with(&domain, &positions, &weights, kind, h, repulsion)
}

fn check_with<const D: usize>(
    domain: &Domain<D>,
    positions: &[[f64; D]],
    weights: &[f64],
    kind: KernelKind,
    h: f64,
    repulsion: Repulsion,
) -> Result<(), TestCaseError> {
    let plain = Plain {
        domain,
        positions,
        weights,
        repulsion,
    };
    let expected = kind.with(h, &plain);
    // Of the targets alone, with other weights, as the second pass has it.
    let others: Vec<f64> = (0..positions.len())
        .map(|i| f64::from(u8::from(Plain::<D>::is_target(i))) * weights[i] * (i as f64).sin())
        .collect();
    let field = Plain {
        weights: &others,
        ..plain
    };
    let of_targets = kind.with(h, &field);
    let shape = Shape::Smoothing(kind);
    let mut list = CellList::new(domain, kind.support_over_h() * h)
        .with_skin(0.2 * h)
        .with_shells(shape.shells::<D>(h, repulsion.reach()));
    list.update_some(positions, Plain::<D>::is_target);
    let mut gathered = Gathered::default();
    gathered.gather(&list, positions, weights, h);
    let mut reweighted = gathered.clone();
    reweighted.weigh(&list, &others);
    for level in levels() {
        let pairs = PackingSums {
            shape,
            length: h,
            blocks: list.blocks(),
            gathered: &gathered,
            level,
        };
        let mut out = vec![PackingSum::default(); list.targets()];
        pairs.sum::<D>(repulsion, &mut out);
        let mut gradients = vec![[0.0; 3]; list.targets()];
        let second = PackingSums {
            gathered: &reweighted,
            ..pairs
        };
        second.gradient::<D>(&mut gradients);
        let strongest = repulsion.force(0.0) * positions.len() as f64;
        let largest = repulsion.potential(0.0) * positions.len() as f64;
        for (i, expected) in expected.iter().enumerate() {
            let Some(slot) = list.slot_of(i) else {
                continue;
            };
            let (density, gradient, repelled) = out[slot];
            let whole = expected.0.whole;
            let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-13 * scale;
            let all_near =
                |a: [f64; 3], b: [f64; 3], scale: f64| (0..3).all(|k| near(a[k], b[k], scale));
            let says = format!(
                "{level:?}, {kind}, particle {i}: {:?}, not {expected:?}",
                out[slot]
            );
            prop_assert!(
                all_near(gradients[slot], of_targets[i].1, whole / h),
                "second pass, {says}"
            );
            prop_assert!(near(density.whole, whole, whole), "{says}");
            prop_assert!(
                near(density.of_others, expected.0.of_others, whole),
                "{says}"
            );
            prop_assert!(near(repelled.energy, expected.2.energy, largest), "{says}");
            prop_assert!(all_near(gradient, expected.1, whole / h), "{says}");
            prop_assert!(
                all_near(repelled.acceleration, expected.2.acceleration, strongest),
                "{says}"
            );
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_loop_says_what_all_pairs_say(
        flat in point_sets::<2>(),
        solid in point_sets::<3>(),
        kind in prop::sample::select(&KernelKind::ALL),
        h in 0.05..0.3_f64,
        periodic in prop::array::uniform3(any::<bool>()),
        scene_unit in prop::sample::select(&[1.0, 1e-9, 3e-3, 7e5, 1e20]),
    ) {
        check(&flat, kind, h, [periodic[0], periodic[1]], scene_unit)?;
        check(&solid, kind, h, periodic, scene_unit)?;
    }
}
