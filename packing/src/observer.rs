//! Watching a packing while it runs, and stopping it.

use std::io::{self, Write};
use std::ops::ControlFlow;

/// What a packing is busy with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Stage {
    /// Surfaces are moved inward, areas and counts are taken.
    Geometry,
    /// Particles are placed on the lattice.
    Seeding,
    /// Particles are captured by the surface while they settle (hybrid).
    Capture,
    /// Particles settle.
    Settling,
}

impl Stage {
    /// The word that progress lines use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Geometry => "geometry",
            Self::Seeding => "seeding",
            Self::Capture => "capture",
            Self::Settling => "settling",
        }
    }
}

/// Where a packing stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// What it is busy with.
    pub stage: Stage,
    /// Force evaluations so far.
    pub evaluation: usize,
    /// The evaluation at which it gives up.
    pub max_evaluations: usize,
    /// What the stop looks at: u_max ∆t/h for damped dynamics, the largest force for minimisers. Dimensionless.
    pub criterion: f64,
    /// The value of `criterion` at which it stops.
    pub tolerance: f64,
    /// Particles on surfaces so far.
    pub on_surface: usize,
    /// Particles that the surfaces should carry (N_s).
    pub target: usize,
    /// Seconds since the packing began.
    pub seconds: f64,
}

/// A line of a packing's history.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HistoryPoint {
    /// Force evaluations so far.
    pub evaluation: usize,
    /// Energy of background pressure and repulsion, per particle and in units of p_b V.
    pub energy: f64,
    /// The largest residual h |Σ V ∇W| of a free particle.
    pub residual: f64,
    /// max |Γ − 1|.
    pub linf: f64,
    /// Seconds since the packing began.
    pub seconds: f64,
}

/// Told how a packing goes on; it may stop it.
///
/// Nothing that an observer does changes the result, except when it stops.
pub trait Observer {
    /// Called at the start of every stage, and every few evaluations. `Break` ends the packing with what there is.
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()>;

    /// Who keeps states to go on from, should this run end too early.
    fn keeper(&mut self) -> Option<&mut dyn Keeper> {
        None
    }
}

/// Keeps states of a packing. A state is all that its loops have come to, as bytes: same method, same problem and a
/// state give the bits that they would have given without a stop. What was placed before the loops is placed again.
pub trait Keeper {
    /// Whether a state is wanted now. Asked once before every step, and once more after [`Observer::progress`] has
    /// stopped the packing.
    fn is_due(&mut self) -> bool;

    /// A state, which `write` writes: some hundred bytes per particle, in small pieces. The packing waits meanwhile.
    /// What comes of it is the keeper's affair.
    fn keep(&mut self, write: &dyn Fn(&mut dyn Write) -> io::Result<()>);

    /// The state to go on from; asked once, when a packing begins.
    fn earlier(&mut self) -> Option<Vec<u8>>;
}

/// Watches nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Observer for Silent {
    fn progress(&mut self, _: &Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
