//! What the sums of graded particles read, column by column.

use sphpack_kernels::KernelKind;
use sphpack_pairs::Repulsion;

use super::mirror::Mirror;
use crate::particles::Particles;

/// A column for each thing that sums read.
#[derive(Debug, Clone, Default)]
pub(super) struct Columns<const D: usize> {
    pub(super) place: Vec<[f64; D]>,
    pub(super) volume: Vec<f64>,
    pub(super) spacing: Vec<f64>,
    pub(super) smoothing_length: Vec<f64>,
    pub(super) support: Vec<f64>,
    /// κ (Γ − Γ₀), held between −1 and 1.
    pub(super) pressure: Vec<f64>,
}

/// How far a particle looks, in its h: as far as its kernel, and as the repulsion.
pub(super) fn reach_over_h(kernel: KernelKind, h_over_spacing: f64) -> f64 {
    (kernel.support_over_h()).max(Repulsion::REACH_OVER_SPACING / h_over_spacing)
}

impl<const D: usize> Columns<D> {
    /// Of particles and, behind them, their images.
    pub(super) fn fill(
        &mut self,
        particles: &Particles<D>,
        mirror: &Mirror<D>,
        kernel: KernelKind,
    ) {
        let (count, sizes) = (particles.len(), &particles.sizes);
        self.place.clear();
        self.place.extend_from_slice(&particles.position);
        self.place.extend(mirror.places(&particles.position));
        self.volume.clear();
        self.volume.extend_from_slice(&particles.volume);
        self.spacing.clear();
        self.spacing.extend((0..count).map(|i| sizes.spacing(i)));
        for i in mirror.particles() {
            self.volume.push(particles.volume[i]);
            self.spacing.push(self.spacing[i]);
        }
        let h_over_spacing = sizes.h_over_spacing();
        self.smoothing_length.clear();
        self.smoothing_length
            .extend(self.spacing.iter().map(|spacing| h_over_spacing * spacing));
        let reach = reach_over_h(kernel, h_over_spacing);
        self.support.clear();
        self.support
            .extend(self.smoothing_length.iter().map(|h| reach * h));
        self.pressure.clear();
        self.pressure.resize(count + mirror.len(), 0.0);
    }
}
