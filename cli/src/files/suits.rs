//! Whether a format can hold what a scene asks for, as far as that is known before anything is packed.

use std::path::Path;

use super::ParticleFormat;
use crate::Error;
use crate::scene::{Masses, Scene};

impl ParticleFormat {
    /// Refuses scenes whose particles cannot be written in this format.
    ///
    /// # Errors
    /// [`Error::Input`] with what it cannot hold, and the cure.
    pub(crate) fn refuse_unsuited(self, path: &Path, scene: &Scene) -> Result<(), Error> {
        let refuse = |message: String| Err(Error::input(path, message));
        if let Some(holder) = self.one_mass_per() {
            let differ = "make the mass of every particle its own";
            if scene.packing.masses == Masses::Corrected {
                return refuse(format!(
                    "{holder}, and corrected masses {differ}; write packing.masses = \"equal\", or another format"
                ));
            }
            if scene.refinement.is_some() {
                return refuse(format!(
                    "{holder}, and [refinement] makes particles differ in size and mass; leave it out, or choose another format"
                ));
            }
            if scene.fluid.hydrostatic.is_some() {
                return refuse(format!(
                    "{holder}, and the densities of fluid.hydrostatic {differ}; leave it out, or choose another format"
                ));
            }
        }
        Ok(())
    }

    /// What has only one mass, where that is all a format knows.
    fn one_mass_per(self) -> Option<&'static str> {
        match self {
            Self::Lammps => Some("LAMMPS has one mass per type of atoms"),
            _ => None,
        }
    }
}
