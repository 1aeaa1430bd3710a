//! How well particles interpolate a function: the study of Negi & Ramachandran (2021), figs. 13, 16 and 20.

use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::point;
use sphpack_packing::interpolation::{Interpolant, MOVED, Wave, rms};
use sphpack_packing::{Kind, Lattice, Packed};

/// Errors of f = sin(r²) and of its derivative along x.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    pub(crate) function: f64,
    pub(crate) derivative: f64,
}

impl Errors {
    /// Eq. 33 of both.
    fn of(errors: &[[f64; 2]]) -> Self {
        let [function, derivative] = rms(errors);
        Self {
            function,
            derivative,
        }
    }
}

/// The three judges.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Study {
    /// As printed: on a regular mesh, against the sum over the mesh's own points.
    pub(crate) printed: Errors,
    /// On a mesh moved by an irrational part of ∆s, against the function itself, over the same of the perfect lattice.
    pub(crate) off_sites: Errors,
    /// At the particles, against the function itself.
    pub(crate) at_particles: Errors,
}

/// Nearer to the middle than this part of the body's longest edge nobody looks: the flow does not (the paper, §4.1).
const MIDDLE: f64 = 0.45;

/// The study of a packing by a kernel at `h_over_spacing`.
pub(crate) fn study<const D: usize>(
    packed: &Packed<D>,
    kernel: KernelKind,
    h_over_spacing: f64,
) -> Study {
    kernel.with(h_over_spacing * packed.spacing, Studied(packed))
}

/// Asks a kernel how well a packing interpolates.
struct Studied<'a, const D: usize>(&'a Packed<D>);

impl<const D: usize> WithKernel<D> for Studied<'_, D> {
    type Output = Study;

    fn call<K: Kernel<D>>(self, kernel: K) -> Study {
        studied(self.0, &kernel)
    }
}

fn studied<const D: usize, K: Kernel<D>>(packed: &Packed<D>, kernel: &K) -> Study {
    let (domain, spacing) = (packed.domain, packed.spacing);
    let particles = &packed.particles;
    // f = sin(r²).
    let wave = Wave {
        center: [0.0; D],
        unit: 1.0,
    };
    let set = Interpolant::new(&particles.position, &particles.volume);
    // The regular mesh, as far as kernels at its points see.
    let lattice = if D == 2 {
        Lattice::Square
    } else {
        Lattice::SimpleCubic
    };
    let mesh = lattice.fill(domain.bounds, spacing);
    let mut sites = mesh.sites();
    let inner = sites.len();
    sites.extend(mesh.continued(&domain, 2.0 * kernel.support()));
    let volumes = vec![mesh.volume_per_site(); sites.len()];
    let regular = Interpolant::new(&sites, &volumes);
    let edge = (packed.surfaces.iter())
        .map(|surface| surface.surface.bounds().size())
        .map(|size| size.into_iter().fold(0.0, f64::max))
        .fold(0.0, f64::max);
    let is_asked = |p: &[f64; D]| point::norm(*p) > MIDDLE * edge && domain.bounds.contains(*p);
    let points: Vec<[f64; D]> = sites[..inner].iter().copied().filter(is_asked).collect();
    // Both less the function itself: what is left is the one less the other.
    let [own, reference] = [&set, &regular].map(|one| one.errors(kernel, &wave, &points));
    let apart: Vec<[f64; 2]> = (own.iter().zip(&reference))
        .map(|(own, reference)| [own[0] - reference[0], own[1] - reference[1]])
        .collect();
    let printed = Errors::of(&apart);
    let moved: Vec<[f64; D]> = (sites[..inner].iter())
        .map(|p| std::array::from_fn(|k| p[k] + MOVED[k] * spacing))
        .filter(is_asked)
        .collect();
    let against_itself = |set: &Interpolant<'_, D>, points: &[[f64; D]]| {
        Errors::of(&set.errors(kernel, &wave, points))
    };
    // The packing's own lattice, undisturbed, beside it.
    let own = packed.frozen_lattice;
    let mut perfect = own.sites();
    perfect.extend(own.continued(&domain, 2.0 * kernel.support()));
    let perfect_volumes = vec![own.volume_per_site(); perfect.len()];
    let perfect = Interpolant::new(&perfect, &perfect_volumes);
    let (ours, floor) = (
        against_itself(&set, &moved),
        against_itself(&perfect, &moved),
    );
    let at: Vec<[f64; D]> = (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen)
        .map(|i| particles.position[i])
        .filter(is_asked)
        .collect();
    Study {
        printed,
        off_sites: Errors {
            function: ours.function / floor.function,
            derivative: ours.derivative / floor.derivative,
        },
        at_particles: against_itself(&set, &at),
    }
}

#[cfg(test)]
mod tests {
    use sphpack_neighbors::Domain;
    use sphpack_packing::{Balanced, Problem};

    use super::*;

    /// A lattice is as good as itself, and its error at its own sites as printed is none.
    #[test]
    fn an_undisturbed_lattice_is_its_own_floor() {
        let domain = Domain::new([-2.0; 2], [2.0; 2]);
        let mut problem = Problem::new(domain, 0.1);
        problem.lattice = Some(Lattice::Square);
        let packed = problem.pack(&Balanced::default()).unwrap();
        let study = study(&packed, KernelKind::Quintic, 1.2);
        assert!(study.printed.function < 1e-12, "{study:?}");
        assert!((study.off_sites.derivative - 1.0).abs() < 1e-6, "{study:?}");
        assert!(study.at_particles.function > 1e-4, "{study:?}");
    }
}
