//! A penalty on what background pressure leaves of chosen particles' forces.

use rayon::prelude::*;
use sphpack_kernels::{Kernel, WithKernel};
use sphpack_neighbors::point;

use crate::forces::Forces;
use crate::particles::Particles;

/// The energy ½ μ h² Σ V_i |∇Γ_i|² of some particles, ∇Γ = Σ V ∇W: what holds density even elsewhere then leaves these
/// with almost no kernel gradient sum.
///
/// Evaluated pair by pair, force against force: for few particles among many.
#[derive(Debug)]
pub struct GradientPenalty<const D: usize> {
    particles: Vec<u32>,
    stiffness: f64,
    force: Vec<[f64; D]>,
}

impl<const D: usize> GradientPenalty<D> {
    /// Of these particles, with μ = `stiffness`.
    pub fn of(particles: Vec<u32>, stiffness: f64) -> Self {
        Self {
            particles,
            stiffness,
            force: Vec::new(),
        }
    }

    /// The energy at the last evaluation of `forces`, volumes in units of `unit`; afterwards [`GradientPenalty::force`] is −∇ of
    /// it. The same bits for any number of threads.
    pub(super) fn evaluate(
        &mut self,
        forces: &Forces<D>,
        particles: &Particles<D>,
        unit: f64,
    ) -> f64 {
        let scale = self.stiffness * forces.smoothing_length().powi(2) / unit;
        let pushes = forces.with_kernel(Pushes {
            of: &self.particles,
            forces,
            particles,
            scale,
        });
        self.force.clear();
        self.force.resize(particles.len(), [0.0; D]);
        let mut energy = 0.0;
        for (&i, pushes) in self.particles.iter().zip(pushes) {
            let i = i as usize;
            let gradient = forces.gradient(i);
            energy += 0.5 * scale * particles.volume[i] * point::dot(gradient, gradient);
            for (j, push) in pushes {
                self.force[i] = point::sub(self.force[i], push);
                self.force[j] = point::add(self.force[j], push);
            }
        }
        energy
    }

    /// The force on every particle.
    pub(super) fn force(&self) -> &[[f64; D]] {
        &self.force
    }
}

/// V_i V_j ∇∇W_ij ∇Γ_i for every pair of some particles i.
struct Pushes<'a, const D: usize> {
    of: &'a [u32],
    forces: &'a Forces<D>,
    particles: &'a Particles<D>,
    scale: f64,
}

impl<const D: usize> WithKernel<D> for Pushes<'_, D> {
    type Output = Vec<Vec<(usize, [f64; D])>>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        let (list, volume) = (self.forces.list(), &self.particles.volume);
        let of_one = |&i: &u32| {
            let i = i as usize;
            let gradient = point::scale(self.forces.gradient(i), self.scale * volume[i]);
            list.around(i, &self.particles.position)
                .map(|(j, apart)| {
                    let row = kernel.hessian(apart).map(|row| point::dot(row, gradient));
                    (j, point::scale(row, volume[j]))
                })
                .collect()
        };
        self.of.par_iter().with_min_len(64).map(of_one).collect()
    }
}
