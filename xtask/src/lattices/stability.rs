//! Which lattices are minima of the energy, and which saddles: eigenvalues of the dynamical matrix.

use faer::{Mat, Side, c64};
use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{Domain, point};
use sphpack_packing::Lattice;

/// Wave vectors that are looked at, spread evenly over the Brillouin zone, and as many again near its middle.
const WAVES: usize = 1000;

/// How near: where long waves bend the lattice as a whole.
const LONG: f64 = 0.1;

/// Two sites are images of each other where they agree to this part of ∆s.
const SAME: f64 = 1e-6;

/// The least eigenvalue of the dynamical matrix of a background pressure, of all waves that a perfect lattice may
/// carry, over the greatest. Negative beyond rounding (10⁻¹²): some collective motion lowers the energy, and the lattice
/// does not stay.
///
/// For a lattice of n sites per cell the matrix at the wave vector k has n × n blocks
/// D_ab = δ_ab Σ_R H(R) − Σ_{R from a to b} e^{ik·R} H(R), with H(R) = (W″ − W′/r) e⊗e + (W′/r) I.
///
/// # Errors
/// Where an eigenvalue is not found.
pub(super) fn softest(lattice: Lattice, kernel: KernelKind, h: f64) -> Result<f64, String> {
    if lattice.dimension() == 2 {
        kernel.with(h, Springs::<2>(lattice)).softest()
    } else {
        kernel.with(h, Springs::<3>(lattice)).softest()
    }
}

/// Asks a kernel for what holds the sites of a lattice.
struct Springs<const D: usize>(Lattice);

/// Site to site: from which, to which of a cell, by what way, how stiff.
struct Spring<const D: usize> {
    from: usize,
    to: usize,
    way: [f64; D],
    stiffness: [[f64; D]; D],
}

/// A cell's edges, its sites, and what holds them.
struct Cell<const D: usize> {
    edges: [f64; D],
    sites: usize,
    springs: Vec<Spring<D>>,
}

impl<const D: usize> WithKernel<D> for Springs<D> {
    type Output = Cell<D>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Cell<D> {
        let filling = self.0.unit_cell::<D>();
        let edges = filling.cell();
        let inner = filling.sites();
        let mut all = inner.clone();
        all.extend(filling.continued(&Domain::new([0.0; D], edges), kernel.support()));
        let number = |p: [f64; D]| {
            inner.iter().position(|site| {
                (0..D).all(|k| {
                    let off = (p[k] - site[k]) / edges[k];
                    (off - off.round()).abs() * edges[k] < SAME
                })
            })
        };
        let mut springs = Vec::new();
        for (from, &here) in inner.iter().enumerate() {
            for &there in &all {
                let way = point::sub(there, here);
                let r = point::norm(way);
                if r > SAME
                    && r < kernel.support()
                    && let Some(to) = number(there)
                {
                    springs.push(Spring {
                        from,
                        to,
                        way,
                        stiffness: kernel.hessian(way),
                    });
                }
            }
        }
        Cell {
            edges,
            sites: inner.len(),
            springs,
        }
    }
}

impl<const D: usize> Cell<D> {
    fn softest(&self) -> Result<f64, String> {
        let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
        for wave in 0..2 * WAVES {
            let near = if wave < WAVES { 1.0 } else { LONG };
            // A Kronecker sequence of the generalised golden ratio, about the middle of the zone.
            let golden: f64 = if D == 2 {
                1.324_717_957_244_746
            } else {
                1.220_744_084_605_759_5
            };
            let k: [f64; D] = std::array::from_fn(|axis| {
                let part = ((wave + 1) as f64 / golden.powi(axis as i32 + 1)).fract() - 0.5;
                near * part * std::f64::consts::TAU / self.edges[axis]
            });
            let found = (self.dynamical(k))
                .self_adjoint_eigenvalues(Side::Lower)
                .map_err(|error| format!("eigenvalues: {error:?}"))?;
            for value in found {
                least = least.min(value);
                greatest = greatest.max(value);
            }
        }
        Ok(least / greatest)
    }

    /// The dynamical matrix.
    fn dynamical(&self, k: [f64; D]) -> Mat<c64> {
        let mut matrix = Mat::<c64>::zeros(D * self.sites, D * self.sites);
        for spring in &self.springs {
            let (sin, cos) = point::dot(k, spring.way).sin_cos();
            let phase = c64::new(cos, sin);
            for row in 0..D {
                for column in 0..D {
                    let here = D * spring.from + row;
                    let stiff = spring.stiffness[row][column];
                    matrix[(here, D * spring.from + column)] += c64::new(stiff, 0.0);
                    matrix[(here, D * spring.to + column)] -= phase * stiff;
                }
            }
        }
        matrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In the plane the square lattice shears, the hexagonal one stays; between 1.10 and 1.12 all close-packed ones do.
    #[test]
    fn close_packed_lattices_are_stable_where_square_ones_are_not() {
        let at = |lattice, h| softest(lattice, KernelKind::Quintic, h).expect("eigenvalues");
        for lattice in [Lattice::Square, Lattice::SimpleCubic] {
            assert!(
                at(lattice, 1.11) < -1e-4,
                "{lattice}: {}",
                at(lattice, 1.11)
            );
        }
        for lattice in [Lattice::Hexagonal, Lattice::Bcc, Lattice::Fcc, Lattice::Hcp] {
            assert!(
                at(lattice, 1.11) > -1e-9,
                "{lattice}: {}",
                at(lattice, 1.11)
            );
        }
        assert!(at(Lattice::Hexagonal, 1.3) < -1e-3);
    }

    /// Where some lattice is stable the one of least energy is, or as good as: elsewhere instabilities reach −0.1.
    #[test]
    fn auto_takes_a_stable_lattice_where_there_is_one() {
        for kernel in [
            KernelKind::Quintic,
            KernelKind::Cubic,
            KernelKind::WendlandC2,
            KernelKind::WendlandC4,
        ] {
            for dimension in [2, 3] {
                for h in [0.93, 1.0, 1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.4] {
                    let at = |lattice| softest(lattice, kernel, h).expect("eigenvalues");
                    let of_dimension = Lattice::ALL
                        .into_iter()
                        .filter(|l| l.dimension() == dimension);
                    // hcp costs most to look at, and is never the only one.
                    let best = (of_dimension.filter(|&l| l != Lattice::Hcp))
                        .map(at)
                        .fold(f64::MIN, f64::max);
                    let taken = Lattice::auto(dimension, kernel, h);
                    assert!(
                        best < -1e-4 || at(taken) > -1.5e-3,
                        "{kernel:?} {h}: {taken} {}",
                        at(taken)
                    );
                }
            }
        }
    }
}
