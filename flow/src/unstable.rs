//! When a run can go on no longer.

use sphpack_neighbors::point;

use crate::particles::Particles;

/// A particle is faster than sound: a weakly compressible flow has no meaning from here on.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "particle {id} is faster than sound at step {step} (t = {time}); take a smaller time step, a greater speed of sound, or look \
     for particles that lie on one another at the start"
)]
pub struct Unstable {
    /// The particle.
    pub id: u32,
    /// The step.
    pub step: usize,
    /// The time at its beginning.
    pub time: f64,
}

impl Unstable {
    /// Finds the first particle of the fluid that is too fast.
    pub(crate) fn look<const D: usize>(
        particles: &Particles<D>,
        sound_speed: f64,
        step: usize,
        time: f64,
    ) -> Result<(), Self> {
        let most = sound_speed * sound_speed;
        let slow = |&u: &[f64; D]| point::norm_squared(u) <= most;
        // What is no number is not slow.
        match particles.velocity[..particles.fluid]
            .iter()
            .position(|u| !slow(u))
        {
            Some(i) => Err(Self {
                id: particles.id[i],
                step,
                time,
            }),
            None => Ok(()),
        }
    }
}
