//! Which lattice a packing starts from unless it is told.

use sphpack_kernels::KernelKind;

use super::Lattice;

/// Where, from an h/∆s up to another, a lattice other than the usual one is the stable one, or by far the least
/// unstable. `docs/lattices.md` has the eigenvalues, and what packings from stable lattices gain: evaluations by a
/// factor of two to six, and evenness.
const UNUSUAL: [(KernelKind, f64, f64, Lattice); 17] = [
    (KernelKind::Quintic, 0.90, 0.95, Lattice::Square),
    (KernelKind::Quintic, 1.23, 1.48, Lattice::Square),
    (KernelKind::Cubic, 0.90, 0.96, Lattice::Square),
    (KernelKind::Cubic, 1.20, 1.48, Lattice::Square),
    (KernelKind::WendlandC2, 0.95, 1.08, Lattice::Square),
    (KernelKind::WendlandC2, 1.43, 1.55, Lattice::Square),
    (KernelKind::Quintic, 0.92, 1.00, Lattice::SimpleCubic),
    (KernelKind::Quintic, 1.00, 1.10, Lattice::Fcc),
    (KernelKind::Quintic, 1.26, 1.48, Lattice::SimpleCubic),
    (KernelKind::Cubic, 0.86, 0.92, Lattice::Fcc),
    (KernelKind::Cubic, 0.92, 1.00, Lattice::SimpleCubic),
    (KernelKind::Cubic, 1.00, 1.10, Lattice::Fcc),
    (KernelKind::Cubic, 1.28, 1.48, Lattice::SimpleCubic),
    (KernelKind::WendlandC2, 0.96, 1.10, Lattice::SimpleCubic),
    (KernelKind::WendlandC2, 1.10, 1.18, Lattice::Fcc),
    (KernelKind::WendlandC2, 1.40, 1.56, Lattice::SimpleCubic),
    (KernelKind::WendlandC4, 1.16, 1.32, Lattice::Fcc),
];

impl Lattice {
    /// What `lattice = "auto"` means for packing with a kernel at an h/∆s: hexagonal in 2-D and body-centred cubic in
    /// 3-D, but for ranges where these are unstable and another one is not.
    pub fn auto(dimension: usize, kernel: KernelKind, h_over_spacing: f64) -> Self {
        let is_meant = |&&(of, from, to, lattice): &&(KernelKind, f64, f64, Self)| {
            of == kernel && lattice.dimension() == dimension && (from..to).contains(&h_over_spacing)
        };
        match (UNUSUAL.iter().find(is_meant), dimension) {
            (Some(&(_, _, _, lattice)), _) => lattice,
            (None, 2) => Self::Hexagonal,
            _ => Self::Bcc,
        }
    }
}
