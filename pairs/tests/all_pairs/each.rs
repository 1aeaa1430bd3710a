//! Particles with a smoothing length each, against all pairs: gather, scatter and a root mean square of h in one walk, with a field.

use fearless_simd::{Simd, f64x8, prelude::*};
use proptest::prelude::*;
use sphpack_kernels::{Kernel, Profile, Quintic, WendlandC4};
use sphpack_neighbors::{CellList, Domain, GROUP, LANES, point};

use super::levels;
use sphpack_pairs::{
    Density, Fields, Gradient, Group, Pairs, Scale, Several, TargetGradient, Targets, Term, shells,
};

/// Σ w_j W(h_j), Σ w_j W(h̄), Σ w_j (f_i − f_j) ∇W(h_j), Σ w_j ∇W(h̄).
#[derive(Debug, Clone, Copy)]
struct Mixed;

#[derive(Debug, Clone, Copy, Default)]
struct MixedSum {
    theirs: f64,
    mean: f64,
    field: [f64; 3],
    gradient: [f64; 3],
}

#[derive(Debug, Clone, Copy)]
struct MixedLanes<S: Simd> {
    own: f64x8<S>,
    sums: [f64x8<S>; 8],
}

impl Term for Mixed {
    type Sum = MixedSum;
    type Lanes<S: Simd> = MixedLanes<S>;

    const THEIRS: bool = true;
    const MEAN: bool = true;

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S> {
        MixedLanes {
            own: targets.field(0),
            sums: [f64x8::splat(targets.simd, 0.0); 8],
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, lanes: &mut Self::Lanes<S>, group: &Group<'_, S, D>) {
        let field = group.field(0);
        let theirs = group.theirs.slope * group.inverse * Several(group.weight);
        let mean = group.mean.slope * group.inverse * Several(group.weight);
        for j in 0..GROUP {
            let sums = &mut lanes.sums;
            sums[0] = group.weight[j].mul_add(group.theirs.value.0[j], sums[0]);
            sums[1] = group.weight[j].mul_add(group.mean.value.0[j], sums[1]);
            for k in 0..D {
                let apart = group.apart[j][k];
                let jump = (lanes.own - field[j]) * apart;
                lanes.sums[2 + k] = theirs.0[j].mul_add(jump, lanes.sums[2 + k]);
                lanes.sums[5 + k] = mean.0[j].mul_add(apart, lanes.sums[5 + k]);
            }
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, lanes: Self::Lanes<S>, scale: &Scale<S>) -> [MixedSum; LANES] {
        let mut all = [MixedSum::default(); LANES];
        let theirs: [f64; LANES] = (scale.value * lanes.sums[0]).into();
        let mean: [f64; LANES] = (scale.value * lanes.sums[1]).into();
        for lane in 0..LANES {
            all[lane].theirs = theirs[lane];
            all[lane].mean = mean[lane];
        }
        for k in 0..3 {
            let field: [f64; LANES] = (scale.slope * lanes.sums[2 + k]).into();
            let gradient: [f64; LANES] = (scale.slope * lanes.sums[5 + k]).into();
            for lane in 0..LANES {
                all[lane].field[k] = field[lane];
                all[lane].gradient[k] = gradient[lane];
            }
        }
        all
    }
}

/// What all pairs say: density, gradient by h_i, and [`Mixed`]; the gradient of the targets alone.
struct Expected<const D: usize> {
    density: f64,
    gradient: [f64; D],
    of_targets: [f64; D],
    theirs: f64,
    mean: f64,
    field: [f64; D],
    mean_gradient: [f64; D],
}

struct Set<'a, const D: usize> {
    domain: Domain<D>,
    positions: &'a [[f64; D]],
    weights: &'a [f64],
    sizes: &'a [f64],
    field: &'a [f64],
}

fn is_target(i: usize) -> bool {
    i % 5 != 2
}

impl<const D: usize> Set<'_, D> {
    fn expected<K: Kernel<D>>(&self, of: impl Fn(f64) -> K, i: usize) -> Expected<D> {
        let box_size = self.domain.bounds.size();
        let mut sums = Expected {
            density: 0.0,
            gradient: [0.0; D],
            of_targets: [0.0; D],
            theirs: 0.0,
            mean: 0.0,
            field: [0.0; D],
            mean_gradient: [0.0; D],
        };
        let away = (3.0 * self.sizes.iter().copied().fold(0.0, f64::max)).ceil() as i32 + 1;
        let steps = 2 * away + 1;
        for (j, &q) in self.positions.iter().enumerate() {
            let base = point::sub(self.domain.wrap(self.positions[i]), self.domain.wrap(q));
            for code in 0..steps.pow(D as u32) {
                let step: [i32; D] =
                    std::array::from_fn(|k| code / steps.pow(k as u32) % steps - away);
                if (0..D).any(|k| !self.domain.periodic[k] && step[k] != 0) {
                    continue;
                }
                let d: [f64; D] =
                    std::array::from_fn(|k| base[k] + f64::from(step[k]) * box_size[k]);
                let r = point::norm(d);
                let (own, theirs) = (of(self.sizes[i]), of(self.sizes[j]));
                let mean = of((0.5 * (self.sizes[i].powi(2) + self.sizes[j].powi(2))).sqrt());
                let w = self.weights[j];
                sums.density += w * own.value(r);
                sums.theirs += w * theirs.value(r);
                sums.mean += w * mean.value(r);
                if r == 0.0 {
                    continue;
                }
                let slope = w * own.slope(r) / r;
                sums.gradient = point::add_scaled(sums.gradient, slope, d);
                if is_target(j) {
                    sums.of_targets = point::add_scaled(sums.of_targets, slope, d);
                }
                let jump = w * theirs.slope(r) / r * (self.field[i] - self.field[j]);
                sums.field = point::add_scaled(sums.field, jump, d);
                sums.mean_gradient =
                    point::add_scaled(sums.mean_gradient, w * mean.slope(r) / r, d);
            }
        }
        sums
    }

    fn check<K: Kernel<D>>(&self, of: impl Fn(f64) -> K + Copy) -> Result<(), TestCaseError> {
        let kernel = of(1.0);
        let support = K::Profile::SUPPORT;
        let supports: Vec<f64> = self.sizes.iter().map(|h| support * h).collect();
        // In parts of the support.
        let parts = shells(kernel, 0.0).map(|r| r / support);
        let more: [&[f64]; 1] = [self.field];
        let fields = Fields::new(kernel, self.positions, self.weights)
            .with_smoothing_lengths(self.sizes)
            .with_more(&more);
        for shells in [None, Some(parts)] {
            let mut list = CellList::new(&self.domain, 0.0).with_skin(0.1);
            if let Some(shells) = shells {
                list.set_shells(shells);
            }
            list.update_each(self.positions, &supports, is_target);
            for level in levels() {
                let pairs = Pairs::new(&list).with_level(level);
                let all = pairs.sum(&(Density, Gradient, Mixed, TargetGradient), &fields);
                for (i, &(density, gradient, mixed, of_targets)) in all.iter().enumerate() {
                    if !is_target(i) {
                        prop_assert_eq!(density.whole, 0.0);
                        continue;
                    }
                    let expected = self.expected(of, i);
                    // Magnitudes of the terms, which may cancel.
                    let most = expected.density + expected.theirs + expected.mean;
                    let steep = most / self.sizes.iter().copied().fold(f64::INFINITY, f64::min);
                    let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * most;
                    let along = |a: [f64; 3], b: [f64; D]| {
                        (0..D).all(|k| (a[k] - b[k]).abs() <= 1e-11 * steep)
                    };
                    prop_assert!(near(density.whole, expected.density), "{level:?} {i}");
                    prop_assert!(near(mixed.theirs, expected.theirs), "{level:?} {i}");
                    prop_assert!(near(mixed.mean, expected.mean), "{level:?} {i}");
                    prop_assert!(along(gradient, expected.gradient), "{level:?} {i}");
                    prop_assert!(along(of_targets, expected.of_targets), "{level:?} {i}");
                    prop_assert!(along(mixed.field, expected.field), "{level:?} {i}");
                    prop_assert!(
                        along(mixed.gradient, expected.mean_gradient),
                        "{level:?} {i}"
                    );
                }
            }
        }
        Ok(())
    }
}

fn check<const D: usize>(
    positions: &[[f64; D]],
    (least, ratio, kind): (f64, f64, usize),
    periodic: [bool; D],
) -> Result<(), TestCaseError> {
    let part = |i: usize, p: &[f64; D]| match kind % 3 {
        0 => (i as f64 * 0.618_033_988_749).fract(),
        1 => p[0],
        _ => f64::from(u8::from(i.is_multiple_of(5))),
    };
    let sizes: Vec<f64> = (positions.iter().enumerate())
        .map(|(i, p)| least * ratio.powf(part(i, p)))
        .collect();
    let weights: Vec<f64> = sizes.iter().map(|h| h.powi(D as i32)).collect();
    let field: Vec<f64> = (0..positions.len()).map(|i| (i as f64).cos()).collect();
    let set = Set {
        domain: Domain::new([0.0; D], [1.0; D]).with_periodic(periodic),
        positions,
        weights: &weights,
        sizes: &sizes,
        field: &field,
    };
    match kind / 3 {
        0 => set.check(Quintic::<D>::new),
        _ => set.check(WendlandC4::<D>::new),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn every_particle_has_its_size(
        flat in prop::collection::vec(prop::array::uniform2(0.0..1.0_f64), 1..120),
        solid in prop::collection::vec(prop::array::uniform3(0.0..1.0_f64), 1..60),
        sizes in (0.004..0.03_f64, 1.0..50.0_f64, 0..6_usize),
        periodic in prop::array::uniform3(any::<bool>()),
    ) {
        check(&flat, sizes, [periodic[0], periodic[1]])?;
        check(&solid, (sizes.0, sizes.1.min(0.3 / sizes.0), sizes.2), periodic)?;
    }
}

/// Lists and sums have the same bits for any number of threads.
#[test]
fn threads_change_no_bit() {
    let part = |i: usize, k: usize| ((i * (k + 3) + k) as f64 * 0.618_033_988_749).fract();
    let positions: Vec<[f64; 2]> = (0..5000).map(|i| [part(i, 0), part(i, 1)]).collect();
    let sizes: Vec<f64> = positions
        .iter()
        .map(|p| 0.002 * 10.0_f64.powf(p[0]))
        .collect();
    let supports: Vec<f64> = sizes.iter().map(|h| 3.0 * h).collect();
    let weights: Vec<f64> = sizes.iter().map(|h| h * h).collect();
    let domain = Domain::new([0.0; 2], [1.0; 2]).with_periodic([true, false]);
    let with_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a thread pool");
        pool.install(|| {
            let mut list = CellList::new(&domain, 0.0).with_skin(0.1);
            list.update_each(&positions, &supports, is_target);
            let fields = Fields::new(Quintic::<2>::new(1.0), &positions, &weights)
                .with_smoothing_lengths(&sizes);
            Pairs::new(&list).sum(&(Density, Gradient), &fields)
        })
    };
    let one = with_threads(1);
    assert_eq!(one, with_threads(2));
    assert_eq!(one, with_threads(5));
}
