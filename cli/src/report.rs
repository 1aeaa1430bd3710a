//! What is known about a packing, for machines: the content of report.json.

use serde::Serialize;
use sphpack_geometry::Moments;
use sphpack_packing::{
    DensityQuality, HistoryPoint, MassCorrection, ResidualQuality, SurfaceQuality, SymmetricDensity,
};

use crate::audit::Audit;
use crate::auto::AutoReport;
use crate::content::Spread;
use crate::scene::Scene;
use crate::walls::WallReport;

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
    /// Where spacings differ, how.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<ResolutionReport>,
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
    pub density: DensityQuality,
    /// h |∇Γ|.
    pub residual: ResidualQuality,
    /// Smallest distance of two particles, in ∆s.
    pub closest_pair_over_spacing: f64,
    /// Each body's particle surface.
    pub surface: Vec<SurfaceQuality>,
    /// Each body's content.
    pub bodies: Vec<BodyReport>,
    /// What a person should know although nothing is wrong, a sentence each.
    pub warnings: Vec<String>,
    /// Whether it is what it should be.
    pub audit: Audit,
    /// With the method "auto", what was picked and whether it is as accurate as it was to be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub auto: Option<AutoReport>,
    /// With corrected masses, what that came to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_correction: Option<MassReport>,
    /// Where the time went.
    pub seconds: SecondsReport,
    /// The most memory that the process has held; 0 where unknown.
    pub peak_memory_bytes: u64,
    /// Along the way.
    pub history: Vec<HistoryPoint>,
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

/// The figures of a surface as JSON can hold them.
pub(crate) fn finite_surface(quality: &SurfaceQuality) -> SurfaceQuality {
    SurfaceQuality {
        body: quality.body.clone(),
        max_distance_over_spacing: finite(quality.max_distance_over_spacing),
        spacing_mean_over_spacing: finite(quality.spacing_mean_over_spacing),
        spacing_cv: finite(quality.spacing_cv),
        ..*quality
    }
}

/// JSON has no infinities: 0 for figures of too few particles.
pub(crate) fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

/// How spacings differ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ResolutionReport {
    /// The finest spacing that a particle has, scene units.
    pub finest: f64,
    /// The coarsest.
    pub coarsest: f64,
    /// The coarsest over the finest.
    pub ratio: f64,
    /// The ratio of neighbouring particles' spacings, 1 + ∣∇s∣: the mean over all free particles.
    pub growth_mean: f64,
    /// The greatest.
    pub growth_max: f64,
    /// How many times as many particles the finest spacing alone would take.
    pub times_fewer: f64,
    /// By whose h density and residual are judged: "gather", every particle's own.
    pub gamma: &'static str,
    /// Density by the mean h of every pair, and what of it the field of spacings itself causes.
    pub symmetric: Option<SymmetricDensity>,
}

/// A body's content.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyReport {
    /// Its name.
    pub name: String,
    /// Volume (area) of the true body.
    pub volume_true: f64,
    /// Volume of its particles, with layers of these; those on its surface count in whole for an inset surface, in half for an exact one.
    pub volume: f64,
    /// Density × `volume`.
    pub mass: f64,
    /// With layers, what they are like; `volume` and `mass` are theirs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall: Option<WallReport>,
    /// A solid as a rigid body; `None` of voids and containers, and of what goes on beyond the sides of the box.
    pub rigid: Option<RigidReport>,
    /// What was mended before it was packed, a sentence each.
    pub repairs: Vec<String>,
}

impl BodyReport {
    /// Of a body that is a wall in layers of such a volume: its particles are no body that turns.
    pub(crate) fn be_wall(&mut self, volume: f64, density: f64, wall: WallReport) {
        self.volume = volume;
        self.mass = density * volume;
        self.wall = Some(wall);
        if let Some(rigid) = &mut self.rigid {
            rigid.particles = None;
        }
    }
}

/// A solid as a rigid body, by its surface and by its particles.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RigidReport {
    /// Of the true body.
    pub exact: Rigid,
    /// Of its particles, as points; `None` where it has none, or only layers of them.
    pub particles: Option<Rigid>,
}

/// What a rigid body is to who turns it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rigid {
    /// Density × volume (area in 2-D).
    pub mass: f64,
    /// Centre of mass, D coordinates, scene units.
    pub center: Vec<f64>,
    /// Tensor of inertia about the centre of mass, along the scene's axes: three rows. In 2-D, where bodies turn about z, of a flat
    /// plate; the last entry is the one for that.
    pub inertia: [[f64; 3]; 3],
}

impl RigidReport {
    pub(crate) fn new<const D: usize>(spread: &Spread<D>, density: f64) -> Self {
        let of = |moments: &Moments<D>| Rigid::new(moments, density);
        Self {
            exact: of(&spread.exact),
            particles: spread.particles.as_ref().map(of),
        }
    }
}

impl Rigid {
    /// Of a body of such moments and density.
    fn new<const D: usize>(moments: &Moments<D>, density: f64) -> Self {
        Self {
            mass: density * moments.volume,
            center: moments.center.to_vec(),
            inertia: moments
                .inertia()
                .map(|row| row.map(|entry| density * entry)),
        }
    }
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
