//! What a term sees: eight targets, and the sources that come by.

use fearless_simd::{Simd, f64x4, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};

use crate::gathered::Gathered;
use crate::lanes::Several;

/// W and its slope for a group, without the factors that all sources of a target share ([`Scale`]).
#[derive(Debug, Clone, Copy)]
pub struct Values<S: Simd> {
    /// W = this · [`Scale::value`].
    pub value: Several<S>,
    /// dW/dr = this · [`Scale::slope`].
    pub slope: Several<S>,
}

/// The factors that all sources of a target share: sums are multiplied by them once.
#[derive(Debug, Clone, Copy)]
pub struct Scale<S: Simd> {
    /// Of W.
    pub value: f64x8<S>,
    /// Of dW/dr; with [`Group::apart`] times [`Group::inverse`], of ∇W.
    pub slope: f64x8<S>,
    /// Of (dW/dr)/r, as [`Values::slope`] times [`Group::inverse`] has it.
    pub over_r: f64x8<S>,
}

/// [`GROUP`] vectors of sources before the eight targets of a block. Lengths are multiplied by the sum's unit
/// ([`crate::unit`]).
#[derive(Debug, Clone, Copy)]
pub struct Group<'a, S: Simd, const D: usize> {
    /// The instructions to use.
    pub simd: S,
    /// x_i − x_j.
    pub apart: [[f64x8<S>; D]; GROUP],
    /// r².
    pub square: [f64x8<S>; GROUP],
    /// 1/r, finite where two coincide.
    pub inverse: Several<S>,
    /// The sources' weights, usually V_j; zero for padding.
    pub weight: [f64x8<S>; GROUP],
    /// W(r, h_i), where the term asks for it ([`crate::Term::OWN`]); else zero.
    pub own: Values<S>,
    /// W(r, h_j), where the term asks for it ([`crate::Term::THEIRS`]); else as [`Group::own`].
    pub theirs: Values<S>,
    /// W(r, h̄) with h̄² = (h_i² + h_j²)/2, where the term asks for it ([`crate::Term::MEAN`]); else as [`Group::own`].
    pub mean: Values<S>,
    /// d²W/dr² = this · [`Scale::over_r`] for W(r, h_i), where the term asks for it ([`crate::Term::CURVATURE`]); else as
    /// [`Values::slope`].
    pub curvature: Several<S>,
    /// Whether the sources are targets, or images of targets.
    pub are_targets: bool,
    /// Whether they are in the list's first shell: what acts over short distances has no others.
    pub is_near: bool,
    /// h of the targets.
    pub(crate) size: f64x8<S>,
    pub(crate) slots: Slots<'a>,
    pub(crate) gathered: &'a Gathered,
}

/// The slots of a group's sources.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Slots<'a> {
    /// One source for all targets.
    Full(&'a [u32; GROUP]),
    /// One for each half of them.
    Split(&'a [u32; 2 * GROUP]),
}

/// One number for the first half of the lanes, another for the second.
#[inline(always)]
pub(crate) fn halves<S: Simd>(simd: S, one: f64, two: f64) -> f64x8<S> {
    simd.combine_f64x4(f64x4::splat(simd, one), f64x4::splat(simd, two))
}

impl Slots<'_> {
    /// What `of` says of the sources, lane by lane.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(self, simd: S, of: impl Fn(usize) -> f64) -> [f64x8<S>; GROUP] {
        let mut lanes = [f64x8::splat(simd, 0.0); GROUP];
        match self {
            Self::Full(slots) => {
                for j in 0..GROUP {
                    lanes[j] = f64x8::splat(simd, of(slots[j] as usize));
                }
            }
            Self::Split(slots) => {
                for j in 0..GROUP {
                    let one = of(slots[2 * j] as usize);
                    let two = of(slots[2 * j + 1] as usize);
                    lanes[j] = halves(simd, one, two);
                }
            }
        }
        lanes
    }
}

impl<S: Simd, const D: usize> Group<'_, S, D> {
    /// `size` (in the sum's unit) over the mean h of target and source; `None` where all have one h.
    #[inline(always)]
    pub fn over_mean(&self, size: f64) -> Option<[f64x8<S>; GROUP]> {
        let sizes = &self.gathered.sizes[..];
        if sizes.is_empty() {
            return None;
        }
        let mut over = self.slots.load(self.simd, |slot| sizes[slot][0]);
        let twice = f64x8::splat(self.simd, 2.0 * size);
        for j in 0..GROUP {
            over[j] = twice / (self.size + over[j]);
        }
        Some(over)
    }

    /// The mean h of target and source over `size` (in the sum's unit); `None` where all have one h.
    #[inline(always)]
    pub fn mean_over(&self, size: f64) -> Option<[f64x8<S>; GROUP]> {
        let sizes = &self.gathered.sizes[..];
        if sizes.is_empty() {
            return None;
        }
        let mut over = self.slots.load(self.simd, |slot| sizes[slot][0]);
        let part = f64x8::splat(self.simd, 0.5 / size);
        for j in 0..GROUP {
            over[j] = part * (self.size + over[j]);
        }
        Some(over)
    }

    /// The sources' field of this number ([`crate::Fields::with_more`]).
    #[inline(always)]
    pub fn field(&self, number: usize) -> [f64x8<S>; GROUP] {
        let (more, stride) = (&self.gathered.more[..], self.gathered.stride);
        self.slots
            .load(self.simd, |slot| more[slot * stride + number])
    }
}

/// The targets of a block.
#[derive(Debug, Clone, Copy)]
pub struct Targets<'a, S: Simd> {
    /// The instructions to use.
    pub simd: S,
    pub(crate) first_slot: usize,
    /// The last lane that counts; those beyond repeat it.
    pub(crate) last: usize,
    pub(crate) gathered: &'a Gathered,
}

impl<S: Simd> Targets<'_, S> {
    /// The targets' weights.
    #[inline(always)]
    pub fn weight(&self) -> f64x8<S> {
        let slots = &self.gathered.slots;
        self.load(|slot| slots[slot][3])
    }

    /// How many fields there are.
    #[inline(always)]
    pub fn fields(&self) -> usize {
        self.gathered.stride
    }

    /// The targets' field of this number ([`crate::Fields::with_more`]).
    #[inline(always)]
    pub fn field(&self, number: usize) -> f64x8<S> {
        let (more, stride) = (&self.gathered.more[..], self.gathered.stride);
        self.load(|slot| more[slot * stride + number])
    }

    #[inline(always)]
    pub(crate) fn load(&self, of: impl Fn(usize) -> f64) -> f64x8<S> {
        let lanes: [f64; LANES] =
            std::array::from_fn(|lane| of(self.first_slot + lane.min(self.last)));
        lanes.simd_into(self.simd)
    }
}
