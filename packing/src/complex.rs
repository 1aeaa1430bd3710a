//! Complex relaxation of paper 004 §2.3: bodies as in separate relaxation, the fluid against their particles.

use crate::confined::Confined;
use crate::observer::Observer;
use crate::packed::Packed;
use crate::problem::{PackingError, Problem};
use crate::relaxation::{Interface, Relaxation};

/// The paper's complex relaxation (004 §2.3), in the plane and in space.
///
/// In each step the bodies move first, each alone as in [`Relaxation`]; then the fluid, which sees the bodies' particles
/// where separate relaxation has confinement (eq. 12). The coupling is one-way: bodies do not see the fluid. Which h
/// holds between a fluid and a solid particle the paper does not say; here the fluid's.
///
/// The fluid is bounded "onto the non-contact surface" only (algorithm 1, line 14): a bound ∆s/2 outside of the bodies,
/// as separate relaxation has, would hold the first layer back with h |Σ V ∇W| up to 0.08. It is kept out of the
/// bodies, φ > 0 (eq. 11), which holds back no more than a particle in a notch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Complex {
    /// How bodies and fluid relax.
    pub relaxation: Relaxation,
}

impl Complex {
    /// Packs the problem.
    ///
    /// # Errors
    /// Those of [`Relaxation::pack`].
    pub fn pack<const D: usize>(
        &self,
        problem: &Problem<D>,
        observer: &mut dyn Observer,
    ) -> Result<Packed<D>, PackingError> {
        self.relaxation
            .relax(problem, observer, Interface::Particles)
    }
}

/// Moves what the fluid sees of the solids, the last of its particles, to where these are now.
pub(crate) fn see<const D: usize>(fluid: &mut Confined<'_, D>, solids: &[Confined<'_, D>]) {
    let count: usize = solids.iter().map(|solid| solid.particles.len()).sum();
    let begin = fluid.particles.len() - count;
    let now = solids.iter().flat_map(|solid| &solid.particles.position);
    for (seen, now) in fluid.particles.position[begin..].iter_mut().zip(now) {
        *seen = *now;
    }
}
