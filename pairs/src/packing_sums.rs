//! The sums that settling takes, compiled with this crate for every kernel.

use fearless_simd::Level;
use sphpack_kernels::{CohesionPotential, Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{Blocks, SHELLS};

use crate::gathered::Gathered;
use crate::term::Term;
use crate::terms::{
    Density, DensityBy, DensityBySum, Gather, Gradient, Mean, Repulsion, Scatter, SizedRepulsion,
    TargetGradient, Variation, VariationSum,
};
use crate::walk::{shells, walk};

/// What acts between pairs, chosen at run time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A smoothing kernel.
    Smoothing(KernelKind),
    /// The [cohesion](CohesionPotential), whose length is its support radius. Only [`PackingSums::sum`] is of it.
    Cohesion,
}

impl Shape {
    /// Runs `work` with the kernel of this shape and length (scene units).
    pub fn with<const D: usize, W: WithKernel<D>>(self, length: f64, work: W) -> W::Output {
        match self {
            Self::Smoothing(kernel) => kernel.with(length, work),
            Self::Cohesion => work.call(CohesionPotential::<D>::new(length)),
        }
    }

    fn kernel(self) -> KernelKind {
        match self {
            Self::Smoothing(kernel) => kernel,
            Self::Cohesion => panic!("of the cohesion there is only the sum of settling"),
        }
    }

    /// [`shells`] of this shape in the plane or in space.
    pub fn shells<const D: usize>(self, length: f64, short: f64) -> [f64; SHELLS - 1] {
        self.with::<D, _>(length, Shells { short })
    }
}

struct Shells {
    short: f64,
}

impl<const D: usize> WithKernel<D> for Shells {
    type Output = [f64; SHELLS - 1];

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        shells(kernel, self.short)
    }
}

/// Density, kernel gradient sum and repulsion, and the gradient of a field: the terms of settling.
#[derive(Debug, Clone, Copy)]
pub struct PackingSums<'a> {
    /// The kernel.
    pub shape: Shape,
    /// Its length (scene units), where sources have no own.
    pub length: f64,
    /// The list's blocks; its shells are [`Shape::shells`].
    pub blocks: &'a Blocks,
    /// Sources.
    pub gathered: &'a Gathered,
    /// The instructions to use.
    pub level: Level,
}

/// The terms of [`PackingSums::sum`].
pub type PackingTerms = (Density, Gradient, Repulsion);

/// What [`PackingSums::sum`] finds for a target.
pub type PackingSum = <PackingTerms as Term>::Sum;

/// What [`PackingSums::gather`] and [`PackingSums::average`] find for a target.
pub type SizedSum = <(DensityBy<Gather>, SizedRepulsion) as Term>::Sum;

impl PackingSums<'_> {
    /// Density, kernel gradient sum and repulsion of every target, `D` of 2 or 3. One entry of `out` per target slot. No
    /// allocation, parallel.
    ///
    /// # Panics
    /// Where `out` is not as long as there are targets.
    pub fn sum<const D: usize>(self, repulsion: Repulsion, out: &mut [PackingSum]) {
        const { assert!(D == 2 || D == 3, "particles are in the plane or in space") };
        let terms = (Density, Gradient, repulsion);
        if D == 2 {
            sum_in_plane(self, &terms, out);
        } else {
            sum_in_space(self, &terms, out);
        }
    }

    /// Σ_j w_j ∇_iW_ij of every target over sources that are targets. Otherwise as [`PackingSums::sum`].
    ///
    /// # Panics
    /// Where `out` is not as long as there are targets, or the shape is the cohesion.
    pub fn gradient<const D: usize>(self, out: &mut [[f64; 3]]) {
        const { assert!(D == 2 || D == 3, "particles are in the plane or in space") };
        if D == 2 {
            gradient_in_plane(self, &TargetGradient, out);
        } else {
            gradient_in_space(self, &TargetGradient, out);
        }
    }

    /// [`Variation`] of every target. Otherwise as [`PackingSums::sum`].
    ///
    /// # Panics
    /// Where `out` is not as long as there are targets, the shape is the cohesion, or there are not `D + 1` fields.
    pub fn vary<const D: usize>(self, out: &mut [VariationSum]) {
        const { assert!(D == 2 || D == 3, "particles are in the plane or in space") };
        assert_eq!(self.gathered.stride, D + 1, "a number and a vector");
        if D == 2 {
            vary_in_plane(self, &Variation::default(), out);
        } else {
            vary_in_space(self, &Variation::default(), out);
        }
    }

    /// Density by every target's own h, and repulsion, between particles of many sizes. Otherwise as [`PackingSums::sum`].
    ///
    /// # Panics
    /// Where `out` is not as long as there are targets, or the shape is the cohesion.
    pub fn gather<const D: usize>(self, repulsion: SizedRepulsion, out: &mut [SizedSum]) {
        const { assert!(D == 2 || D == 3, "particles are in the plane or in space") };
        let terms = (DensityBy::default(), repulsion);
        if D == 2 {
            gather_in_plane(self, &terms, out);
        } else {
            gather_in_space(self, &terms, out);
        }
    }

    /// Density by the mean h of every pair, and repulsion, between particles of many sizes. Otherwise as [`PackingSums::sum`].
    ///
    /// # Panics
    /// Where `out` is not as long as there are targets, or the shape is the cohesion.
    pub fn average<const D: usize>(self, repulsion: SizedRepulsion, out: &mut [SizedSum]) {
        const { assert!(D == 2 || D == 3, "particles are in the plane or in space") };
        let terms = (DensityBy::default(), repulsion);
        if D == 2 {
            average_in_plane(self, &terms, out);
        } else {
            average_in_space(self, &terms, out);
        }
    }

    /// Density by every source's h. Otherwise as [`PackingSums::sum`].
    ///
    /// # Panics
    /// Where `out` is not as long as there are targets, or the shape is the cohesion.
    pub fn scatter<const D: usize>(self, out: &mut [DensityBySum]) {
        const { assert!(D == 2 || D == 3, "particles are in the plane or in space") };
        if D == 2 {
            scatter_in_plane(self, &DensityBy::default(), out);
        } else {
            scatter_in_space(self, &DensityBy::default(), out);
        }
    }
}

/// Sums of these terms in the plane and in space, of any shape or of its kernel. Not generic, so that the loops, long code for
/// every kernel and vector width, are compiled here, once.
macro_rules! compiled {
    ($($plane:ident, $space:ident: $terms:ty, of $shape:ident $(. $kernel:ident ())?;)+) => {
        $(
            fn $plane(of: PackingSums<'_>, terms: &$terms, out: &mut [<$terms as Term>::Sum]) {
                of.$shape$(.$kernel())?.with::<2, _>(of.length, Work { of, terms, out });
            }

            fn $space(of: PackingSums<'_>, terms: &$terms, out: &mut [<$terms as Term>::Sum]) {
                of.$shape$(.$kernel())?.with::<3, _>(of.length, Work { of, terms, out });
            }
        )+
    };
}

compiled! {
    sum_in_plane, sum_in_space: PackingTerms, of shape;
    gradient_in_plane, gradient_in_space: TargetGradient, of shape.kernel();
    vary_in_plane, vary_in_space: Variation, of shape.kernel();
    gather_in_plane, gather_in_space: (DensityBy<Gather>, SizedRepulsion), of shape.kernel();
    average_in_plane, average_in_space: (DensityBy<Mean>, SizedRepulsion), of shape.kernel();
    scatter_in_plane, scatter_in_space: DensityBy<Scatter>, of shape.kernel();
}

/// Work for whichever kernel.
struct Work<'a, T: Term> {
    of: PackingSums<'a>,
    terms: &'a T,
    out: &'a mut [T::Sum],
}

impl<T: Term, const D: usize> WithKernel<D> for Work<'_, T> {
    type Output = ();

    fn call<K: Kernel<D>>(self, kernel: K) {
        let of = self.of;
        walk(
            of.level,
            kernel,
            self.terms,
            of.blocks,
            of.gathered,
            self.out,
        );
    }
}
