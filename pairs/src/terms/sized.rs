//! Terms for particles of many sizes: a density by whichever smoothing length of a pair, and a repulsion that knows what it does
//! to sizes.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};

use crate::group::{Group, Scale, Targets, Values};
use crate::lanes::Several;
use crate::term::Term;
use crate::terms::Repulsion;

/// Whose smoothing length a kernel takes.
pub trait Length: Copy + std::fmt::Debug + Default + PartialEq + Send + Sync + 'static {
    /// Whether it is the target's own.
    const OWN: bool = false;
    /// Whether it is the source's.
    const THEIRS: bool = false;

    /// The kernel by it.
    fn of<S: Simd, const D: usize>(group: &Group<'_, S, D>) -> Values<S>;
}

/// The target's own h.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Gather;

/// The source's h.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Scatter;

/// The root mean square of both.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Mean;

impl Length for Gather {
    const OWN: bool = true;

    #[inline(always)]
    fn of<S: Simd, const D: usize>(group: &Group<'_, S, D>) -> Values<S> {
        group.own
    }
}

impl Length for Scatter {
    const THEIRS: bool = true;

    #[inline(always)]
    fn of<S: Simd, const D: usize>(group: &Group<'_, S, D>) -> Values<S> {
        group.theirs
    }
}

impl Length for Mean {
    #[inline(always)]
    fn of<S: Simd, const D: usize>(group: &Group<'_, S, D>) -> Values<S> {
        group.mean
    }
}

/// Σ_j w_j W(r_ij, h) by the h of `L`, its gradient and, by the target's own, how it answers to h.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DensityBy<L> {
    by: L,
    /// The unit of the loop's lengths.
    unit: f64,
}

/// The sums of [`DensityBy`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DensityBySum {
    /// Σ_j w_j W.
    pub value: f64,
    /// Σ_j w_j ∇_iW; coordinates beyond D are zero.
    pub gradient: [f64; 3],
    /// By the target's own h, Σ_j w_j r_ij W': ∂(Σ_j w_j W)/∂h_i = −(D value + this)/h_i. Else zero.
    pub stretch: f64,
}

impl<L: Length> Term for DensityBy<L> {
    type Sum = DensityBySum;
    /// Gradient, value, stretch.
    type Lanes<S: Simd> = [f64x8<S>; 5];

    const OWN: bool = L::OWN;
    const THEIRS: bool = L::THEIRS;
    const MEAN: bool = !L::OWN && !L::THEIRS;

    fn in_unit(&self, unit: f64) -> Self {
        Self { unit, ..*self }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S> {
        [f64x8::splat(targets.simd, 0.0); 5]
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut Self::Lanes<S>, group: &Group<'_, S, D>) {
        let weight = Several(group.weight);
        let kernel = L::of(group);
        let over_r = kernel.slope * group.inverse * weight;
        for j in 0..GROUP {
            sums[3] = weight.0[j].mul_add(kernel.value.0[j], sums[3]);
            if L::OWN {
                sums[4] = over_r.0[j].mul_add(group.square[j], sums[4]);
            }
            for k in 0..D {
                sums[k] = over_r.0[j].mul_add(group.apart[j][k], sums[k]);
            }
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: Self::Lanes<S>, scale: &Scale<S>) -> [Self::Sum; LANES] {
        let value: [f64; LANES] = (scale.value * sums[3]).into();
        let mut all = [DensityBySum::default(); LANES];
        for lane in 0..LANES {
            all[lane].value = value[lane];
        }
        if L::OWN {
            let per_unit = f64x8::splat(sums[4].simd, 1.0 / self.unit);
            let stretch: [f64; LANES] = (scale.slope * per_unit * sums[4]).into();
            for lane in 0..LANES {
                all[lane].stretch = stretch[lane];
            }
        }
        for k in 0..3 {
            let lanes: [f64; LANES] = (scale.slope * sums[k]).into();
            for lane in 0..LANES {
                all[lane].gradient[k] = lanes[lane];
            }
        }
        all
    }
}

/// A [`Repulsion`] given [at a size](Repulsion::at_size), between particles of many sizes: lengths scale with the mean h of
/// a pair, the potential with a power of it. Every pair counts half for each of its particles, images and other sources too.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizedRepulsion {
    /// For the size that it is given at.
    pub repulsion: Repulsion,
    /// Whether the potential is in proportion to the volume of a pair, h̄^D; else it is the same for all sizes.
    pub by_volume: bool,
}

/// The sums of [`SizedRepulsion`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SizedRepulsionSum {
    /// Minus the energy's gradient, sizes kept; coordinates beyond D are zero.
    pub force: [f64; 3],
    /// Half of the energy of every pair.
    pub energy: f64,
    /// The energy's derivative by the target's size over that which the repulsion is given at, were the potential
    /// the same for all sizes.
    pub by_size: f64,
}

/// Sums on their way.
#[derive(Debug, Clone, Copy)]
pub struct SizedRepulsionLanes<S: Simd> {
    force: [f64x8<S>; 3],
    energy: f64x8<S>,
    by_size: f64x8<S>,
}

impl Term for SizedRepulsion {
    type Sum = SizedRepulsionSum;
    type Lanes<S: Simd> = SizedRepulsionLanes<S>;

    const OWN: bool = false;

    fn in_unit(&self, unit: f64) -> Self {
        Self {
            repulsion: self.repulsion.in_unit(unit),
            ..*self
        }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S> {
        let zero = f64x8::splat(targets.simd, 0.0);
        SizedRepulsionLanes {
            force: [zero; 3],
            energy: zero,
            by_size: zero,
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut Self::Lanes<S>, group: &Group<'_, S, D>) {
        if !group.is_near || self.repulsion.is_none() {
            return;
        }
        let one = f64x8::splat(group.simd, 1.0);
        let half = f64x8::splat(group.simd, 0.5);
        let larger = group.mean_over(self.repulsion.size());
        for j in 0..GROUP {
            // By how much the pair is larger than what the repulsion is for.
            let larger = match larger {
                Some(larger) => larger[j],
                None => one,
            };
            if !(self.repulsion).reaches(group.square[j], larger) {
                continue;
            }
            let smaller = one / larger;
            let inverse = group.inverse.0[j];
            let scaled =
                (self.repulsion).pair(group.square[j] * smaller * smaller, inverse * larger);
            let Some([force, mut potential]) = scaled else {
                continue;
            };
            let mut push = force * inverse * smaller;
            let along = push * group.square[j] * smaller;
            sums.by_size = along.mul_add(half, sums.by_size);
            if self.by_volume {
                for _ in 0..D {
                    push *= larger;
                    potential *= larger;
                }
            }
            for k in 0..D {
                sums.force[k] = push.mul_add(group.apart[j][k], sums.force[k]);
            }
            sums.energy = potential.mul_add(half, sums.energy);
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: Self::Lanes<S>, _: &Scale<S>) -> [Self::Sum; LANES] {
        let scale = f64x8::splat(sums.energy.simd, self.repulsion.energy_scale());
        let energy: [f64; LANES] = (scale * sums.energy).into();
        let by_size: [f64; LANES] = (scale * sums.by_size).into();
        let mut all = [SizedRepulsionSum::default(); LANES];
        for k in 0..3 {
            let lanes: [f64; LANES] = sums.force[k].into();
            for lane in 0..LANES {
                all[lane].force[k] = lanes[lane];
            }
        }
        for lane in 0..LANES {
            all[lane].energy = energy[lane];
            all[lane].by_size = by_size[lane];
        }
        all
    }
}
