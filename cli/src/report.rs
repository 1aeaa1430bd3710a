//! What is known about a packing, for machines: the content of report.json.

use serde::Serialize;
use sphpack_packing::{
    DensityQuality, HistoryPoint, MassCorrection, ResidualQuality, SurfaceQuality,
};

use crate::audit::Audit;
use crate::scene::Scene;

/// The version of the report's keys.
pub const SCHEMA: u32 = 1;

/// A packing's report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: u32,
    /// The program's version.
    pub version: &'static str,
    /// The scene with its defaults filled in.
    pub scene: Scene,
    /// 2 or 3.
    pub dimension: usize,
    /// ∆s, scene units.
    pub spacing: f64,
    /// The method's name.
    pub method: &'static str,
    /// The name of the kernel that packed.
    pub kernel: &'static str,
    /// Its smoothing length over ∆s.
    pub h_over_spacing: f64,
    /// The scene's.
    pub seed: u64,
    /// Threads that worked.
    pub threads: usize,
    /// Whether the tolerance was reached.
    pub converged: bool,
    /// Why it stopped.
    pub stop_reason: &'static str,
    /// Of the method.
    pub iterations: usize,
    /// Of density and force.
    pub force_evaluations: usize,
    /// How many there are.
    pub particles: Counts,
    /// Of Γ, over free, boundary and fixed particles.
    pub density: Density,
    /// h |∇Γ|.
    pub residual: Residual,
    /// Smallest distance of two particles, in ∆s.
    pub closest_pair_over_spacing: f64,
    /// Each body's particle surface.
    pub surface: Vec<SurfaceReport>,
    /// Each body's content.
    pub bodies: Vec<BodyReport>,
    /// What a person should know although nothing is wrong, a sentence each.
    pub warnings: Vec<String>,
    /// Whether it is what it should be.
    pub audit: Audit,
    /// With corrected masses, what that came to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_correction: Option<MassReport>,
    /// Where the time went.
    pub seconds: SecondsReport,
    /// The most memory that the process has held; 0 where unknown.
    pub peak_memory_bytes: u64,
    /// Along the way.
    pub history: Vec<History>,
}

/// How many particles there are, after roles and `fluid.fill`, before `output.include`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// All of them, frozen ones included.
    pub total: usize,
    /// Move freely.
    pub free: usize,
    /// Move on a surface.
    pub boundary: usize,
    /// Sit on corners.
    pub fixed: usize,
    /// Outside the domain.
    pub frozen: usize,
    /// Belong to a body.
    pub solid: usize,
    /// Belong to the fluid; frozen ones belong to neither.
    pub fluid: usize,
}

/// Γ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Density {
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
    /// max |Γ − 1|.
    pub linf: f64,
    /// max − min.
    pub total_variation: f64,
    /// Root mean square of Γ − 1.
    pub rms: f64,
    /// Γ of the perfect lattice.
    pub lattice: f64,
}

impl From<DensityQuality> for Density {
    fn from(quality: DensityQuality) -> Self {
        Self {
            min: quality.min,
            max: quality.max,
            linf: quality.linf,
            total_variation: quality.total_variation,
            rms: quality.rms,
            lattice: quality.lattice,
        }
    }
}

/// h |∇Γ|.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Residual {
    /// Largest of the free particles.
    pub max: f64,
    /// Root mean square of the free particles.
    pub rms: f64,
    /// Mean of the free particles.
    pub mean: f64,
    /// Largest tangential part of the boundary particles.
    pub max_tangential: f64,
}

impl From<ResidualQuality> for Residual {
    fn from(quality: ResidualQuality) -> Self {
        Self {
            max: quality.max,
            rms: quality.rms,
            mean: quality.mean,
            max_tangential: quality.max_tangential,
        }
    }
}

/// A body's particle surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SurfaceReport {
    /// The body's name.
    pub body: String,
    /// Length or area.
    pub measure: f64,
    /// N_s.
    pub target_count: usize,
    /// Particles on it.
    pub count: usize,
    /// Largest distance of one from it.
    pub max_distance_over_spacing: f64,
    /// Mean distance to the nearest neighbour on it.
    pub spacing_mean_over_spacing: f64,
    /// Coefficient of variation of that.
    pub spacing_cv: f64,
}

impl From<&SurfaceQuality> for SurfaceReport {
    fn from(quality: &SurfaceQuality) -> Self {
        Self {
            body: quality.body.clone(),
            measure: quality.measure,
            target_count: quality.target_count,
            count: quality.count,
            max_distance_over_spacing: finite(quality.max_distance_over_spacing),
            spacing_mean_over_spacing: finite(quality.spacing_mean_over_spacing),
            spacing_cv: finite(quality.spacing_cv),
        }
    }
}

/// JSON has no infinities: 0 for figures of too few particles.
pub(crate) fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

/// A body's content.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyReport {
    /// Its name.
    pub name: String,
    /// Volume (area) of the true body.
    pub volume_true: f64,
    /// Volume of its particles; those on its surface count in whole for an inset surface, in half for an exact one.
    pub volume: f64,
    /// Density × `volume`.
    pub mass: f64,
    /// What was mended before it was packed, a sentence each.
    pub repairs: Vec<String>,
}

/// What a correction of masses came to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MassReport {
    /// max |Γ − 1| before.
    pub linf_before: f64,
    /// Largest change of a mass, as a part of it.
    pub spread: f64,
    /// Sums over all pairs that it took.
    pub evaluations: usize,
}

impl From<MassCorrection> for MassReport {
    fn from(correction: MassCorrection) -> Self {
        Self {
            linf_before: correction.linf[0],
            spread: correction.spread,
            evaluations: correction.evaluations,
        }
    }
}

/// Seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct SecondsReport {
    /// From reading the scene to the last file.
    pub total: f64,
    /// Reading bodies, moving surfaces inward.
    pub geometry: f64,
    /// Placing particles.
    pub seeding: f64,
    /// Keeping neighbour lists.
    pub neighbors: f64,
    /// Density and forces.
    pub forces: f64,
    /// Keeping particles on surfaces.
    pub projection: f64,
    /// What else settling takes: the minimiser's own arithmetic, or moving and capturing.
    pub minimiser: f64,
    /// Telling particles apart, their figures, the audit.
    pub measuring: f64,
    /// Writing files, this one not included.
    pub output: f64,
}

/// Figures at one evaluation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct History {
    /// Which.
    pub evaluation: usize,
    /// Energy per particle, in p_b V.
    pub energy: f64,
    /// Largest h |∇Γ| of a free particle.
    pub residual: f64,
    /// max |Γ − 1|.
    pub linf: f64,
    /// Since the packing began.
    pub seconds: f64,
}

impl From<&HistoryPoint> for History {
    fn from(sample: &HistoryPoint) -> Self {
        Self {
            evaluation: sample.evaluation,
            energy: sample.energy,
            residual: sample.residual,
            linf: sample.linf,
            seconds: sample.seconds,
        }
    }
}

impl Report {
    /// The report as JSON text, a line break at its end.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).map_or_else(|_| String::new(), |text| text + "\n")
    }
}

/// The most memory that this process has held, bytes; 0 where the system does not say.
pub(crate) fn peak_memory_bytes() -> u64 {
    kibibytes("/proc/self/status", "VmHWM:").unwrap_or(0)
}

/// A line "NAME  123 kB" of a file of the system, in bytes.
pub(crate) fn kibibytes(file: &str, name: &str) -> Option<u64> {
    std::fs::read_to_string(file)
        .ok()?
        .lines()
        .find_map(|line| line.strip_prefix(name))?
        .split_whitespace()
        .next()?
        .parse::<u64>()
        .ok()?
        .checked_mul(1024)
}
