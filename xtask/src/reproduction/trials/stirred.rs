//! A lattice with an agitator in its middle, which becomes a free particle: does the lattice come back? (Negi & Ramachandran,
//! preprint, figs. 7b and 14b.)

use std::collections::BTreeMap;

use sphpack_neighbors::{Domain, point};
use sphpack_packing::{
    Agitated, Agitators, Kind, Lattice, Method, Packed, Problem, RunLog, Silent,
};

use super::brute::{gamma, periodic_gamma};
use crate::reproduction::measure::Measure;

/// What is stirred, under which forces, for how long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stirred {
    pub(crate) lattice: Lattice,
    /// Whether the number density's gradient (ND) acts alone, or with the repulsion (RF).
    pub(crate) is_repelled: bool,
    pub(crate) agitators: Agitators,
    /// Until it is looked at; the agitator is free after half of one.
    pub(crate) revolutions: usize,
}

/// The paper's largest step in ∆s/√p_b, and how many make a revolution of the plane.
const STEP: f64 = 0.0895;
pub(crate) const REVOLUTION: usize = 2000;

impl Stirred {
    pub(crate) fn words(&self) -> String {
        let forces = if self.is_repelled { "ND + RF" } else { "ND" };
        format!(
            "{} lattice, {forces}, agitator {} for half a revolution, after {}",
            self.lattice.name(),
            match self.agitators {
                Agitators::Turning => "turning",
                Agitators::Resting => "resting",
                Agitators::None => "none",
            },
            self.revolutions
        )
    }

    pub(crate) fn figures(&self) -> Result<BTreeMap<Measure, f64>, String> {
        if self.lattice.dimension() == 2 {
            self.in_dimension::<2>()
        } else {
            self.in_dimension::<3>()
        }
    }

    /// 20 × 20 particles in a periodic box with a tenth of the damping, and 4 × 4 × 4 among frozen ones.
    pub(crate) fn packed<const D: usize>(&self) -> Result<Packed<D>, String>
    where
        Agitated: Method<D>,
    {
        let (edge, spacing) = if D == 2 { (1.0, 0.05) } else { (0.4, 0.1) };
        let domain = Domain::new([0.0; D], [edge; D]).with_periodic([D == 2; D]);
        let mut problem = Problem::new(domain, spacing);
        problem.lattice = Some(self.lattice);
        let method = Agitated {
            // Never met: the curves go on to the end.
            density_tolerance: 0.0,
            max_iterations: self.revolutions * REVOLUTION,
            damping: if D == 2 { 5e-4 } else { 5e-3 },
            repulsion: if self.is_repelled { 1.0 / 2000.0 } else { 0.0 },
            revolution: REVOLUTION as f64 * STEP,
            largest_step: STEP,
            agitators: self.agitators,
            // Half of one: the curve of eq. 13 takes two.
            steady_revolutions: if D == 2 { 0.5 } else { 0.25 },
            // One for the whole box.
            grid_over_spacing: 1000.0,
            ..Agitated::default()
        };
        (method.pack(&problem, &mut RunLog::new(&mut Silent))).map_err(|error| error.to_string())
    }

    fn in_dimension<const D: usize>(&self) -> Result<BTreeMap<Measure, f64>, String>
    where
        Agitated: Method<D>,
    {
        let packed = self.packed::<D>()?;
        let h = packed.h_over_spacing * packed.spacing;
        let filling = packed.frozen_lattice;
        let edges = packed.domain.bounds.size();
        // Γ of the places that move, with whoever is around them.
        let sums = |places: &[[f64; D]]| {
            if packed.domain.is_periodic() {
                return periodic_gamma(places, edges, h);
            }
            let mut all = places.to_vec();
            all.extend(filling.continued(&packed.domain, 3.0 * h + packed.spacing));
            gamma(&all, places.len(), filling.volume_per_site(), h)
        };
        let sites = filling.sites();
        let of_lattice = sums(&sites)[0];
        let particles = &packed.particles;
        let places: Vec<[f64; D]> = (0..particles.len())
            .filter(|&i| particles.kind[i] != Kind::Frozen)
            .map(|i| particles.position[i])
            .collect();
        let left = (sums(&places).iter())
            .map(|gamma| (gamma - of_lattice).abs())
            .fold(0.0, f64::max);
        let largest = (packed.history.iter())
            .filter(|sample| sample.evaluation <= REVOLUTION / 2)
            .map(|sample| sample.linf)
            .fold(0.0, f64::max);
        let mut figures = BTreeMap::from([
            (Measure::DensityLeft, left),
            (Measure::DensityLeftOverStirred, left / largest),
        ]);
        // A periodic lattice may drift as a whole.
        if !packed.domain.is_periodic() {
            let off = (places.iter())
                .map(|place| {
                    let ways = sites.iter().map(|site| point::distance(*place, *site));
                    ways.fold(f64::INFINITY, f64::min)
                })
                .fold(0.0, f64::max);
            figures.insert(Measure::FromSite, off / packed.spacing);
        }
        Ok(figures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Who rests leaves an even lattice as it was.
    #[test]
    fn an_agitator_at_rest_stirs_nothing_and_a_turning_one_does() {
        let left = |agitators| {
            let trial = Stirred {
                lattice: Lattice::Hexagonal,
                is_repelled: false,
                agitators,
                revolutions: 1,
            };
            trial.figures().unwrap()[&Measure::DensityLeft]
        };
        assert!(left(Agitators::Resting) < 1e-6);
        assert!(left(Agitators::Turning) > 1e-4);
    }
}
