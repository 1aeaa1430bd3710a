//! A group of candidates against eight targets, as one number of the kernels; and roots without a division.

use std::ops::{Add, Mul, Neg, Sub};

use fearless_simd::{Level, Simd, f32x16, f64x8, prelude::*};
use sphpack_kernels::Number;
use sphpack_neighbors::GROUP;

/// √x and 1/√x, to the last digits but one: a rough 1/√x and one step of third order. A root and a division of doubles
/// take longer than all the rest of a pair.
#[inline(always)]
pub(crate) fn roots<S: Simd>(x: Several<S>) -> (Several<S>, Several<S>) {
    let mut y = x;
    for j in 0..GROUP {
        y.0[j] = rough_inverse_root(x.0[j]);
    }
    let t = x * y;
    let e = t.multiply_add(y, x.constant(-1.0));
    let p = e.multiply_add(x.constant(-5.0 / 16.0), x.constant(3.0 / 8.0));
    let p = p.multiply_add(e, x.constant(-0.5));
    let p = p * e;
    (p.multiply_add(t, t), p.multiply_add(y, y))
}

/// 1/√x to 13 bits or better, for x in the range of single precision.
#[inline(always)]
fn rough_inverse_root<S: Simd>(x: f64x8<S>) -> f64x8<S> {
    match x.simd.level() {
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(avx512) => {
            let lanes: [f64; 8] = x.into();
            let y = rsqrt14(avx512, lanes.simd_into(avx512));
            let lanes: [f64; 8] = y.into();
            lanes.simd_into(x.simd)
        }
        _ => {
            let y = x.simd.narrow_f64x8(x, x).sqrt();
            let y = f32x16::splat(x.simd, 1.0) / y;
            x.simd.widen_f32x16(y).0
        }
    }
}

fearless_simd::kernel!(
    #[inline(always)]
    fn rsqrt14(
        token: Avx512,
        x: f64x8<fearless_simd::x86::Avx512>,
    ) -> f64x8<fearless_simd::x86::Avx512> {
        core::arch::x86_64::_mm512_rsqrt14_pd(x.into()).simd_into(token)
    }
);

/// A group's lanes side by side, for the kernels.
#[derive(Debug, Clone, Copy)]
pub struct Several<S: Simd>(
    /// Vector by vector.
    pub [f64x8<S>; GROUP],
);

impl<S: Simd> Add for Several<S> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        for j in 0..GROUP {
            self.0[j] += other.0[j];
        }
        self
    }
}

impl<S: Simd> Sub for Several<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        for j in 0..GROUP {
            self.0[j] -= other.0[j];
        }
        self
    }
}

impl<S: Simd> Mul for Several<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, other: Self) -> Self {
        for j in 0..GROUP {
            self.0[j] *= other.0[j];
        }
        self
    }
}

impl<S: Simd> Neg for Several<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        for j in 0..GROUP {
            self.0[j] = -self.0[j];
        }
        self
    }
}

impl<S: Simd> Number for Several<S> {
    #[inline(always)]
    fn constant(self, c: f64) -> Self {
        Self([f64x8::splat(self.0[0].simd, c); GROUP])
    }

    #[inline(always)]
    fn at_least(mut self, c: f64) -> Self {
        for j in 0..GROUP {
            self.0[j] = self.0[j].max(f64x8::splat(self.0[j].simd, c));
        }
        self
    }

    #[inline(always)]
    fn multiply_add(mut self, b: Self, c: Self) -> Self {
        for j in 0..GROUP {
            self.0[j] = self.0[j].mul_add(b.0[j], c.0[j]);
        }
        self
    }
}
