//! The first variation of density and kernel gradient sum, against all pairs, finite differences and its own transpose.

use proptest::prelude::*;
use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{CellList, Domain, point};
use sphpack_pairs::{Density, Fields, Gradient, Pairs, Variation, VariationSum, shells};

use super::{levels, point_sets};

struct Set<'a, const D: usize> {
    domain: Domain<D>,
    positions: &'a [[f64; D]],
    weights: Vec<f64>,
    number: Vec<f64>,
    vector: Vec<[f64; D]>,
}

fn is_target(i: usize) -> bool {
    i % 4 != 3
}

/// Numbers between −½ and ½ that look random.
fn noise(i: usize, k: usize) -> f64 {
    ((i * 7 + k * 13 + 1) as f64 * 0.618_033_988_749).fract() - 0.5
}

impl<'a, const D: usize> Set<'a, D> {
    fn new(positions: &'a [[f64; D]], periodic: [bool; D]) -> Self {
        let all = 0..positions.len();
        Self {
            domain: Domain::new([0.0; D], [1.0; D]).with_periodic(periodic),
            positions,
            weights: all.clone().map(|i| 1.0 + noise(i, 9)).collect(),
            number: all.clone().map(|i| noise(i, 0)).collect(),
            vector: all
                .map(|i| std::array::from_fn(|k| noise(i, k + 1)))
                .collect(),
        }
    }

    /// Every pair and image: the separation, and the other one.
    fn pairs(&self, i: usize) -> impl Iterator<Item = (usize, [f64; D])> {
        let size = self.domain.bounds.size();
        (0..self.positions.len()).flat_map(move |j| {
            let of = |p: [f64; D]| self.domain.wrap(p);
            let base = point::sub(of(self.positions[i]), of(self.positions[j]));
            (0..5_i32.pow(D as u32)).filter_map(move |code| {
                let step: [i32; D] = std::array::from_fn(|k| code / 5_i32.pow(k as u32) % 5 - 2);
                let is_image = (0..D).all(|k| self.domain.periodic[k] || step[k] == 0);
                let d = std::array::from_fn(|k| base[k] + f64::from(step[k]) * size[k]);
                is_image.then_some((j, d))
            })
        })
    }

    fn expected<K: Kernel<D>>(&self, kernel: K, i: usize) -> (VariationSum, f64) {
        let (mut sum, mut size) = (VariationSum::default(), 0.0);
        for (j, d) in self.pairs(i) {
            let r = point::norm(d);
            if r >= kernel.support() {
                continue;
            }
            let u = point::sub(self.vector[i], self.vector[j]);
            let (gradient, hessian) = (kernel.gradient(d), kernel.hessian(d));
            sum.density += self.weights[j] * point::dot(gradient, u);
            for k in 0..D {
                let own = (self.number[i] + self.number[j]) * gradient[k];
                sum.gradient[k] += self.weights[j] * (own + point::dot(hessian[k], u));
            }
            size += self.weights[j] * hessian.iter().map(|row| point::norm(*row)).sum::<f64>();
        }
        (sum, size)
    }

    fn check<K: Kernel<D>>(&self, kernel: K) -> Result<(), TestCaseError> {
        let columns: Vec<Vec<f64>> = (0..D)
            .map(|k| self.vector.iter().map(|u| u[k]).collect())
            .collect();
        let mut more: Vec<&[f64]> = vec![&self.number];
        more.extend(columns.iter().map(Vec::as_slice));
        let fields = Fields::new(kernel, self.positions, &self.weights).with_more(&more);
        for is_in_shells in [false, true] {
            let mut list =
                CellList::new(&self.domain, kernel.support()).with_skin(0.1 * kernel.support());
            if is_in_shells {
                list.set_shells(shells(kernel, 0.0));
            }
            list.update_some(self.positions, is_target);
            for level in levels() {
                let sums = Pairs::new(&list)
                    .with_level(level)
                    .sum(&Variation::default(), &fields);
                for (i, sum) in sums.iter().enumerate() {
                    if !is_target(i) {
                        prop_assert_eq!(*sum, VariationSum::default());
                        continue;
                    }
                    let (expected, size) = self.expected(kernel, i);
                    // Kernels jump in their second derivative, or in none; near a join both sides are right.
                    let most = 1e-9 * size.max(1.0);
                    prop_assert!(
                        (sum.density - expected.density).abs() <= most,
                        "{level:?} {i}: {} {}",
                        sum.density,
                        expected.density
                    );
                    for k in 0..D {
                        prop_assert!(
                            (sum.gradient[k] - expected.gradient[k]).abs() <= most,
                            "{level:?} {i}: {:?} {:?}",
                            sum.gradient,
                            expected.gradient
                        );
                    }
                }
            }
        }
        Ok(())
    }
}

struct Check<'a, const D: usize>(&'a Set<'a, D>);

impl<const D: usize> WithKernel<D> for Check<'_, D> {
    type Output = Result<(), TestCaseError>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        self.0.check(kernel)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn variation_is_that_of_all_pairs(
        flat in point_sets::<2>(),
        solid in point_sets::<3>(),
        kernel in 0..KernelKind::ALL.len(),
        h in 0.02..0.1_f64,
        periodic in prop::array::uniform3(any::<bool>()),
    ) {
        let kernel = KernelKind::ALL[kernel];
        let set = Set::new(&flat, [periodic[0], periodic[1]]);
        kernel.with(h, Check(&set))?;
        let set = Set::new(&solid, periodic);
        kernel.with(h, Check(&set))?;
    }
}

struct ByDifferences;

impl WithKernel<2> for ByDifferences {
    type Output = ();

    /// Γ and ∇Γ of moved particles change by what the variation says; and so does a weighted sum of them by each position.
    fn call<K: Kernel<2>>(self, kernel: K) {
        let positions: Vec<[f64; 2]> = (0..100)
            .map(|i| {
                let site = [0.1 * f64::from(i % 10), 0.1 * f64::from(i / 10)];
                std::array::from_fn(|k| site[k] + 0.02 * noise(i as usize, k))
            })
            .collect();
        let set = Set::new(&positions, [true, false]);
        let volumes: Vec<f64> = set.weights.iter().map(|w| 0.01 * w).collect();
        let mut list = CellList::new(&set.domain, kernel.support()).with_skin(0.01);
        let of = |positions: &[[f64; 2]]| {
            let mut list = CellList::new(&set.domain, kernel.support()).with_skin(0.01);
            list.update(positions);
            let fields = Fields::new(kernel, positions, &volumes);
            Pairs::new(&list).sum(&(Density, Gradient), &fields)
        };
        let moved = |step: f64| -> Vec<[f64; 2]> {
            (positions.iter().zip(&set.vector))
                .map(|(&p, &u)| point::add_scaled(p, step, u))
                .collect()
        };
        list.update(&positions);
        let vary = |number: &[f64], vector: &[[f64; 2]]| {
            let columns: [Vec<f64>; 2] =
                std::array::from_fn(|k| vector.iter().map(|u| u[k]).collect());
            let more: [&[f64]; 3] = [number, &columns[0], &columns[1]];
            let fields = Fields::new(kernel, &positions, &volumes).with_more(&more);
            Pairs::new(&list).sum(&Variation::default(), &fields)
        };
        let step = 1e-6;
        let (up, down) = (of(&moved(step)), of(&moved(-step)));
        let zero = vec![0.0; positions.len()];
        let changes = vary(&zero, &set.vector);
        for ((change, up), down) in changes.iter().zip(&up).zip(&down) {
            let density = (up.0.whole - down.0.whole) / (2.0 * step);
            assert!(
                (density - change.density).abs() < 1e-5,
                "{density} {change:?}"
            );
            for k in 0..2 {
                let gradient = (up.1[k] - down.1[k]) / (2.0 * step);
                assert!(
                    (gradient - change.gradient[k]).abs() < 2e-2,
                    "{gradient} {change:?}"
                );
            }
        }
        // a · δΓ + b · δ∇Γ is the same from either side.
        let a: Vec<f64> = (0..100).map(|i| noise(i, 20)).collect();
        let b: Vec<[f64; 2]> = (0..100).map(|i| [noise(i, 21), noise(i, 22)]).collect();
        let direct: f64 = (changes.iter().zip(&a).zip(&b))
            .map(|((change, a), b)| {
                a * change.density + b[0] * change.gradient[0] + b[1] * change.gradient[1]
            })
            .sum();
        let over: Vec<f64> = a.iter().zip(&volumes).map(|(a, v)| a / v).collect();
        let under: Vec<[f64; 2]> = (b.iter().zip(&volumes))
            .map(|(b, v)| b.map(|b| b / v))
            .collect();
        let transposed: f64 = (vary(&over, &under).iter().zip(&set.vector).zip(&volumes))
            .map(|((sum, u), v)| v * (sum.gradient[0] * u[0] + sum.gradient[1] * u[1]))
            .sum();
        assert!(
            (direct - transposed).abs() < 1e-10 * direct.abs().max(1.0),
            "{direct} {transposed}"
        );
    }
}

#[test]
fn variation_is_the_change_and_its_own_transpose() {
    for kernel in KernelKind::ALL {
        // The cubic spline's second derivative has a kink at every join: differences are rougher there.
        kernel.with(0.12, ByDifferences);
    }
}
