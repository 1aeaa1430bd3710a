//! Density by the mean smoothing length of every pair, and what a field of spacings makes of it.

use rayon::prelude::*;
use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{CellList, gauss, point};

use crate::forces::{blocked_sum, largest};
use crate::packed::Packed;
use crate::particles::Kind;
use crate::slabs::{self, Slab};

/// Γˢ_i = Σ_j V_j W(r_ij, (h_i + h_j)/2) of all particles but frozen ones. A field of spacings biases it, whatever the packing, by
/// μ (¼ |∇h|² + ½ h ∇²h), where μ h² is the kernel's second moment along an axis; beside a kink of the field that is a rough
/// mean.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SymmetricDensity {
    /// The largest |Γˢ − 1|.
    pub linf: f64,
    /// Its root mean square.
    pub rms: f64,
    /// The largest bias that the field causes by itself.
    pub bias_linf: f64,
    /// Its root mean square.
    pub bias_rms: f64,
    /// The root mean square of what is left without it, Γˢ − 1 − bias.
    pub rest_rms: f64,
}

/// The field's second derivatives are differences of its gradients over so many spacings to either side: about as far as a kernel
/// weighs them.
const BESIDE: f64 = 1.0;

impl<const D: usize> Packed<D> {
    /// [`SymmetricDensity`] by the kernel that packed; `None` where all particles have one size. O(n log n), parallel, one
    /// closest point or so of every body for each particle and axis.
    pub fn symmetric_density(&self) -> Option<SymmetricDensity> {
        self.particles.sizes.relative()?;
        let gamma = self.symmetric();
        let moment = second_moment::<D>(self.kernel);
        let inner: Vec<usize> = (0..self.particles.len())
            .filter(|&i| self.particles.kind[i] != Kind::Frozen)
            .collect();
        let bias: Vec<f64> = inner
            .par_iter()
            .with_min_len(64)
            .map(|&i| moment * self.bend(i))
            .collect();
        let off: Vec<f64> = inner.iter().map(|&i| gamma[i] - 1.0).collect();
        let rest: Vec<f64> = off
            .iter()
            .zip(&bias)
            .map(|(off, bias)| off - bias)
            .collect();
        let rms = |of: &[f64]| (blocked_sum(of, |x| x * x) / of.len().max(1) as f64).sqrt();
        let linf = |of: &[f64]| largest(of.len(), |k| of[k].abs());
        Some(SymmetricDensity {
            linf: linf(&off),
            rms: rms(&off),
            bias_linf: linf(&bias),
            bias_rms: rms(&bias),
            rest_rms: rms(&rest),
        })
    }

    /// ¼ |∇h|² + ½ h ∇²h at a particle.
    fn bend(&self, i: usize) -> f64 {
        let resolution = &self.problem.resolution;
        let place = self.particles.position[i];
        let here = resolution.at(place);
        let step = BESIDE * here.value;
        let mut laplacian = 0.0;
        for k in 0..D {
            let beside = |step: f64| {
                let mut p = place;
                p[k] += step;
                resolution.at(self.domain.wrap(p)).gradient[k]
            };
            laplacian += (beside(step) - beside(-step)) / (2.0 * step);
        }
        let ratio = self.particles.sizes.h_over_spacing();
        let slope = point::norm_squared(here.gradient);
        ratio * ratio * (0.25 * slope + 0.5 * here.value * laplacian)
    }

    /// Γˢ of every particle; zero for frozen ones.
    fn symmetric(&self) -> Vec<f64> {
        let particles = &self.particles;
        let sizes = &particles.sizes;
        let length = |i: usize| sizes.smoothing_length(i);
        let support = self.kernel.support_over_h();
        let most = (0..particles.len()).fold(0.0, |most: f64, i| most.max(length(i)));
        let mut gamma = vec![0.0; particles.len()];
        let slabs = slabs::slabs(
            &self.domain,
            &particles.position,
            support * most,
            slabs::MOST,
        );
        for Slab { order, is_inside } in slabs {
            let positions: Vec<[f64; D]> = order.iter().map(|&i| particles.position[i]).collect();
            let supports: Vec<f64> = order.iter().map(|&i| support * length(i)).collect();
            let mut list = CellList::new(&self.domain, support * most);
            let is_target = |k: usize| is_inside[k] && particles.kind[order[k]] != Kind::Frozen;
            list.update_each(&positions, &supports, is_target);
            let sum = |k: usize| {
                let near = list.neighbors(k).map(|(j, shift)| {
                    let way = point::sub(positions[k], point::add(positions[j], shift));
                    let (i, j) = (order[k], order[j]);
                    [
                        particles.volume[j],
                        point::norm(way),
                        0.5 * (length(i) + length(j)),
                    ]
                });
                // A particle is none of its own neighbours.
                let own = [particles.volume[order[k]], 0.0, length(order[k])];
                self.kernel.with::<D, _>(1.0, Sum(near.chain([own])))
            };
            let targets = list.target_particles();
            let sums: Vec<(usize, f64)> = (targets.par_iter().with_min_len(64))
                .map(|&k| (order[k as usize], sum(k as usize)))
                .collect();
            for (i, sum) in sums {
                gamma[i] = sum;
            }
        }
        gamma
    }
}

/// Σ V W(r, h) over triples of these.
struct Sum<I>(I);

impl<const D: usize, I: Iterator<Item = [f64; 3]>> WithKernel<D> for Sum<I> {
    type Output = f64;

    fn call<K: Kernel<D>>(self, unit: K) -> f64 {
        let of = |[volume, r, h]: [f64; 3]| volume * unit.value(r / h) / h.powi(D as i32);
        self.0.map(of).sum()
    }
}

/// μ = ∫ W x² dV / h².
fn second_moment<const D: usize>(kernel: KernelKind) -> f64 {
    struct Moment;

    impl<const D: usize> WithKernel<D> for Moment {
        type Output = f64;

        fn call<K: Kernel<D>>(self, unit: K) -> f64 {
            let sphere = if D == 2 { 2.0 } else { 4.0 } * std::f64::consts::PI;
            // Piece by piece: kernels are piecewise polynomials.
            let pieces = 12.0 * unit.support();
            let width = unit.support() / pieces.ceil();
            let mut sum = 0.0;
            for piece in 0..pieces.ceil() as usize {
                for (x, weight) in gauss::FIVE {
                    let r = (piece as f64 + 0.5 * (1.0 + x)) * width;
                    sum += 0.5 * width * weight * unit.value(r) * r.powi(D as i32 + 1);
                }
            }
            sphere * sum / D as f64
        }
    }

    kernel.with::<D, _>(1.0, Moment)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::Balanced;
    use crate::{Problem, Spacing, SpacingFunction};
    use sphpack_geometry::Ball;

    #[test]
    fn moments_are_those_of_the_kernels() {
        // In the plane a Wendland C2's is 5/72 of its support squared, by Euler's beta function.
        assert!((second_moment::<2>(KernelKind::Quintic) - 0.4833).abs() < 1e-3);
        assert!((second_moment::<3>(KernelKind::Quintic) - 0.4671).abs() < 1e-3);
        let wendland = second_moment::<2>(KernelKind::WendlandC2) / 4.0;
        assert!((wendland - 5.0 / 72.0).abs() < 1e-9, "{wendland}");
    }

    #[test]
    fn the_bias_is_the_fields() {
        let ball = Ball::new([0.0; 2], 0.5).expect("a ball");
        // Smooth: ln s is a cosine of the distance.
        let field = SpacingFunction::new([0.02, 0.08], |p: [f64; 2]| {
            let r = p[0].hypot(p[1]);
            let angle = std::f64::consts::PI * r.min(1.0);
            let value = 0.04 * (-(2.0_f64.ln()) * angle.cos()).exp();
            let slope = value * 2.0_f64.ln() * angle.sin() * std::f64::consts::PI / r.max(1e-9);
            Spacing {
                value,
                gradient: p.map(|x| slope * x),
            }
        });
        let packed = Problem::around(&ball, field).pack(&Balanced::default());
        let packed = packed.expect("a packing");
        let symmetric = packed.symmetric_density().expect("many sizes");
        // By gather it is level; by the mean of h most of what is off is what the field causes; the rest is of higher order.
        assert!(packed.quality().density.linf < 2e-3);
        assert!(symmetric.rms > 2e-3, "{symmetric:?}");
        assert!(symmetric.rest_rms < 0.55 * symmetric.rms, "{symmetric:?}");
        let uniform = (Problem::around(&ball, 0.1).pack(&Balanced::default())).expect("a packing");
        assert_eq!(uniform.symmetric_density(), None);
    }
}
