//! The dynamical matrix of a background pressure.

use faer::{Mat, Side, c64};
use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{Domain, point};
use sphpack_packing::Lattice;

use super::PrimitiveCell;

/// Who is nearer than this, in ∆s, is the site itself.
const ITSELF: f64 = 1e-6;

/// The squares of a running wave add up to nothing; a wave whose squares do not, per site, stands.
const STANDING: f64 = 1e-6;

/// A lattice, and what holds its sites.
///
/// The energy is that of [`sphpack_packing::minimise::Energy`] without repulsion, which reaches 0.95 ∆s and no site: per
/// p_b ∆s^D it is ½ Σ_ij W_ij, lengths in ∆s, volume one. Its second derivatives between sites a and b, R apart, are −H(R), H = ∇∇W =
/// (W″ − W′/r) e⊗e + (W′/r) I. At the wave vector k the matrix of a cell of n sites has n × n blocks
/// D_ab = δ_ab Σ_R H(R) − Σ_{R from a to b} e^{ik·R} H(R); its eigenvalues are squares of frequencies, in p_b/ρ∆s²: a negative one is the
/// square of the rate at which the wave grows.
pub(crate) struct Crystal<const D: usize> {
    pub(crate) cell: PrimitiveCell<D>,
    /// Σ_R H(R) of every site of the cell: what holds it while all others stay.
    own: Vec<[[f64; D]; D]>,
    bonds: Vec<Bond<D>>,
}

/// From a site of the cell to all images of another, or of itself.
struct Bond<const D: usize> {
    from: usize,
    to: usize,
    /// By what way, how stiff.
    springs: Vec<([f64; D], [[f64; D]; D])>,
}

/// One wave: an eigenvector of the dynamical matrix.
#[derive(Debug, Clone)]
pub(crate) struct Mode<const D: usize> {
    pub(crate) k: [f64; D],
    /// ω².
    pub(crate) value: f64,
    /// Which way each site of the cell moves, real and imaginary parts; Σ |e|² = 1.
    pub(crate) ways: Vec<[[f64; 2]; D]>,
}

/// Asks a kernel for what holds the sites of a lattice.
struct Springs(Lattice);

impl<const D: usize> WithKernel<D> for Springs {
    type Output = Crystal<D>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Crystal<D> {
        let cell = PrimitiveCell::<D>::of(self.0);
        let unit = self.0.unit_cell::<D>();
        let mut all = unit.sites();
        all.extend(unit.continued(&Domain::new([0.0; D], unit.cell()), kernel.support()));
        let sites = cell.sites().len();
        let mut own = vec![[[0.0; D]; D]; sites];
        let mut bonds: Vec<Bond<D>> = (0..sites * sites)
            .map(|i| Bond {
                from: i / sites,
                to: i % sites,
                springs: Vec::new(),
            })
            .collect();
        for (from, &here) in cell.sites().iter().enumerate() {
            for &there in &all {
                let way = point::sub(there, here);
                let r = point::norm(way);
                if r > ITSELF
                    && r < kernel.support()
                    && let Some(to) = cell.number(there)
                {
                    let stiffness = kernel.hessian(way);
                    for (sum, row) in own[from].iter_mut().zip(stiffness) {
                        *sum = point::add(*sum, row);
                    }
                    bonds[from * sites + to].springs.push((way, stiffness));
                }
            }
        }
        Crystal { cell, own, bonds }
    }
}

impl<const D: usize> Crystal<D> {
    /// A lattice of dimension `D` under a kernel.
    pub(crate) fn new(lattice: Lattice, kernel: KernelKind, h_over_spacing: f64) -> Self {
        kernel.with(h_over_spacing, Springs(lattice))
    }

    /// The dynamical matrix.
    fn matrix(&self, k: [f64; D]) -> Mat<c64> {
        let size = D * self.cell.sites().len();
        let mut matrix = Mat::<c64>::zeros(size, size);
        for (site, own) in self.own.iter().enumerate() {
            for (row, stiff) in own.iter().enumerate() {
                for (column, stiff) in stiff.iter().enumerate() {
                    matrix[(D * site + row, D * site + column)] = c64::new(*stiff, 0.0);
                }
            }
        }
        for bond in &self.bonds {
            let [mut real, mut imaginary] = [[[0.0; D]; D]; 2];
            for (way, stiffness) in &bond.springs {
                let (sin, cos) = point::dot(k, *way).sin_cos();
                for row in 0..D {
                    real[row] = point::add_scaled(real[row], cos, stiffness[row]);
                    imaginary[row] = point::add_scaled(imaginary[row], sin, stiffness[row]);
                }
            }
            for row in 0..D {
                for column in 0..D {
                    matrix[(D * bond.from + row, D * bond.to + column)] -=
                        c64::new(real[row][column], imaginary[row][column]);
                }
            }
        }
        matrix
    }

    /// The eigenvalues at a wave vector, the least first.
    ///
    /// # Errors
    /// Where one is not found.
    pub(crate) fn values(&self, k: [f64; D]) -> Result<Vec<f64>, String> {
        let matrix = self.matrix(k);
        // With one site in the cell all is symmetric about it, and real: half the work.
        let found = if self.bonds.len() == 1 {
            let real = Mat::from_fn(D, D, |row, column| matrix[(row, column)].re);
            real.self_adjoint_eigenvalues(Side::Lower)
        } else {
            matrix.self_adjoint_eigenvalues(Side::Lower)
        };
        found.map_err(|error| format!("eigenvalues at the wave vector {k:?}: {error:?}"))
    }

    /// The waves of a wave vector, the softest first.
    ///
    /// # Errors
    /// Where one is not found.
    pub(crate) fn modes(&self, k: [f64; D]) -> Result<Vec<Mode<D>>, String> {
        let found = self.matrix(k).self_adjoint_eigen(Side::Lower);
        let found = found.map_err(|error| format!("waves at the wave vector {k:?}: {error:?}"))?;
        let (ways, values) = (found.U(), found.S().column_vector());
        let modes = (0..values.nrows()).map(|number| Mode {
            k,
            value: values[number].re,
            ways: (0..self.cell.sites().len())
                .map(|site| {
                    std::array::from_fn(|axis| {
                        let part = ways[(D * site + axis, number)];
                        [part.re, part.im]
                    })
                })
                .collect(),
        });
        Ok(modes.collect())
    }

    /// The eigenvalues of what holds one site while all others stay, the least first: by how much the energy rises where one particle
    /// alone is moved.
    ///
    /// # Errors
    /// Where one is not found.
    pub(crate) fn alone(&self) -> Result<Vec<f64>, String> {
        let matrix = Mat::from_fn(D, D, |row, column| self.own[0][row][column]);
        let found = matrix.self_adjoint_eigenvalues(Side::Lower);
        found.map_err(|error| format!("eigenvalues of one site: {error:?}"))
    }

    /// How a wave moves sites: Re(e^{i(k·x + φ)} e) at each place x, with the phase φ in which it moves them most where that makes a
    /// difference, as it does for waves that are their own mirror images. A place that is no site is not moved.
    pub(crate) fn field(&self, mode: &Mode<D>, places: &[[f64; D]]) -> Vec<[f64; D]> {
        let complex: Vec<[[f64; 2]; D]> = (places.iter())
            .map(|&place| {
                let Some(site) = self.cell.number(place) else {
                    return [[0.0; 2]; D];
                };
                let (sin, cos) = point::dot(mode.k, place).sin_cos();
                mode.ways[site].map(|[re, im]| [cos * re - sin * im, sin * re + cos * im])
            })
            .collect();
        let squares = (complex.iter().flatten()).fold([0.0; 2], |sum, [re, im]| {
            [sum[0] + re * re - im * im, sum[1] + 2.0 * re * im]
        });
        let turn = if squares[0].hypot(squares[1]) > STANDING * places.len() as f64 {
            -0.5 * squares[1].atan2(squares[0])
        } else {
            0.0
        };
        let (sin, cos) = turn.sin_cos();
        (complex.iter())
            .map(|way| way.map(|[re, im]| cos * re - sin * im))
            .collect()
    }
}
