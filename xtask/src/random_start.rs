//! Particles that settle from random places of a periodic box, with no body in the way.

use sphpack_kernels::KernelKind;
use sphpack_neighbors::Domain;
use sphpack_neighbors::random::SplitMix64;
use sphpack_packing::forces::Forces;
use sphpack_packing::minimise::{Energy, Lbfgs, Minimiser, Step};
use sphpack_packing::{Kind, Particles, Sizes};
use sphpack_pairs::Repulsion;

/// Where and how long they settle. Lengths are in ∆s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RandomStart {
    pub(crate) kernel: KernelKind,
    pub(crate) h_over_spacing: f64,
    /// Of the box, which holds as many particles as it has room for.
    pub(crate) edge: usize,
    pub(crate) repulsion: Repulsion,
    /// The residual at which they count as settled.
    pub(crate) settled: f64,
    /// Evaluations after which they are looked at in any case.
    pub(crate) patience: usize,
    pub(crate) seed: u64,
}

impl RandomStart {
    /// The box and the particles in the end, by L-BFGS.
    pub(crate) fn run<const D: usize>(&self) -> (Domain<D>, Particles<D>) {
        let (edge, h) = (self.edge as f64, self.h_over_spacing);
        let domain = Domain::new([0.0; D], [edge; D]).with_periodic([true; D]);
        let mut random = SplitMix64::new(self.seed);
        let mut particles = Particles::new(Sizes::uniform(1.0, h));
        for _ in 0..self.edge.pow(D as u32) {
            let place = std::array::from_fn(|_| edge * random.unit());
            particles.push(place, Kind::Free, 1.0, None);
        }
        let forces = Forces::new(&domain, self.kernel, h, 0.3, self.repulsion);
        let reach = self.kernel.support_over_h() * h;
        let mut energy = Energy::new(&mut particles, &[], forces, reach);
        let mut minimiser = Lbfgs::default();
        while energy.residual() > self.settled && energy.evaluations() < self.patience {
            if minimiser.step(&mut energy) == Step::Stuck {
                break;
            }
        }
        drop(energy);
        (domain, particles)
    }
}
