//! Lattices that fill a box exactly, and go on beyond it.

use std::fmt;
use std::str::FromStr;

use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{Bounds, Domain, Odometer, point};

/// A regular arrangement of particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Lattice {
    /// 2-D, one site per square cell.
    Square,
    /// 2-D, rows shifted by half a spacing; Negi & Ramachandran (2021), fig. 6b.
    Hexagonal,
    /// 3-D, one site per cubic cell.
    SimpleCubic,
    /// 3-D, body-centred cubic.
    Bcc,
    /// 3-D, face-centred cubic.
    Fcc,
    /// 3-D, hexagonal close-packed.
    Hcp,
}

/// A lattice name that is none.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "no lattice is called \"{0}\"; there are square, hexagonal (2-D), simple-cubic, bcc, fcc, hcp (3-D)"
)]
pub struct UnknownLattice(pub String);

impl FromStr for Lattice {
    type Err = UnknownLattice;

    fn from_str(name: &str) -> Result<Self, UnknownLattice> {
        Self::ALL
            .into_iter()
            .find(|lattice| lattice.name() == name)
            .ok_or_else(|| UnknownLattice(name.to_owned()))
    }
}

impl fmt::Display for Lattice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Lattice {
    /// Every lattice.
    pub const ALL: [Self; 6] = [
        Self::Square,
        Self::Hexagonal,
        Self::SimpleCubic,
        Self::Bcc,
        Self::Fcc,
        Self::Hcp,
    ];

    /// The name that scenes and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Square => "square",
            Self::Hexagonal => "hexagonal",
            Self::SimpleCubic => "simple-cubic",
            Self::Bcc => "bcc",
            Self::Fcc => "fcc",
            Self::Hcp => "hcp",
        }
    }

    /// 2 or 3.
    pub fn dimension(self) -> usize {
        match self {
            Self::Square | Self::Hexagonal => 2,
            _ => 3,
        }
    }

    /// What `lattice = "auto"` means for packing with a kernel at an h/∆s: the lattice of least Γ, which is twice its energy
    /// per particle under a background pressure. That one is stable wherever one of its dimension is, or the least
    /// unstable; `docs/lattices.md` has the eigenvalues, and what packings from stable lattices gain. With the quintic at
    /// 1.2 it is the hexagonal and the body-centred cubic one. Hexagonal close packing, which is never stable alone, is
    /// not asked.
    pub fn auto(dimension: usize, kernel: KernelKind, h_over_spacing: f64) -> Self {
        let (usual, others): (Self, &[Self]) = if dimension == 2 {
            (Self::Hexagonal, &[Self::Square])
        } else {
            (Self::Bcc, &[Self::Fcc, Self::SimpleCubic])
        };
        let gamma = |lattice: Self| lattice.gamma(kernel, h_over_spacing);
        (others.iter()).fold(usual, |best, &other| {
            if gamma(other) < gamma(best) {
                other
            } else {
                best
            }
        })
    }

    /// Edge lengths of the rectangular cell for a volume of one per site.
    fn cell(self) -> [f64; 3] {
        let root3 = 3.0_f64.sqrt();
        match self {
            Self::Square | Self::SimpleCubic => [1.0, 1.0, 1.0],
            Self::Hexagonal => {
                let a = (2.0 / root3).sqrt();
                [a, root3 * a, 1.0]
            }
            Self::Bcc => [2.0_f64.cbrt(); 3],
            Self::Fcc => [4.0_f64.cbrt(); 3],
            Self::Hcp => {
                let a = 2.0_f64.powf(1.0 / 6.0);
                [a, root3 * a, (8.0_f64 / 3.0).sqrt() * a]
            }
        }
    }

    /// Sites in the cell, as fractions of its edges, placed evenly about the cell's middle.
    fn sites(self) -> &'static [[f64; 3]] {
        const SIXTH: f64 = 1.0 / 6.0;
        match self {
            Self::Square | Self::SimpleCubic => &[[0.5, 0.5, 0.5]],
            Self::Hexagonal => &[[0.25, 0.25, 0.0], [0.75, 0.75, 0.0]],
            Self::Bcc => &[[0.25, 0.25, 0.25], [0.75, 0.75, 0.75]],
            Self::Fcc => &[
                [0.25, 0.25, 0.25],
                [0.75, 0.75, 0.25],
                [0.75, 0.25, 0.75],
                [0.25, 0.75, 0.75],
            ],
            Self::Hcp => &[
                [0.25, SIXTH, 0.25],
                [0.75, SIXTH + 0.5, 0.25],
                [0.25, 5.0 * SIXTH, 0.75],
                [0.75, 2.0 * SIXTH, 0.75],
            ],
        }
    }

    /// Γ of a particle of the perfect, unstretched lattice: Σ V W over the lattice, 1 but for the kernel's own bias.
    pub fn gamma(self, kernel: KernelKind, h_over_spacing: f64) -> f64 {
        if self.dimension() == 2 {
            self.unit_cell::<2>().gamma(kernel, h_over_spacing)
        } else {
            self.unit_cell::<3>().gamma(kernel, h_over_spacing)
        }
    }

    /// One unstretched cell, from the origin on, of unit volume per site; `D` is the lattice's dimension.
    pub fn unit_cell<const D: usize>(self) -> Filling<D> {
        let unit = self.cell();
        Filling {
            lattice: self,
            bounds: Bounds::new([0.0; D], point::of_slice(&unit)),
            cells: [1; D],
            phase: [0.0; D],
        }
    }

    /// The lattice stretched to fill a box with a whole number of cells along each axis, at about one site per
    /// `spacing`^D. Of the whole numbers next to the ideal ones it takes those that keep the volume per site closest
    /// to `spacing`^D and the stretch most even.
    ///
    /// # Panics
    /// For a lattice of another dimension than `D`, or an empty box: callers check.
    pub fn fill<const D: usize>(self, bounds: Bounds<D>, spacing: f64) -> Filling<D> {
        assert_eq!(
            self.dimension(),
            D,
            "a lattice fills boxes of its own dimension"
        );
        let unit = self.cell();
        let size = bounds.size();
        let mut best: Option<(f64, [u64; D])> = None;
        for choice in 0..1_u32 << D {
            let cells: [u64; D] = std::array::from_fn(|k| {
                let ideal = size[k] / (spacing * unit[k]);
                let number = if choice >> k & 1 == 1 {
                    ideal.ceil()
                } else {
                    ideal.floor()
                };
                number.clamp(1.0, 1e15) as u64
            });
            let stretch: [f64; D] =
                std::array::from_fn(|k| (size[k] / (cells[k] as f64 * spacing * unit[k])).ln());
            let mean = stretch.iter().sum::<f64>() / D as f64;
            let uneven: f64 = stretch.iter().map(|s| (s - mean) * (s - mean)).sum();
            let cost = uneven + 20.0 * mean * mean;
            if best.is_none_or(|(least, _)| cost < least - 1e-12) {
                best = Some((cost, cells));
            }
        }
        let (_, cells) = best.expect("at least one choice");
        Filling {
            lattice: self,
            bounds,
            cells,
            phase: [0.0; D],
        }
    }
}

/// Σ W over the sites of an endless lattice, seen from one of them.
struct SiteSum<const D: usize>(Filling<D>);

impl<const D: usize> WithKernel<D> for SiteSum<D> {
    type Output = f64;

    fn call<K: Kernel<D>>(self, kernel: K) -> f64 {
        let cell = self.0.cell();
        let filling = Filling {
            bounds: Bounds::new([0.0; D], cell),
            cells: [1; D],
            phase: [0.0; D],
            ..self.0
        };
        let first = filling.sites()[0];
        let mut sites = filling.sites();
        sites.extend(filling.continued(&Domain::new([0.0; D], cell), kernel.support()));
        sites
            .iter()
            .map(|&site| kernel.value(point::distance(site, first)))
            .sum()
    }
}

/// A lattice fitted to a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filling<const D: usize> {
    lattice: Lattice,
    bounds: Bounds<D>,
    cells: [u64; D],
    /// How far the lattice is shifted, in fractions of a cell.
    phase: [f64; D],
}

impl<const D: usize> Filling<D> {
    /// The same lattice shifted by a fraction of its cell along each axis. It fills the box with as many sites:
    /// what leaves at one side enters at the other.
    #[must_use]
    pub fn shifted(self, phase: [f64; D]) -> Self {
        Self { phase, ..self }
    }

    /// Number of sites in the box; saturates.
    pub fn count(&self) -> u64 {
        self.cells
            .iter()
            .fold(self.lattice.sites().len() as u64, |n, &c| {
                n.saturating_mul(c)
            })
    }

    /// The volume of one site: box volume / number of sites.
    pub fn volume_per_site(&self) -> f64 {
        self.bounds.volume() / self.count() as f64
    }

    /// Γ of a particle of the lattice, stretched as it is; `smoothing_length` in scene units.
    pub fn gamma(&self, kernel: KernelKind, smoothing_length: f64) -> f64 {
        self.volume_per_site() * kernel.with(smoothing_length, SiteSum(*self))
    }

    /// Edge lengths of the stretched cell, scene units.
    pub fn cell(&self) -> [f64; D] {
        let size = self.bounds.size();
        std::array::from_fn(|k| size[k] / self.cells[k] as f64)
    }

    /// The sites inside the box, cell by cell.
    pub fn sites(&self) -> Vec<[f64; D]> {
        let mut sites = Vec::with_capacity(self.count() as usize);
        self.visit([0; D], self.cells.map(|c| c as i64), |p| sites.push(p));
        sites
    }

    /// About how many sites [`Filling::continued`] gives.
    pub fn continued_count(&self, domain: &Domain<D>, depth: f64) -> f64 {
        let outer: f64 = (0..D)
            .map(|k| domain.bounds.size()[k] + if domain.periodic[k] { 0.0 } else { 2.0 * depth })
            .product();
        (outer - self.bounds.volume()) / self.volume_per_site()
    }

    /// The same lattice continued beyond each side that is not periodic, `depth` deep.
    pub fn continued(&self, domain: &Domain<D>, depth: f64) -> Vec<[f64; D]> {
        let mut outer = self.bounds;
        for k in (0..D).filter(|&k| !domain.periodic[k]) {
            outer.min[k] -= depth;
            outer.max[k] += depth;
        }
        let mut sites = Vec::new();
        self.visit_beyond(outer, |p| sites.push(p));
        sites
    }

    /// Visits the same lattice within `outer`, but for what is within its own box.
    pub fn visit_beyond(&self, outer: Bounds<D>, mut f: impl FnMut([f64; D])) {
        let cell = self.cell();
        let extra = |gap: f64, k: usize| (gap / cell[k]).ceil().max(0.0) as i64;
        let from = std::array::from_fn(|k| -extra(self.bounds.min[k] - outer.min[k], k));
        let to = std::array::from_fn(|k| {
            self.cells[k] as i64 + extra(outer.max[k] - self.bounds.max[k], k)
        });
        self.visit(from, to, |p| {
            if outer.contains(p) && !self.bounds.contains(p) {
                f(p);
            }
        });
    }

    fn visit(&self, from: [i64; D], to: [i64; D], mut f: impl FnMut([f64; D])) {
        let cell = self.cell();
        let sites: Vec<[f64; D]> = (self.lattice.sites().iter())
            .map(|site| std::array::from_fn(|k| (site[k] + self.phase[k]).rem_euclid(1.0)))
            .collect();
        for index in Odometer::new(from, to) {
            for site in &sites {
                f(std::array::from_fn(|k| {
                    self.bounds.min[k] + cell[k] * (index[k] as f64 + site[k])
                }));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Nearest-neighbour distance over ∆s and coordination number of the unstretched lattice.
    fn expected(lattice: Lattice) -> (f64, usize) {
        match lattice {
            Lattice::Square => (1.0, 4),
            Lattice::Hexagonal => ((2.0 / 3.0_f64.sqrt()).sqrt(), 6),
            Lattice::SimpleCubic => (1.0, 6),
            Lattice::Bcc => (2.0_f64.cbrt() * 0.75_f64.sqrt(), 8),
            Lattice::Fcc => (4.0_f64.cbrt() / 2.0_f64.sqrt(), 12),
            Lattice::Hcp => (2.0_f64.powf(1.0 / 6.0), 12),
        }
    }

    fn check_neighbours<const D: usize>(lattice: Lattice) {
        // A box of whole unstretched cells: every site, frozen continuation included, has the right neighbours.
        let cell = lattice.cell();
        let max: [f64; D] = std::array::from_fn(|k| 3.0 * cell[k]);
        let domain = Domain::new([0.0; D], max);
        let filling = lattice.fill(domain.bounds, 1.0);
        let inner = filling.sites();
        assert_eq!(inner.len() as u64, filling.count());
        assert!((filling.volume_per_site() - 1.0).abs() < 1e-12);
        assert!(
            inner.iter().all(|&p| domain.bounds.contains(p)),
            "{lattice}: sites inside the box"
        );
        let mut all = filling.continued(&domain, 3.0);
        all.extend(&inner);
        let (nearest, coordination) = expected(lattice);
        for &p in &inner {
            let mut distances: Vec<f64> = all.iter().map(|&q| point::distance(p, q)).collect();
            distances.sort_by(f64::total_cmp);
            assert!(
                (distances[1] - nearest).abs() < 1e-9,
                "{lattice}: {} {nearest}",
                distances[1]
            );
            let touching = distances
                .iter()
                .filter(|&&d| d > 0.0 && d < nearest * 1.001)
                .count();
            assert_eq!(touching, coordination, "{lattice}");
        }
    }

    #[test]
    fn neighbours_of_every_lattice() {
        for lattice in Lattice::ALL {
            if lattice.dimension() == 2 {
                check_neighbours::<2>(lattice);
            } else {
                check_neighbours::<3>(lattice);
            }
        }
    }

    #[test]
    fn perfect_lattices_of_short_kernels_are_biased() {
        let check = |lattice: Lattice, expected: f64| {
            let gamma = lattice.gamma(KernelKind::WendlandC2, 1.3);
            assert!((gamma - expected).abs() < 5e-5, "{lattice}: {gamma}");
        };
        check(Lattice::Square, 1.0105);
        check(Lattice::Hexagonal, 1.0088);
        check(Lattice::SimpleCubic, 1.0095);
        check(Lattice::Fcc, 1.0068);
        for h in [1.0, 1.1, 1.2] {
            let gamma = Lattice::Hexagonal.gamma(KernelKind::Quintic, h);
            assert!((gamma - 1.0).abs() < 2e-4, "hexagonal at {h}: {gamma}");
        }
    }

    proptest! {
        #[test]
        fn fills_any_box(size in prop::array::uniform3(0.5..4.0_f64), spacing in 0.1..0.4_f64, phase in prop::array::uniform3(-1.0..1.0_f64)) {
            for lattice in Lattice::ALL.into_iter().filter(|l| l.dimension() == 3) {
                let bounds = Bounds::new([-1.0; 3], size.map(|s| s - 1.0));
                let filling = lattice.fill(bounds, spacing);
                let sites = filling.shifted(phase).sites();
                prop_assert_eq!(sites.len() as u64, filling.count());
                prop_assert!(sites.iter().all(|&p| bounds.contains(p)));
                prop_assert!((filling.volume_per_site() * sites.len() as f64 / bounds.volume() - 1.0).abs() < 1e-12);
            }
        }

        #[test]
        fn scales_with_the_unit(size in prop::array::uniform2(1.0..4.0_f64), unit in prop::sample::select(vec![1e-6, 1e6])) {
            let at = |u: f64| Lattice::Hexagonal.fill(Bounds::new([0.0; 2], size.map(|s| s * u)), 0.1 * u);
            prop_assert_eq!(at(1.0).count(), at(unit).count());
        }
    }
}
