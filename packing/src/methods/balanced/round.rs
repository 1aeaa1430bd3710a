//! Where a round of the band begins.

use std::io::{self, Write};

use crate::finish::Uneven;
use crate::forces::Forces;
use crate::particles::Particles;
use crate::state::{Damaged, State, Value};

/// What settling begins with, as wide as the band is now. Before the first round particles are as they were placed.
pub(super) struct Round<'a, const D: usize> {
    pub(super) number: usize,
    pub(super) width: f64,
    pub(super) particles: &'a mut Particles<D>,
    pub(super) forces: &'a mut Forces<D>,
    /// Whether the last one came to rest, and where it left particles uneven.
    pub(super) is_at_rest: bool,
    pub(super) uneven: Uneven<D>,
}

impl<const D: usize> State for Round<'_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.number.save(out)?;
        self.width.save(out)?;
        if self.number > 0 {
            self.particles.save(out)?;
            self.forces.save(out)?;
            self.is_at_rest.save(out)?;
            self.uneven.put(out)?;
        }
        Ok(())
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.number.load(from)?;
        self.width.load(from)?;
        if self.number > 0 {
            self.particles.load(from)?;
            self.forces.load(from)?;
            self.is_at_rest.load(from)?;
            self.uneven = Uneven::take(from)?;
        }
        Ok(())
    }
}
