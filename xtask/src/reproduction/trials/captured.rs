//! A cylinder by the hybrid method with another interval between captures (Negi & Ramachandran 2021, fig. 8).

use std::collections::BTreeMap;

use sphpack_geometry::Ball;
use sphpack_neighbors::Domain;
use sphpack_packing::{Hybrid, Kind, Problem};

use super::brute::gradients;
use crate::reproduction::measure::Measure;

/// The paper's body: radius 1, ∆s = 0.1, in a box of side 4.
const SPACING: f64 = 0.1;
const H_OVER_SPACING: f64 = 1.2;

/// So many iterations between two captures of free particles by the surface.
///
/// The paper puts boundary particles back onto the surface at the same interval; ours never leave it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Captured {
    pub(crate) every: usize,
}

impl Captured {
    pub(crate) fn words(&self) -> String {
        format!(
            "cylinder, ∆s = {SPACING}, h/∆s = {H_OVER_SPACING}, hybrid, captures every {} iterations",
            self.every
        )
    }

    pub(crate) fn figures(&self) -> Result<BTreeMap<Measure, f64>, String> {
        let body = Ball::new([0.0; 2], 1.0).map_err(|error| error.to_string())?;
        let mut problem =
            Problem::new(Domain::new([-2.0; 2], [2.0; 2]), SPACING).body("cylinder", body);
        problem.h_over_spacing = H_OVER_SPACING;
        let method = Hybrid {
            projection_frequency: self.every,
            ..Hybrid::default()
        };
        let packed = problem.pack(&method).map_err(|error| error.to_string())?;
        let particles = &packed.particles;
        let h = H_OVER_SPACING * SPACING;
        let targets: Vec<usize> = (0..particles.len())
            .filter(|&i| particles.kind[i] == Kind::Free)
            .collect();
        let found = gradients(&particles.position, &particles.volume, &targets, h);
        let sizes: Vec<f64> = (found.iter())
            .map(|gradient| h * gradient.iter().map(|x| x * x).sum::<f64>().sqrt())
            .collect();
        let mean = sizes.iter().map(|size| size * size).sum::<f64>() / sizes.len().max(1) as f64;
        Ok(BTreeMap::from([
            (Measure::Residual, sizes.iter().copied().fold(0.0, f64::max)),
            (Measure::ResidualRms, mean.sqrt()),
            (Measure::Iterations, packed.iterations as f64),
        ]))
    }
}
