//! The walk of blocks through their candidates: the only place where kernels meet neighbours.

use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use sphpack_kernels::{Kernel, PIECES, Profile, SMALLEST_Q};
use sphpack_neighbors::{Block, Blocks, GROUP, SHELLS};

use crate::gathered::Gathered;
use crate::group::{Group, Scale, Slots, Targets, Values, halves};
use crate::lanes::{Several, roots};
use crate::term::Term;

/// In parts of h, a distance that is not near zero.
const APART: f64 = 1e-3;

/// The radii of a list's shells for a kernel, in the unit of its smoothing length: where what acts over `short` distances
/// ends, where the kernel's second and third piece begin.
pub fn shells<K: Kernel<D>, const D: usize>(kernel: K, short: f64) -> [f64; SHELLS - 1] {
    const { assert!(PIECES == SHELLS - 1, "a shell for every piece") };
    let [_, second, third] = K::Profile::STARTS.map(|q| q * kernel.smoothing_length());
    // Beyond the first shell nothing repels; beyond the second no distance is near zero, where the roots fail.
    let second = second.max(short).max(APART * kernel.smoothing_length());
    [short, second, third.max(second)]
}

/// Adds up `term` over the blocks of a list. `kernel` gives the shape, and the smoothing length where all have one (scene
/// units). The list's shells must be those of [`shells`], or none. `out` has one entry per target slot.
///
/// # Panics
/// Where `out` is not as long as there are targets.
pub fn walk<K: Kernel<D>, T: Term, const D: usize>(
    level: Level,
    kernel: K,
    term: &T,
    blocks: &Blocks,
    gathered: &Gathered,
    out: &mut [T::Sum],
) {
    let unit = gathered.unit;
    let h = kernel.smoothing_length() * unit;
    let value = K::Profile::SIGMA / h.powi(D as i32);
    let run = Run {
        term: &term.in_unit(unit),
        gathered,
        smoothing_length: h,
        units: unit.powi(D as i32),
        value: value * unit.powi(D as i32),
        slope: value / h * K::Profile::SLOPE * unit.powi(D as i32 + 1),
        unit,
    };
    blocks.for_each(out, |block, out| {
        dispatch!(level, simd => block_sums::<_, K::Profile, T, D>(simd, &run, block, out));
    });
}

/// What is the same for all blocks, in the loop's unit of length.
struct Run<'a, T> {
    term: &'a T,
    gathered: &'a Gathered,
    /// Of all, where sources have no own.
    smoothing_length: f64,
    /// From Σ w to Γ, for that h.
    value: f64,
    /// From Σ w'/SLOPE to ∇Γ, for that h.
    slope: f64,
    unit: f64,
    /// unit^D.
    units: f64,
}

// A closure that does vector arithmetic must be inlined by force, or the vector instructions cannot be inlined into
// it: so plain loops here, no `from_fn` or `map` over vectors.
#[inline(always)]
fn block_sums<S: Simd, P: Profile<D>, T: Term, const D: usize>(
    simd: S,
    run: &Run<'_, T>,
    block: Block<'_>,
    out: &mut [T::Sum],
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let mut walk = Walk::<S, T, D>::new(simd, run, &block);
            for are_targets in [true, false] {
                if !are_targets && !T::OTHERS {
                    break;
                }
                for group in block.full(0, are_targets) {
                    walk.add::<P, 0>(Slots::Full(group), are_targets, true);
                }
                for group in block.full(1, are_targets) {
                    walk.add::<P, 0>(Slots::Full(group), are_targets, false);
                }
                for group in block.full(2, are_targets) {
                    walk.add::<P, 1>(Slots::Full(group), are_targets, false);
                }
                for group in block.full(3, are_targets) {
                    walk.add::<P, 2>(Slots::Full(group), are_targets, false);
                }
                for group in block.split(are_targets) {
                    walk.add::<P, 2>(Slots::Split(group), are_targets, false);
                }
                if are_targets {
                    run.term.targets_are_done(&mut walk.sums);
                }
            }
            let scale = walk.scale::<P>();
            let sums = run.term.finish(walk.sums, &scale);
            out.copy_from_slice(&sums[..out.len()]);
        },
    );
}

/// A block on its walk through its candidates.
struct Walk<'a, S: Simd, T: Term, const D: usize> {
    simd: S,
    run: &'a Run<'a, T>,
    /// Coordinates of the targets.
    x: [f64x8<S>; D],
    /// 1/h of the targets.
    inverse: f64x8<S>,
    /// h of the targets.
    size: f64x8<S>,
    sums: T::Lanes<S>,
}

impl<'a, S: Simd, T: Term, const D: usize> Walk<'a, S, T, D> {
    /// A walk that has not begun. Lanes beyond a short block repeat its last particle and are dropped at the end.
    #[inline(always)]
    fn new(simd: S, run: &'a Run<'a, T>, block: &Block<'_>) -> Self {
        let gathered = run.gathered;
        let targets = Targets {
            simd,
            first_slot: block.first_slot,
            last: block.len - 1,
            gathered,
        };
        let mut x = [f64x8::splat(simd, 0.0); D];
        for k in 0..D {
            x[k] = targets.load(|slot| gathered.slots[slot][k]);
        }
        let mut size = f64x8::splat(simd, run.smoothing_length);
        let mut inverse = f64x8::splat(simd, 1.0 / run.smoothing_length);
        if !gathered.sizes.is_empty() {
            size = targets.load(|slot| gathered.sizes[slot][0]);
            inverse = targets.load(|slot| gathered.sizes[slot][1]);
        }
        Self {
            simd,
            run,
            x,
            inverse,
            size,
            sums: run.term.start(&targets),
        }
    }

    /// Adds a group of which all are as far away as the kernel's piece begins.
    #[inline(always)]
    fn add<P: Profile<D>, const PIECE: usize>(
        &mut self,
        slots: Slots<'_>,
        are_targets: bool,
        is_near: bool,
    ) {
        let (simd, gathered) = (self.simd, self.run.gathered);
        let zero = f64x8::splat(simd, 0.0);
        let mut apart = [[zero; D]; GROUP];
        let mut square = [zero; GROUP];
        let mut weight = [zero; GROUP];
        let sources = &gathered.slots[..];
        match slots {
            Slots::Full(slots) => {
                for j in 0..GROUP {
                    let slot = &sources[slots[j] as usize];
                    for k in 0..D {
                        apart[j][k] = self.x[k] - f64x8::splat(simd, slot[k]);
                    }
                    weight[j] = f64x8::splat(simd, slot[3]);
                }
            }
            Slots::Split(slots) => {
                for j in 0..GROUP {
                    let one = &sources[slots[2 * j] as usize];
                    let two = &sources[slots[2 * j + 1] as usize];
                    for k in 0..D {
                        apart[j][k] = self.x[k] - halves(simd, one[k], two[k]);
                    }
                    weight[j] = halves(simd, one[3], two[3]);
                }
            }
        }
        for j in 0..GROUP {
            square[j] = apart[j][0] * apart[j][0];
        }
        for k in 1..D {
            for j in 0..GROUP {
                square[j] = apart[j][k].mul_add(apart[j][k], square[j]);
            }
        }
        let mut at_least = square;
        if PIECE == 0 {
            let smallest = f64x8::splat(simd, SMALLEST_Q) * self.size;
            for j in 0..GROUP {
                at_least[j] = square[j].max(smallest * smallest);
            }
        }
        let (r, inverse) = roots(Several(at_least));
        let by_own = Several([self.inverse; GROUP]);
        // The kernel is most of a pair: only those that the term asks for, and each in one place whether sizes differ or not,
        // or the loop has too many numbers for its registers.
        let own = if T::OWN {
            values::<S, P, PIECE, D>(r, by_own)
        } else {
            let none = Several([zero; GROUP]);
            Values {
                value: none,
                slope: none,
            }
        };
        let (mut theirs, mut mean) = (own, own);
        let sizes = &gathered.sizes[..];
        if T::THEIRS {
            let of = if sizes.is_empty() {
                by_own
            } else {
                Several(slots.load(simd, |slot| sizes[slot][1]))
            };
            theirs = relative(values::<S, P, PIECE, D>(r, of), self.size, of, D);
        }
        if T::MEAN {
            let mut square = [self.size; GROUP];
            if !sizes.is_empty() {
                square = slots.load(simd, |slot| sizes[slot][0]);
            }
            let half = f64x8::splat(simd, 0.5);
            for j in 0..GROUP {
                let theirs = half * square[j] * square[j];
                square[j] = (half * self.size).mul_add(self.size, theirs);
            }
            let of = roots(Several(square)).1;
            mean = relative(values::<S, P, PIECE, D>(r, of), self.size, of, D);
        }
        let mut curvature = own.slope;
        if T::CURVATURE {
            let of = Several([self.inverse; GROUP]);
            curvature = P::curvature::<_, PIECE>(r, of) * of;
        }
        let group = Group {
            simd,
            apart,
            square,
            inverse,
            weight,
            own,
            theirs,
            mean,
            curvature,
            are_targets,
            is_near,
            size: self.size,
            slots,
            gathered,
        };
        self.run.term.add(&mut self.sums, &group);
    }

    #[inline(always)]
    fn scale<P: Profile<D>>(&self) -> Scale<S> {
        let (simd, run) = (self.simd, self.run);
        if run.gathered.sizes.is_empty() {
            return Scale {
                value: f64x8::splat(simd, run.value),
                slope: f64x8::splat(simd, run.slope),
                over_r: f64x8::splat(simd, run.slope * run.unit),
            };
        }
        let mut value = f64x8::splat(simd, P::SIGMA * run.units);
        for _ in 0..D {
            value *= self.inverse;
        }
        let slope = value * self.inverse * f64x8::splat(simd, P::SLOPE * run.unit);
        Scale {
            value,
            slope,
            over_r: slope * f64x8::splat(simd, run.unit),
        }
    }
}

#[inline(always)]
fn values<S: Simd, P: Profile<D>, const PIECE: usize, const D: usize>(
    r: Several<S>,
    inverse: Several<S>,
) -> Values<S> {
    let (value, slope) = P::value_and_slope::<_, PIECE>(r, inverse);
    Values { value, slope }
}

/// Values by another h, of which `inverse` is the inverse, such that the targets' own scale applies to them.
#[inline(always)]
fn relative<S: Simd>(
    values: Values<S>,
    own: f64x8<S>,
    inverse: Several<S>,
    dimension: usize,
) -> Values<S> {
    let ratio = Several([own; GROUP]) * inverse;
    let mut power = ratio;
    for _ in 1..dimension {
        power = power * ratio;
    }
    Values {
        value: values.value * power,
        slope: values.slope * power * ratio,
    }
}
