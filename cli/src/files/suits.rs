//! Whether a format can hold what a scene asks for, as far as that is known before anything is packed.

use std::path::Path;

use sphpack_packing::Kind;

use super::ParticleFormat;
use super::reload::FLUID;
use crate::Error;
use crate::scene::{Masses, Role, Scene};

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
        let periodic = scene.domain.periodic.iter().flatten();
        if self == Self::Bi4 && periodic.copied().any(|is| is) {
            return refuse(
                "DualSPHysics takes a period from where particles are, which is not the period of packed ones; leave domain.periodic out, or choose another format"
                    .to_owned(),
            );
        }
        let has_frozen = scene.includes(Kind::Frozen) || scene.output.surroundings.is_some();
        if self == Self::Bi4 && has_frozen {
            return refuse(
                "DualSPHysics has one mass for the fluid, and frozen particles have one of their own; leave \"frozen\" out of output.include, and output.surroundings, or choose another format"
                    .to_owned(),
            );
        }
        let on_voids = (scene.body.iter())
            .find(|body| body.role == Role::Void && body.surface.0 == 0.0 && scene.fluid.fill);
        if let Some(body) = on_voids.filter(|_| self == Self::Bi4) {
            return refuse(format!(
                "DualSPHysics has one mass for the fluid, and its particles on the exact surface of \"{}\" have less; write surface = \"inset\", or choose another format",
                body.name
            ));
        }
        let walled =
            (scene.body.iter()).find(|body| body.role == Role::Container && body.layers.is_some());
        if let Some(body) = walled.filter(|_| self == Self::Bi4 && scene.fluid.fill) {
            return refuse(format!(
                "DualSPHysics has one mass for the fluid, and its first particles beside the wall of \"{}\" have one of their own; leave layers out, or choose another format",
                body.name
            ));
        }
        let mut bodies = scene.body.iter().map(|body| body.name.as_str());
        let is_reload = matches!(self, Self::Reload | Self::ReloadBody);
        if is_reload && bodies.any(|name| name == FLUID) {
            return refuse(format!(
                "a body is called \"{FLUID}\", as the fluid is in this file; give the body another name"
            ));
        }
        Ok(())
    }

    /// What has only one mass, where that is all a format knows.
    fn one_mass_per(self) -> Option<&'static str> {
        match self {
            Self::Lammps => Some("LAMMPS has one mass per type of atoms"),
            Self::Bi4 => Some("DualSPHysics has one mass for the fluid and one for boundaries"),
            _ => None,
        }
    }
}
