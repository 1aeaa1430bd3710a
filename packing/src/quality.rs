//! Measures of a particle set, the same for every method and for anybody's particles.

use std::fmt;

use rayon::prelude::*;
use sphpack_geometry::thickness;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Domain, KdTree, point};

use crate::closest_pair::{ClosestPair, NEIGHBORS_IN_SIZES};
use crate::forces::{Forces, blocked_sum, largest};
use crate::packed::{Packed, ParticleSurface, SurfaceParticle};
use crate::particles::Kind;
use crate::sizes::Sizes;
use crate::slabs::{self, Slab};
use sphpack_pairs::Repulsion;

/// Γ and ∇Γ at every particle.
#[derive(Debug, Clone, PartialEq)]
pub struct Fields<const D: usize> {
    /// The kernel that measured.
    pub kernel: KernelKind,
    /// The spacings, and the smoothing length over them that measured.
    pub sizes: Sizes,
    /// Γ_i = Σ_j V_j W_ij, the particle itself included. Dimensionless; 1 is ideal.
    pub gamma: Vec<f64>,
    /// ∇Γ_i = Σ_j V_j ∇_iW_ij, per scene unit; 0 is ideal.
    pub gradient: Vec<[f64; D]>,
}

/// How even the density is, over free, boundary and fixed particles.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DensityQuality {
    /// Smallest Γ.
    pub min: f64,
    /// Largest Γ.
    pub max: f64,
    /// max |Γ − 1|.
    pub linf: f64,
    /// max |Γ − Γ₀|, Γ₀ being `lattice`: what no kernel's own bias is part of.
    pub linf_lattice: f64,
    /// max Γ − min Γ.
    pub total_variation: f64,
    /// Root mean square of Γ − 1.
    pub rms: f64,
    /// Γ of the perfect lattice of this kernel and h/∆s; differs from 1 for short kernels.
    pub lattice: f64,
}

/// How far from rest under background pressure alone: h |∇Γ|, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    /// Mean distance to the nearest neighbour on the surface, in ∆s, where the particle surface's sides are at least ∆s
    /// apart: thinner parts have fewer particles on purpose.
    pub spacing_mean_over_spacing: f64,
    /// Coefficient of variation of that distance.
    pub spacing_cv: f64,
}

/// Everything that is measured of a packing.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quality {
    /// Density.
    pub density: DensityQuality,
    /// Residual.
    pub residual: ResidualQuality,
    /// Each body's surface.
    pub surface: Vec<SurfaceQuality>,
    /// Smallest distance between two particles, in ∆s; where they differ in size, in the mean of both sizes, V^(1/D).
    pub closest_pair_over_spacing: f64,
    /// Smallest distance between two particles in the mean of both sizes, V^(1/D), where that is below a half; infinite
    /// where no two are so near.
    pub crowded: f64,
    /// Where that is; empty where it is nowhere.
    pub crowded_at: Vec<f64>,
}

/// The figures in a line, such as `L∞ 0.0010, residual 2.1e-3, closest pair 0.92, on surfaces 0e0`.
impl fmt::Display for Quality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let off = (self.surface.iter()).fold(0.0, |most: f64, surface| {
            most.max(surface.max_distance_over_spacing)
        });
        write!(
            f,
            "L∞ {:.4}, residual {:.1e}, closest pair {:.2}, on surfaces {off:.0e}",
            self.density.linf, self.residual.max, self.closest_pair_over_spacing
        )
    }
}

impl<const D: usize> Fields<D> {
    /// Γ and ∇Γ of the particles for which `is_measured` holds; zero for the others, which are sources only.
    /// Volumes: one per particle. O(n log n), parallel. Neighbours are listed for some two million particles at a time.
    pub fn measure(
        domain: &Domain<D>,
        positions: &[[f64; D]],
        volumes: &[f64],
        is_measured: impl Fn(usize) -> bool + Sync,
        kernel: KernelKind,
        smoothing_length: f64,
    ) -> Self {
        let sizes = Sizes::uniform(smoothing_length, 1.0);
        Self::measure_each(domain, positions, volumes, sizes, is_measured, kernel)
    }

    /// [`Fields::measure`] of particles that differ in size, each by its own h.
    pub fn measure_each(
        domain: &Domain<D>,
        positions: &[[f64; D]],
        volumes: &[f64],
        sizes: Sizes,
        is_measured: impl Fn(usize) -> bool + Sync,
        kernel: KernelKind,
    ) -> Self {
        let fields = Self {
            kernel,
            sizes,
            gamma: vec![0.0; positions.len()],
            gradient: vec![[0.0; D]; positions.len()],
        };
        fields.measured(domain, positions, volumes, is_measured, slabs::MOST)
    }

    /// The fields filled in, `most` particles at a time.
    fn measured(
        mut self,
        domain: &Domain<D>,
        positions: &[[f64; D]],
        volumes: &[f64],
        is_measured: impl Fn(usize) -> bool + Sync,
        most: usize,
    ) -> Self {
        let (kernel, relative) = (self.kernel, self.sizes.relative());
        let h = self.sizes.smallest_smoothing_length();
        let largest = relative.map_or(1.0, |over| over.iter().copied().fold(0.0, f64::max));
        let reach = kernel.support_over_h() * h * largest;
        for Slab { order, is_inside } in slabs::slabs(domain, positions, reach, most) {
            let positions: Vec<[f64; D]> = order.iter().map(|&i| positions[i]).collect();
            let volumes: Vec<f64> = order.iter().map(|&i| volumes[i]).collect();
            let mut forces = Forces::new(domain, kernel, h, 0.0, Repulsion::none());
            let is_target = |k: usize| is_inside[k] && is_measured(order[k]);
            let relative: Option<Vec<f64>> =
                relative.map(|over| order.iter().map(|&i| over[i]).collect());
            forces.evaluate_each(&positions, &volumes, relative.as_deref(), is_target);
            for (k, &i) in order.iter().enumerate() {
                if is_target(k) {
                    self.gamma[i] = forces.gamma(k);
                    self.gradient[i] = forces.gradient(k);
                }
            }
        }
        self
    }
    /// h_i |∇Γ_i|, dimensionless.
    pub fn residual(&self, i: usize) -> f64 {
        self.sizes.smoothing_length(i) * point::norm(self.gradient[i])
    }
}

impl DensityQuality {
    /// The figures of some particles' Γ; `lattice` is Γ of the perfect lattice. All zero for no particles.
    pub fn of(gamma: &[f64], lattice: f64) -> Self {
        let n = gamma.len().max(1) as f64;
        let (min, max) = gamma
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), &g| {
                (min.min(g), max.max(g))
            });
        if gamma.is_empty() {
            return Self {
                min: 0.0,
                max: 0.0,
                linf: 0.0,
                linf_lattice: 0.0,
                total_variation: 0.0,
                rms: 0.0,
                lattice,
            };
        }
        Self {
            min,
            max,
            linf: (max - 1.0).max(1.0 - min),
            linf_lattice: (max - lattice).max(lattice - min),
            total_variation: max - min,
            rms: (blocked_sum(gamma, |g| (g - 1.0) * (g - 1.0)) / n).sqrt(),
            lattice,
        }
    }
}

impl ResidualQuality {
    /// The figures of the free particles' residuals, and the largest tangential one of the boundary particles.
    pub fn of(free: &[f64], max_tangential: f64) -> Self {
        let n = free.len().max(1) as f64;
        Self {
            max: largest(free.len(), |i| free[i]),
            rms: (blocked_sum(free, |r| r * r) / n).sqrt(),
            mean: blocked_sum(free, |&r| r) / n,
            max_tangential,
        }
    }
}

/// How evenly points are spread: the distance from each to the nearest other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spacing {
    /// Mean, scene units; 0 for fewer than two points.
    pub mean: f64,
    /// Coefficient of variation.
    pub cv: f64,
}

impl Spacing {
    /// Of the points for which `is_asked` holds, others being neighbours only; each point's distance divided by what `size` says.
    /// O(n log n), parallel.
    pub fn of_some<const D: usize>(
        points: &[[f64; D]],
        is_asked: impl Fn(usize) -> bool + Sync,
        size: impl Fn(usize) -> f64 + Sync,
    ) -> Self {
        let Ok(tree) = KdTree::new(points) else {
            return Self { mean: 0.0, cv: 0.0 };
        };
        let distances: Vec<f64> = (0..points.len())
            .into_par_iter()
            .with_min_len(256)
            .filter(|&i| is_asked(i))
            .filter_map(|i| {
                let nearest = tree.nearest_n(points[i], 2);
                nearest.get(1).map(|hit| hit.distance / size(i))
            })
            .collect();
        let n = distances.len().max(1) as f64;
        let mean = blocked_sum(&distances, |&s| s) / n;
        let variance = blocked_sum(&distances, |s| (s - mean) * (s - mean)) / n;
        let cv = if mean > 0.0 {
            variance.sqrt() / mean
        } else {
            0.0
        };
        Self { mean, cv }
    }
}

impl<const D: usize> Packed<D> {
    /// Γ and ∇Γ of all but the frozen particles, by the kernel and h/∆s given (which need not be those that packed).
    /// Frozen particles support a kernel as far as the packing's own reached.
    pub fn fields(&self, kernel: KernelKind, h_over_spacing: f64) -> Fields<D> {
        Fields::measure_each(
            &self.domain,
            &self.particles.position,
            &self.particles.volume,
            self.particles
                .sizes
                .clone()
                .with_h_over_spacing(h_over_spacing),
            |i| self.particles.kind[i] != Kind::Frozen,
            kernel,
        )
    }

    /// Every measure of the packing, by the kernel that packed.
    pub fn quality(&self) -> Quality {
        self.quality_by(&self.fields(self.kernel, self.h_over_spacing))
    }

    /// Every measure of the packing, from its [`Packed::fields`].
    pub fn quality_by(&self, fields: &Fields<D>) -> Quality {
        let particles = &self.particles;
        let of_kind = |wanted: fn(Kind) -> bool| {
            (0..particles.len()).filter(move |&i| wanted(particles.kind[i]))
        };
        let gamma: Vec<f64> = of_kind(|kind| kind != Kind::Frozen)
            .map(|i| fields.gamma[i])
            .collect();
        let free: Vec<f64> = of_kind(|kind| kind == Kind::Free)
            .map(|i| fields.residual(i))
            .collect();
        let max_tangential = largest(self.on_surface.len(), |k| {
            let SurfaceParticle { particle, hit } = self.on_surface[k];
            if particles.kind[particle] != Kind::Boundary {
                return 0.0;
            }
            let along = point::reject(fields.gradient[particle], hit.normal);
            fields.sizes.smoothing_length(particle) * point::norm(along)
        });
        let h_over_spacing = fields.sizes.smallest_smoothing_length() / self.spacing;
        let is_graded = particles.sizes.relative().is_some();
        let is_asked = |i: usize| particles.kind[i] != Kind::Frozen;
        let (places, volumes) = (&particles.position, &particles.volume);
        let likely = 2.0 * self.spacing;
        let (pair, closest) = if is_graded {
            let pair = ClosestPair::by_size(
                &self.domain,
                places,
                volumes,
                is_asked,
                likely,
                NEIGHBORS_IN_SIZES,
            );
            (pair, pair.crowded)
        } else {
            let pair = ClosestPair::of(&self.domain, places, volumes, is_asked, likely);
            (pair, pair.distance / self.spacing)
        };
        Quality {
            density: DensityQuality::of(&gamma, self.lattice.gamma(fields.kernel, h_over_spacing)),
            residual: ResidualQuality::of(&free, max_tangential),
            surface: (self.surfaces.iter().zip(&self.bodies).zip(0_u16..))
                .map(|((surface, name), body)| self.surface_quality(surface, name, body))
                .collect(),
            closest_pair_over_spacing: closest,
            crowded: pair.crowded,
            crowded_at: if pair.crowded.is_finite() {
                pair.place.to_vec()
            } else {
                Vec::new()
            },
        }
    }

    fn surface_quality(
        &self,
        surface: &ParticleSurface<D>,
        name: &str,
        body: u16,
    ) -> SurfaceQuality {
        let particles = &self.particles;
        let own: Vec<SurfaceParticle<D>> = (self.on_surface.iter())
            .filter(|seat| particles.on_surface(seat.particle) == Some(body))
            .copied()
            .collect();
        let on: Vec<[f64; D]> = (own.iter())
            .map(|seat| particles.position[seat.particle])
            .collect();
        // Fixed particles in the middle of a thin part are on no surface.
        let farthest = largest(own.len(), |k| match particles.kind[own[k].particle] {
            Kind::Boundary => own[k].hit.distance.abs(),
            _ => 0.0,
        });
        // In thin parts particles sit farther apart on purpose.
        let is_thick: Vec<bool> = (own.par_iter().with_min_len(64))
            .map(|seat| {
                let spacing = particles.sizes.spacing(seat.particle);
                let thickness = thickness(surface.surface.as_ref(), &seat.hit, spacing);
                thickness >= 0.999 * spacing
            })
            .collect();
        let over_finest = |k: usize| particles.sizes.over_finest(own[k].particle);
        let spacing = Spacing::of_some(&on, |i| is_thick[i], over_finest);
        SurfaceQuality {
            body: name.to_owned(),
            measure: surface.surface.measure(),
            target_count: surface.target_count,
            count: on.len(),
            max_distance_over_spacing: farthest / self.spacing,
            spacing_mean_over_spacing: spacing.mean / self.spacing,
            spacing_cv: spacing.cv,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Lattice;
    use sphpack_neighbors::Bounds;

    /// A shaken lattice, on a torus or not: slabs see what the whole sees.
    #[test]
    fn slabs_change_nothing() {
        let bounds = Bounds::new([0.0; 3], [14.0, 9.0, 9.0]);
        let mut positions = Lattice::Bcc.fill(bounds, 1.0).sites();
        for (i, p) in positions.iter_mut().enumerate() {
            p[0] = (p[0] + 0.2 * (i as f64).sin()).clamp(0.0, 14.0);
            p[1] += 0.1 * (3.0 * i as f64).sin();
        }
        let volumes: Vec<f64> = (0..positions.len())
            .map(|i| 1.0 + 0.1 * (i as f64).cos())
            .collect();
        for periodic in [true, false] {
            let domain = Domain {
                bounds,
                periodic: [periodic; 3],
            };
            let of = |most: usize| {
                let blank = Fields {
                    kernel: KernelKind::Quintic,
                    sizes: Sizes::uniform(1.0, 1.2),
                    gamma: vec![0.0; positions.len()],
                    gradient: vec![[0.0; 3]; positions.len()],
                };
                let is_measured = |i: usize| !i.is_multiple_of(7);
                blank.measured(&domain, &positions, &volumes, is_measured, most)
            };
            let (whole, parts) = (of(usize::MAX), of(300));
            for i in 0..positions.len() {
                assert!((whole.gamma[i] - parts.gamma[i]).abs() < 1e-13);
                assert!(point::distance(whole.gradient[i], parts.gradient[i]) < 1e-13);
                assert_eq!(parts.gamma[i] == 0.0, i.is_multiple_of(7));
            }
        }
    }
}
