//! Corrected kernel gradients: exact for linear fields, whatever the particles' places.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{GROUP, LANES};
use sphpack_pairs::{Group, Scale, Targets, Term};

use crate::neighborhood::compiled;

/// Entries of a symmetric matrix, row by row from the diagonal on.
pub(super) const fn entries(dimension: usize) -> usize {
    dimension * (dimension + 1) / 2
}

/// The place of one of them.
pub(super) const fn entry(dimension: usize, row: usize, column: usize) -> usize {
    let (first, second) = if row < column {
        (row, column)
    } else {
        (column, row)
    };
    first * dimension - first * first.saturating_sub(1) / 2 + (second - first)
}

/// −Σ_j V_j r_ij ⊗ ∇W_ij, of which the correction is the inverse: a unit matrix where space is evenly filled.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moments {
    /// The sum's unit of length: the moment is one more length than the scale of slopes knows.
    pub(super) unit: f64,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct MomentLanes<S: Simd> {
    sums: [f64x8<S>; 6],
}

impl Term for Moments {
    type Sum = [f64; 6];
    type Lanes<S: Simd> = MomentLanes<S>;

    fn in_unit(&self, unit: f64) -> Self {
        Self { unit }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> MomentLanes<S> {
        MomentLanes {
            sums: [f64x8::splat(targets.simd, 0.0); 6],
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut MomentLanes<S>, group: &Group<'_, S, D>) {
        let gradient = group.own.slope * group.inverse;
        for j in 0..GROUP {
            let x = group.apart[j];
            let along = group.weight[j] * gradient.0[j];
            for row in 0..D {
                let by_row = along * x[row];
                for column in row..D {
                    let sum = &mut sums.sums[entry(D, row, column)];
                    *sum = by_row.mul_add(x[column], *sum);
                }
            }
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: MomentLanes<S>, scale: &Scale<S>) -> [Self::Sum; LANES] {
        let factor = scale.slope * f64x8::splat(scale.slope.simd, -1.0 / self.unit);
        let mut all = [[0.0; 6]; LANES];
        for k in 0..6 {
            let lanes: [f64; LANES] = (factor * sums.sums[k]).into();
            for lane in 0..LANES {
                all[lane][k] = lanes[lane];
            }
        }
        all
    }
}

compiled!(Moments);

/// The inverse of a symmetric matrix in the plane or in space. Of one that has none, as of particles that are alone, the unit matrix.
pub(super) fn inverse<const D: usize>(moments: &[f64; 6]) -> [f64; 6] {
    let m = |row: usize, column: usize| moments[entry(D, row, column)];
    let mut unit = [0.0; 6];
    for k in 0..D {
        unit[entry(D, k, k)] = 1.0;
    }
    let mut cofactors = [0.0; 6];
    if D == 2 {
        cofactors[..3].copy_from_slice(&[m(1, 1), -m(0, 1), m(0, 0)]);
    } else {
        // Of a symmetric matrix rows and columns after a row follow one another in a ring.
        for row in 0..3 {
            for column in row..3 {
                let (a, b) = ((row + 1) % 3, (row + 2) % 3);
                let (c, d) = ((column + 1) % 3, (column + 2) % 3);
                cofactors[entry(3, row, column)] = m(a, c) * m(b, d) - m(a, d) * m(b, c);
            }
        }
    }
    let determinant: f64 = (0..D).map(|k| m(0, k) * cofactors[entry(D, 0, k)]).sum();
    if determinant.abs() < LEAST {
        return unit;
    }
    cofactors.map(|cofactor| cofactor / determinant)
}

/// Of the moments' determinant, which is 1 where space is evenly filled.
const LEAST: f64 = 1e-3;
