//! The interface of what is added up over pairs.

use fearless_simd::Simd;
use sphpack_neighbors::LANES;

use crate::group::{Group, Scale, Targets};

/// What is added up over the pairs of a target. Several terms in a tuple are added up in one walk.
///
/// Its functions compute with vectors, so they must be `#[inline(always)]`, and use plain loops: vector arithmetic in
/// closures cannot be inlined.
pub trait Term: Clone + Sync {
    /// What a target has in the end; the default is that of a target without sources.
    type Sum: Copy + Default + Send;
    /// The sums of eight targets on the way.
    type Lanes<S: Simd>: Copy;

    /// Whether [`Group::own`] is needed.
    const OWN: bool = true;
    /// Whether [`Group::theirs`] is needed.
    const THEIRS: bool = false;
    /// Whether [`Group::mean`] is needed.
    const MEAN: bool = false;
    /// Whether [`Group::curvature`] is needed.
    const CURVATURE: bool = false;
    /// Whether sources that are no targets count.
    const OTHERS: bool = true;

    /// The same term where lengths are multiplied by `unit`.
    #[must_use]
    fn in_unit(&self, unit: f64) -> Self {
        let _ = unit;
        self.clone()
    }

    /// Sums before the first source.
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S>;

    /// Adds a group of sources.
    fn add<S: Simd, const D: usize>(&self, sums: &mut Self::Lanes<S>, group: &Group<'_, S, D>);

    /// Called when all sources that are targets have been added, and the others come.
    #[inline(always)]
    fn targets_are_done<S: Simd>(&self, sums: &mut Self::Lanes<S>) {
        let _ = sums;
    }

    /// The sums of all eight.
    fn finish<S: Simd>(&self, sums: Self::Lanes<S>, scale: &Scale<S>) -> [Self::Sum; LANES];
}

macro_rules! tuples {
    ($($name:ident $number:tt),+) => {
        impl<$($name: Term),+> Term for ($($name,)+) {
            type Sum = ($($name::Sum,)+);
            type Lanes<S: Simd> = ($($name::Lanes<S>,)+);

            const OWN: bool = $($name::OWN)||+;
            const THEIRS: bool = $($name::THEIRS)||+;
            const MEAN: bool = $($name::MEAN)||+;
            const CURVATURE: bool = $($name::CURVATURE)||+;
            const OTHERS: bool = $($name::OTHERS)||+;

            fn in_unit(&self, unit: f64) -> Self {
                ($(self.$number.in_unit(unit),)+)
            }

            #[inline(always)]
            fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Self::Lanes<S> {
                ($(self.$number.start(targets),)+)
            }

            #[inline(always)]
            fn add<S: Simd, const D: usize>(&self, sums: &mut Self::Lanes<S>, group: &Group<'_, S, D>) {
                $(
                    if $name::OTHERS || group.are_targets {
                        self.$number.add(&mut sums.$number, group);
                    }
                )+
            }

            #[inline(always)]
            fn targets_are_done<S: Simd>(&self, sums: &mut Self::Lanes<S>) {
                $(self.$number.targets_are_done(&mut sums.$number);)+
            }

            #[inline(always)]
            fn finish<S: Simd>(&self, sums: Self::Lanes<S>, scale: &Scale<S>) -> [Self::Sum; LANES] {
                let each = ($(self.$number.finish(sums.$number, scale),)+);
                let mut all = [<Self::Sum>::default(); LANES];
                for lane in 0..LANES {
                    all[lane] = ($(each.$number[lane],)+);
                }
                all
            }
        }
    };
}

tuples!(A 0, B 1);
tuples!(A 0, B 1, C 2);
tuples!(A 0, B 1, C 2, E 3);
