//! What kernels compute with: one number, or several side by side.

use std::ops::{Add, Mul, Neg, Sub};

/// A number, or a fixed count of numbers worked on at the same time. Implemented for `f64`; a vector type of several
/// lanes needs a newtype of the caller's.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The constant `c`, in the shape of `self`, whose value does not matter.
    fn constant(self, c: f64) -> Self;

    /// max(self, c).
    fn at_least(self, c: f64) -> Self;

    /// self · b + c; rounded once or twice, whichever is faster.
    fn multiply_add(self, b: Self, c: Self) -> Self;

    /// max(self, 0).
    #[inline(always)]
    fn positive(self) -> Self {
        self.at_least(0.0)
    }
}

impl Number for f64 {
    #[inline(always)]
    fn constant(self, c: f64) -> Self {
        c
    }

    #[inline(always)]
    fn at_least(self, c: f64) -> Self {
        // One instruction; `f64::max` also sorts out NaN, which costs two more.
        if self > c { self } else { c }
    }

    #[inline(always)]
    fn multiply_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
}
