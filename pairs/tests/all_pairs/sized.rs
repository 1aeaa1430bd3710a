//! Densities by either smoothing length of a pair or their mean, and the repulsion between particles of many sizes, against all pairs and
//! differences.

use proptest::prelude::*;
use sphpack_kernels::{Kernel, Quintic};
use sphpack_neighbors::{CellList, Domain, point};
use sphpack_pairs::{
    DensityBy, Fields, Gather, Length, Mean, Pairs, Repulsion, Scatter, SizedRepulsion, shells,
};

use super::levels;

/// A set of particles, each with its h, in an open box.
struct Set<const D: usize> {
    positions: Vec<[f64; D]>,
    sizes: Vec<f64>,
}

impl<const D: usize> Set<D> {
    fn of(positions: &[[f64; D]], (least, ratio): (f64, f64)) -> Self {
        let size = |i: usize| least * ratio.powf((i as f64 * 0.618_033_988_749).fract());
        Self {
            sizes: (0..positions.len()).map(size).collect(),
            positions: positions.to_vec(),
        }
    }

    fn weight(&self, i: usize) -> f64 {
        self.sizes[i].powi(D as i32) * (1.0 + 0.5 * (i as f64).sin())
    }

    /// Value, gradient and stretch of particle `i`, by an h² of which so much is its own.
    fn density(&self, own_part: f64, i: usize) -> (f64, [f64; D], f64) {
        let (mut value, mut gradient, mut stretch) = (0.0, [0.0; D], 0.0);
        for j in 0..self.positions.len() {
            let [own, their] = [self.sizes[i], self.sizes[j]].map(|h| h * h);
            let kernel = Quintic::<D>::new((own_part * own + (1.0 - own_part) * their).sqrt());
            let d = point::sub(self.positions[i], self.positions[j]);
            let r = point::norm(d);
            value += self.weight(j) * kernel.value(r);
            gradient = point::add_scaled(gradient, self.weight(j), kernel.gradient(d));
            stretch += self.weight(j) * r * kernel.slope(r);
        }
        (value, gradient, stretch)
    }

    /// The energy of all pairs, of which `at_size` (given at h = 1) repels at the mean h.
    fn energy(&self, at_size: &Repulsion, by_volume: bool) -> f64 {
        let mut energy = 0.0;
        for i in 0..self.positions.len() {
            for j in 0..i {
                let mean = 0.5 * (self.sizes[i] + self.sizes[j]);
                let r = point::distance(self.positions[i], self.positions[j]);
                let volume = if by_volume { mean.powi(D as i32) } else { 1.0 };
                energy += at_size.potential(r / mean) * volume;
            }
        }
        energy
    }

    fn check(&self) -> Result<(), TestCaseError> {
        let all = 0..self.positions.len();
        let weights: Vec<f64> = all.clone().map(|i| self.weight(i)).collect();
        let unit = Quintic::<D>::new(1.0);
        let support = unit.support();
        let supports: Vec<f64> = self.sizes.iter().map(|h| support * h).collect();
        let fields =
            Fields::new(unit, &self.positions, &weights).with_smoothing_lengths(&self.sizes);
        let repulsion = Repulsion::new(0.8, 0.01);
        let domain = Domain::new([0.0; D], [1.0; D]);
        let mut list = CellList::new(&domain, 0.0).with_skin(0.1);
        list.set_shells(shells(unit, repulsion.reach()).map(|r| r / support));
        list.update_each(&self.positions, &supports, |_| true);
        for level in levels() {
            let pairs = Pairs::new(&list).with_level(level);
            self.check_density::<Gather>(&pairs, &fields, 1.0)?;
            self.check_density::<Scatter>(&pairs, &fields, 0.0)?;
            self.check_density::<Mean>(&pairs, &fields, 0.5)?;
            for by_volume in [false, true] {
                let term = SizedRepulsion {
                    repulsion: repulsion.at_size(1.0),
                    by_volume,
                };
                let sums = pairs.sum(&term, &fields);
                let energy: f64 = sums.iter().map(|sum| sum.energy).sum();
                let expected = self.energy(&repulsion, by_volume);
                prop_assert!((energy - expected).abs() <= 1e-10 * expected.max(1e-30));
                self.check_slopes(&sums, &repulsion, by_volume)?;
            }
        }
        Ok(())
    }

    fn check_density<L: Length>(
        &self,
        pairs: &Pairs<'_, D>,
        fields: &Fields<'_, Quintic<D>, D>,
        own_part: f64,
    ) -> Result<(), TestCaseError> {
        let sums = pairs.sum(&DensityBy::<L>::default(), fields);
        for i in 0..self.positions.len() {
            let (value, gradient, stretch) = self.density(own_part, i);
            let stretch = if own_part == 1.0 { stretch } else { 0.0 };
            let sum = &sums[i];
            let near = |a: f64, b: f64, size: f64| (a - b).abs() <= 1e-11 * size;
            let steep = 4.0 * value / self.sizes[i] + point::norm(gradient);
            prop_assert!(near(sum.value, value, value), "{own_part} {i}");
            prop_assert!(near(sum.stretch, stretch, 10.0 * value), "{own_part} {i}");
            for k in 0..D {
                prop_assert!(near(sum.gradient[k], gradient[k], steep * 10.0));
            }
        }
        Ok(())
    }

    /// Forces and answers to sizes against differences, for a few particles.
    fn check_slopes(
        &self,
        sums: &[sphpack_pairs::SizedRepulsionSum],
        repulsion: &Repulsion,
        by_volume: bool,
    ) -> Result<(), TestCaseError> {
        for i in (0..sums.len()).step_by(sums.len().div_ceil(4)) {
            let slope = |change: &dyn Fn(&mut Self, f64), step: f64| {
                let at = |step: f64| {
                    let mut moved = Self {
                        positions: self.positions.clone(),
                        sizes: self.sizes.clone(),
                    };
                    change(&mut moved, step);
                    moved.energy(repulsion, by_volume)
                };
                (at(step) - at(-step)) / (2.0 * step)
            };
            let h = self.sizes[i];
            let step = 1e-7 * h;
            // Of one pair in the core, for its size.
            let volume = if by_volume { h.powi(D as i32) } else { 1.0 };
            let steep = repulsion.force(0.0) / h * volume * sums.len() as f64;
            for k in 0..D {
                let measured = slope(&|set, step| set.positions[i][k] += step, step);
                prop_assert!(
                    (measured + sums[i].force[k]).abs() < 1e-5 * steep,
                    "{i} {k}"
                );
            }
            if !by_volume {
                let measured = slope(&|set, step| set.sizes[i] += step, step);
                prop_assert!(
                    (measured - sums[i].by_size).abs() < 1e-5 * steep,
                    "{i}: {measured} {}",
                    sums[i].by_size
                );
            }
        }
        Ok(())
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn sums_of_many_sizes_are_those_of_all_pairs(
        flat in prop::collection::vec(prop::array::uniform2(0.0..1.0_f64), 2..60),
        solid in prop::collection::vec(prop::array::uniform3(0.0..1.0_f64), 2..40),
        sizes in (0.02..0.1_f64, 1.0..8.0_f64),
    ) {
        Set::of(&flat, sizes).check()?;
        Set::of(&solid, sizes).check()?;
    }
}
