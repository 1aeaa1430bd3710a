//! The state of particles that are captured by surfaces.

use std::io::{self, Write};

use crate::particles::Particles;
use crate::state::{Damaged, State, load_as_many};

/// Particles that come to belong to one of so many bodies when they are captured.
pub(crate) struct Captured<'a, const D: usize> {
    pub(crate) particles: &'a mut Particles<D>,
    pub(crate) bodies: usize,
}

impl<const D: usize> State for Captured<'_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.particles.save(out)?;
        self.particles.body.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.particles.load(from)?;
        load_as_many(&mut self.particles.body, from)?;
        let mut bodies = self.particles.body.iter().flatten();
        (bodies.all(|&body| usize::from(body) < self.bodies))
            .then_some(())
            .ok_or(Damaged)
    }
}
