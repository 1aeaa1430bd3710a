//! The primitive cell of a lattice: the least that repeats, and the waves that fit into a periodic box.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use faer::Mat;
use faer::linalg::solvers::DenseSolveCore;
use sphpack_neighbors::{Odometer, point};
use sphpack_packing::Lattice;

/// Two sites are images of each other where they agree to this part of a translation.
const SAME: f64 = 1e-6;

/// Waves agree where they do so to one part in this many of the reciprocal cell.
const WAVES_APART: f64 = 1e6;

/// Lengths are in ∆s, with a volume of one per site; it lies in space as `Lattice::unit_cell` does.
#[derive(Debug, Clone)]
pub(crate) struct PrimitiveCell<const D: usize> {
    /// Translations that carry the lattice into itself.
    vectors: [[f64; D]; D],
    /// b with b_i · a_j = 2π δ_ij for the translations a.
    reciprocal: [[f64; D]; D],
    sites: Vec<[f64; D]>,
}

impl<const D: usize> PrimitiveCell<D> {
    /// The cell of a lattice of dimension `D`.
    pub(crate) fn of(lattice: Lattice) -> Self {
        let filling = lattice.unit_cell::<D>();
        let edges = filling.cell();
        let parts = translations(lattice);
        let vectors: [[f64; D]; D] =
            std::array::from_fn(|i| std::array::from_fn(|axis| parts[i][axis] * edges[axis]));
        let inverse = Mat::from_fn(D, D, |i, axis| vectors[i][axis])
            .partial_piv_lu()
            .inverse();
        let reciprocal =
            std::array::from_fn(|i| std::array::from_fn(|axis| TAU * inverse[(axis, i)]));
        let mut cell = Self {
            vectors,
            reciprocal,
            sites: Vec::new(),
        };
        for site in filling.sites() {
            if cell.number(site).is_none() {
                cell.sites.push(site);
            }
        }
        cell
    }

    /// Translations of the reciprocal lattice, of which wave vectors are known only up to.
    pub(crate) fn reciprocal(&self) -> &[[f64; D]; D] {
        &self.reciprocal
    }

    /// The sites that are no images of each other.
    pub(crate) fn sites(&self) -> &[[f64; D]] {
        &self.sites
    }

    /// Which of the cell's sites a place is an image of.
    pub(crate) fn number(&self, place: [f64; D]) -> Option<usize> {
        let is_image = |site: &[f64; D]| {
            let way = point::sub(place, *site);
            (self.reciprocal.iter()).all(|b| {
                let part = point::dot(*b, way) / TAU;
                (part - part.round()).abs() < SAME
            })
        };
        self.sites.iter().position(is_image)
    }

    /// The wave vector with these parts of the reciprocal translations; parts of 0 … 1 are the whole Brillouin zone.
    pub(crate) fn wave(&self, parts: [f64; D]) -> [f64; D] {
        (parts.iter().zip(&self.reciprocal))
            .fold([0.0; D], |k, (part, b)| point::add_scaled(k, *part, *b))
    }

    /// The shortest of the wave vectors that mean the same wave.
    pub(crate) fn shortest(&self, k: [f64; D]) -> [f64; D] {
        let steps = Odometer::new([-2; D], [3; D]);
        let others = steps.map(|n| point::add(k, self.wave(n.map(|n| n as f64))));
        others.fold(k, |best, other| {
            let is_shorter = point::norm_squared(other) < point::norm_squared(best) - SAME;
            if is_shorter { other } else { best }
        })
    }

    /// All waves that fit into a periodic box of whole unit cells, each once, one for every `sites` of its sites. The first
    /// is no wave at all.
    pub(crate) fn waves_in(&self, lattice: Lattice, cells: [usize; D]) -> Vec<[f64; D]> {
        let edges = lattice.unit_cell::<D>().cell();
        let mut found = BTreeMap::new();
        // Twice a reciprocal edge of the unit cell is a reciprocal translation of every lattice here.
        for n in Odometer::new([0; D], cells.map(|count| 2 * count as i64)) {
            let k: [f64; D] = std::array::from_fn(|axis| {
                TAU * n[axis] as f64 / (cells[axis] as f64 * edges[axis])
            });
            let key: [i64; D] = std::array::from_fn(|i| {
                let part = point::dot(k, self.vectors[i]) / TAU;
                (part.rem_euclid(1.0) * WAVES_APART).round() as i64 % WAVES_APART as i64
            });
            found.entry(key).or_insert(k);
        }
        found.into_values().collect()
    }
}

/// Primitive translations in parts of the unit cell's edges.
fn translations(lattice: Lattice) -> [[f64; 3]; 3] {
    match lattice {
        Lattice::Square | Lattice::SimpleCubic => {
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        }
        Lattice::Hexagonal | Lattice::Hcp => [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.0, 1.0]],
        Lattice::Bcc => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 0.5]],
        Lattice::Fcc => [[0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]],
    }
}
