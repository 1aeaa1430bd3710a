//! How kernel gradient sums change with positions, factorised.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, IntranodeLbltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, Mat, Par, Side};
use rayon::prelude::*;
use sphpack_kernels::{Kernel, WithKernel};
use sphpack_neighbors::{CellList, point};

use crate::forces::Forces;
use crate::particles::Particles;

/// A pair as one of both sees it: the other, ∇W and ∇∇W.
#[derive(Debug, Clone, Copy)]
pub(super) struct Linked<const D: usize> {
    pub(super) other: u32,
    pub(super) gradient: [f64; D],
    pub(super) hessian: [[f64; D]; D],
}

/// The pairs of every particle that is judged.
#[derive(Debug)]
pub(super) struct Links<const D: usize> {
    start: Vec<usize>,
    all: Vec<Linked<D>>,
}

impl<const D: usize> Links<D> {
    /// Where `forces` were evaluated last.
    pub(super) fn of(forces: &Forces<D>, positions: &[[f64; D]]) -> Self {
        let each = forces.with_kernel(Link {
            list: forces.list(),
            positions,
        });
        let mut links = Self {
            start: vec![0],
            all: Vec::with_capacity(each.iter().map(Vec::len).sum()),
        };
        for of_one in each {
            links.all.extend(of_one);
            links.start.push(links.all.len());
        }
        links
    }

    pub(super) fn of_particle(&self, i: usize) -> &[Linked<D>] {
        &self.all[self.start[i]..self.start[i + 1]]
    }
}

struct Link<'a, const D: usize> {
    list: &'a CellList<D>,
    positions: &'a [[f64; D]],
}

impl<const D: usize> WithKernel<D> for Link<'_, D> {
    type Output = Vec<Vec<Linked<D>>>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        let of_one = |i: usize| {
            (self.list.around(i, self.positions))
                .map(|(j, apart)| Linked {
                    other: j as u32,
                    gradient: kernel.gradient(apart),
                    hessian: kernel.hessian(apart),
                })
                .collect()
        };
        (0..self.positions.len())
            .into_par_iter()
            .with_min_len(64)
            .map(of_one)
            .collect()
    }
}

/// The matrix H = ∂(V_i ∇Γ_i)/∂x_j over free particles, per particle volume. It is that of the second derivatives of the
/// pressure's energy: symmetric, and indefinite where the lattice would rather buckle; so it is factorised as
/// L B Lᵀ with small pivots (Bunch & Kaufman 1977) within the blocks of a sparse elimination.
pub(super) struct Factor {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    below: Vec<f64>,
    forward: Vec<usize>,
    backward: Vec<usize>,
}

impl Factor {
    /// Of the particles whose numbers `row` has, per `unit` of volume; `None` where there is no memory for it.
    pub(super) fn of<const D: usize>(
        links: &Links<D>,
        particles: &Particles<D>,
        row: &[Option<u32>],
        unit: f64,
    ) -> Option<Self> {
        let volume = &particles.volume;
        let mut entries = Vec::new();
        let mut rows = 0;
        for (i, own) in row.iter().enumerate() {
            let Some(own) = own.map(|own| own as usize) else {
                continue;
            };
            rows += D;
            let mut sum = [[0.0; D]; D];
            for link in links.of_particle(i) {
                let j = link.other as usize;
                for k in 0..D {
                    sum[k] = point::add_scaled(sum[k], volume[j], link.hessian[k]);
                }
                // The lower triangle; an image of the particle itself moves with it.
                let Some(other) = row[j].map(|other| other as usize) else {
                    continue;
                };
                if other == own {
                    for k in 0..D {
                        sum[k] = point::add_scaled(sum[k], -volume[j], link.hessian[k]);
                    }
                } else if other < own {
                    let weight = -volume[i] * volume[j] / unit;
                    for k in 0..D {
                        for l in 0..D {
                            let value = weight * link.hessian[k][l];
                            entries.push(Triplet::new(D * own + k, D * other + l, value));
                        }
                    }
                }
            }
            for k in 0..D {
                for l in 0..=k {
                    let value = volume[i] / unit * sum[k][l];
                    entries.push(Triplet::new(D * own + k, D * own + l, value));
                }
            }
        }
        let matrix =
            SparseColMat::<usize, f64>::try_new_from_triplets(rows, rows, &entries).ok()?;
        drop(entries);
        // The library's other way, for matrices with few entries, has no pivots.
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let ordering = SymmetricOrdering::Amd;
        let symbolic =
            factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, ordering, params).ok()?;
        let mut values = Vec::new();
        values.try_reserve_exact(symbolic.len_val()).ok()?;
        values.resize(symbolic.len_val(), 0.0);
        let mut factor = Self {
            values,
            below: vec![0.0; rows],
            forward: vec![0; rows],
            backward: vec![0; rows],
            symbolic,
        };
        let scratch = (factor.symbolic)
            .factorize_numeric_intranode_lblt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::try_new(scratch).ok()?;
        factor.symbolic.factorize_numeric_intranode_lblt(
            &mut factor.values,
            &mut factor.below,
            &mut factor.forward,
            &mut factor.backward,
            matrix.as_ref(),
            Side::Lower,
            // In one thread: the same bits whatever their number.
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        );
        Some(factor)
    }

    /// Puts H⁻¹ of the columns of `right` in their place.
    pub(super) fn solve(&self, right: &mut Mat<f64>) {
        let rows = self.forward.len();
        if rows == 0 {
            return;
        }
        let order = faer::perm::PermRef::new_checked(&self.forward, &self.backward, rows);
        let factor = IntranodeLbltRef::new(&self.symbolic, &self.values, &self.below, order);
        let scratch = self
            .symbolic
            .solve_in_place_scratch::<f64>(right.ncols(), Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        factor.solve_in_place_with_conj(
            Conj::No,
            right.as_mut(),
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }
}

/// x of A x = b for a symmetric, positive definite A; `None` where it is not.
pub(super) fn solve_definite(a: &Mat<f64>, b: &Mat<f64>) -> Option<Mat<f64>> {
    Some(a.llt(Side::Lower).ok()?.solve(b))
}
