//! The airfoil 30P30N by 004's relaxations: gaps and kernel gradients at its edges (Zhao et al. 2025, fig. 8).

use std::collections::BTreeMap;

use crate::relaxed_airfoils::{Figures, Way, airfoils};
use crate::reproduction::measure::Measure;
use crate::selection::Selection;

/// How it is parsed and relaxed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Elements {
    pub(crate) way: Way,
}

/// Its name among the airfoils.
const NAME: &str = "30P30N";

impl Elements {
    pub(crate) fn words(&self) -> String {
        format!("{NAME}, ∆s = c/250, {}", self.short())
    }

    /// The way alone.
    pub(crate) fn short(&self) -> String {
        format!(
            "{}, fluid bounded by {}",
            self.way.relaxation(),
            self.way.boundary()
        )
    }

    /// `None` where its files are not there.
    pub(crate) fn figures(
        &self,
        selection: &Selection,
    ) -> Result<Option<BTreeMap<Measure, f64>>, String> {
        let all = airfoils(selection)?;
        let Some(airfoil) = all.iter().find(|airfoil| airfoil.name == NAME) else {
            return Ok(None);
        };
        let particles = airfoil.relaxed(self.way)?;
        let figures = Figures::of(airfoil, &particles);
        Ok(Some(BTreeMap::from([
            (Measure::LargestHole, figures.hole[0]),
            (Measure::LeastGamma, figures.least[0]),
            (Measure::FluidResidual, airfoil.fluid_residual(&particles)),
        ])))
    }
}
