//! Measures of a particle set, the same for every method and for anybody's particles.

use sphpack_kernels::KernelKind;

/// Γ and ∇Γ at every particle.
#[derive(Debug, Clone, PartialEq)]
pub struct Fields<const D: usize> {
    /// The kernel that measured.
    pub kernel: KernelKind,
    /// Its smoothing length, scene units.
    pub smoothing_length: f64,
    /// Γ_i = Σ_j V_j W_ij, the particle itself included. Dimensionless; 1 is ideal.
    pub gamma: Vec<f64>,
    /// ∇Γ_i = Σ_j V_j ∇_iW_ij, per scene unit; 0 is ideal.
    pub gradient: Vec<[f64; D]>,
}

/// How even the density is, over free, boundary and fixed particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DensityQuality {
    /// Smallest Γ.
    pub min: f64,
    /// Largest Γ.
    pub max: f64,
    /// max |Γ − 1|.
    pub linf: f64,
    /// max Γ − min Γ.
    pub total_variation: f64,
    /// Root mean square of Γ − 1.
    pub rms: f64,
    /// Γ of the perfect lattice of this kernel and h/∆s; differs from 1 for short kernels.
    pub lattice: f64,
}

/// How far from rest under background pressure alone: h |∇Γ|, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResidualQuality {
    /// Largest of the free particles.
    pub max: f64,
    /// Root mean square of the free particles.
    pub rms: f64,
    /// Mean of the free particles.
    pub mean: f64,
    /// Largest tangential part of the boundary particles.
    pub max_tangential: f64,
}

/// How well a surface is covered.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceQuality {
    /// The body's name.
    pub body: String,
    /// Length or area of the particle surface.
    pub measure: f64,
    /// N_s.
    pub target_count: usize,
    /// Particles on it.
    pub count: usize,
    /// Largest distance of a boundary particle from the particle surface, in ∆s.
    pub max_distance_over_spacing: f64,
    /// Mean distance to the nearest neighbour on the surface, in ∆s.
    pub spacing_mean_over_spacing: f64,
    /// Coefficient of variation of that distance.
    pub spacing_cv: f64,
}

/// Everything that is measured of a packing.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// Density.
    pub density: DensityQuality,
    /// Residual.
    pub residual: ResidualQuality,
    /// Each body's surface.
    pub surface: Vec<SurfaceQuality>,
    /// Smallest distance between two particles, in ∆s.
    pub closest_pair_over_spacing: f64,
}
