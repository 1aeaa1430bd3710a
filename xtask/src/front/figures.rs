//! What a packing of the chart came to.

use serde::{Deserialize, Serialize};

/// The figures, judged by the quintic at h/∆s = 1.2 unless they say otherwise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Figures {
    /// All but the frozen ones.
    pub(super) particles: f64,
    /// Of density and force.
    pub(super) evaluations: f64,
    /// That all sums went over, about ([`pairs`](super::pairs::pairs)).
    pub(super) pairs: f64,
    /// Wall clock, from scene to figures, the quickest of some repeats.
    pub(super) seconds: f64,
    /// Of all threads together, of that same repeat.
    pub(super) processor_seconds: f64,
    /// Most memory of the process.
    pub(super) peak_memory_bytes: f64,
    /// max |Γ − 1|.
    pub(super) linf: f64,
    /// Largest h |∇Γ| of a free particle.
    pub(super) residual: f64,
    /// L2 of a wave interpolated off the sites, over the lattice's own ([`Packed::interpolation`](sphpack_packing::Packed::interpolation));
    /// of small packings alone.
    pub(super) function: Option<f64>,
    /// The same of its derivative.
    pub(super) derivative: Option<f64>,
    /// In ∆s.
    pub(super) closest_pair: f64,
    /// Particles on the surface over N_s.
    pub(super) on_surface: f64,
    /// Why it stopped.
    pub(super) stop_reason: String,
    /// max |Γ − Γ₀| by each of the judges ([`judges`](super::judges::judges)).
    pub(super) judged: Vec<f64>,
}

/// How a packing ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Ended {
    /// With figures.
    Measured(Box<Figures>),
    /// Without, and why.
    LeftOut(String),
}
