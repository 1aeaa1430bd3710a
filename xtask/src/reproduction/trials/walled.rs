//! A lattice among frozen particles with one off its site: does it come back? (Negi & Ramachandran, preprint, fig. 14a.)

use std::collections::BTreeMap;

use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Domain, point};
use sphpack_packing::forces::Forces;
use sphpack_packing::minimise::{Damped, Energy, Minimiser};
use sphpack_packing::{Kind, Lattice, Particles, Sizes};
use sphpack_pairs::Repulsion;

use super::brute::gamma;
use crate::reproduction::measure::Measure;

/// What is moved, under which forces, for how long. Lengths are in ∆s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Walled {
    /// One of space.
    pub(crate) lattice: Lattice,
    pub(crate) h_over_spacing: f64,
    /// Whether the number density's gradient (ND) acts alone, or with the repulsion (RF).
    pub(crate) is_repelled: bool,
    /// How far the particle nearest to the middle is moved along each axis.
    pub(crate) by: f64,
    pub(crate) iterations: usize,
}

/// Particles along an edge, about: a whole number of cells; and layers of frozen ones around them.
const EDGE: f64 = 4.0;
const LAYERS: f64 = 5.0;

impl Walled {
    pub(crate) fn words(&self) -> String {
        format!(
            "{} lattice among frozen particles, h/∆s = {}, {}, one particle moved by {} ∆s along each axis, {} iterations",
            self.lattice.name(),
            self.h_over_spacing,
            self.short(),
            self.by,
            self.iterations
        )
    }

    /// Its forces.
    pub(crate) fn short(&self) -> &'static str {
        if self.is_repelled { "ND + RF" } else { "ND" }
    }

    pub(crate) fn figures(&self) -> BTreeMap<Measure, f64> {
        let cell = self.lattice.unit_cell::<3>().cell();
        let edges = cell.map(|length| length * (EDGE / length).round().max(1.0));
        let domain = Domain::new([0.0; 3], edges);
        let filling = self.lattice.fill(domain.bounds, 1.0);
        let (sites, frozen) = (filling.sites(), filling.continued(&domain, LAYERS));
        let h = self.h_over_spacing;
        let volume = filling.volume_per_site();
        let mut particles = Particles::new(Sizes::uniform(1.0, h));
        for (places, kind) in [(&sites, Kind::Free), (&frozen, Kind::Frozen)] {
            for &place in places {
                particles.push(place, kind, volume, None);
            }
        }
        let of_lattice = gamma(&particles.position, sites.len(), volume, h)[0];
        let middle = edges.map(|edge| 0.5 * edge);
        let distance = |i: &usize| point::distance(sites[*i], middle);
        let moved = (0..sites.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        for x in &mut particles.position[moved.unwrap_or(0)] {
            *x += self.by;
        }
        let excess = |particles: &Particles<3>| {
            (gamma(&particles.position, sites.len(), volume, h).iter())
                .map(|gamma| (gamma - of_lattice).abs())
                .fold(0.0, f64::max)
        };
        let start = excess(&particles);
        let repulsion = if self.is_repelled {
            Repulsion::new(1.0, Repulsion::STRENGTH)
        } else {
            Repulsion::none()
        };
        let forces = Forces::new(&domain, KernelKind::Quintic, h, 0.3, repulsion);
        let reach = KernelKind::Quintic.support_over_h() * h;
        let mut energy = Energy::new(&mut particles, &[], forces, reach);
        let mut dynamics = Damped::default();
        for _ in 0..self.iterations {
            dynamics.step(&mut energy);
        }
        drop(energy);
        let end = excess(&particles);
        // Frozen neighbours hold it: it does not drift.
        let off = |place: &[f64; 3]| {
            let ways = sites.iter().map(|site| point::distance(*place, *site));
            ways.fold(f64::INFINITY, f64::min)
        };
        let off = (particles.position[..sites.len()].iter())
            .map(off)
            .fold(0.0, f64::max);
        BTreeMap::from([
            (Measure::FromSite, off),
            (Measure::DensityLeft, end),
            (Measure::DensityLeftOverStart, end / start),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_moved_stays_and_what_is_begins_uneven() {
        let trial = |by, iterations| {
            let trial = Walled {
                lattice: Lattice::SimpleCubic,
                h_over_spacing: 1.2,
                is_repelled: false,
                by,
                iterations,
            };
            trial.figures()
        };
        let still = trial(0.0, 20);
        assert!(still[&Measure::FromSite] < 1e-9, "{still:?}");
        assert!(still[&Measure::DensityLeft] < 1e-9, "{still:?}");
        let begun = trial(0.25, 0);
        assert!((begun[&Measure::FromSite] - 0.25 * 3.0_f64.sqrt()).abs() < 1e-12);
        assert!(begun[&Measure::DensityLeft] > 0.01, "{begun:?}");
    }
}
