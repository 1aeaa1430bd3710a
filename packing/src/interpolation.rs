//! How well particles interpolate a function between their places.
//!
//! Most of an interpolation's error is the kernel's own smoothing, which a perfect lattice has too. So the error is told as
//! a ratio: that of the particles over that of the lattice that they began on, at the same places, by the same kernel.

use rayon::prelude::*;
use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{Bounds, Domain, KdTree, point};

use crate::lattice::Lattice;
use crate::packed::Packed;

/// The part of ∆s by which a regular mesh is moved, axis by axis, so that no site of any lattice is there: on its own sites a
/// lattice interpolates better than anywhere else.
pub const MOVED: [f64; 3] = [0.381_966, 0.236_068, 0.145_898];

/// The longest edge of the box in the unit of [`Wave`]: the phase then goes up to 4 … 12 in it, and a wave is ten particles
/// long or more wherever an edge has thirty of them.
const EDGE_OF_BOX: f64 = 4.0;

/// The function sin(∣p − center∣²/unit²), whose waves become shorter outward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave<const D: usize> {
    /// Where it is even.
    pub center: [f64; D],
    /// The length for which the phase is 1.
    pub unit: f64,
}

impl<const D: usize> Wave<D> {
    /// The one that fits a box of any size.
    pub fn in_box(bounds: Bounds<D>) -> Self {
        let longest = bounds.size().into_iter().fold(0.0, f64::max);
        Self {
            center: bounds.center(),
            unit: longest / EDGE_OF_BOX,
        }
    }

    /// Its value, and its derivative along the first axis.
    pub fn at(&self, p: [f64; D]) -> [f64; 2] {
        let apart = point::sub(p, self.center).map(|x| x / self.unit);
        let phase = point::norm_squared(apart);
        [phase.sin(), 2.0 * apart[0] / self.unit * phase.cos()]
    }
}

/// Particles that interpolate: ⟨f⟩ = Σ V f W.
#[derive(Debug)]
pub struct Interpolant<'a, const D: usize> {
    tree: Option<KdTree<D>>,
    positions: &'a [[f64; D]],
    volumes: &'a [f64],
}

impl<'a, const D: usize> Interpolant<'a, D> {
    /// Of these particles, a volume for each.
    pub fn new(positions: &'a [[f64; D]], volumes: &'a [f64]) -> Self {
        Self {
            tree: KdTree::new(positions).ok(),
            positions,
            volumes,
        }
    }

    /// ⟨f⟩ and ⟨∂f/∂x⟩ at a place.
    pub fn at<K: Kernel<D>>(&self, kernel: &K, wave: &Wave<D>, p: [f64; D]) -> [f64; 2] {
        let Some(tree) = &self.tree else {
            return [0.0; 2];
        };
        let (mut value, mut slope) = (0.0, 0.0);
        for found in tree.within(p, kernel.support()) {
            let j = found.index;
            let apart = point::sub(p, self.positions[j]);
            let of_j = self.volumes[j] * wave.at(self.positions[j])[0];
            value += of_j * kernel.value(found.distance);
            slope += of_j * kernel.gradient(apart)[0];
        }
        [value, slope]
    }

    /// What [`Interpolant::at`] gives less the function itself, at many places.
    pub fn errors<K: Kernel<D>>(
        &self,
        kernel: &K,
        wave: &Wave<D>,
        places: &[[f64; D]],
    ) -> Vec<[f64; 2]> {
        let error = |&p: &[f64; D]| {
            let (own, exact) = (self.at(kernel, wave, p), wave.at(p));
            [own[0] - exact[0], own[1] - exact[1]]
        };
        (places.par_iter().with_min_len(64)).map(error).collect()
    }
}

/// Root mean squares of errors of the function and of its derivative.
pub fn rms(errors: &[[f64; 2]]) -> [f64; 2] {
    let n = errors.len().max(1) as f64;
    [0, 1].map(|k| (errors.iter().map(|e| e[k] * e[k]).sum::<f64>() / n).sqrt())
}

/// An error over the lattice's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ratio<const D: usize> {
    /// The root mean square over the box, over the same of the packing's own lattice, undisturbed; 1 is as good as that.
    pub over_lattice: f64,
    /// Where the error is more than the lattice's by most.
    pub worst_at: [f64; D],
}

/// How well a packing interpolates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpolation<const D: usize> {
    /// Of [`Wave::in_box`].
    pub function: Ratio<D>,
    /// Of its derivative along the first axis.
    pub derivative: Ratio<D>,
}

impl<const D: usize> Packed<D> {
    /// How well it interpolates by a kernel, at the nodes of a mesh off all sites: farther from periodic sides than the
    /// kernel reaches, as the function is not periodic. `None` where no node is left, or particles differ in size.
    /// O(n log n), parallel: some seconds for 100,000 particles in space.
    pub fn interpolation(
        &self,
        kernel: KernelKind,
        h_over_spacing: f64,
    ) -> Option<Interpolation<D>> {
        if self.particles.sizes.relative().is_some() {
            return None;
        }
        kernel.with(h_over_spacing * self.spacing, Measured(self))
    }
}

/// Asks a kernel how well a packing interpolates.
struct Measured<'a, const D: usize>(&'a Packed<D>);

impl<const D: usize> WithKernel<D> for Measured<'_, D> {
    type Output = Option<Interpolation<D>>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        let packed = self.0;
        let wave = Wave::in_box(packed.domain.bounds);
        let nodes = nodes(&packed.domain, packed.spacing, kernel.support());
        if nodes.is_empty() {
            return None;
        }
        let particles = &packed.particles;
        let own = Interpolant::new(&particles.position, &particles.volume);
        let own = own.errors(&kernel, &wave, &nodes);
        let lattice = packed.frozen_lattice;
        let mut sites = lattice.sites();
        let around = Domain {
            periodic: [false; D],
            ..packed.domain
        };
        sites.extend(lattice.continued(&around, 1.01 * kernel.support()));
        let volumes = vec![lattice.volume_per_site(); sites.len()];
        let floor = Interpolant::new(&sites, &volumes).errors(&kernel, &wave, &nodes);
        let [function, derivative] = [0, 1].map(|k| {
            let excess = |i: usize| own[i][k].abs() - floor[i][k].abs();
            let worst = (0..nodes.len()).max_by(|&a, &b| excess(a).total_cmp(&excess(b)));
            Ratio {
                over_lattice: rms(&own)[k] / rms(&floor)[k],
                worst_at: worst.map_or([0.0; D], |i| nodes[i]),
            }
        });
        Some(Interpolation {
            function,
            derivative,
        })
    }
}

/// The nodes of a square or cubic mesh off all sites, `clear` of periodic sides.
fn nodes<const D: usize>(domain: &Domain<D>, spacing: f64, clear: f64) -> Vec<[f64; D]> {
    let mesh = if D == 2 {
        Lattice::Square
    } else {
        Lattice::SimpleCubic
    };
    let bounds = domain.bounds;
    let is_asked = |p: &[f64; D]| {
        (0..D).all(|k| {
            let room = if domain.periodic[k] { clear } else { 0.0 };
            p[k] >= bounds.min[k] + room && p[k] <= bounds.max[k] - room
        })
    };
    (mesh.fill(bounds, spacing).sites().into_iter())
        .map(|p| std::array::from_fn(|k| p[k] + MOVED[k] * spacing))
        .filter(is_asked)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::Balanced;
    use crate::problem::Problem;

    fn lattice(periodic: [bool; 2], size: f64) -> Packed<2> {
        let domain = Domain::new([0.0; 2], [20.0 * size; 2]).with_periodic(periodic);
        Problem::new(domain, size)
            .pack(&Balanced::default())
            .unwrap()
    }

    #[test]
    fn an_undisturbed_lattice_is_its_own_floor_at_any_size() {
        for (periodic, size) in [([false; 2], 1e-3), ([false; 2], 50.0), ([true, false], 1.0)] {
            let found = lattice(periodic, size).interpolation(KernelKind::Quintic, 1.2);
            let found = found.unwrap();
            for ratio in [found.function, found.derivative] {
                assert!((ratio.over_lattice - 1.0).abs() < 1e-6, "{ratio:?}");
            }
        }
    }

    #[test]
    fn one_particle_off_its_site_is_found() {
        let mut packed = lattice([false; 2], 1.0);
        let i = (0..packed.particles.len())
            .min_by(|&a, &b| {
                let off = |i: usize| point::distance(packed.particles.position[i], [14.0, 9.0]);
                off(a).total_cmp(&off(b))
            })
            .unwrap();
        packed.particles.position[i][0] += 0.4;
        let found = packed.interpolation(KernelKind::Quintic, 1.2).unwrap();
        // One of 400, beside what the kernel smooths away; undisturbed it is 1 to 10⁻⁶.
        assert!(found.derivative.over_lattice > 1.001, "{found:?}");
        let off = point::distance(found.derivative.worst_at, [14.0, 9.0]);
        assert!(off < 3.0, "{found:?}");
    }

    #[test]
    fn a_box_that_kernels_fill_is_not_measured() {
        let domain = Domain::new([0.0; 2], [8.0; 2]).with_periodic([true; 2]);
        let packed = Problem::new(domain, 1.0)
            .pack(&Balanced::default())
            .unwrap();
        assert_eq!(packed.interpolation(KernelKind::Quintic, 1.6), None);
    }
}
