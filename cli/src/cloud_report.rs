//! What `sphpack quality` says of anybody's particles.

use serde::Serialize;
use sphpack_kernels::KernelKind;
use sphpack_packing::{DensityQuality, ResidualQuality};

use crate::Error;
use crate::audit::Audit;
use crate::cloud::{Cloud, CloudQuality};

/// The figures and the audit of somebody's particles.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CloudReport {
    /// 2 or 3.
    pub dimension: usize,
    /// ∆s, scene units.
    pub spacing: f64,
    /// The kernel that measures.
    pub kernel: &'static str,
    /// Its smoothing length over ∆s.
    pub h_over_spacing: f64,
    /// How many particles were measured.
    pub particles: CloudCounts,
    /// Γ.
    pub density: DensityQuality,
    /// h |∇Γ|.
    pub residual: ResidualQuality,
    /// What is wrong with them.
    pub audit: Audit,
}

/// Numbers of particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct CloudCounts {
    /// In the file.
    pub total: usize,
    /// Frozen ones among them.
    pub frozen: usize,
    /// Of which Γ was measured.
    pub measured: usize,
    /// Not measured, as they are near the edge of a set without frozen particles.
    pub left_out_near_edge: usize,
}

impl Cloud {
    /// Measures the particles and audits them.
    ///
    /// # Errors
    /// Those of [`Cloud::measure`].
    pub fn report(
        &self,
        spacing: f64,
        kernel: KernelKind,
        h_over_spacing: f64,
    ) -> Result<CloudReport, Error> {
        let measured = self.measure(spacing, kernel, h_over_spacing)?;
        let audit = Audit::of_cloud(self, spacing, &measured);
        let CloudQuality {
            density,
            residual,
            measured,
            left_out,
            ..
        } = measured;
        Ok(CloudReport {
            dimension: self.dimension,
            spacing,
            kernel: kernel.name(),
            h_over_spacing,
            particles: CloudCounts {
                total: self.position.len(),
                frozen: self.frozen_count(),
                measured,
                left_out_near_edge: left_out,
            },
            density,
            residual,
            audit,
        })
    }
}

impl CloudReport {
    /// The report as JSON text, a line break at its end.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).map_or_else(|_| String::new(), |text| text + "\n")
    }
}
