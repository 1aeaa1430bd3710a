//! Errors that the chart is drawn over.

use super::figures::Figures;

/// A figure by which packings are better or worse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Error {
    /// [`Figures::linf`].
    Linf,
    /// [`Figures::residual`].
    Residual,
    /// How far [`Figures::function`] is from 1.
    Function,
    /// How far [`Figures::derivative`] is from 1.
    Derivative,
}

impl Error {
    /// On axes and in tables.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Linf => "largest error of the density |Γ − 1|, %",
            Self::Residual => "largest residual h|∇Γ|",
            Self::Function => "L2 of sin(r²), off the lattice's by, %",
            Self::Derivative => "L2 of its derivative, off the lattice's by, %",
        }
    }

    /// As it is drawn: in the unit of its title.
    pub(super) fn of(self, figures: &Figures) -> Option<f64> {
        match self {
            Self::Linf => Some(100.0 * figures.linf),
            Self::Residual => Some(figures.residual),
            // Both lie within a few per cent of the lattice's: most of an error is the kernel's own smoothing.
            Self::Function => figures.function.map(off),
            Self::Derivative => figures.derivative.map(off),
        }
    }
}

/// A ratio's distance from 1, in per cent.
fn off(ratio: f64) -> f64 {
    100.0 * (ratio - 1.0).abs()
}
