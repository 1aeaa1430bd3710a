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
    /// All, in the order of tables.
    pub(super) const ALL: [Self; 4] =
        [Self::Linf, Self::Residual, Self::Function, Self::Derivative];

    /// As a scene's `accuracy` calls it.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Linf => "linf",
            Self::Residual => "residual",
            Self::Function => "interpolation",
            Self::Derivative => "derivative",
        }
    }

    /// How many units of its title are 1: all but residuals are in per cent.
    pub(super) fn unit(self) -> f64 {
        match self {
            Self::Residual => 1.0,
            _ => 100.0,
        }
    }

    /// On axes and in tables.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Linf => "largest error of the density |Γ − 1|, %",
            Self::Residual => "largest residual h|∇Γ|",
            Self::Function => "L2 of a wave, off the lattice's by, %",
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
