//! A lattice with one particle off its site: does it come back? (Negi & Ramachandran 2021, fig. 7.)

use std::collections::BTreeMap;

use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Domain, point};
use sphpack_packing::forces::Forces;
use sphpack_packing::minimise::{Damped, Energy, Minimiser};
use sphpack_packing::{Kind, Lattice, Particles, Sizes};
use sphpack_pairs::Repulsion;

use super::brute::{nearest, periodic_gamma};
use crate::reproduction::measure::Measure;

/// What is moved, under which forces, for how long. Lengths are in ∆s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Displaced {
    pub(crate) lattice: Lattice,
    /// Edge of the periodic box, about: a whole number of cells.
    pub(crate) edge: f64,
    pub(crate) h_over_spacing: f64,
    /// Whether the number density's gradient (ND) acts alone, or with the repulsion (RF).
    pub(crate) is_repelled: bool,
    /// How far the particle near the middle is moved along each axis.
    pub(crate) by: f64,
    pub(crate) iterations: usize,
}

/// Means that are taken off before places are compared with sites: a particle that has changed its site no longer counts after one.
const ROUNDS: usize = 4;

impl Displaced {
    pub(crate) fn words(&self) -> String {
        let forces = if self.is_repelled { "ND + RF" } else { "ND" };
        format!(
            "{} lattice, periodic, h/∆s = {}, {forces}, one particle moved by {} ∆s along each axis, {} iterations",
            self.lattice.name(),
            self.h_over_spacing,
            self.by,
            self.iterations
        )
    }

    pub(crate) fn figures(&self) -> BTreeMap<Measure, f64> {
        if self.lattice.dimension() == 2 {
            self.in_dimension::<2>()
        } else {
            self.in_dimension::<3>()
        }
    }

    fn in_dimension<const D: usize>(&self) -> BTreeMap<Measure, f64> {
        let cell = self.lattice.unit_cell::<D>().cell();
        let edges = cell.map(|length| length * (self.edge / length).round().max(1.0));
        let domain = Domain::new([0.0; D], edges).with_periodic([true; D]);
        let filling = self.lattice.fill(domain.bounds, 1.0);
        let sites = filling.sites();
        let h = self.h_over_spacing;
        let mut particles = Particles::new(Sizes::uniform(1.0, h));
        for &site in &sites {
            particles.push(site, Kind::Free, filling.volume_per_site(), None);
        }
        let moved = near_the_middle(&sites, edges);
        for x in &mut particles.position[moved] {
            *x += self.by;
        }
        let repulsion = if self.is_repelled {
            Repulsion::new(1.0, Repulsion::STRENGTH)
        } else {
            Repulsion::none()
        };
        let forces = Forces::new(&domain, KernelKind::Quintic, h, 0.3, repulsion);
        let excess = |positions: &[[f64; D]]| {
            let of_sites = periodic_gamma(&sites[..], edges, h)[0];
            let all = periodic_gamma(positions, edges, h);
            all.iter()
                .map(|gamma| (gamma - of_sites).abs())
                .fold(0.0, f64::max)
        };
        let start = excess(&particles.position);
        let reach = KernelKind::Quintic.support_over_h() * h;
        let mut energy = Energy::new(&mut particles, &[], forces, reach);
        let mut dynamics = Damped::default();
        for _ in 0..self.iterations {
            dynamics.step(&mut energy);
        }
        drop(energy);
        let end = excess(&particles.position);
        BTreeMap::from([
            (
                Measure::FromSite,
                off_sites(&particles.position, &sites, edges),
            ),
            (Measure::DensityLeft, end),
            (Measure::DensityLeftOverStart, end / start),
        ])
    }
}

fn near_the_middle<const D: usize>(sites: &[[f64; D]], edges: [f64; D]) -> usize {
    let middle = edges.map(|edge| 0.5 * edge);
    let distance = |i: &usize| point::distance(sites[*i], middle);
    (0..sites.len())
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .unwrap_or(0)
}

/// The farthest that a particle is from the nearest site, where the lattice may drift as a whole: a particle pushes all others.
fn off_sites<const D: usize>(places: &[[f64; D]], sites: &[[f64; D]], edges: [f64; D]) -> f64 {
    let mut drift = [0.0; D];
    let mut farthest = 0.0;
    for _ in 0..ROUNDS {
        let mut sum = [0.0; D];
        farthest = 0.0;
        for place in places {
            let ways = sites.iter().map(|site| {
                let way: [f64; D] =
                    std::array::from_fn(|k| nearest(place[k] - drift[k] - site[k], edges[k]));
                (point::norm(way), way)
            });
            if let Some((length, way)) = ways.min_by(|a, b| a.0.total_cmp(&b.0)) {
                farthest = f64::max(farthest, length);
                sum = point::add_scaled(sum, 1.0, way);
            }
        }
        drift = point::add_scaled(drift, 1.0 / places.len() as f64, sum);
    }
    farthest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Vec<[f64; 2]> {
        (0..64)
            .map(|i| [f64::from(i % 8), f64::from(i / 8)])
            .collect()
    }

    #[test]
    fn a_drift_is_none_and_one_off_its_site_is_found() {
        let sites = square();
        let edges = [8.0; 2];
        let drifted: Vec<[f64; 2]> = sites.iter().map(|p| [p[0] + 0.2, p[1] - 0.1]).collect();
        assert!(off_sites(&drifted, &sites, edges) < 1e-12);
        let mut places = sites.clone();
        places[9][0] += 0.25;
        let off = off_sites(&places, &sites, edges);
        assert!((off - 0.25 * 63.0 / 64.0).abs() < 1e-12, "{off}");
        // Who has changed places with a neighbour, across a side too, is on a site.
        places = sites.clone();
        places.swap(0, 7);
        assert!(off_sites(&places, &sites, edges) < 1e-12);
    }

    #[test]
    fn a_hexagonal_lattice_heals_and_a_square_one_does_not_where_it_is_unstable() {
        let trial = |lattice, by| {
            let trial = Displaced {
                lattice,
                edge: 12.0,
                h_over_spacing: 1.1,
                is_repelled: false,
                by,
                iterations: 3000,
            };
            trial.figures()
        };
        let healed = trial(Lattice::Hexagonal, 0.25);
        assert!(healed[&Measure::FromSite] < 0.02, "{healed:?}");
        assert!(healed[&Measure::DensityLeftOverStart] < 1e-2, "{healed:?}");
        let other = trial(Lattice::Square, 0.25);
        assert!(other[&Measure::FromSite] > 0.1, "{other:?}");
    }
}
